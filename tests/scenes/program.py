# SPDX-License-Identifier: LGPL-2.1-or-later
"""What tests of the program itself have in common. The last argument of a test script is the program."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop()


class ProgramTest(unittest.TestCase):
    """Each test has an output directory of its own, `path`, in a folder that goes with the test."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name) / "output"

    def command(self, file, *options):
        return [PROGRAM, str(file), "--output", str(self.path), *options]

    def run_program(self, file, *options):
        return subprocess.run(self.command(file, *options), capture_output=True, text=True, check=False)

    def report(self):
        done = subprocess.run([str(ROOT / "scripts/report"), str(self.path)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def summary(self, folder=""):
        return json.loads((self.path / folder / "summary.json").read_text(encoding="utf-8"))
