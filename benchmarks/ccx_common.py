# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the comparisons with CalculiX share: the two programs, a run of one of them and what it costs, lines of a deck."""
import os
import shutil
import subprocess
import sys

# One thread each, whichever library brings threads.
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1"}
# In half cells, in the order in which CalculiX has the nodes.
HEXAHEDRON_CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))


class RunError(Exception):
    """A code did not finish, or not with a result."""


def find_ccx(signorini):
    """The path of ccx. Where it is missing the program ends with code 0, and with 2 where signorini, a path, is."""
    ccx = shutil.which("ccx")
    if not ccx:
        print("There is no ccx: nothing is compared. On Debian: apt-get install calculix-ccx")
        sys.exit(0)
    if not signorini.is_file():
        print(f"{sys.argv[0]}: {signorini} is missing; scripts/run builds it.", file=sys.stderr)
        sys.exit(2)
    return ccx


def execute(name, command, directory):
    """Runs it there; user and system time [s] and peak of the resident memory [MB], in which the system counts this Python's
    own from before the start. RunError: it ended with a code other than 0."""
    directory.mkdir(parents=True, exist_ok=True)
    with (directory / "screen.txt").open("wb") as screen:
        process = subprocess.Popen(command, cwd=directory, stdout=screen, stderr=subprocess.STDOUT,
                                   env={**os.environ, **ENVIRONMENT})
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RunError(f"{name}: exit code {process.returncode}; see {screen.name}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def signorini_command(program, file, directory, keys):
    """keys: what is set of the parameter file, by its path."""
    options = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
    return [str(program), str(file), "--output", str(directory), "--quiet", *options]


def numbered(rows, form, first=1):
    return [f"{number}," + ",".join(map(form.format, row)) for number, row in enumerate(rows, first)]
