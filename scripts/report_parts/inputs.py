# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what a run wrote. Every file but summary.json may be absent."""
import csv
import dataclasses
import json
import math
import pathlib
import re


class InputError(Exception):
    """The folder does not hold a readable run."""


class Table:
    """A CSV file by columns. Column names carry their unit in the file (`time [s]`) and lose it here."""

    def __init__(self, columns, units):
        self.columns = columns
        self.units = units

    def __contains__(self, name):
        return name in self.columns

    def __getitem__(self, name):
        return self.columns[name]

    def n_rows(self):
        return len(next(iter(self.columns.values()), []))

    def has_values(self, name):
        """Whether the column exists and holds two finite numbers or more: a curve."""
        return sum(math.isfinite(value) for value in self.columns.get(name, [])) > 1

    def label(self, name):
        unit = self.units.get(name, "")
        return f"{name} [{unit}]" if unit not in ("", "1") else name


@dataclasses.dataclass
class Run:
    directory: pathlib.Path
    summary: dict
    statistics: Table
    profile: Table
    parameters: str

    @property
    def is_study(self):
        return isinstance(self.summary.get("study"), dict)


def read_run(directory):
    summary_file = directory / "summary.json"
    if not summary_file.is_file():
        raise InputError(f"{directory} holds no summary.json: it is not the output directory of a finished run.")
    try:
        summary = json.loads(summary_file.read_text(encoding="utf-8"))
    except ValueError as error:
        raise InputError(f"{summary_file} is not valid JSON: {error}") from error
    if not isinstance(summary, dict):
        raise InputError(f"{summary_file} does not hold a JSON object.")
    parameters_file = directory / "parameters.prm"
    parameters = ""
    if parameters_file.is_file():
        parameters = parameters_file.read_text(encoding="utf-8", errors="replace")
    return Run(directory, summary, read_table(directory / "statistics.csv"), read_table(directory / "profile.csv"),
               parameters)


def read_table(path):
    """An empty table when there is no such file. A cell that is no number, or a cut last line, becomes NaN."""
    columns, units = {}, {}
    if not path.is_file():
        return Table(columns, units)
    with path.open(newline="", encoding="utf-8", errors="replace") as stream:
        rows = [row for row in csv.reader(stream, skipinitialspace=True) if row]
    if not rows:
        return Table(columns, units)
    names = []
    for cell in rows[0]:
        name, unit = split_unit(cell)
        names.append(name)
        columns[name] = []
        units[name] = unit
    for row in rows[1:]:
        for index, name in enumerate(names):
            columns[name].append(number(row[index]) if index < len(row) else math.nan)
    return Table(columns, units)


def split_unit(cell):
    match = re.fullmatch(r"(.*?)\s*\[([^\]]*)\]\s*", cell.strip())
    return (match.group(1), match.group(2)) if match else (cell.strip(), "")


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan
