#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests of studies: what they compute, what they leave, and how they go on: test_study.py PROGRAM."""
import csv
import math
import shutil
import signal
import subprocess
import time
import unittest

from program import ROOT, ProgramTest

BARS = ROOT / "parameter_files/study/alpha_h.prm"
SMALL = ["--set", "Study/Uniform refinements=0,1,2", "--set", "Study/Penalty factors=1,10,100"]
END = "displacement of the loaded end"


class StudyTest(ProgramTest):
    def run_study(self, *options):
        return self.run_program(BARS, *options)

    def test_orders_are_those_of_the_theory(self):
        done = self.run_study(*SMALL)
        self.assertEqual(done.returncode, 0, done.stderr)
        study = self.summary()["study"]
        self.assertEqual(len(study["rows"]), 9)
        self.assertEqual({row["status"] for row in study["rows"]}, {"ok"})
        # exact: h/(alpha L) with 4 cells on a bar of length 1
        for row in study["rows"]:
            exact = 0.5 ** int(row["settings"]["uniform"]) / (4 * float(row["settings"]["alpha"]))
            self.assertLess(abs(row["largest_error"] / exact - 1), 1e-4, row["run"])
        for quantity, variable, order, count in ((END, "h", 1, 3), (END, "1/alpha", 1, 3),
                                                 ("estimated contact", "h", 0.5, 3),
                                                 ("estimated contact", "1/alpha", 0.5, 3)):
            fits = [fit for fit in study["orders"] if fit["quantity"] == quantity and fit["in"] == variable]
            self.assertEqual(len(fits), count, (quantity, variable))
            for fit in fits:
                # The norm of the solution, which the estimate is relative to, has the contact energy h/alpha in it.
                self.assertLess(abs(fit["order"] - order), 0.005 if quantity == END else 0.06, fit)
                self.assertEqual(fit["n_points"], 3)
        good = [row for row in study["rows"] if row["largest_error"] <= study["tolerance"]]
        self.assertEqual(study["cheapest"], min(good, key=lambda row: row["run_time"])["run"])
        self.check_table(study)

    def check_table(self, study):
        with (self.path / "study.csv").open(newline="", encoding="utf-8") as stream:
            table = list(csv.DictReader(stream))
        self.assertEqual([row["run"] for row in table], [row["run"] for row in study["rows"]])
        for cells, row in zip(table, study["rows"]):
            self.assertEqual(cells["alpha"], row["settings"]["alpha"])
            self.assertTrue(math.isclose(float(cells[f"{END}: relative error"]), row["largest_error"], rel_tol=1e-8))
            self.assertGreater(float(cells["memory [MB]"]), 0)

    def test_the_report_of_a_study(self):
        self.assertEqual(self.run_study(*SMALL).returncode, 0)
        done = self.report()
        page = (self.path / "report.html").read_text(encoding="utf-8")
        for words in ("Observed orders", "All runs", "uniform-2_alpha-100", "cheapest"):
            self.assertIn(words, page)
        if "matplotlib" not in done.stdout:
            for name in ("error_time", "error_dofs", "memory"):
                self.assertTrue((self.path / f"report_{name}.png").is_file(), name)

    def test_only_what_is_missing_or_changed_is_run_again(self):
        self.assertEqual(self.run_study(*SMALL).returncode, 0)
        runs = self.path / "runs"
        shutil.rmtree(runs / "uniform-1_alpha-10_repeat-1")
        before = {path.name: (path / "summary.json").stat().st_mtime_ns for path in runs.iterdir()}
        done = self.run_study(*SMALL, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("from before"), 8)
        after = {path.name: (path / "summary.json").stat().st_mtime_ns for path in runs.iterdir()}
        self.assertEqual([name for name in after if after[name] != before.get(name)], ["uniform-1_alpha-10_repeat-1"])
        self.assertEqual(len(self.summary()["study"]["rows"]), 9)
        used = self.run_program(self.path / "parameters.prm", "--resume")
        self.assertEqual(used.stdout.count("from before"), 9, used.stderr)
        changed = self.run_study(*SMALL, "--resume", "--set", "Body upper/Material/Young's modulus=2e7")
        self.assertEqual(changed.stdout.count("from before"), 0)
        anew = self.run_study(*SMALL)
        self.assertEqual(anew.stdout.count("from before"), 0)

    def test_a_run_that_fails_is_a_row(self):
        file = self.path.parent / "gap.prm"
        text = BARS.read_text(encoding="utf-8").replace("Penalty factors     = 1, 10, 100, 1000", "Penalty factors = 1, 1000")
        file.write_text(text.replace("set Tolerance = 1e-10", "set Tolerance = 1e-10\n set Maximum iterations = 1\n"
                                     " set Maximum bisections = 0"), encoding="utf-8")
        done = self.run_program(file)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("no run of the study ended well", done.stderr)
        self.assertEqual({row["status"] for row in self.summary()["study"]["rows"]}, {"failed"})
        self.assertIn("8 of 8 runs failed", self.summary()["warnings"][0])
        self.report()
        self.assertIn("an order needs three runs", (self.path / "report.html").read_text(encoding="utf-8"))

    def test_an_interrupted_study_leaves_what_there_is(self):
        process = subprocess.Popen(self.command(BARS, "--set", "Study/Repeats=100"), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        for _ in range(5000):
            if len(list(self.path.glob("runs/*/summary.json"))) > 3:
                break
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        message = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 1)
        self.assertIn("--resume", message)
        self.assertEqual(self.summary()["status"], "interrupted")
        self.assertGreater(len(self.summary()["study"]["rows"]), 0)

    def test_the_plan_is_printed(self):
        done = self.run_study(*SMALL, "--validate")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("_repeat-1: about"), 9)
        self.assertFalse(self.path.exists())

    def test_larger_runs_are_left_out(self):
        done = self.run_study(*SMALL, "--set", "Study/Maximum dofs=100")
        self.assertEqual(done.returncode, 0, done.stderr)
        left_out = [row["run"] for row in self.summary()["study"]["rows"] if row["status"] == "left out"]
        self.assertEqual(left_out, ["uniform-2_alpha-1", "uniform-2_alpha-10", "uniform-2_alpha-100"])


if __name__ == "__main__":
    unittest.main()
