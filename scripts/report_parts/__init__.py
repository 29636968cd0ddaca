# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parts of scripts/report: inputs, curves, scene, pictures, page; study_curves, study."""
