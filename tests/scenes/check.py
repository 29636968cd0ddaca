#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the program as a .expect file says and holds the results to it.

check.py FILE.expect --program PATH --output DIR [--mpirun PATH]
Exit code: 0 every check holds, 1 a check or a run failed, 2 the .expect file is wrong.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
import expectations
from expectations import ExpectError


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("expect", type=pathlib.Path)
    parser.add_argument("--program", required=True)
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for the output of the runs")
    parser.add_argument("--mpirun", default="mpirun")
    arguments = parser.parse_args()
    try:
        expected = expectations.parse(arguments.expect.read_text(encoding="utf-8"))
        parameter_file = find_parameter_file(arguments.expect, expected.head["prm"])
    except (OSError, ExpectError) as error:
        print(f"{arguments.expect}: {error}", file=sys.stderr)
        return 2
    results = {}
    for run in expected.runs:
        output = arguments.output / run.name
        try:
            results[run.name] = perform(run, parameter_file, output, arguments)
        except ExpectError as error:
            print(f"run {run.name}: {error}", file=sys.stderr)
            return 1
    n_failed = sum(not holds(check, results) for check in expected.checks)
    print(f"{len(expected.checks) - n_failed} of {len(expected.checks)} checks hold; output: {arguments.output}")
    return 1 if n_failed else 0


def find_parameter_file(expect, name):
    for folder in (expect.resolve().parent, pathlib.Path(__file__).resolve().parents[2]):
        if (folder / name).is_file():
            return folder / name
    raise ExpectError(f"line 1: there is no {name} beside the file or under the root of the repository")


def perform(run, parameter_file, output, arguments):
    """Runs the program into an empty folder; returns the summary with the statistics as one more entry."""
    shutil.rmtree(output, ignore_errors=True)
    output.parent.mkdir(parents=True, exist_ok=True)
    command = [arguments.program, str(parameter_file), "--output", str(output), *run.options]
    if run.n_ranks > 1:
        command = [arguments.mpirun, "-np", str(run.n_ranks), "--oversubscribe", "--bind-to", "none", *command]
    started = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False,
                          env=environment(run.n_ranks))
    print(f"run {run.name}: {time.monotonic() - started:.1f} s, exit code {done.returncode}", flush=True)
    if done.returncode != 0:
        tail = "\n".join((done.stdout + done.stderr).splitlines()[-25:])
        raise ExpectError(f"the program ended with exit code {done.returncode}:\n  {' '.join(command)}\n{tail}")
    try:
        result = json.loads((output / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ExpectError(f"no readable summary.json: {error}") from error
    result["statistics"] = read_statistics(output / "statistics.csv")
    return result


def environment(n_ranks):
    variables = dict(os.environ)
    if os.geteuid() == 0:
        variables.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        # Single-copy messages need rights that containers withhold; first their name of Open MPI 4, then that of 5.
        variables.setdefault("OMPI_MCA_btl_vader_single_copy_mechanism", "none")
        variables.setdefault("OMPI_MCA_smsc", "^cma")
    if n_ranks > 1:
        variables.update(DEAL_II_NUM_THREADS="1", OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    return variables


def read_statistics(path):
    """First, last, least and greatest value of every column."""
    if not path.is_file():
        return {}
    with path.open(newline="", encoding="utf-8") as stream:
        rows = [row for row in csv.reader(stream, skipinitialspace=True) if row]
    columns = {}
    for index, cell in enumerate(rows[0] if rows else []):
        try:
            values = [float(row[index]) for row in rows[1:]]
        except (IndexError, ValueError):
            continue
        if values:
            # A NaN anywhere must show, wherever Python's min and max would have lost it.
            spoiled = math.nan if any(map(math.isnan, values)) else 0.0
            name = re.sub(r"\s*\[[^\]]*\]\s*$", "", cell.strip())
            columns[name] = {"first": values[0], "last": values[-1], "min": min(values) + spoiled,
                             "max": max(values) + spoiled}
    return columns


def holds(check, results):
    try:
        findings = check.judge(results)
    except ExpectError as error:
        findings = [(False, str(error))]
    passed = all(good for good, _ in findings)
    print(f"{'ok  ' if passed else 'FAIL'} {check.text}")
    print(f"       found {'; '.join(found for _, found in findings)}   ({check.kind}: {check.reason})")
    return passed


if __name__ == "__main__":
    sys.exit(main())
