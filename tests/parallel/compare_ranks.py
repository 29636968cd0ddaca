#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a scene on several numbers of ranks and holds all rows of its statistics to those on the first number.

compare_ranks.py PROGRAM SCENE --ranks 1,2,3 --output DIR [--most-held SHARE] [-- OPTIONS of the program]
A value may differ by 1e-10 of the largest one of the same unit in the run (angles and shares: at least of 1). With
--most-held no rank of the last run may hold more than that share of the contact surface.
"""
import argparse
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

TOLERANCE = 1e-10


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--ranks", required=True, help="numbers of ranks, the first one is what the others are held to")
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--most-held", type=float, default=1.0)
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = parser.parse_args(sys.argv[1:end])
    arguments.options = sys.argv[end + 1:]
    numbers = [int(n) for n in arguments.ranks.split(",")]
    expected, n_failed = None, 0
    for n_ranks in numbers:
        output = arguments.output / str(n_ranks)
        fault = run(arguments, n_ranks, output)
        if fault:
            print(fault)
            return 1
        rows = read_statistics(output / "statistics.csv")
        if expected is None:
            expected = rows
            continue
        differences = compare(expected, rows)
        worst = max(differences.values())
        print(f"{n_ranks} ranks: largest difference {worst:.1e}")
        for name, difference in sorted(differences.items(), key=lambda entry: -entry[1])[:5]:
            if not difference <= TOLERANCE:
                print(f"  {name}: {difference:.1e}")
        n_failed += not worst <= TOLERANCE
    contact = json.loads((arguments.output / str(numbers[-1]) / "summary.json").read_text(encoding="utf-8"))["contact"]
    share = contact["facets_held"] / contact["facets"]
    print(f"{numbers[-1]} ranks: one holds {share:.3f} of {contact['facets']} facets")
    return 1 if n_failed or share > arguments.most_held else 0


def run(arguments, n_ranks, output):
    """Runs into an empty folder; returns what went wrong."""
    shutil.rmtree(output, ignore_errors=True)
    output.parent.mkdir(parents=True, exist_ok=True)
    command = [arguments.program, str(arguments.scene), "--output", str(output), *arguments.options]
    if n_ranks > 1:
        command = ["mpirun", "-np", str(n_ranks), "--oversubscribe", "--bind-to", "none", *command]
    # Ranks that wait for each other on fewer processors must let go of them.
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1",
                   "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
                   "OMPI_MCA_smsc": "^cma",
                   "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False, env=environment)
    if done.returncode != 0:
        return f"{n_ranks} ranks: exit code {done.returncode}\n" + "\n".join((done.stdout + done.stderr).splitlines()[-25:])
    summary = json.loads((output / "summary.json").read_text(encoding="utf-8"))
    print(f"{n_ranks} ranks: {summary['run_time']['total']:.1f} s")
    return "" if summary["status"] == "ok" else f"{n_ranks} ranks: status {summary['status']}"


def read_statistics(path):
    with path.open(newline="", encoding="utf-8") as stream:
        head, *rows = [row for row in csv.reader(stream, skipinitialspace=True) if row]
    return {name.strip(): [float(row[column]) for row in rows] for column, name in enumerate(head)}


def compare(expected, found):
    """The largest difference of each column over the largest value of its unit; infinite where rows are missing."""
    unit_of = {name: (re.findall(r"\[([^\]]*)\]$", name) or [""])[0] for name in expected}
    scales = {unit: 1.0 if unit in ("", "1") else 0.0 for unit in unit_of.values()}
    for name, values in expected.items():
        scales[unit_of[name]] = max([scales[unit_of[name]], *map(abs, values)])
    differences = {}
    for name, values in expected.items():
        others = found.get(name, [])
        gap = max((abs(a - b) for a, b in zip(values, others)), default=0.0)
        scale = scales[unit_of[name]]
        is_same_shape = len(values) == len(others) and not any(map(lambda x: x != x, others))
        differences[name] = float("inf") if not is_same_shape else gap / scale if scale > 0.0 else gap
    return differences


if __name__ == "__main__":
    sys.exit(main())
