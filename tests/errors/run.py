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

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from copies import Copies  # noqa: E402
from catalogue import BASE, CASES
from files import problems_in_directory, problems_in_failure

FORBIDDEN = ("Stacktrace", "Backtrace", "terminate called", "An error occurred in", "violated condition", "Segmentation")


def apply_changes(text, changes, message):
    """The text with (old, new) replaced, and the number of the first line changed last, or of the entry there that is meant."""
    line = 0
    entry = next((re.match("entry '([^']*)'", pattern)[1] for pattern in message if re.match("entry '[^']*'", pattern)), None)
    for old, new in changes:
        assert text.count(old) == 1, f"'{old}' must stand once in the base file"
        line = text[:text.index(old)].count("\n") + 1 + new[:max(0, new.find(f"set {entry} "))].count("\n")
        text = text.replace(old, new)
    return text, line


NOBODY = 65534
copies = None


def run(command, directory, user=None):
    global copies
    if len(command) and command[0].endswith("talus") and user is None:
        copies = copies or Copies(command[0])
        return copies.run(command[1:], directory, by_clock=60)
    environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    try:
        result = subprocess.run(command, cwd=directory, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True, timeout=60, user=user)
    except subprocess.TimeoutExpired as error:
        return None, (error.stdout or b"").decode(), (error.stderr or b"").decode()
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


def prepare(case, directory):
    """Files of a case; the line that its message names."""
    shutil.rmtree(directory, ignore_errors=True)
    os.makedirs(directory)
    text, line = apply_changes(BASE, case.changes, case.message)
    with open(os.path.join(directory, "case.prm"), "w") as file:
        file.write(text)
    for name, content in case.files.items():
        os.makedirs(os.path.dirname(os.path.join(directory, name)), exist_ok=True)
        with open(os.path.join(directory, name), "wb" if isinstance(content, bytes) else "w") as file:
            file.write(content)
    return line


def why_not(case, directory, talus):
    """Why a case cannot be tried here, or nothing."""
    if case.disk:
        os.makedirs(os.path.join(directory, "disk"))
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={case.disk}k", "tmpfs", os.path.join(directory, "disk")],
                               stderr=subprocess.PIPE, text=True)
        return "no file system can be mounted: " + mount.stderr.strip() if mount.returncode else ""
    if case.is_user and os.getuid() == 0:
        os.chmod(directory, 0o777)
        try:
            subprocess.run([talus, "--version"], cwd=directory, user=NOBODY, check=True, stdout=subprocess.PIPE,
                           stderr=subprocess.PIPE)
        except (OSError, subprocess.SubprocessError) as error:
            return f"nobody but root can run it: {error}"
    return ""


def try_case(case, directory, talus, shear, mpirun):
    """What is wrong, and what was written to stderr."""
    line = prepare(case, directory)
    reason = why_not(case, directory, talus)
    if reason:
        return [], "left out, " + reason
    try:
        for arguments in case.before:
            status, stdout, stderr = run(mpirun + [talus] + arguments, directory)
            if status:
                return [f"the run before ends with {status}"], stderr
        if case.spoil:
            case.spoil(directory)
        arguments = [argument.replace("SHEAR", shear) for argument in case.arguments]
        user = NOBODY if case.is_user and os.getuid() == 0 else None
        status, stdout, stderr = run(mpirun + [talus] + arguments, directory, user)
        problems = [] if status == case.status else [f"exit status {status} instead of {case.status}"]
        problems += problems_in_message(case, stderr, f"case.prm:{line}", not mpirun)
        problems += [f"'{word}' is written" for word in FORBIDDEN if word in stdout]
        if case.output:
            problems += problems_in_directory(os.path.join(directory, case.output))
            problems += [] if case.disk else problems_in_failure(directory, stderr)
        return problems, stderr
    finally:
        if case.disk:
            subprocess.run(["umount", os.path.join(directory, "disk")])


def main():
    talus, shear, work, group, ranks = sys.argv[1:6]
    mpirun = sys.argv[6:] + ["-n", ranks] if ranks != "1" else []
    n_failed = 0
    for case in CASES[group]:
        problems, stderr = try_case(case, os.path.join(work, case.name.replace(" ", "_")), talus, shear,
                                    [] if case.is_user else mpirun)
        print(("FAIL " if problems else "pass ") + case.name + "".join("\n    " + p for p in problems))
        print("    " + "\n    ".join(line for line in stderr.splitlines()
                                     if problems or line.startswith(("talus: ", "left out, "))))
        n_failed += bool(problems)
    print(f"{len(CASES[group]) - n_failed} passed, {n_failed} failed")
    return n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
