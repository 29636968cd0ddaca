# SPDX-License-Identifier: LGPL-2.1-or-later
"""The problem (mm, N, MPa), as in parameter_files/study/ccx_hertz.prm, and what its solution should be."""
import math

YOUNGS_MODULUS = 200e3
POISSONS_RATIO = 0.3
RADIUS = 10.0
APPROACH = 0.025
CONTACT_RADIUS = math.sqrt(RADIUS * APPROACH)  # about
QUARTER = 0.25  # the share of the contact that the octant has

# The ball is no half-space: how far from Hertz at this load fine meshes of Signorini end, with Contact/Correction; first
# and second moment of their pressure give the same radius within 1e-4. Those of CalculiX (C3D20R), its contact stiffness
# taken to infinity, end at -0.0074 of the radius and -0.0166 of the approach, and its pressures between -0.0045 and 0.001.
OWN_DIFFERENCE = {"peak pressure": -0.0015, "contact radius": -0.007, "approach": -0.0168}


def discretization_errors(computed_over_hertz):
    """Relative errors of a run: its distance from Hertz less that of the finite ball."""
    return {name: ratio - 1 - OWN_DIFFERENCE[name] for name, ratio in computed_over_hertz.items()}


def over_hertz(force, moment, pressure):
    """Peak pressure, contact radius and approach of an octant's run over those of Hertz at its force. The radius is that of
    Hertz's pressure with this moment: on a quarter of the circle the mean of p x is 3/8 of it times the mean of p."""
    modulus = YOUNGS_MODULUS / (1 - POISSONS_RATIO ** 2)
    radius = (0.75 * force / QUARTER * RADIUS / modulus) ** (1 / 3)
    return {"peak pressure": pressure / (1.5 * force / QUARTER / (math.pi * radius ** 2)),
            "contact radius": 8 / 3 * moment / force / radius,
            "approach": APPROACH / (radius ** 2 / RADIUS)}
