#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests of what runs do to their output directory, and of runs that are stopped: test_directory.py PROGRAM."""
import pathlib
import signal
import subprocess
import time
import unittest

from program import ROOT, ProgramTest

BLOCKS = ROOT / "parameter_files/demonstration/two_blocks.prm"
HERTZ = ROOT / "parameter_files/validation/hertz_cylinder.prm"
ENDLESS = ["--set", "Quasi-static/Load steps=1000000", "--set", "Output/Number of fields=1"]


class DirectoryTest(ProgramTest):
    def start_endless(self):
        process = subprocess.Popen(self.command(BLOCKS, *ENDLESS), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        statistics = self.path / "statistics.csv"
        for _ in range(1000):
            if statistics.is_file() and statistics.read_text().count("\n") > 3:
                return process
            time.sleep(0.01)
        return self.fail("the run has not begun")

    def test_an_interrupted_run_leaves_whole_output(self):
        for stop in (signal.SIGINT, signal.SIGTERM):
            process = self.start_endless()
            process.send_signal(stop)
            message = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 1)
            self.assertIn(f"interrupted by {stop.name}", message)
            self.assertEqual(self.summary()["status"], "interrupted")
            self.assertIn(f"interrupted by {stop.name}", self.summary()["reason"])
            self.assertTrue((self.path / "solution.pvd").is_file())
            self.report()
            (self.path / "statistics.csv").unlink()

    def test_two_runs_do_not_share_a_directory(self):
        process = self.start_endless()
        other = self.run_program(BLOCKS)
        self.assertEqual(other.returncode, 3)
        self.assertIn("in use by another run", other.stderr)
        process.terminate()
        process.communicate(timeout=60)
        self.assertEqual(self.run_program(BLOCKS).returncode, 0)

    def test_a_run_is_repeated_from_its_own_parameters(self):
        self.assertEqual(self.run_program(BLOCKS).returncode, 0)
        used = self.path / "parameters.prm"
        text = "# my comment\n" + used.read_text(encoding="utf-8")
        used.write_text(text, encoding="utf-8")
        self.assertEqual(self.run_program(used).returncode, 0)
        self.assertEqual(self.summary()["status"], "ok")
        refused = self.run_program(used, "--set", "Contact/Penalty factor=20")
        self.assertEqual(refused.returncode, 3)
        self.assertIn("the input lies where", refused.stderr)
        self.assertEqual(used.read_text(encoding="utf-8"), text)

    def test_nothing_is_compared_where_nothing_touches(self):
        done = self.run_program(HERTZ, "--set", "Body cylinder/Placement/Shift=0,1")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("nothing touches at the end: nothing to compare with case 'Hertz cylinder'", done.stderr)
        self.assertEqual(self.summary()["status"], "failed")
        self.assertEqual(self.summary()["errors"], [])

    def test_deep_penetration_is_warned_of(self):
        done = self.run_program(BLOCKS, "--set", "Contact/Penalty factor=0.05", "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        on_the_way, at_the_end = self.summary()["warnings"]
        self.assertIn("body 'upper' has sunk into what it touches by 0.3", on_the_way)
        self.assertIn("at 0.5 of an element the run will stop", on_the_way)
        self.assertIn("raise Contact/Penalty factor or refine", at_the_end)

    def test_a_linear_body_that_turns_is_warned_of(self):
        turned = pathlib.Path(self.folder.name) / "turned.prm"
        turned.write_text("""set Dimension = 2\nset Bodies = block
            subsection Body block
              subsection Mesh\nend
              subsection Material\nset Young's modulus = 1e6\nset Poisson's ratio = 0.3\nend
              subsection Support bottom\nset x = (cos(0.2*t) - 1)*x\nset y = sin(0.2*t)*x\nend
            end
            subsection Quasi-static\nend""", encoding="utf-8")
        for model, warnings in (("linear elastic", 1), ("neo-Hookean", 0)):
            done = self.run_program(turned, "--set", f"Body block/Material/Model={model}")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(self.summary()["warnings"]), warnings)
            self.assertEqual("body 'block' is turned by up to 1" in done.stdout, warnings == 1, done.stdout)

    def test_a_mesh_in_pieces_is_warned_of(self):
        mesh = pathlib.Path(self.folder.name) / "pieces.inp"
        mesh.write_text("*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
                        "5, 4, 0, 0\n6, 5, 0, 0\n7, 4, 1, 0\n8, 4, 0, 1\n"
                        "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 5, 6, 7, 8\n", encoding="utf-8")
        done = self.run_program(ROOT / "tests/rejects/mesh_file_missing.prm", "--set", f"Body part/Mesh/File={mesh}")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the mesh of body 'part' is in 2 pieces", self.summary()["warnings"][0])
        self.assertIn("near (4.25, 0.25, 0.25)", self.summary()["warnings"][0])


if __name__ == "__main__":
    unittest.main()
