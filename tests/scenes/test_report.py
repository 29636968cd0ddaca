#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests of scripts/report with a folder that no program wrote: what must be read there, and what may be missing."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUMMARY = {
    "program": "signorini", "status": "failed", "reason": "no equilibrium beyond load parameter 0.5", "input": "a_b.prm",
    "warnings": ["the largest penetration of the run, 0.2 h"],
    "contact": {"max_pressure": 17.0, "touching": True, "peak": {"max_pressure": 4321.0},
                "resultant": [{"name": "a from b", "on": "a", "from": "b", "force": [0.0, -2.5]}]},
    "supports": [{"name": "y on a at bottom", "force": 2.5}],
    "energy": {"elastic": 1.0, "contact": 0.25},
}
STATISTICS = """load parameter [s],elastic energy [J/m],contact energy [J/m],max pressure [Pa],\
contact force y on a from b [N/m],support force y on a at bottom [N/m]
0,0,0,0,0,0
1,1,0.25,17,-2.5,2.5
"""


class ReportTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        (self.path / "summary.json").write_text(json.dumps(SUMMARY))

    def report(self):
        return subprocess.run([str(ROOT / "scripts/report"), str(self.path)], capture_output=True, text=True, check=False)

    def test_the_page_says_what_the_summary_says(self):
        self.assertEqual(self.report().returncode, 0)
        page = (self.path / "report.html").read_text(encoding="utf-8")
        for words in ("failed", SUMMARY["reason"], SUMMARY["warnings"][0], "4321", "per undeformed area", "a from b", "0, -2.5",
                      "y on a at bottom", "the run wrote no solution.pvd"):
            self.assertIn(words, page)

    def test_an_interrupted_run_has_a_page(self):
        (self.path / "summary.json").write_text(json.dumps({**SUMMARY, "status": "interrupted"}))
        self.assertEqual(self.report().returncode, 0)
        self.assertIn('badge bad">interrupted', (self.path / "report.html").read_text(encoding="utf-8"))

    def test_curves_run_over_the_load(self):
        (self.path / "statistics.csv").write_text(STATISTICS)
        done = self.report()
        if "matplotlib" in done.stdout:
            self.skipTest("no matplotlib")
        for name in ("energy", "contact_force", "support_force", "largest_pressure"):
            self.assertTrue((self.path / f"report_{name}.png").is_file(), name)

    def test_a_folder_without_a_run_is_refused(self):
        (self.path / "summary.json").unlink()
        self.assertEqual(self.report().returncode, 3)

    def test_every_energy_of_the_ledger_is_drawn(self):
        drawn = (ROOT / "scripts/report_parts/curves.py").read_text(encoding="utf-8")
        drawn = drawn[drawn.index("\nHELD = "):drawn.index("\ndef energy_ledger")]
        written = (ROOT / "source/simulation/simulation_motion.cc").read_text(encoding="utf-8")
        self.assertEqual(set(re.findall(r'"([^"]+)"', drawn)), set(re.findall(r'joules\("([^"]+)"\)', written)))

    def test_a_later_run_removes_the_pictures_by_their_names(self):
        made = {"scene"}
        for part in ("curves", "study_curves"):
            text = (ROOT / f"scripts/report_parts/{part}.py").read_text(encoding="utf-8")
            made.update(re.findall(r'\("(\w+)", \w+\)', text[text.index("\nALL = "):]))
        source = (ROOT / "source/output/earlier_output.cc").read_text(encoding="utf-8")
        listed = re.search(r"report_\(([^)]*)\)", source.replace('"\n', "").replace('      "', ""))[1]
        self.assertEqual(set(listed.split("|")), made)


if __name__ == "__main__":
    unittest.main()
