# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs of both codes: series of ever finer meshes, each run a process of its own whose cost is measured alike."""
import dataclasses
import json
import os
import subprocess

from . import calculix, mesh, problem

# One thread each, whichever library brings threads.
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1"}
CUBE = 1.25  # CalculiX: width of the mesh's cube of equal cells, in contact radii
GROWTH = 1.5  # CalculiX: of the shells around it
CELLS = {"C3D8I": (3, 4, 5, 6, 8, 10), "C3D10": (2, 3, 4, 5), "C3D20R": (2, 3, 4, 5)}
STIFFNESS = {"C3D8I": 10, "C3D10": 10, "C3D20R": 20}  # times E/h: of 6, 10, 20 and 60 the best for each


class RunError(Exception):
    """A code did not finish, or not with a result."""


@dataclasses.dataclass
class Run:
    code: str
    series: str
    name: str
    command: list
    directory: object
    read: object  # () -> (dofs, computed over Hertz)
    seconds: float = float("inf")  # user and system, the least of the repeats
    megabytes: float = 0.0  # peak of the resident memory; the system counts this Python's own from before the start
    dofs: int = 0
    errors: dict = dataclasses.field(default_factory=dict)


def execute(run):
    run.directory.mkdir(parents=True, exist_ok=True)
    with (run.directory / "screen.txt").open("wb") as screen:
        process = subprocess.Popen(run.command, cwd=run.directory, stdout=screen, stderr=subprocess.STDOUT,
                                   env={**os.environ, **ENVIRONMENT})
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RunError(f"{run.code} {run.name}: exit code {process.returncode}; see {screen.name}")
    run.seconds = min(run.seconds, usage.ru_utime + usage.ru_stime)
    run.megabytes = max(run.megabytes, usage.ru_maxrss / 1024)
    run.dofs, ratios = run.read()
    run.errors = problem.discretization_errors(ratios)


def calculix_runs(program, directory):
    return [calculix_run(program, directory, element, cells) for element in CELLS for cells in CELLS[element]]


def calculix_run(program, directory, element, cells):
    """Writes the deck; its time is not counted."""
    name = f"{element}_{cells}"
    folder = directory / name
    folder.mkdir(parents=True, exist_ok=True)
    width = CUBE * problem.CONTACT_RADIUS
    octant = mesh.make(element, problem.RADIUS, cells, width, GROWTH)
    stiffness = STIFFNESS[element] * problem.YOUNGS_MODULUS / (width / cells)
    calculix.write_deck(folder / "hertz.inp", element, octant, stiffness)

    def read():
        contact = calculix.read_contact((folder / "hertz.dat").read_text(encoding="ascii"))
        return octant.points.size, problem.over_hertz(*contact)

    return Run("CalculiX", element, name, [program, "-i", "hertz"], folder, read)


def signorini_runs(program, file, directory):
    grading, runs = "Body ball/Mesh/Grading/", []
    # Of a few distances the cheapest: degree 2 needs fewer layers of the finest cells.
    for degree, refinements, distance in ((1, 1, 6e-4), (2, 0, 5e-4)):
        keys = {"Degree": degree, "Body ball/Mesh/Refinements": refinements, grading + "Distance": distance}
        for levels in (4, 5, 6):
            runs.append(signorini_run(program, file, directory, f"degree {degree}, graded", levels,
                                      {**keys, grading + "Levels": levels}))
        keys = {"Degree": degree, "Body ball/Mesh/Refinements": 1, grading + "Levels": 1}
        for cycles in (4, 5, 6, 7):
            runs.append(signorini_run(program, file, directory, f"degree {degree}, adaptive", cycles,
                                      {**keys, "Adaptivity/Maximum cycles": cycles}))
    return runs


def signorini_run(program, file, directory, series, number, keys):
    name = f"{series} {number}".replace(",", "").replace(" ", "_")
    folder = directory / name
    command = [program, str(file), "--output", str(folder), "--quiet"]
    for key, value in keys.items():
        command += ["--set", f"{key}={value}"]

    def read():
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        if summary["status"] != "ok":
            raise RunError(f"Signorini {name}: {summary['reason']}")
        rows = {row["quantity"]: row["computed"] / row["exact"] for row in summary["errors"] if row["exact"]}
        return summary["n_dofs"], {name: rows[name] for name in problem.OWN_DIFFERENCE}

    return Run("Signorini", series, name, command, folder, read)
