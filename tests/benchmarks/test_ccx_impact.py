#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parts of benchmarks/ccx_impact that need no CalculiX: mesh, deck, reading of results, errors, rates, judgement."""
import pathlib
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "benchmarks"))
try:
    import numpy
    from ccx_common import RunError
    from ccx_impact_parts import calculix, results, runs
except ModuleNotFoundError as error:
    print(f"{error}: skipped")
    sys.exit(77)

ACROSS, ALONG = 2, 6


def write_velocities(values):
    """As CalculiX does, after energies of an earlier time."""
    lines = [f"{number:10} {0.0:13.6E} {0.0:13.6E} {value:13.6E}" for number, value in enumerate(values, 1)]
    head = " velocities (vx,vy,vz) for set ALL and time  "
    return f"\n{head}0.1E-03\n\n         1 9.0E+00 9.0E+00 9.0E+00\n\n{head}0.6000000E-03\n\n" + "\n".join(lines) + "\n"


class CalculixTest(unittest.TestCase):
    def test_cells_fill_the_bars(self):
        points, elements = calculix.make_bars(ACROSS, ALONG)
        corners = points[elements]
        self.assertTrue(numpy.allclose(corners.mean(axis=1) * 2, corners[:, 0] + corners[:, 6]))  # opposite corners
        edges = corners[:, [1, 3, 4]] - corners[:, [0]]
        volumes = numpy.linalg.det(edges)
        self.assertGreater(volumes.min(), 0.0)
        for volume in numpy.split(volumes, 2):
            self.assertAlmostEqual(volume.sum(), calculix.LENGTH * calculix.WIDTH ** 2)
        self.assertEqual(numpy.unique(elements).size, len(points))

    def test_faces_of_the_deck_are_those_that_meet(self):
        points, elements = calculix.make_bars(ACROSS, ALONG)
        faces = {"S1": (0, 1, 2, 3), "S2": (4, 5, 6, 7)}
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "impact.inp"
            calculix.write_deck(path, "C3D8", "NODE TO SURFACE", ACROSS, ALONG, 1e-3)
            text = path.read_text(encoding="ascii")
        for name, height in (("TOP", 0.0), ("BOTTOM", calculix.GAP)):
            listed = re.search(rf"\*SURFACE, NAME={name}\n((?:\d+,S\d\n)+)", text)[1].split()
            self.assertEqual(len(listed), ACROSS ** 2)
            for number, face in (line.split(",") for line in listed):
                corners = points[elements[int(number) - 1][list(faces[face])]]
                self.assertTrue(numpy.allclose(corners[:, 2], height, atol=1e-12), (name, number))

    def test_energies(self):
        text = "\n".join(f"\n total {kind} energy for set BARS and time  {time}\n\n        {energy}\n" for time, kind, energy in
                         (("0.1E-03", "internal", "1.5E+00"), ("0.1E-03", "kinetic", "1.8E+01"),
                          ("0.2E-03", "internal", "2.5E+00"), ("0.2E-03", "kinetic", "1.7E+01")))
        self.assertEqual(calculix.read_energies(text, "kinetic").tolist(), [[1e-4, 18.0], [2e-4, 17.0]])
        self.assertEqual(calculix.read_energies(text, "internal").tolist(), [[1e-4, 1.5], [2e-4, 2.5]])

    def test_mean_velocity_weighs_nodes_by_their_share(self):
        points, _ = calculix.make_bars(ACROSS, ALONG)
        lower, upper = numpy.split(points, 2)
        values = numpy.concatenate([3.0 + lower[:, 2] + lower[:, 0], 10.0 * (upper[:, 0] == 0.0)])
        self.assertTrue(numpy.allclose(calculix.read_velocities(write_velocities(values), ACROSS, ALONG),
                                       [3.0 - 0.5 + calculix.WIDTH / 2, 10.0 / (2 * ACROSS)], atol=1e-5))

    def test_steps_are_counted(self):
        for n_steps, step_of_rest in ((160, 1.0), (160, 0.4), (151, 1.0), (150, 1.0), (26, 1.0)):
            n_first = n_steps // 2 if step_of_rest < 1.0 else n_steps
            steps = numpy.where(numpy.arange(n_steps) < n_first, 1e-6, step_of_rest * 1e-6)
            steps[-1] *= 0.3
            times = numpy.cumsum(steps)
            printed = [*times[calculix.EVERY - 1:-1:calculix.EVERY], times[-1]]
            self.assertEqual(calculix.count_steps([float(f"{time:.6e}") for time in printed]), n_steps)
        with self.assertRaises(RunError):
            calculix.count_steps([1e-6])

    def test_numbers_are_those_of_the_parameter_file(self):
        text = (ROOT / "parameter_files/study/ccx_impact.prm").read_text(encoding="utf-8")
        width, gap = f"{calculix.WIDTH}, {calculix.WIDTH}", calculix.GAP
        for said in (f"Young's modulus = {calculix.YOUNGS_MODULUS / 1e11:.0f}e11", "Poisson's ratio = 0\n",
                     f"Density         = {calculix.DENSITY:.0f}", f"Lower corner = 0, 0, -{calculix.LENGTH:.0f}",
                     f"Upper corner = {width}, 0", f"Lower corner = 0, 0, {gap:.0e}".replace("e-04", "e-4"),
                     f"Upper corner = {width}, {gap + calculix.LENGTH}", f"Penalty factor = {2 * calculix.STIFFNESS}",
                     f"End time = {runs.TIMES['full']:.0e}".replace("e-04", "e-4")):
            self.assertIn(said, text)


class RunsTest(unittest.TestCase):
    def make_case(self, stepping, name="Signorini"):
        case = runs.Case(name, pathlib.Path("nowhere"), ACROSS, ALONG)
        case.steps, case.stepping, case.seconds = {"short": 100, "full": 1100}, stepping, {"full": 9.0}
        return case

    def test_errors_of_the_exact_motion_vanish(self):
        case = self.make_case([1.0])
        times = numpy.linspace(0.0, 6e-4, 31)
        kinetic = numpy.interp(times, [5e-5, 2.5e-4, 4.5e-4], [20.0, 0.0, 20.0])
        case.set_errors([-1.0, 1.0], times, kinetic, 20.0)
        for name, error in case.errors.items():
            self.assertAlmostEqual(error, 0.0, 12, name)
        longer = numpy.interp(times, [4e-5, 2.6e-4, 4.8e-4], [20.0, 0.0, 20.0])
        case.set_errors([-0.99, 1.01], times, longer, 20.2)
        for name, error in (("contact time", 0.1), ("velocity lower", -0.01), ("velocity upper", 0.01), ("energy", 0.01)):
            self.assertAlmostEqual(case.errors[name], error, 12, name)
        with self.assertRaises(RunError):
            case.set_errors([1.0, -1.0], times, 20.0 + 0 * times, 20.0)

    def test_rate_is_of_the_median_and_refused_for_short_runs(self):
        self.assertAlmostEqual(self.make_case([1.0, 9.0, 2.0]).rate, 2 * ACROSS ** 2 * ALONG * 1000 / 2.0)
        with self.assertRaises(RunError):
            _ = self.make_case([0.4]).rate

    def test_judgement(self):
        ours = self.make_case([1.0])
        said = results.judge([[ours, self.make_case([199.0], "A"), self.make_case([200.0], "B")]]).splitlines()
        self.assertTrue(said[0].endswith("A: 199 times, the aim of 200 is NOT reached"), said)
        self.assertTrue(said[1].endswith("B: 200 times, the aim of 200 is reached"), said)


if __name__ == "__main__":
    unittest.main()
