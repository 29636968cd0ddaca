# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs of both codes: series of ever finer meshes, each run a process of its own whose cost is measured alike."""
import dataclasses
import json

import ccx_common

from . import calculix, mesh, problem

CUBE = 1.25  # CalculiX, shells: width of the mesh's cube of equal cells, in contact radii
BLOCK = 1.5  # the same, mapped
# CalculiX: kind of mesh, growth of its layers, element, cells along the cube, and contact stiffness in E/h. Tried were, on
# shells, 10, 20, 40 and 100 for C3D8I, 10, 12, 14, 20, 40 and 100 for C3D10, 10, 18, 20, 25, 30, 40 and 100 for C3D20R; on
# mapped bricks 10, 20 and 40 for C3D8I, 20 and 40 for C3D20R. Softer contact errs in the radius, stiffer in the pressure.
CALCULIX_SERIES = (("shells", 1.5, "C3D8I", (3, 4, 5, 6, 8), 20), ("shells", 1.5, "C3D10", (2, 3, 4), 12),
                   ("shells", 1.5, "C3D20R", (2, 3, 4), 18), ("shells", 1.5, "C3D20R", (2, 3, 4, 5), 25),
                   ("mapped", 1.4, "C3D8I", (3, 4, 5, 6), 20), ("mapped", 1.4, "C3D20R", (2, 3), 20))


@dataclasses.dataclass
class Run:
    code: str
    series: str
    name: str
    command: list
    directory: object
    read: object  # () -> (dofs, computed over Hertz)
    seconds: float = float("inf")  # user and system, the least of the repeats
    megabytes: float = 0.0  # peak of the resident memory
    dofs: int = 0
    errors: dict = dataclasses.field(default_factory=dict)


def execute(run):
    seconds, megabytes = ccx_common.execute(f"{run.code} {run.name}", run.command, run.directory)
    run.seconds = min(run.seconds, seconds)
    run.megabytes = max(run.megabytes, megabytes)
    run.dofs, ratios = run.read()
    run.errors = problem.discretization_errors(ratios)


def calculix_runs(program, directory):
    return [calculix_run(program, directory, kind, growth, element, count, stiffness)
            for kind, growth, element, cells, stiffness in CALCULIX_SERIES for count in cells]


def calculix_run(program, directory, kind, growth, element, cells, stiffness):
    """Writes the deck; its time is not counted."""
    name = f"{element}_{kind}_{stiffness}_{cells}"
    folder = directory / name
    folder.mkdir(parents=True, exist_ok=True)
    width, make = (BLOCK, mesh.make_mapped) if kind == "mapped" else (CUBE, mesh.make_shells)
    width *= problem.CONTACT_RADIUS
    octant = make(element, problem.RADIUS, cells, width, growth)
    calculix.write_deck(folder / "hertz.inp", element, octant, stiffness * problem.YOUNGS_MODULUS / (width / cells))

    def read():
        contact = calculix.read_contact((folder / "hertz.dat").read_text(encoding="ascii"))
        return octant.points.size, problem.over_hertz(*contact)

    return Run("CalculiX", f"{element}, {kind}, K = {stiffness} E/h", name, [program, "-i", "hertz"], folder, read)


def signorini_runs(program, file, directory):
    levels, cycles, runs = "Body ball/Mesh/Grading/Levels", "Adaptivity/Maximum cycles", []
    for degree, first_cycle, refinements in ((1, 5, 1), (2, 3, 0)):
        for series, more in (("adaptive", {}), ("corrected", {"Contact/Correction/Tolerance": 1e-2})):
            for number in range(first_cycle, first_cycle + 4):
                runs.append(signorini_run(program, file, directory, f"degree {degree}, {series}", number,
                                          {"Degree": degree, levels: 1, cycles: number, **more}))
        for number in (4, 5, 6):
            runs.append(signorini_run(program, file, directory, f"degree {degree}, graded", number,
                                      {"Degree": degree, "Body ball/Mesh/Refinements": refinements, levels: number}))
    return runs


def signorini_run(program, file, directory, series, number, keys):
    name = f"{series} {number}".replace(",", "").replace(" ", "_")
    folder = directory / name

    def read():
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        if summary["status"] != "ok":
            raise ccx_common.RunError(f"Signorini {name}: {summary['reason']}")
        rows = {row["quantity"]: row for row in summary["errors"]}
        ratios = {name: rows[name]["computed"] / rows[name]["exact"] for name in problem.OWN_DIFFERENCE}
        # Of single points, as in CalculiX; the row has the pressure projected onto the faces.
        ratios["peak pressure"] = summary["contact"]["max_pressure"] / rows["peak pressure"]["exact"]
        return summary["n_dofs"], ratios

    return Run("Signorini", series, name, ccx_common.signorini_command(program, file, folder, keys), folder, read)
