#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parts of benchmarks/ccx_hertz that need no CalculiX: meshes, deck, reading of results, choice of the cheapest."""
import itertools
import math
import pathlib
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "benchmarks"))
try:
    import numpy
    from ccx_hertz_parts import calculix, mesh, problem, results, runs
except ModuleNotFoundError as error:
    print(f"{error}: skipped")
    sys.exit(77)

RADIUS = 10.0
# Derivatives of the trilinear shape functions are taken at the corners of a hexahedron: its three edges there.
CORNER_EDGES = ((0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7), (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2),
                (7, 6, 4, 3))


KINDS = (mesh.make_mapped, mesh.make_shells)


def make_all(*elements, cells=4, growth=1.5):
    """(kind and element, octant) of each."""
    for make, element in itertools.product(KINDS, elements):
        yield (make.__name__, element), make(element, RADIUS, cells, 0.625, growth)


def tetrahedron_volumes(points):
    return numpy.linalg.det(points[:, 1:4] - points[:, :1]) / 6


class MeshTest(unittest.TestCase):
    def test_hexahedra_are_positive_at_all_corners(self):
        """On the mapped sphere two sides of bricks are one: there the corner is flat."""
        for name, octant in make_all("C3D8I", "C3D20R"):
            points = octant.points[octant.elements]
            on_sphere = numpy.isin(octant.elements, octant.boundaries["sphere"])
            for corner, *others in CORNER_EDGES:
                volumes = numpy.linalg.det(points[:, others] - points[:, [corner]])
                flat = on_sphere[:, [corner, *others]].all(axis=1)
                self.assertGreater(volumes[~flat].min(), 0.0, (name, corner))

    def test_volume_approaches_that_of_the_octant(self):
        exact = math.pi * RADIUS ** 3 / 6
        errors = {}
        for cells in (2, 4, 8):
            for name, octant in make_all("C3D10", cells=cells, growth=1 + 2 / cells):
                volumes = tetrahedron_volumes(octant.points[octant.elements])
                self.assertGreater(volumes.min(), 0.0, name)
                errors.setdefault(name, []).append(1 - volumes.sum() / exact)
        for name, of_kind in errors.items():
            for coarse, fine in zip(of_kind, of_kind[1:]):
                self.assertGreater(fine, 0.0)  # chords lie within the ball
                self.assertGreater(coarse / fine, 2.5, (name, of_kind))  # nearly of second order

    def test_no_node_is_there_twice_or_unused(self):
        for name, octant in make_all(*mesh.SHAPES):
            self.assertEqual(numpy.unique(octant.elements).size, len(octant.points), name)
            spacing = 0.625 / 4 / 2
            self.assertEqual(len(numpy.unique(numpy.round(octant.points / (0.01 * spacing)), axis=0)), len(octant.points))

    def test_faces_are_shared_by_two_elements_or_lie_on_one_boundary(self):
        for name, octant in make_all(*mesh.SHAPES):
            on = {name: set(nodes) for name, nodes in octant.boundaries.items()}
            count = {}
            for corners in octant.faces:
                for face in octant.elements[:, corners]:
                    key = frozenset(face)
                    count[key] = count.get(key, 0) + 1
            self.assertEqual(set(count.values()), {1, 2}, name)
            for face, times in count.items():
                self.assertEqual(times == 1, any(face <= nodes for nodes in on.values()), (name, face))

    def test_boundaries_hold_the_nodes_between_corners(self):
        for name, octant in make_all(*mesh.SHAPES):
            distance = numpy.linalg.norm(octant.points, axis=1)
            on_sphere = numpy.flatnonzero(abs(distance - RADIUS) < 1e-9)
            self.assertEqual(set(on_sphere), set(octant.boundaries["sphere"]), name)
            for axis, cut in enumerate("xyz"):
                on_cut = numpy.flatnonzero(octant.points[:, axis] == 0.0)
                self.assertEqual(set(on_cut), set(octant.boundaries[cut]), name)


class CalculixTest(unittest.TestCase):
    def test_result(self):
        contact = calculix.read_contact((HERE / "contact.dat").read_text(encoding="ascii"))
        self.assertEqual(contact, (932.6299, 175.5318, 7155.516))

    def test_hertz(self):
        modulus, force = 200e3 / 0.91, 3700.0
        radius = (0.75 * force * RADIUS / modulus) ** (1 / 3)
        peak = 1.5 * force / (math.pi * radius ** 2)
        r, angle = (numpy.arange(1000)[:, None] + 0.5) * radius / 1000, (numpy.arange(100) + 0.5) * math.pi / 200
        cells = radius / 1000 * math.pi / 200 * r
        pressures = peak * numpy.sqrt(1 - (r / radius) ** 2) * cells
        ratios = problem.over_hertz(force / 4, numpy.sum(pressures * r * numpy.cos(angle)), peak)
        self.assertAlmostEqual(ratios["peak pressure"], 1.0)
        self.assertAlmostEqual(ratios["contact radius"], 1.0, 4)
        self.assertAlmostEqual(ratios["approach"], problem.APPROACH * RADIUS / radius ** 2)

    def test_deck(self):
        octant = mesh.make_shells("C3D20R", RADIUS, 2, 0.625, 1.5)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "hertz.inp"
            calculix.write_deck(path, "C3D20R", octant, 1e6)
            lines = path.read_text(encoding="ascii").splitlines()
        start = lines.index("*ELEMENT, TYPE=C3D20R, ELSET=BALL") + 1
        self.assertEqual([len(line.rstrip(",").split(",")) for line in lines[start:start + 2]], [15, 6])
        faces = [line for line in lines if re.fullmatch(r"\d+,S\d", line)]
        self.assertGreaterEqual(len(faces), 2 * 2 + 1)

    def test_numbers_are_those_of_the_parameter_file(self):
        text = (ROOT / "parameter_files/study/ccx_hertz.prm").read_text(encoding="utf-8")
        for said in (f"Young's modulus = {problem.YOUNGS_MODULUS / 1e3:.0f}e9", f"Poisson's ratio = {problem.POISSONS_RATIO}",
                     f"set z = -{problem.APPROACH * 1e3:.0f}e-6*t", f"Radius                  = {problem.RADIUS / 1e3}"):
            self.assertIn(said, text)


class ChoiceTest(unittest.TestCase):
    def run_with(self, dofs, seconds, error, code="one"):
        return runs.Run(code, "series", f"run {dofs}", [], None, None, seconds, 1.0, dofs,
                        {"peak pressure": error, "contact radius": -error, "approach": 0.0})

    def test_luck_does_not_count(self):
        series = [self.run_with(1, 1.0, 0.001), self.run_with(2, 2.0, 0.05), self.run_with(3, 3.0, 0.009),
                  self.run_with(4, 4.0, 0.002)]
        self.assertIs(results.find_cheapest(series, 0.01), series[2])
        self.assertIs(results.find_cheapest(series, 0.1), series[0])
        self.assertIsNone(results.find_cheapest(series, 0.001))

    def test_ratio(self):
        ours, theirs = self.run_with(1, 2.0, 0.001, "Signorini"), self.run_with(1, 30.0, 0.001, "CalculiX")
        self.assertIn("CalculiX needs 15 times", results.describe([ours, theirs]))


if __name__ == "__main__":
    unittest.main()
