#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run `signorini FILE MORE` and compare its exit code and message with the comments at the head of the file.

Comments: `# exit: CODE` and any number of `# message: FRAGMENT` (all must appear in the message).
"""
import re
import subprocess
import sys


def read_expectation(file):
    expectation = {"exit": [], "message": []}
    with open(file, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            found = re.match(r"# (exit|message): (.*)", line.rstrip("\r\n"))
            if found:
                expectation[found[1]].append(found[2])
    return expectation


def main():
    program, file, *more = sys.argv[1:]
    expectation = read_expectation(file)
    run = subprocess.run([program, *more, file], capture_output=True, text=True, check=False)
    message = run.stdout + run.stderr
    faults = [f"the message lacks '{text}'" for text in expectation["message"] if text not in message]
    if [str(run.returncode)] != expectation["exit"]:
        faults.append(f"exit code {run.returncode}, expected {expectation['exit']}")
    if not expectation["message"]:
        faults.append("the file expects no message")
    for trace in ("terminate called", "Stacktrace", "MPI_ABORT", "runtime error"):
        if trace in message:
            faults.append(f"the message has '{trace}'")
    if faults:
        print("\n".join(faults) + "\n--- the program said:\n" + message)
    return 1 if faults else 0


sys.exit(main())
