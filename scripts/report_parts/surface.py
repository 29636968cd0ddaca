# SPDX-License-Identifier: LGPL-2.1-or-later
"""The outer surface of a mesh with hanging nodes.

Where the mesh width changes, one coarse face meets several fine ones. No two are the same, so VTK takes them all for
outer faces and draws their edges as if the body ended there.
"""
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

NEAR = 1e-2  # of a face's diagonal: single precision in the files


def outer_surface(grid):
    """The surface as polygons, without the faces between coarse and fine cells of one body."""
    filtered = vtk.vtkDataSetSurfaceFilter()
    filtered.SetInputData(grid)
    filtered.SetNonlinearSubdivisionLevel(2)
    filtered.Update()
    surface = filtered.GetOutput()
    body = surface.GetPointData().GetArray("body")
    quads = vtk_to_numpy(surface.GetPolys().GetConnectivityArray())
    if body is None or not surface.GetNumberOfCells() or len(quads) != 4 * surface.GetNumberOfCells():
        return surface
    quads = quads.reshape(-1, 4)
    inner = inner_faces(surface, quads, numpy.round(vtk_to_numpy(body)[quads[:, 0]]))
    kept = quads[~inner].astype(numpy.int64)
    cells = vtk.vtkCellArray()
    cells.SetData(numpy_to_vtk(4 * numpy.arange(len(kept) + 1), deep=True, array_type=vtk.VTK_ID_TYPE),
                  numpy_to_vtk(kept.reshape(-1), deep=True, array_type=vtk.VTK_ID_TYPE))
    outer = vtk.vtkPolyData()
    outer.SetPoints(surface.GetPoints())
    outer.SetPolys(cells)
    outer.GetPointData().ShallowCopy(surface.GetPointData())
    return outer


def inner_faces(surface, quads, body):
    """Coarse faces that hold a node in their middle, and the fine ones at that node that lie on them."""
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    corners = points[quads]
    middles = corners.mean(axis=1)
    widths = numpy.linalg.norm(corners[:, 0] - corners[:, 2], axis=1)
    locator = vtk.vtkStaticPointLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    nearest = numpy.array([locator.FindClosestPoint(middle) for middle in middles])
    is_inner = numpy.linalg.norm(points[nearest] - middles, axis=1) < NEAR * widths
    faces_at = {}
    for face, nodes in enumerate(quads):
        for node in nodes:
            faces_at.setdefault(node, []).append(face)
    for coarse in numpy.flatnonzero(is_inner):
        fine = [face for face in faces_at[nearest[coarse]]
                if body[face] == body[coarse] and abs(widths[face] / widths[coarse] - 0.5) < 0.25
                and lies_on(corners[face], corners[coarse], NEAR * widths[coarse])]
        is_inner[coarse] = len(fine) == 4
        if len(fine) == 4:
            is_inner[fine] = True
    return is_inner


def lies_on(corners, coarse, tolerance):
    """Whether one corner is the coarse face's middle, one a corner of it and two are middles of its edges."""
    targets = numpy.vstack([coarse, (coarse + numpy.roll(coarse, 1, axis=0)) / 2, coarse.mean(axis=0)])
    distances = numpy.linalg.norm(corners[:, None] - targets[None], axis=2)
    return bool((distances.min(axis=1) < tolerance).all())
