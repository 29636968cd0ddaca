# SPDX-License-Identifier: LGPL-2.1-or-later
"""An octant of a ball, meshed finely around its pole (0, 0, R), in two ways.

Mapped: a cube of bricks whose sides are equal near the pole and grow geometrically along each axis beyond, mapped to the
octant by x -> x sqrt(1 - y^2/2 - z^2/2 + y^2 z^2/3) and so on. It is what is made without much thought.

Shells: the inversion x -> s + 2 R^2 (x - s) / |x - s|^2 with s = (0, 0, -R) takes the octant to itself and exchanges its
centre and its pole, its mid-plane and its sphere. So the mesh is first made around the centre, a cube of equal cells and
shells about it whose thickness grows geometrically, and then inverted; the map is conformal and keeps the cells' shapes.

Nodes stand on a lattice of half a cell, so that those at the middle of edges lie on the sphere and the planes as well.
"""
import dataclasses
import itertools
import math

import numpy

from ccx_common import HEXAHEDRON_CORNERS

HEXAHEDRON_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
HEXAHEDRON_FACES = ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
TETRAHEDRON_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
TETRAHEDRON_FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))


@dataclasses.dataclass
class Mesh:
    points: numpy.ndarray  # of the nodes, n x 3
    elements: numpy.ndarray  # nodes of each element in CalculiX's order, from 0
    faces: tuple  # corners of each face of an element
    boundaries: dict  # x, y, z (the cuts) and sphere: the numbers of their nodes


