#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sources as clang-format writes them: format.py ROOT. Exit code 77 (skipped) where there is none of VERSION."""
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import tree

SKIPPED = 77
VERSION = "14"  # of Debian 12: others break lines and braces in other places


def find_program():
    """A clang-format of VERSION by either name, or None."""
    for name in (f"clang-format-{VERSION}", "clang-format"):
        program = shutil.which(name)
        if program:
            said = subprocess.run([program, "--version"], capture_output=True, text=True, check=False).stdout
            if re.search(rf"\bversion {VERSION}\.", said):
                return program
    return None


def main(root):
    program = find_program()
    if not program:
        print(f"no clang-format {VERSION}: skipped")
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
    print(f"run: {program} -i on the files named above")
    return 1


if __name__ == "__main__":
    sys.exit(main(tree.root_from(sys.argv)))
