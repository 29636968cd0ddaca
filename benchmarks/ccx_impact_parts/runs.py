# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs of both codes on one mesh: a short and a full one in turns, whose difference is the cost of the steps."""
import csv
import json
import statistics

import numpy

from ccx_common import RunError, execute, signorini_command

from . import calculix

TIMES = {"short": 4e-5, "full": 6e-4}  # the bars meet at 5e-5
N_ROWS = 30  # of statistics in the full run of Signorini: about as many as CalculiX writes lines of energies
LEVEL = 0.75  # of the kinetic energy, which falls and rises linearly: below it for this share of the contact time
CONTACT_TIME, ENERGY = 4e-4, 20.0
LEAST = 0.5  # core-seconds of the timed steps: the start of Signorini alone varies by about 0.05


class Case:
    """One code with one set of options on one mesh; seconds, steps and errors of its last runs by kind of run, and the
    core-seconds of the timed steps of every pair of them."""

    def __init__(self, name, folder, across, along):
        self.name, self.folder, self.across, self.along = name, folder, across, along
        self.seconds, self.steps, self.errors, self.stepping = {}, {}, {}, []

    @property
    def n_cells(self):
        return 2 * self.across ** 2 * self.along

    @property
    def element_steps(self):
        return self.n_cells * (self.steps["full"] - self.steps["short"])

    @property
    def median_stepping(self):
        return statistics.median(self.stepping)

    @property
    def rate(self):
        """Element steps per core-second. RunError: the steps took too little to be told from the start of the program."""
        if self.median_stepping < LEAST:
            raise RunError(f"{self.name}: the timed steps took {self.median_stepping:.3f} core-seconds, fewer than {LEAST}: "
                           "nothing can be said of their cost; take more --cells")
        return self.element_steps / self.median_stepping

    def execute(self):
        for kind in TIMES:
            directory = self.folder / kind
            directory.mkdir(parents=True, exist_ok=True)
            command = self.prepare(kind, directory)
            self.seconds[kind], _ = execute(f"{self.name}, {kind}", command, directory)
            self.read(kind, directory)
        self.stepping.append(self.seconds["full"] - self.seconds["short"])

    def set_errors(self, velocities, times, kinetic, energy):
        """Against the exchange of the velocities +-1 m/s, the time of contact and the energy of one-dimensional waves."""
        below = numpy.flatnonzero(kinetic < LEVEL * ENERGY)
        if len(below) == 0 or below[0] == 0 or below[-1] == len(kinetic) - 1:
            raise RunError(f"{self.name}: the bars do not touch and part again; see {self.folder}")
        first, last = below[0], below[-1]
        begin = numpy.interp(-LEVEL * ENERGY, -kinetic[first - 1:first + 1], times[first - 1:first + 1])
        end = numpy.interp(LEVEL * ENERGY, kinetic[last:last + 2], times[last:last + 2])
        self.errors = {"contact time": (end - begin) / (LEVEL * CONTACT_TIME) - 1, "velocity lower": -1 - velocities[0],
                       "velocity upper": velocities[1] - 1, "energy": energy / ENERGY - 1}


class Calculix(Case):
    def __init__(self, program, element, contact, folder, *mesh):
        super().__init__(f"CalculiX, {element}, {contact.lower()}",
                         folder / f"{element}_{contact}".replace(" ", "_").lower(), *mesh)
        self.program, self.element, self.contact = program, element, contact

    def prepare(self, kind, directory):
        calculix.write_deck(directory / "impact.inp", self.element, self.contact, self.across, self.along, TIMES[kind])
        return [self.program, "-i", "impact"]

    def read(self, kind, directory):
        text = (directory / "impact.dat").read_text(encoding="ascii")
        times, kinetic = calculix.read_energies(text, "kinetic").T
        self.steps[kind] = calculix.count_steps(times)
        if kind == "full":
            self.set_errors(calculix.read_velocities(text, self.across, self.along), times, kinetic,
                            kinetic[-1] + calculix.read_energies(text, "internal")[-1, 1])


class Signorini(Case):
    def __init__(self, program, file, folder, *mesh):
        super().__init__("Signorini", folder / "signorini", *mesh)
        self.program, self.file = program, file

    def prepare(self, kind, directory):
        cells = f"{self.across},{self.across},{self.along}"
        return signorini_command(self.program, self.file, directory,
                                 {"Body lower/Mesh/Cells": cells, "Body upper/Mesh/Cells": cells,
                                  "Explicit/End time": TIMES[kind],
                                  "Output/Number of statistics rows": round(N_ROWS * TIMES[kind] / TIMES["full"])})

    def read(self, kind, directory):
        summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
        if summary["status"] != "ok" or summary["n_cells"] != self.n_cells:
            raise RunError(f"{self.name}, {kind}: status {summary['status']}, {summary['n_cells']} cells; see {directory}")
        self.steps[kind] = summary["n_steps"]
        if kind == "full":
            with (directory / "statistics.csv").open(encoding="utf-8") as stream:
                rows = list(csv.DictReader(stream))
            times, kinetic = (numpy.array([float(row[name]) for row in rows])
                              for name in ("time [s]", "kinetic energy [J]"))
            self.set_errors([float(rows[-1][f"mean velocity z of {body} [m/s]"]) for body in ("lower", "upper")], times,
                            kinetic, kinetic[-1] + float(rows[-1]["elastic energy [J]"]))
