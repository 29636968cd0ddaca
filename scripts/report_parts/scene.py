#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Renders the last output of solution.pvd off screen: scene.py DIR WORK writes WORK/whole.png, WORK/close.png
(3-D contact only: a cut through the point of highest contact pressure) and WORK/picture.json.

A program of its own, because VTK without an X server aborts the process: pictures.py starts it under xvfb-run.
"""
import json
import math
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import obstacles
from surface import outer_surface

SIZE = (1400, 1050)
COLOUR_MAP = "YlGnBu"


def last_files(directory):
    """The time and the files of the last entry of solution.pvd."""
    entries = [(float(entry.get("timestep", 0)), entry.get("file"))
               for entry in ElementTree.parse(directory / "solution.pvd").iter("DataSet")]
    if not entries:
        raise ValueError("solution.pvd lists no output")
    last = max(time for time, _ in entries)
    return last, [directory / name for time, name in entries if time == last]


def read_grid(path):
    reader = vtk.vtkXMLPUnstructuredGridReader() if path.suffix == ".pvtu" else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0:
        raise ValueError(f"{path.name} holds no cells")
    return grid


def join_and_deform(grid):
    """Gives every cell of a body the same points and moves them by the displacement.

    deal.II writes each cell with points of its own. Points are one where they lie and move together: bodies that
    only touch stay apart, because one penetrates the other.
    """
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    displacement = grid.GetPointData().GetArray("displacement")
    moved = points + vtk_to_numpy(displacement) if displacement else points
    finite = numpy.nan_to_num(numpy.hstack([points, moved]))
    width = numpy.ptp(finite[:, :3], axis=0).max() or 1.0
    steps = numpy.array([1e-6 * width] * 3 + [1e-9 * width] * 3)
    _, first, joined_of = numpy.unique(numpy.round(finite / steps), axis=0, return_index=True, return_inverse=True)
    joined = vtk.vtkUnstructuredGrid()
    new_points = vtk.vtkPoints()
    new_points.SetData(numpy_to_vtk(finite[first, 3:], deep=True))
    joined.SetPoints(new_points)
    cells = vtk.vtkCellArray()
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    cells.SetData(grid.GetCells().GetOffsetsArray(),
                  numpy_to_vtk(joined_of.reshape(-1)[connectivity].astype(numpy.int64), deep=True,
                               array_type=vtk.VTK_ID_TYPE))
    joined.SetCells(grid.GetCellTypesArray(), cells)
    joined.GetCellData().ShallowCopy(grid.GetCellData())
    counts = numpy.bincount(joined_of.reshape(-1))
    for index in range(grid.GetPointData().GetNumberOfArrays()):
        array = grid.GetPointData().GetArray(index)
        values = vtk_to_numpy(array).reshape(grid.GetNumberOfPoints(), -1)
        means = numpy.stack([numpy.bincount(joined_of.reshape(-1), numpy.nan_to_num(column)) / counts
                             for column in values.T], axis=1)
        mean = numpy_to_vtk(means[:, 0] if means.shape[1] == 1 else means, deep=True)
        mean.SetName(array.GetName())
        joined.GetPointData().AddArray(mean)
    averaged = vtk.vtkCellDataToPointData()
    averaged.SetInputData(joined)
    averaged.Update()
    return averaged.GetUnstructuredGridOutput()


def values_of(grid, name):
    array = grid.GetPointData().GetArray(name)
    if array is None:
        return None
    values = vtk_to_numpy(array)
    return numpy.linalg.norm(values, axis=1) if values.ndim > 1 else values


def contact_pressure_of(grid):
    """The pressure of all contact, or of obstacles alone where no more is known, or None."""
    pressure = values_of(grid, "contact_pressure")
    return values_of(grid, "obstacle_pressure") if pressure is None else pressure


def choose_field(grids):
    for name, title in (("von_mises_stress", "von Mises stress [Pa]"),
                        ("contact_pressure", "contact pressure [Pa]"),
                        ("obstacle_pressure", "pressure of obstacles [Pa]"), ("displacement", "displacement [m]")):
        found = [values for values in (values_of(grid, name) for grid in grids) if values is not None]
        if found and max(values.max() for values in found) > 0:
            return name, title, numpy.concatenate(found)
    return None, "", numpy.zeros(1)


def colour_table(upper):
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetRange(0, upper)
    try:
        from matplotlib import colormaps
        for index in range(256):
            table.SetTableValue(index, *colormaps[COLOUR_MAP](index / 255))
    except ImportError:
        table.SetHueRange(0.6, 0.0)
        table.Build()
    return table


def actors_of(data, field, table, upper, flat):
    """The coloured surface, its mesh where that is not too fine to see, and its sharp edges."""
    surface = outer_surface(data)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(surface)
    if field and data.GetPointData().GetArray(field):
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(field)
        mapper.SetLookupTable(table)
        mapper.SetScalarRange(0, upper)
        mapper.SetInterpolateScalarsBeforeMapping(True)
        if data.GetPointData().GetArray(field).GetNumberOfComponents() > 1:
            table.SetVectorModeToMagnitude()
    else:
        mapper.ScalarVisibilityOff()
    body = vtk.vtkActor()
    body.SetMapper(mapper)
    look = body.GetProperty()
    look.SetColor(0.82, 0.85, 0.88)
    look.SetAmbient(0.42)
    look.SetDiffuse(0.62)
    look.SetSpecular(0.08)
    if surface.GetNumberOfCells() <= 12000:
        look.EdgeVisibilityOn()
        look.SetEdgeColor(0.45, 0.52, 0.58)
        look.SetLineWidth(0.6)
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.SetFeatureAngle(50)
    edges.ColoringOff()
    edges.ManifoldEdgesOff()
    edges.SetBoundaryEdges(flat)
    edge_mapper = vtk.vtkPolyDataMapper()
    edge_mapper.SetInputConnection(edges.GetOutputPort())
    edge_mapper.ScalarVisibilityOff()
    outline = vtk.vtkActor()
    outline.SetMapper(edge_mapper)
    outline.GetProperty().SetColor(0.15, 0.2, 0.25)
    outline.GetProperty().SetLineWidth(0.8 if flat else 1.6)
    return [body, outline]


def render(actors, place_camera, path):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for actor in actors:
        renderer.AddActor(actor)
    # Light from above the viewer's shoulder and a fill from all round: no side of a body turns grey.
    lights = vtk.vtkLightKit()
    lights.SetKeyLightIntensity(0.62)
    lights.SetKeyToFillRatio(1.6)
    lights.SetKeyToHeadRatio(1.8)
    lights.AddLightsToRenderer(renderer)
    place_camera(renderer)
    renderer.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    image.Update()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


def camera(flat, direction, focus=None, radius=None):
    """Looks along -direction, at everything or at a ball around a point; a flat scene is seen from above."""

    def place(renderer):
        view = renderer.GetActiveCamera()
        renderer.ResetCamera()
        centre = numpy.array(focus if focus is not None else view.GetFocalPoint())
        towards = numpy.array([0.0, 0.0, 1.0]) if flat else direction / numpy.linalg.norm(direction)
        view.SetFocalPoint(*centre)
        view.SetPosition(*(centre + towards * view.GetDistance()))
        view.SetViewUp(*((0, 1, 0) if flat else (0, 0, 1)))
        view.ParallelProjectionOn()
        if radius is None:
            renderer.ResetCamera()
        else:
            view.SetParallelScale(radius)

    return place


def close_up(grids, centre, extent, actors_for, obstacles_behind, path):
    """A cut through the point of highest contact pressure; returns the direction it is best seen from, or None."""
    pressures = [contact_pressure_of(grid) for grid in grids]
    peaks = [values.max() if values is not None else 0 for values in pressures]
    best = int(numpy.argmax(peaks))
    if not peaks[best] > 0:
        return None
    positions = vtk_to_numpy(grids[best].GetPoints().GetData())
    peak = positions[int(numpy.argmax(pressures[best]))]
    patch = positions[pressures[best] > 0.05 * peaks[best]]
    near = numpy.linalg.norm(patch - peak, axis=1)
    radius = min(max(3.5 * numpy.median(near), 0.06 * extent), 0.4 * extent)
    # Parts of symmetric bodies show their cut faces on the side where the peak lies.
    side = [1 if offset > 0.05 * extent else -1 if offset < -0.05 * extent else usual
            for offset, usual in zip((peak - centre)[:2], (1, -1))]
    direction = numpy.array([0.45 * side[0], 0.85 * side[1], 0.32])
    plane = vtk.vtkPlane()
    plane.SetOrigin(*peak)
    plane.SetNormal(0, -side[1], 0)
    actors = []
    for grid in grids:
        clip = vtk.vtkTableBasedClipDataSet()
        clip.SetInputData(grid)
        clip.SetClipFunction(plane)
        # A symmetry plane is there already: leave it whole, round-off would tear it.
        clip.SetValue(-1e-6 * extent)
        clip.Update()
        if clip.GetOutput().GetNumberOfCells():
            actors += actors_for(clip.GetOutput())
    actors += obstacles_behind(plane)
    render(actors, camera(False, direction, peak, radius), path)
    return direction


def main(directory, work):
    time, files = last_files(directory)
    grids = [join_and_deform(read_grid(path)) for path in files]
    bounds = numpy.array([grid.GetBounds() for grid in grids])
    lower, upper_corner = bounds[:, ::2].min(axis=0), bounds[:, 1::2].max(axis=0)
    extent = float(numpy.linalg.norm(upper_corner - lower))
    flat = upper_corner[2] - lower[2] <= 1e-9 * extent
    name, title, values = choose_field(grids)
    # A singular edge must not wash out everything else.
    upper = float(numpy.quantile(values, 0.9985)) or float(values.max()) or 1.0
    table = colour_table(upper)

    def actors_for(data):
        return actors_of(data, name, table, upper, flat)

    rigid = obstacles.read(directory, time)

    def obstacles_behind(plane):
        return obstacles.make_actors(rigid, lower, upper_corner, flat, plane)

    direction = None
    if not flat:
        direction = close_up(grids, (lower + upper_corner) / 2, extent, actors_for, obstacles_behind,
                             work / "close.png")
    actors = [actor for grid in grids for actor in actors_for(grid)] + obstacles_behind(None)
    whole = direction if direction is not None else numpy.array([0.5, -0.85, 0.42])
    render(actors, camera(flat, whole), work / "whole.png")
    description = {"time": time, "field": title, "upper": upper, "colour_map": COLOUR_MAP,
                   "exceeded": bool(values.max() > 1.001 * upper), "close": direction is not None,
                   "finite": math.isfinite(float(values.sum()))}
    (work / "picture.json").write_text(json.dumps(description))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
