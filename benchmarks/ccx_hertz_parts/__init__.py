# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parts of benchmarks/ccx_hertz: problem, mesh, calculix, runs, results."""
