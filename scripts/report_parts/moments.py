#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Renders a 3-D run at given times, cut in half along y = 0: moments.py DIR OUTPUT_STEM TIME...

Writes OUTPUT_STEM_1.png and so on, all in the same view and colours. Needs an X server: start it under xvfb-run -a.
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import obstacles
import scene


def files_at(directory, time):
    """The time of the output nearest to a time, and its files."""
    entries = [(float(entry.get("timestep", 0)), entry.get("file"))
               for entry in ElementTree.parse(directory / "solution.pvd").iter("DataSet")]
    nearest = min((t for t, _ in entries), key=lambda t: abs(t - time))
    return nearest, [directory / name for t, name in entries if t == nearest]


def front_half_removed(grid):
    """The cells that stood behind y = 0 before they were deformed: whole ones, so that the cut shows the mesh."""
    reference = vtk_to_numpy(grid.GetPoints().GetData()) - vtk_to_numpy(grid.GetPointData().GetArray("displacement"))
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
    extract = vtk.vtkExtractCells()
    extract.SetInputData(grid)
    behind = vtk.vtkIdList()
    for cell in numpy.flatnonzero(reference[corners, 1].mean(axis=1) > 0):
        behind.InsertNextId(int(cell))
    extract.SetCellList(behind)
    extract.Update()
    return extract.GetOutput()


def main(directory, stem, times):
    found = [files_at(directory, time) for time in times]
    moments = [[scene.join_and_deform(scene.read_grid(path)) for path in files] for _, files in found]
    bounds = numpy.array([grid.GetBounds() for grids in moments for grid in grids])
    lower, upper = bounds[:, ::2].min(axis=0), bounds[:, 1::2].max(axis=0)
    values = numpy.concatenate([scene.values_of(grid, "von_mises_stress") for grids in moments for grid in grids])
    largest = float(numpy.quantile(values, 0.9985))
    table = scene.colour_table(largest)
    scene.SIZE = (720, 640)
    view = scene.camera(False, numpy.array([0.25, -0.9, 0.35]), (lower + upper) / 2,
                        0.35 * float(numpy.linalg.norm(upper - lower)))
    cut = vtk.vtkPlane()
    cut.SetNormal(0, 1, 0)
    for number, ((time, _), grids) in enumerate(zip(found, moments), start=1):
        actors = obstacles.make_actors(obstacles.read(directory, time), lower, upper, False, cut)
        for grid in grids:
            actors += scene.actors_of(front_half_removed(grid), "von_mises_stress", table, largest, False)
        scene.render(actors, view, pathlib.Path(f"{stem}_{number}.png"))
    print(f"colours end at {largest:.3g} Pa")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), sys.argv[2], [float(time) for time in sys.argv[3:]])