def make_mapped(element, radius, cells, width, growth):
    """Octant for C3D8I, C3D20R or C3D10: cells along an edge of the cube of equal ones at the pole, width of the cube, and
    the factor by which a layer is thicker than the one before."""
    axes = [place_layers(cells, size / radius, growth) for size in (math.sqrt(2) * width, math.sqrt(2) * width, width)]
    axes[2] = 1 - axes[2][::-1]
    cube = numpy.stack(numpy.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    numbers = numpy.arange(len(cube)).reshape([len(axis) for axis in axes])
    starts = itertools.product(*(range(0, len(axis) - 1, 2) for axis in axes))
    hexahedra = numpy.array([numbers[i:i + 3, j:j + 3, k:k + 3] for i, j, k in starts])
    on = {name: cube[:, axis] == 0 for axis, name in enumerate("xyz")}
    on["sphere"] = (cube == 1).any(axis=1)
    return make(element, radius * map_to_octant(cube), hexahedra, on)


def make_shells(element, radius, cells, width, growth):
    """As make_mapped; the layers are the shells."""
    keys, hexahedra, n_layers = make_lattice(cells, width / (2 * radius), growth)
    points = radius * invert(place(keys, cells, width / (2 * radius), n_layers, growth))
    on = {"x": keys[:, 1] == 0, "y": keys[:, 2] == 0, "sphere": keys[:, 3] == 0, "z": keys[:, 0] == 2 * n_layers}
    return make(element, points, hexahedra, on)


def make(element, points, hexahedra, on):
    """The mesh of these nodes, the hexahedra being 3 x 3 x 3 of their numbers; on: masks of the boundaries' nodes."""
    elements = SHAPES[element](hexahedra)
    used, numbers = numpy.unique(elements, return_inverse=True)
    points, on = points[used], {name: mask[used] for name, mask in on.items()}
    for axis, name in enumerate("xyz"):
        points[on[name], axis] = 0.0
    faces = TETRAHEDRON_FACES if element == "C3D10" else HEXAHEDRON_FACES
    return Mesh(points, numbers.reshape(elements.shape), faces,
                {name: numpy.flatnonzero(mask) for name, mask in on.items()})


def count_layers(cells, width, growth):
    """So many layers from width to 1 that the first is about as thick as the cells before."""
    return max(2, round(numpy.log1p((1 - width) * (growth - 1) / (width / cells * growth)) / numpy.log(growth)))


def bound_layers(n_layers, growth):
    bounds = growth ** numpy.arange(n_layers + 1) - 1
    return bounds / bounds[-1]


def place_layers(cells, width, growth):
    """The half cells' bounds along an axis from 0 to 1: equal ones up to width, then growing ones."""
    layers = bound_layers(count_layers(cells, width, growth), growth)
    bounds = numpy.concatenate([width * numpy.arange(cells) / cells, 1 - (1 - width) * (1 - layers)])
    return numpy.append(numpy.stack([bounds[:-1], (bounds[:-1] + bounds[1:]) / 2], axis=1), bounds[-1])


def map_to_octant(cube):
    x, y, z = cube.T ** 2
    return cube * numpy.sqrt([1 - y / 2 - z / 2 + y * z / 3, 1 - z / 2 - x / 2 + z * x / 3, 1 - x / 2 - y / 2 + x * y / 3]).T


def make_lattice(cells, width, growth):
    """Keys (half layer, i, j, k) of the nodes, the hexahedra as 3 x 3 x 3 of their numbers, and the layers of shells."""
    n_layers = count_layers(cells, width, growth)
    numbers, hexahedra = {}, []
    steps = list(itertools.product(range(3), repeat=3))

    def add(key_of):
        hexahedra.append([numbers.setdefault(key_of(*step), len(numbers)) for step in steps])

    ranges = range(0, 2 * cells, 2)
    for i, j, k in itertools.product(ranges, repeat=3):
        add(lambda a, b, c: (0, i + a, j + b, k + c))
    for layer, j, k in itertools.product(range(0, 2 * n_layers, 2), ranges, ranges):
        add(lambda a, b, c: (layer + a, 2 * cells, j + b, k + c))
        add(lambda a, b, c: (layer + a, k + c, 2 * cells, j + b))
        add(lambda a, b, c: (layer + a, j + b, k + c, 2 * cells))
    # The inversion turns left and right about, and so does this.
    cubes = numpy.array(hexahedra).reshape(-1, 3, 3, 3).swapaxes(2, 3)
    return numpy.array(list(numbers)), cubes, n_layers


def place(keys, cells, width, n_layers, growth):
    """Points of the lattice about the centre of the unit ball."""
    bounds = bound_layers(n_layers, growth)
    shares = numpy.interp(numpy.arange(2 * n_layers + 1) / 2, numpy.arange(n_layers + 1), bounds)[keys[:, :1]]
    points = keys[:, 1:] * (width / (2 * cells))
    lengths = numpy.linalg.norm(points, axis=1, keepdims=True)
    return points * (1 - shares + shares / numpy.where(lengths > 0, lengths, 1))


def invert(points):
    """The inversion in the unit ball that exchanges centre and pole."""
    shifted = points + (0, 0, 1)
    return 2 * shifted / numpy.sum(shifted ** 2, axis=1, keepdims=True) - (0, 0, 1)


def hexahedra_8(cubes):
    return numpy.array([cubes[:, a, b, c] for a, b, c in HEXAHEDRON_CORNERS]).T


def hexahedra_20(cubes):
    return numpy.array([cubes[:, a, b, c] for a, b, c in with_middles(HEXAHEDRON_CORNERS, HEXAHEDRON_EDGES)]).T


def tetrahedra_10(cubes):
    """Six tetrahedra a cube, around its diagonal: neighbours agree on the diagonals of their faces."""
    elements = []
    for order in itertools.permutations(range(3)):
        corners = numpy.zeros((4, 3), dtype=int)
        for position, axis in enumerate(order):
            corners[position + 1:, axis] = 2
        if numpy.linalg.det(corners[1:]) < 0:
            corners[[1, 2]] = corners[[2, 1]]
        elements.append([cubes[:, a, b, c] for a, b, c in with_middles(corners, TETRAHEDRON_EDGES)])
    return numpy.concatenate([numpy.array(element).T for element in elements])


def with_middles(corners, edges):
    corners = [tuple(corner) for corner in corners]
    return corners + [tuple((a + b) // 2 for a, b in zip(corners[start], corners[end])) for start, end in edges]


SHAPES = {"C3D8I": hexahedra_8, "C3D20R": hexahedra_20, "C3D10": tetrahedra_10}
