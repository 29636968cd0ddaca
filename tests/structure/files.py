#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sizes, licence lines, scripts, parameter files and change notes: files.py ROOT."""
import os
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import tree

LICENCE = "SPDX-License-Identifier: LGPL-2.1-or-later"
GREATEST = 400
GREATEST_MAIN = 60
KINDS = ("New", "Changed", "Fixed")


def check(root):
    errors = []
    for path in tree.files(root):
        name = path.relative_to(root)
        if tree.is_code(path):
            errors += check_code(name, tree.read(path))
        if tree.has_shebang(path):
            errors += check_script(path, name)
        elif path.parent == root / "scripts" and path.suffix != ".md":
            errors += check_shell(path, name)
    for path in tree.files(root, "parameter_files"):
        if path.suffix == ".prm":
            errors += check_parameter_file(path.relative_to(root), tree.read(path))
    for path in tree.files(root, "doc/changes"):
        if path.name != "README.md":
            errors += check_change(path.relative_to(root), path.suffix, tree.read(path))
    return errors


def check_code(name, text):
    errors = []
    lines = text.splitlines()
    greatest = GREATEST_MAIN if name.as_posix() == "source/main.cc" else GREATEST
    if len(lines) > greatest:
        errors.append(f"{name}: {len(lines)} lines; {greatest} at most")
    # The pattern is put together so that this file does not count itself twice.
    stated = [number for number, line in enumerate(lines) if re.match(r"(//|#) " + LICENCE + "$", line)]
    if len(stated) != 1 or stated[0] > 1:
        errors.append(f"{name}: needs one line '{LICENCE}' in its first two lines, in a comment of its own")
    return errors


def check_script(path, name):
    errors = []
    if not os.access(path, os.X_OK):
        errors.append(f"{name}: starts with #! but may not be executed")
    first = tree.read(path).split("\n", 1)[0]
    if "bash" in first:
        errors += check_shell(path, name)
    elif "python" in first:
        try:
            compile(tree.read(path), str(name), "exec")
        except SyntaxError as error:
            errors.append(f"{name}: {error}")
    return errors


def check_shell(path, name):
    done = subprocess.run(["bash", "-n", str(path)], capture_output=True, text=True, check=False)
    return [] if done.returncode == 0 else [f"{name}: bash -n: {done.stderr.strip()}"]


def check_parameter_file(name, text):
    if text.lstrip().startswith("#"):
        return []
    return [f"{name}: must start with a comment: purpose, source, expected result"]


def check_change(name, suffix, text):
    first = text.split("\n", 1)[0]
    if suffix == ".md" and re.match(rf"({'|'.join(KINDS)}): \S.*\.$", first):
        return []
    return [f"{name}: a change note is a .md file whose first line is '{'|'.join(KINDS)}: one sentence.'"]


if __name__ == "__main__":
    sys.exit(tree.report(check(tree.root_from(sys.argv)), "files"))
