#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases of the stress suite that are refused: test_stress_refusals.py PROGRAM."""
import unittest

from program import ROOT, ProgramTest

IMPLICIT_CONTACT = ["--set", "Explicit/Contact stepping=implicit"]


class StressRefusalTest(ProgramTest):
    def check_refused(self, file, message, *options):
        done = self.run_program(ROOT / "parameter_files/stress" / file, *options)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(message, done.stderr)
        self.assertEqual(self.summary()["status"], "failed")

    def test_bars_at_a_quarter_of_the_wave_speed(self):
        self.check_refused("bars.prm", "the energy ledger does not close", "--set", "Explicit/End time=0.08",
                           *IMPLICIT_CONTACT, "--set", "Body left/Initial motion/Velocity=25, 0",
                           "--set", "Body right/Initial motion/Velocity=-25, 0")

    def test_a_block_as_fast_as_the_plate_is_thin(self):
        for stepping in ([], IMPLICIT_CONTACT):
            self.check_refused("plate.prm", "sinks into what it touches", "--set", "Explicit/End time=0.02", *stepping,
                               "--set", "Body block/Initial motion/Velocity=0, -140")

    def test_a_deep_overlap_at_the_default_steps(self):
        self.check_refused("overlap.prm", "the energy ledger does not close", "--set", "Explicit/End time=0.05",
                           "--set", "Body block/Placement/Shift=0, -5e-2")

    def test_a_bounce_at_the_default_steps(self):
        self.check_refused("bouncing.prm", "the energy ledger does not close", "--set", "Contact/Penalty factor=10")

    def test_a_slope_too_steep(self):
        self.check_refused("slope_at_rest.prm", "a net force of (7.019, ", "--set", "Contact/Friction/Friction coefficient=0.49")


if __name__ == "__main__":
    unittest.main()
