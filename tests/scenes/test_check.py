#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests of check.py with a program that only writes the results it is told."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
HEAD = "# prm=scene.prm label=fast timeout=10\n"

# Its penetration is 1 / alpha to first order; its exit code and its number of ranks can be set.
FAKE = """#!/usr/bin/python3
import json, os, pathlib, sys
settings = {"alpha": "1", "exit": "0", "value": "0.97"}
words = sys.argv[1:]
for word, value in zip(words, words[1:]):
    if word == "--set":
        settings.update([value.split("=")])
if os.environ.get("OMPI_COMM_WORLD_RANK", "0") != "0":
    sys.exit(0)
output = pathlib.Path(words[words.index("--output") + 1])
output.mkdir(parents=True)
alpha, value = float(settings["alpha"]), float(settings["value"])
summary = {"status": "ok", "n_ranks": int(os.environ.get("OMPI_COMM_WORLD_SIZE", "1")),
           "contact": {"max_penetration": 1 / alpha, "resultant": [3.0, 0.0, -4.0]},
           "momentum": {"linear_drift": -1e-14, "angular_drift": float("nan")},
           "run_time": {"sections": {"contact search": 2.0}},
           "errors": [{"quantity": "contact radius", "computed": value, "exact": 1.0, "relative_error": value - 1},
                      {"quantity": "width at 0.5 m", "computed": 0.25},
                      {"quantity": "limit", "computed": 5 + alpha ** -2}]}
(output / "summary.json").write_text(json.dumps(summary))
(output / "statistics.csv").write_text("time [s], contact force z [N], bad [1]\\n0, 1, 1\\n1, 7, nan\\n2, 2, 0\\n")
print("the end")
sys.exit(int(settings["exit"]))
"""


class CheckTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        (self.path / "scene.prm").write_text("# a scene\n")
        (self.path / "fake").write_text(FAKE)
        (self.path / "fake").chmod(0o755)

    def run_check(self, body, head=HEAD):
        (self.path / "scene.expect").write_text(head + body, encoding="utf-8")
        return subprocess.run([sys.executable, str(HERE / "check.py"), str(self.path / "scene.expect"), "--program",
                               str(self.path / "fake"), "--output", str(self.path / "output")], capture_output=True,
                              text=True, check=False)

    def expect(self, code, body, saying=""):
        done = self.run_check(body)
        said = done.stdout + done.stderr
        self.assertEqual(done.returncode, code, f"{body}\n{said}")
        self.assertIn(saying, said)

    def test_comparisons_hold_and_fail(self):
        for good, bad in (("errors[contact radius].computed = 1 ± 4%", "errors[contact radius].computed = 1 ± 2%"),
                          ("errors[contact radius].computed = 1 +- 0.031", "errors[contact radius].computed = 1 ± 0.029"),
                          ("errors[contact radius].computed = 1 ± 1e-9 ± 0.04 rel",
                           "errors[contact radius].computed = 1 ± 1e-9 ± 0.02 rel"),
                          ("errors[contact radius].relative_error <= -0.02", "n_ranks <= 0.5"),
                          ("contact.max_penetration >= 1", "contact.max_penetration >= 1.01"),
                          ("contact.resultant[2] = -4 ± 0", "contact.resultant[0] = -4 ± 0"),
                          ("norm(contact.resultant) = 5 ± 1e-12", "norm(contact.resultant) = 4 ± 1e-12"),
                          ("abs(momentum.linear_drift) <= 1e-12", "abs(momentum.linear_drift) <= 1e-15"),
                          ("run_time.sections[contact search] = 2 ± 0", "run_time.sections[contact search] = 3 ± 0"),
                          ("errors[width at 0.5 m].computed = 0.25 ± 0", "errors[0].computed = 0.25 ± 0"),
                          ("statistics[contact force z].max = 7 ± 0", "statistics[contact force z].last = 7 ± 0"),
                          ('status = "ok"', 'status = "failed"')):
            self.expect(0, f"{good}  # exact: theory\n", "1 of 1 checks hold")
            self.expect(1, f"{bad}  # exact: theory\n", "FAIL")

    def test_missing_and_nan_values_fail(self):
        self.expect(1, "contact.max_presure <= 1e99  # exact: x\n", "it has: max_penetration, resultant")
        self.expect(1, "errors[radius].computed <= 1e99  # exact: x\n", "contact radius")
        self.expect(1, "momentum.angular_drift <= 1e99  # exact: x\n", "nan")
        self.expect(1, "momentum.angular_drift >= -1e99  # exact: x\n", "nan")
        self.expect(1, "statistics[bad].max <= 1e99  # exact: x\n", "nan")
        self.expect(1, "status <= 3  # exact: x\n", "not a number")

    def test_one_failure_among_many_counts(self):
        self.expect(1, "n_ranks = 1 ± 0  # exact: x\nn_ranks = 2 ± 0  # exact: x\n", "1 of 2 checks hold")

    def test_a_failing_run_fails(self):
        self.expect(1, "run a: --set exit=3\nn_ranks = 1 ± 0  # exact: x\n", "exit code 3")

    def test_runs_orders_and_agreement(self):
        runs = "run a: --set alpha=1\nrun b: --set alpha=2\nrun c: --set alpha=4\nrun d: --set alpha=4.5\n"
        for code, check in ((0, "order contact.max_penetration of a,b,c over ratio 2 = 1.00 ± 0.02"),
                            (1, "order contact.max_penetration of a,b,d over ratio 2 = 1.00 ± 0.02"),
                            (1, "order contact.max_penetration of a,b,c over ratio 2 = 2 ± 0.02"),
                            (0, "order differences errors[limit].computed of a,b,c over ratio 2 = 2 ± 0.01"),
                            (1, "order errors[limit].computed of a,b,c over ratio 2 = 2 ± 0.01"),
                            (0, "agree a,b errors[contact radius].computed ± 1e-10 rel"),
                            (1, "agree a,b errors[limit].computed ± 1e-10 rel"),
                            (0, "[b] contact.max_penetration = 0.5 ± 0"), (1, "[a,b] contact.max_penetration = 0.5 ± 0"),
                            (1, "contact.max_penetration = 0.5 ± 0")):
            self.expect(code, f"{runs}{check}  # stored: theory\n")

    def test_what_cannot_be_understood_is_refused(self):
        for bad in ("n_ranks = 1", "n_ranks = 1 ± 0", "n_ranks = 1 ± 0  # guess: x", "n_ranks = 1 ± 0  # exact:",
                    "n_ranks = 1  # exact: no tolerance", "n_ranks <= 1 ± 3  # exact: x", "n_ranks < 1  # exact: x",
                    "n_ranks = 0 ± 2%  # exact: x", "n_ranks = one ± 0  # exact: x", "[z] n_ranks = 1 ± 0  # exact: x",
                    "order n_ranks of a over ratio 2 = 1 ± 0  # exact: x", "agree run n_ranks ± 0  # exact: x",
                    "run a: -np none\nn_ranks = 1 ± 0  # exact: x", "run a:\nrun a:\nn_ranks = 1 ± 0  # exact: x", ""):
            self.expect(2, bad + "\n")
        for head in ("", "# label=fast timeout=3\n", "# prm=none.prm label=fast timeout=3\n",
                     "# prm=scene.prm label=fast timeout=3 tiemout=3\n"):
            self.assertEqual(self.run_check("n_ranks = 1 ± 0  # exact: x\n", head).returncode, 2, head)

    @unittest.skipUnless(shutil.which("mpirun"), "no mpirun")
    def test_ranks(self):
        runs = "run one: --set alpha=1\nrun two: -np 2\n"
        self.expect(0, f"{runs}[one] n_ranks = 1 ± 0  # exact: x\n[two] n_ranks = 2 ± 0  # exact: x\n")
        self.expect(1, f"{runs}agree one,two n_ranks ± 0  # exact: x\n")


if __name__ == "__main__":
    unittest.main()
