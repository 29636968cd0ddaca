#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The benchmark of the kernels runs, and takes the best instructions that the processor says it has: PROGRAM."""
import os
import pathlib
import platform
import re
import subprocess
import sys
import unittest

PROGRAM = sys.argv.pop()
NEEDED = (("avx512", {"avx512f", "avx512vl", "avx512dq", "avx2", "fma"}), ("avx2", {"avx2", "fma"}))


def best_of_this_machine():
    information = pathlib.Path("/proc/cpuinfo")
    if platform.machine() != "x86_64" or not information.is_file():
        return "baseline"
    flags = set(re.search(r"^flags\s*:(.*)$", information.read_text(encoding="utf-8"), re.MULTILINE)[1].split())
    return next((name for name, needed in NEEDED if needed <= flags), "baseline")


class Kernels(unittest.TestCase):
    def test_takes_the_best_instructions(self):
        best = best_of_this_machine()
        done = subprocess.run([PROGRAM, "--benchmark_min_time=0.01", f"--benchmark_filter={best}/tetrahedra.*threads:1"],
                              capture_output=True, text=True, check=True, env={**os.environ, "LC_ALL": "C"})
        self.assertRegex(done.stdout, rf"1 thread: triad [0-9.]+ GB/s, peak [0-9.]+ Gflop/s with {best}\n")
        for law in ("linear elastic", "neo-Hookean"):
            row = re.search(rf"^{best}/tetrahedra/{law}/.* Mcells/s=(\S+) .*of_triad=(\S+)", done.stdout, re.MULTILINE)
            self.assertIsNotNone(row, done.stdout)
            self.assertGreater(float(row[1]), 0.0)
            self.assertTrue(0.0 < float(row[2]), row[2])


if __name__ == "__main__":
    unittest.main()
