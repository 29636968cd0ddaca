# SPDX-License-Identifier: LGPL-2.1-or-later
"""The problem (mm, N, MPa), as in parameter_files/study/ccx_hertz.prm, and what its solution should be."""
import math

YOUNGS_MODULUS = 200e3
POISSONS_RATIO = 0.3
RADIUS = 10.0
APPROACH = 0.025
CONTACT_RADIUS = math.sqrt(RADIUS * APPROACH)  # about
QUARTER = 0.25  # the share of the contact that the octant has

# The ball is no half-space: what fine meshes of independent codes agree on beside Hertz at this load.
OWN_DIFFERENCE = {"peak pressure": -0.005, "contact radius": 0.0, "approach": -0.0155}


def discretization_errors(computed_over_hertz):
    """Relative errors of a run: its distance from Hertz less that of the finite ball."""
    return {name: ratio - 1 - OWN_DIFFERENCE[name] for name, ratio in computed_over_hertz.items()}


def over_hertz(force, area, pressure):
    """Peak pressure, contact radius and approach of an octant's run over those of Hertz at its force."""
    modulus = YOUNGS_MODULUS / (1 - POISSONS_RATIO ** 2)
    radius = (0.75 * force / QUARTER * RADIUS / modulus) ** (1 / 3)
    return {"peak pressure": pressure / (1.5 * force / QUARTER / (math.pi * radius ** 2)),
            "contact radius": math.sqrt(area / QUARTER / math.pi) / radius,
            "approach": APPROACH / (radius ** 2 / RADIUS)}
