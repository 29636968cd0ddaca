# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the runs say: the table of all, and how the rates compare with what is aimed at."""
import csv

from . import runs

AIM = 200  # element steps per core-second of Signorini over those of CalculiX


def tabulate(cases):
    """A row for each code and set of options on one mesh; the first case is that of Signorini."""
    for case in cases:
        steps = case.steps["full"]
        yield {"code": case.name, "cells [1]": case.n_cells, "steps [1]": steps,
               "mean time step [s]": f"{runs.TIMES['full'] / steps:.3e}", "element steps timed [1]": case.element_steps,
               "core-seconds of them, median [s]": f"{case.median_stepping:.3f}",
               "least [s]": f"{min(case.stepping):.3f}", "most [s]": f"{max(case.stepping):.3f}",
               "core-seconds of the last full run [s]": f"{case.seconds['full']:.3f}",
               "element steps per core-second [1/s]": f"{case.rate:.4g}",
               "Signorini over it [1]": f"{cases[0].rate / case.rate:.3g}",
               **{f"error of {name} [1]": f"{error:+.5f}" for name, error in case.errors.items()}}


def write_table(path, rows):
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, rows[0])
        writer.writeheader()
        writer.writerows(rows)


def describe(rows):
    """Text: the rows of one mesh side by side."""
    return "\n".join(f"{name:38}" + "".join(f"{str(row[name]).removeprefix('CalculiX, '):>28}" for row in rows)
                     for name in rows[0])


def judge(meshes):
    """Text: whether the aim is reached, against each set of options of CalculiX on each mesh; meshes: lists of cases."""
    lines = []
    for ours, *others in meshes:
        for case in others:
            ratio = ours.rate / case.rate
            said = "reached" if ratio >= AIM else "NOT reached"
            lines.append(f"{case.n_cells} cells, {case.name}: {ratio:.3g} times, the aim of {AIM} is {said}")
    return "\n".join(lines)
