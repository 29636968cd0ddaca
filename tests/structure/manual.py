#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/parameters.md is what the program prints: manual.py ROOT PROGRAM."""
import difflib
import subprocess
import sys

sys.dont_write_bytecode = True
import tree


def main(root, program):
    done = subprocess.run([program, "--parameters=md"], capture_output=True, text=True, check=False)
    if done.returncode != 0 or not done.stdout.strip():
        print(f"{program} --parameters=md: exit code {done.returncode}\n{done.stderr}")
        return 1
    path = root / "doc/parameters.md"
    stored = tree.read(path) if path.is_file() else ""
    if stored == done.stdout:
        return 0
    changes = difflib.unified_diff(stored.splitlines(), done.stdout.splitlines(), "doc/parameters.md",
                                   "signorini --parameters=md", lineterm="", n=1)
    print("\n".join(list(changes)[:40]))
    print("doc/parameters.md is not current: build/release/signorini --parameters=md > doc/parameters.md")
    return 1


if __name__ == "__main__":
    sys.exit(main(tree.root_from(sys.argv), sys.argv[2]))
