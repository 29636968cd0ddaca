# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs of both codes: a short and a full one, whose difference is the cost of the steps, and one that is watched."""
import csv
import json
import os
import subprocess

import numpy

from ccx_hertz_parts.runs import ENVIRONMENT, RunError

from . import calculix

END, SHORT = 6e-4, 6e-5
TIMES = {"short": SHORT, "full": END, "watched": END}
LEVEL = 0.9  # of the kinetic energy, which falls and rises linearly: below it for this share of the contact time
CONTACT_TIME, ENERGY = 4e-4, 20.0
LEAST = 0.5  # core-seconds of the timed steps: the start of Signorini alone varies by about 0.05


class Case:
    """One code with one set of options; cost and steps by kind of run."""

    def __init__(self, name, folder, across, along):
        self.name, self.folder, self.across, self.along = name, folder, across, along
        self.seconds, self.steps, self.errors = {}, {}, {}

    @property
    def n_cells(self):
        return 2 * self.across ** 2 * self.along

    @property
    def stepping(self):
        return self.seconds["full"] - self.seconds["short"]

    @property
    def element_steps(self):
        return self.n_cells * (self.steps["full"] - self.steps["short"])

    @property
    def rate(self):
        """Element steps per core-second. RunError: the steps took too little to be told from the start of the program."""
        if self.stepping < LEAST:
            raise RunError(f"{self.name}: the timed steps took {self.stepping:.3f} core-seconds, fewer than {LEAST}: "
                           "nothing can be said of their cost; take more --cells")
        return self.element_steps / self.stepping

    def execute(self, kind):
        directory = self.folder / kind
        directory.mkdir(parents=True, exist_ok=True)
        command = self.prepare(kind, directory)
        with (directory / "screen.txt").open("wb") as screen:
            process = subprocess.Popen(command, cwd=directory, stdout=screen, stderr=subprocess.STDOUT,
                                       env={**os.environ, **ENVIRONMENT})
            _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise RunError(f"{self.name}, {kind}: exit code {process.returncode}; see {directory}/screen.txt")
        self.seconds[kind] = min(self.seconds.get(kind, float("inf")), usage.ru_utime + usage.ru_stime)
        self.read(kind, directory)

    def set_errors(self, velocities, energy):
        self.errors.update({"velocity lower": -1 - velocities[0], "velocity upper": velocities[1] - 1,
                            "energy": energy / ENERGY - 1})

    def set_contact_time(self, times, kinetic):
        below = numpy.flatnonzero(kinetic < LEVEL * ENERGY)
        first, last = below[0], below[-1]
        begin = numpy.interp(-LEVEL * ENERGY, -kinetic[first - 1:first + 1], times[first - 1:first + 1])
        end = numpy.interp(LEVEL * ENERGY, kinetic[last:last + 2], times[last:last + 2])
        self.errors["contact time"] = (end - begin) / (LEVEL * CONTACT_TIME) - 1


class Calculix(Case):
    def __init__(self, program, element, contact, *rest):
        super().__init__(f"CalculiX, {element}, {contact.lower()}", *rest)
        self.program, self.element, self.contact = program, element, contact

    def prepare(self, kind, directory):
        calculix.write_deck(directory / "impact.inp", self.element, self.contact, self.across, self.along, TIMES[kind],
                            kind == "watched")
        return [self.program, "-i", "impact"]

    def read(self, kind, directory):
        text = (directory / "impact.dat").read_text(encoding="ascii")
        kinetic = calculix.read_energies(text, "kinetic")
        if kind == "watched":
            self.steps = {name: int((kinetic[:, 0] < 0.999999 * time).sum()) + 1 for name, time in TIMES.items()}
            self.set_contact_time(*kinetic.T)
        elif kind == "full":
            self.set_errors(calculix.read_velocities(text, self.across, self.along),
                            kinetic[-1, 1] + calculix.read_energies(text, "internal")[-1, 1])


class Signorini(Case):
    def __init__(self, program, file, *rest):
        super().__init__("Signorini", *rest)
        self.program, self.file = program, file

    def prepare(self, kind, directory):
        cells = f"{self.across},{self.across},{self.along}"
        keys = {"Body lower/Mesh/Cells": cells, "Body upper/Mesh/Cells": cells, "Explicit/End time": TIMES[kind],
                "Output/Number of statistics rows": 1000 if kind == "watched" else 5}
        options = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
        return [self.program, str(self.file), "--output", str(directory), "--quiet", *options]

    def read(self, kind, directory):
        summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
        if summary["status"] != "ok" or summary["n_cells"] != self.n_cells:
            raise RunError(f"{self.name}, {kind}: status {summary['status']}, {summary['n_cells']} cells; see {directory}")
        self.steps[kind] = summary["n_steps"]
        with (directory / "statistics.csv").open(encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
        if kind == "watched":
            self.set_contact_time(*(numpy.array([float(row[name]) for row in rows])
                                    for name in ("time [s]", "kinetic energy [J]")))
        elif kind == "full":
            names = ("mean velocity z of lower [m/s]", "mean velocity z of upper [m/s]")
            self.set_errors([float(rows[-1][name]) for name in names],
                            float(rows[-1]["kinetic energy [J]"]) + float(rows[-1]["elastic energy [J]"]))
