# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rigid obstacles of a run as translucent actors, cut off near the bodies. Reads parameters.prm and
statistics.csv as the run left them."""
import re

import numpy
import vtk

import inputs

COLOUR, OPACITY = (0.36, 0.42, 0.5), 0.28
MARGIN = 0.12  # around the bodies, as a share of the scene


def read(directory, time):
    """The entries of every obstacle and, as "shift", how far it has moved by then; none where the file is missing."""
    path, table = directory / "parameters.prm", inputs.read_table(directory / "statistics.csv")
    progress = "time" if "time" in table else "load parameter"

    def shift_of(name):
        columns = [f"displacement {component} of {name}" for component in "xyz"]
        return [numpy.interp(time, table[progress], table[column]) if column in table else 0.0 for column in columns]

    obstacles, inside = [], []
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines() if path.is_file() else []:
        words = line.split("#")[0].strip()
        if words.startswith("subsection "):
            inside.append(words[len("subsection "):].strip())
            if len(inside) == 1 and inside[0].startswith("Obstacle "):
                obstacles.append({"shift": shift_of(inside[0][len("Obstacle "):].strip())})
        elif words == "end":
            inside = inside[:-1]
        elif words.startswith("set ") and len(inside) == 1 and inside[0].startswith("Obstacle "):
            key, _, value = words[len("set "):].partition("=")
            obstacles[-1][key.strip()] = value.strip()
    return obstacles


def numbers(text, length=3):
    values = [float(value) for value in re.split(r"\s*,\s*", text)]
    return numpy.array((values + [0.0] * length)[:length])


def make_actors(obstacles, lower, upper, flat, cut=None):
    """One actor an obstacle, inside the bodies' box and a margin; `cut` is a plane that takes off the near side."""
    extent = numpy.linalg.norm(upper - lower)
    centre = (lower + upper) / 2
    actors = []
    for obstacle in obstacles:
        function, foot = make_function(obstacle, centre, flat)
        if numpy.linalg.norm(foot - centre) > 2 * extent:
            continue
        corners = numpy.minimum(lower, foot) - MARGIN * extent, numpy.maximum(upper, foot) + MARGIN * extent
        source = (make_area if flat else make_surface)(function, *corners)
        if cut is not None:
            source = clip(source.GetOutputPort(), cut, 0)
        source.Update()
        if source.GetOutput().GetNumberOfCells():
            actors.append(translucent(source))
    return actors


def make_function(obstacle, centre, flat):
    """The signed distance from the obstacle, positive outside, and its surface's point nearest to `centre`."""
    shape, shift = obstacle.get("Shape", "plane"), numpy.array(obstacle["shift"])
    point = numbers(obstacle.get("Point", "0, 0, 0")) + shift
    radius = float(obstacle.get("Radius", 1))
    if shape == "box":
        corners = [numbers(obstacle.get(key, usual)) + shift
                   for key, usual in (("Lower corner", "0, 0, 0"), ("Upper corner", "1, 1, 1"))]
        if flat:
            corners[0][2], corners[1][2] = -1e3, 1e3
        function = vtk.vtkBox()
        function.SetBounds(*numpy.column_stack(corners).reshape(-1))
        return function, numpy.clip(centre, *corners)
    if shape == "cylinder":
        axis = numbers(obstacle.get("Axis", "0, 0, 1"))
        axis /= numpy.linalg.norm(axis)
        arm = centre - point - axis * numpy.dot(centre - point, axis)
        function = vtk.vtkCylinder()
        function.SetCenter(*point)
        function.SetAxis(*axis)
        function.SetRadius(radius)
        return function, centre - arm + radius * arm / (numpy.linalg.norm(arm) or 1)
    if shape == "sphere":
        arm = centre - point
        function = vtk.vtkSphere()
        function.SetCenter(*point)
        function.SetRadius(radius)
        return function, point + radius * arm / (numpy.linalg.norm(arm) or 1)
    normal = numbers(obstacle.get("Normal", "0, 0, 1"))
    normal[2] *= not flat
    normal /= numpy.linalg.norm(normal)
    function = vtk.vtkPlane()
    function.SetOrigin(*point)
    function.SetNormal(*normal)
    return function, centre - normal * numpy.dot(centre - point, normal)


def make_surface(function, lower, upper):
    """The obstacle's surface inside a box."""
    sample = vtk.vtkSampleFunction()
    sample.SetImplicitFunction(function)
    sample.SetModelBounds(*numpy.column_stack([lower, upper]).reshape(-1))
    sample.SetSampleDimensions(80, 80, 80)
    contour = vtk.vtkContourFilter()
    contour.SetInputConnection(sample.GetOutputPort())
    contour.SetValue(0, 0)
    return contour


def make_area(function, lower, upper):
    """The obstacle inside a rectangle."""
    source = vtk.vtkPlaneSource()
    source.SetOrigin(lower[0], lower[1], 0)
    source.SetPoint1(upper[0], lower[1], 0)
    source.SetPoint2(lower[0], upper[1], 0)
    source.SetResolution(300, 300)
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(source.GetOutputPort())
    return clip(triangles.GetOutputPort(), function, 0, inside_out=True)


def clip(port, function, value, inside_out=False):
    clipper = vtk.vtkClipPolyData()
    clipper.SetInputConnection(port)
    clipper.SetClipFunction(function)
    clipper.SetValue(value)
    clipper.SetInsideOut(inside_out)
    return clipper


def translucent(source):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*COLOUR)
    actor.GetProperty().SetOpacity(OPACITY)
    return actor
