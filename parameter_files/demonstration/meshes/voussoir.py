#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes voussoir.inp, a wedge of an arch about the y axis: voussoir.py ANGLE INNER OUTER N_ALONG N_ACROSS > voussoir.inp.

ANGLE in degrees, radii in m. Every quadrilateral of a polar grid is cut into four triangles about its centre.
"""
import math
import sys


def main(angle, inner, outer, n_along, n_across):
    def place(i, j):
        turn = math.radians(angle) * (i / n_along - 0.5)
        radius = inner + (outer - inner) * j / n_across
        return radius * math.sin(turn), radius * math.cos(turn)

    nodes = [place(i, j) for i in range(n_along + 1) for j in range(n_across + 1)]
    triangles = []
    for i in range(n_along):
        for j in range(n_across):
            corner = i * (n_across + 1) + j
            ring = [corner, corner + 1, corner + n_across + 2, corner + n_across + 1]
            nodes.append(tuple(sum(nodes[node][axis] for node in ring) / 4 for axis in range(2)))
            triangles += [(ring[k], len(nodes) - 1, ring[(k + 1) % 4]) for k in range(4)]
    print(f"** Wedge of {angle:g} degrees between the radii {inner:g} and {outer:g}, made by voussoir.py.\n*NODE")
    for number, (x, y) in enumerate(nodes, start=1):
        print(f"{number}, {x:.15g}, {y:.15g}, 0.")
    print("*ELEMENT, TYPE=CPE3, ELSET=voussoir")
    for number, corners in enumerate(triangles, start=1):
        print(f"{number}, " + ", ".join(str(corner + 1) for corner in corners))


if __name__ == "__main__":
    main(*map(float, sys.argv[1:4]), *map(int, sys.argv[4:6]))
