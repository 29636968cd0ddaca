# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files of the repository, as the structure tests see them. No git: a copy without history is tested as well."""
import pathlib

OUTSIDE = {"build", "output", ".git", "__pycache__"}


def files(root, *folders):
    """Every file of the folders (of the whole repository without any), build and output folders apart."""
    found = []
    for folder in [root / name for name in folders] or [root]:
        for path in sorted(folder.rglob("*")):
            if path.is_file() and not OUTSIDE & set(path.relative_to(root).parts):
                found.append(path)
    return found


def has_shebang(path):
    with path.open("rb") as stream:
        return stream.read(2) == b"#!"


def is_code(path):
    """Sources, CMake files and scripts: what carries a licence line."""
    return path.suffix in (".h", ".cc", ".cmake", ".py", ".sh") or path.name == "CMakeLists.txt" or has_shebang(path)


def read(path):
    return path.read_text(encoding="utf-8", errors="replace")


def report(errors, what):
    """Prints what was found; the exit code of a check."""
    for error in errors:
        print(error)
    print(f"{what}: {len(errors)} error{'' if len(errors) == 1 else 's'}")
    return 1 if errors else 0


def root_from(arguments):
    return pathlib.Path(arguments[1] if len(arguments) > 1 else ".").resolve()
