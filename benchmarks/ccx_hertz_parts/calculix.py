# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Hertz problem as a CalculiX deck (mm, N, MPa), and what a run of it gave."""
import numpy

from ccx_common import numbered

from . import problem


def write_deck(path, element, mesh, stiffness):
    """stiffness: of the contact, MPa/mm. One step, small strain, one increment; the floor is one rigid hexahedron."""
    n_nodes, n_elements, size = len(mesh.points), len(mesh.elements), 4 * problem.CONTACT_RADIUS
    low, high = problem.RADIUS, problem.RADIUS + size
    corners = ((-1, -1, low), (1, -1, low), (1, 1, low), (-1, 1, low), (-1, -1, high), (1, -1, high), (1, 1, high),
               (-1, 1, high))
    floor = numpy.array([(size * x, size * y, z) for x, y, z in corners])
    lines = ["*NODE, NSET=ALL", *numbered(numpy.vstack([mesh.points, floor]), "{:.15g}")]
    lines += [f"*ELEMENT, TYPE={element}, ELSET=BALL", *wrapped(numbered(mesh.elements + 1, "{}"))]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=FLOOR", *numbered(n_nodes + 1 + numpy.arange(8)[None], "{}", n_elements + 1)]
    lines += ["*NSET, NSET=FLOORNODES, GENERATE", f"{n_nodes + 1},{n_nodes + 8}"]
    for name, nodes in mesh.boundaries.items():
        lines += [f"*NSET, NSET={name.upper()}", *map("{},".format, nodes + 1)]
    lines += ["*SURFACE, NAME=TOUCHING", *(f"{number + 1},S{face + 1}" for number, face in touching_faces(mesh)),
              "*SURFACE, NAME=PLANE", f"{n_elements + 1},S1",
              "*MATERIAL, NAME=STEEL", "*ELASTIC", f"{problem.YOUNGS_MODULUS},{problem.POISSONS_RATIO}",
              "*SOLID SECTION, ELSET=BALL, MATERIAL=STEEL", "*SOLID SECTION, ELSET=FLOOR, MATERIAL=STEEL",
              "*SURFACE INTERACTION, NAME=LAW", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{stiffness:.9g}",
              "*CONTACT PAIR, INTERACTION=LAW, TYPE=SURFACE TO SURFACE", "TOUCHING,PLANE",
              "*STEP, INC=1000", "*STATIC", "1.,1.",
              "*BOUNDARY", "X,1,1", "Y,2,2", f"Z,3,3,{problem.APPROACH}", "FLOORNODES,1,3",
              "*CONTACT PRINT", "CSTR", "*CONTACT PRINT, SLAVE=TOUCHING, MASTER=PLANE", "CF", "*END STEP"]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def wrapped(lines, most=15):
    """CalculiX reads at most 16 entries a line."""
    for line in lines:
        words = line.split(",")
        yield from (",".join(words[start:start + most]) + ("," if start + most < len(words) else "")
                    for start in range(0, len(words), most))


def touching_faces(mesh):
    """(element, face) of the sphere's faces with a corner near enough to the pole to touch."""
    near = numpy.linalg.norm(mesh.points[:, :2], axis=1) < 1.5 * problem.CONTACT_RADIUS
    sphere = numpy.zeros(len(mesh.points), dtype=bool)
    sphere[mesh.boundaries["sphere"]] = True
    for face, corners in enumerate(mesh.faces):
        nodes = mesh.elements[:, corners]
        yield from ((number, face) for number in numpy.flatnonzero(sphere[nodes].all(1) & near[nodes].any(1)))


def read_contact(text):
    """Force, its moment about an axis in the plane and largest pressure of the octant's contact from the .dat file: the
    last of what it holds."""
    _, stresses = text.rsplit("contact stress (slave element+face,press,tang1,tang2)", 1)
    stresses, statistics = stresses.split("statistics for slave set", 1)
    rows = [line.split() for line in stresses.splitlines()[1:]]
    pressures = [float(row[2]) for row in rows if len(row) == 5]
    _, last = statistics.rsplit("total surface force (fx,fy,fz) and moment about the origin (mx,my,mz)", 1)
    _, _, force, moment = map(float, last.split()[:4])
    return -force, -moment, max(pressures)
