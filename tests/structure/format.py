#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sources as clang-format writes them: format.py ROOT. Exit code 77 (skipped) where there is no clang-format."""
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import tree

SKIPPED = 77


def main(root):
    program = shutil.which("clang-format")
    if not program:
        print("no clang-format: skipped")
        return SKIPPED
    sources = [str(path) for path in tree.files(root, "include", "source", "tests", "benchmarks", "cmake")
               if path.suffix in (".h", ".cc")]
    if not sources:
        return 0
    done = subprocess.run([program, "--dry-run", "-Werror", "--ferror-limit=1", *sources], capture_output=True,
                          text=True, check=False)
    if done.returncode == 0:
        return 0
    print(done.stderr)
    print("run: clang-format -i on the files named above")
    return 1


if __name__ == "__main__":
    sys.exit(main(tree.root_from(sys.argv)))
