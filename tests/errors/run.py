#!/usr/bin/env python3
"""Runs talus with wrong inputs and checks exit status and message.

Usage: run.py TALUS SHEAR_PRM WORK_DIRECTORY GROUP RANKS [MPIRUN ...]

Each case changes a small file that runs. The message must be one line, written once, that names the place
and the remedy; without mpirun it must be all that is written to stderr. After a failed run the files left
behind must be complete and hold finite numbers only.
"""
import os
import re
import shutil
import subprocess
import sys

from cases import BASE, CASES
from files import problems_in_directory

FORBIDDEN = ("Stacktrace", "Backtrace", "terminate called", "An error occurred in", "violated condition", "Segmentation")


def apply_changes(text, changes):
    """The text with (old, new) replaced, and the number of the first line changed last."""
    line = 0
    for old, new in changes:
        assert text.count(old) == 1, f"'{old}' must stand once in the base file"
        line = text[:text.index(old)].count("\n") + 1
        text = text.replace(old, new)
    return text, line


def run(command, directory):
    environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    result = subprocess.run(command, cwd=directory, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, timeout=60)
    return result.returncode, result.stdout, result.stderr


def problems_in_message(case, stderr, where, is_direct):
    messages = [line for line in stderr.splitlines() if line.startswith("talus: ")]
    if len(messages) != 1:
        return [f"{len(messages)} messages instead of one"]
    problems = [f"'{word}' is written" for word in FORBIDDEN if word in stderr]
    if is_direct and stderr.strip() != messages[0]:
        problems.append("more than the message is written")
    for pattern in case.message:
        pattern = pattern.replace("FILE:LINE", re.escape(where))
        if not re.search(pattern, messages[0]):
            problems.append(f"the message lacks '{pattern}'")
    return problems


def main():
    talus, shear, work, group, ranks = sys.argv[1:6]
    mpirun = sys.argv[6:] + ["-n", ranks] if ranks != "1" else []
    n_failed = 0
    for case in CASES[group]:
        directory = os.path.join(work, case.name.replace(" ", "_"))
        shutil.rmtree(directory, ignore_errors=True)
        os.makedirs(directory)
        text, line = apply_changes(BASE, case.changes)
        with open(os.path.join(directory, "case.prm"), "w") as file:
            file.write(text)
        for name, content in case.files.items():
            os.makedirs(os.path.dirname(os.path.join(directory, name)), exist_ok=True)
            with open(os.path.join(directory, name), "w") as file:
                file.write(content)
        arguments = [argument.replace("SHEAR", shear) for argument in case.arguments]
        status, stdout, stderr = run(mpirun + [talus] + arguments, directory)

        problems = [] if status == case.status else [f"exit status {status} instead of {case.status}"]
        problems += problems_in_message(case, stderr, f"case.prm:{line}", not mpirun)
        problems += [f"'{word}' is written" for word in FORBIDDEN if word in stdout]
        if case.output:
            problems += problems_in_directory(os.path.join(directory, case.output))
        print(("FAIL " if problems else "pass ") + case.name + "".join("\n    " + p for p in problems))
        print("    " + "\n    ".join(line for line in stderr.splitlines() if problems or line.startswith("talus: ")))
        n_failed += bool(problems)
    print(f"{len(CASES[group]) - n_failed} passed, {n_failed} failed")
    return n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
