# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two bars that collide as a CalculiX deck (m, kg, s), as in parameter_files/study/ccx_impact.prm, and what a run gave."""
import math
import re

import numpy

from ccx_common import HEXAHEDRON_CORNERS, RunError, numbered

LENGTH, WIDTH, GAP = 1.0, 0.05, 1e-4
YOUNGS_MODULUS, DENSITY = 2e11, 8000.0
STIFFNESS = 0.2  # of the contact, in E/h
EVERY = 25  # steps from one line of energies to the next


def make_bars(across, along):
    """Points of both bars, n x 3, lower first, and the nodes of their elements from 0, in CalculiX's order."""
    width = numpy.linspace(0.0, WIDTH, across + 1)
    points, elements = [], []
    for start in (-LENGTH, GAP):
        z, y, x = numpy.meshgrid(numpy.linspace(start, start + LENGTH, along + 1), width, width, indexing="ij")
        points.append(numpy.stack([x, y, z], axis=-1).reshape(-1, 3))
        numbers = len(elements) * x.size + numpy.arange(x.size).reshape(x.shape)
        ends = [slice(0, -1), None, slice(1, None)]  # by the half cells of the corners
        elements.append(numpy.stack([numbers[ends[c], ends[b], ends[a]].ravel() for a, b, c in HEXAHEDRON_CORNERS], axis=1))
    return numpy.vstack(points), numpy.vstack(elements)


def write_deck(path, element, contact, across, along, end_time):
    """contact: NODE TO SURFACE or SURFACE TO SURFACE. CalculiX chooses the time step: told to keep the given one (DIRECT),
    version 2.20 takes steps of 0 s and never ends."""
    points, elements = make_bars(across, along)
    n_nodes, n_cells, face = len(points) // 2, len(elements) // 2, across * across
    lines = ["*NODE, NSET=ALL", *numbered(points, "{:.15g}")]
    lines += [f"*ELEMENT, TYPE={element}, ELSET=BARS", *numbered(elements + 1, "{}")]
    lines += ["*NSET, NSET=LOWER, GENERATE", f"1,{n_nodes}", "*NSET, NSET=UPPER, GENERATE", f"{n_nodes + 1},{2 * n_nodes}"]
    lines += ["*SURFACE, NAME=TOP", *(f"{number},S2" for number in range(n_cells - face + 1, n_cells + 1))]
    lines += ["*SURFACE, NAME=BOTTOM", *(f"{number},S1" for number in range(n_cells + 1, n_cells + face + 1))]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{YOUNGS_MODULUS},0.", "*DENSITY", f"{DENSITY}",
              "*SOLID SECTION, ELSET=BARS, MATERIAL=STEEL", "*SURFACE INTERACTION, NAME=LAW",
              "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{STIFFNESS * YOUNGS_MODULUS * along / LENGTH:.9g},1e-3",
              f"*CONTACT PAIR, INTERACTION=LAW, TYPE={contact}", "BOTTOM,TOP",
              "*INITIAL CONDITIONS, TYPE=VELOCITY", "LOWER,3,1.", "UPPER,3,-1.",
              "*STEP, INC=1000000", "*DYNAMIC, EXPLICIT", f"1e-6,{end_time}",
              f"*EL PRINT, ELSET=BARS, TOTALS=ONLY, FREQUENCY={EVERY}", "ELSE,ELKE",
              f"*NODE PRINT, NSET=ALL, FREQUENCY={EVERY}", "V", "*END STEP"]  # CalculiX has one frequency for both
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def read_energies(text, kind):
    """Times and energies of the .dat file, n x 2; kind: internal or kinetic."""
    return numpy.array(re.findall(rf"total {kind} energy for set BARS and time\s+(\S+)\s+(\S+)", text), dtype=float)


def count_steps(times):
    """All steps, from the times of every EVERY-th and of the last one, if the last of them are equal but for the very last.
    RunError: too few of them."""
    if len(times) < 2:
        raise RunError(f"CalculiX took fewer than {EVERY} steps, which are too few to count; take more --cells")
    *_, before, last, end = 0.0, *times
    return EVERY * (len(times) - 1) + math.ceil((end - last) / (last - before) * EVERY - 0.01)  # of digits lost


def read_velocities(text, across, along):
    """Mean velocities of the lower and the upper bar along z: of the last velocities in the .dat file."""
    rows = [line.split() for line in text.rsplit("velocities (vx,vy,vz)", 1)[1].splitlines()[1:]]
    nodal = numpy.array([float(row[3]) for row in rows if len(row) == 4])
    nodal = nodal.reshape(2, along + 1, across + 1, across + 1)
    for axis, count in ((1, along), (2, across), (3, across)):
        weights = numpy.ones(count + 1) / count
        weights[[0, -1]] /= 2
        nodal = nodal * weights.reshape([-1 if axis == here else 1 for here in range(4)])
    return nodal.sum(axis=(1, 2, 3))
