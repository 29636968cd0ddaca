#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holds the includes to doc/layers.txt: layers.py ROOT.

A file includes only headers of its own folder and of folders above it in doc/layers.txt, by the path from include/,
and no header includes itself by way of others. source/ mirrors include/signorini/: headers stand in the one, sources in
the other; NAME.cc (or NAME_part.cc) belongs to NAME.h in the same folder. source/main.cc may include everything.
"""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
import tree

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<(signorini/[^>]+)>)', re.MULTILINE)
PREFIX = "signorini/"


def check(root):
    folders = read_order(root / "doc/layers.txt")
    headers = {str(path.relative_to(root / "include")): path for path in tree.files(root, "include")}
    sources = [path for path in tree.files(root, "source")]
    errors = []
    for path in list(headers.values()) + sources:
        errors += check_place(root, path, folders)
    for path in sources:
        errors += check_header_of(root, path)
    includes = {}
    for path in list(headers.values()) + sources:
        found, wrong = check_includes(root, path, folders, headers)
        errors += wrong
        if path.is_relative_to(root / "include"):
            includes[str(path.relative_to(root / "include"))] = found
    return errors + find_cycles(includes)


def read_order(path):
    lines = [line.partition("#")[0].strip() for line in tree.read(path).splitlines()]
    return {folder: level for level, folder in enumerate(line for line in lines if line)}


def folder_of(root, path):
    """The folder as doc/layers.txt names it; empty for a file beside the folders."""
    base = root / "include" / "signorini" if path.is_relative_to(root / "include") else root / "source"
    if not path.is_relative_to(base):
        return ""
    folder = path.parent.relative_to(base).as_posix()
    return "" if folder == "." else folder


def is_main(root, path):
    return path == root / "source" / "main.cc"


def check_place(root, path, folders):
    name = path.relative_to(root)
    expected = ".h" if path.is_relative_to(root / "include") else ".cc"
    errors = []
    if path.suffix != expected:
        errors.append(f"{name}: {name.parts[0]}/ holds {expected} files only")
    if not is_main(root, path) and folder_of(root, path) not in folders:
        errors.append(f"{name}: its folder is not listed in doc/layers.txt")
    return errors


def check_header_of(root, path):
    if is_main(root, path) or path.suffix != ".cc":
        return []
    folder = root / "include" / "signorini" / path.parent.relative_to(root / "source")
    words = path.stem.split("_")
    if any((folder / ("_".join(words[:count]) + ".h")).is_file() for count in range(len(words), 0, -1)):
        return []
    return [f"{path.relative_to(root)}: there is no {(folder / path.stem).relative_to(root)}.h"]


def check_includes(root, path, folders, headers):
    """The project's headers that a file includes, and what is wrong with them."""
    name, own = path.relative_to(root), folder_of(root, path)
    found, errors = [], []
    for quoted, angled in INCLUDE.findall(tree.read(path)):
        header = quoted or angled
        if angled or not header.startswith(PREFIX):
            errors.append(f'{name}: write #include "signorini/..." for own headers and <...> for others: {header}')
        elif header not in headers:
            errors.append(f"{name}: includes {header}, which does not exist")
        else:
            found.append(header)
            folder = folder_of(root, headers[header])
            if is_main(root, path) or folder == own or own not in folders or folder not in folders:
                continue
            if folders[folder] > folders[own]:
                errors.append(f"{name}: includes {header}, but {folder} stands below {own} in doc/layers.txt")
    return found, errors


def find_cycles(includes):
    errors, done = [], set()

    def visit(header, way):
        if header in way:
            errors.append("cycle of includes: " + " -> ".join(way[way.index(header):] + [header]))
        elif header not in done:
            for other in includes.get(header, []):
                visit(other, way + [header])
            done.add(header)

    for header in includes:
        visit(header, [])
    return errors


if __name__ == "__main__":
    sys.exit(tree.report(check(pathlib.Path(tree.root_from(sys.argv))), "layers"))
