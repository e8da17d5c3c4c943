#!/usr/bin/env python3
"""Runs talus with spoiled files and looks at how it ends.

Usage: run.py TALUS WORK_DIRECTORY CASES SEED [FORK_SERVER] [--case NUMBER]

Each case is a valid input with a few changes, which hang on SEED and the number of the case alone. The program must end
within ten seconds of processor time with 0, 1 or 2, without a signal; with one sentence of its own on stderr where it is
not 0, and with finite numbers in all files where it is. --case runs one of them and keeps its files.
"""
import os
import random
import re
import shutil
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE), os.path.join(os.path.dirname(HERE), "errors")]
import checkpoint  # noqa: E402
import files  # noqa: E402
from copies import Copies  # noqa: E402
from elements import POINT  # noqa: E402
from mutations import mutate_bytes, mutate_lines, mutate_table  # noqa: E402
from seeds import SEEDS  # noqa: E402

STEPS = 3
SECONDS, GRACE = 10, 300  # of the processor, and by the clock where others use the machine
LIMIT = ["--set", f"Run/Number of steps = {STEPS}", "--set", "Output/Directory = output"]
RAW = re.compile(r"std::|basic_string|vector::|stoi|stod|stoul|HDF5-DIAG|An error occurred in|violated condition|Additional info|"
                 r"[Bb]oost|\bmu::|Exception of|p4est|MPI_|terminate called|Assertion|bad_|what\(\)|deal\.II|dealii|Exc[A-Z]|"
                 r"[Ss]egmentation|ERROR: |SUMMARY: |runtime error|libtalus|\.cc:|\.h:")


def write(directory, name, data):
    with open(os.path.join(directory, name), "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode("utf8", "surrogateescape"))


class Cases:
    def __init__(self, program, work, seed):
        self.program, self.work, self.seed = program, work, seed
        self.whole, self.checkpoints = {}, []
        for name, (text, named) in SEEDS.items():
            directory = self.directory_of("seed " + name)
            write(directory, "case.prm", text)
            for file, content in named.items():
                write(directory, file, content)
            # With all the entries that there are, so that each of them has its turn.
            status, entries, error = program.run(["case.prm", "--parameters"], directory)
            assert status == 0, f"seed {name}: {error}"
            self.whole[name] = "\n".join(line for line in entries.split("\n") if not line.lstrip().startswith("#"))
            status, _, error = program.run(["case.prm", "--set", f"Checkpoints/Step interval = {STEPS - 1}"] + LIMIT, directory)
            assert status == 0, f"seed {name}: {error}"
            self.checkpoints.append(name)

    def directory_of(self, name):
        directory = os.path.join(self.work, name.replace(" ", "_"))
        shutil.rmtree(directory, ignore_errors=True)
        os.makedirs(directory)
        return directory

    def run(self, number):
        """What is wrong, and what was done."""
        dice = random.Random(f"{self.seed}.{number}")
        directory = self.directory_of(f"case {number}")
        kind = dice.choice(["entries"] * 8 + ["bytes"] * 2 + ["files"] * 5 + ["checkpoint"] * 3 + ["arguments", "element"])
        name, arguments = getattr(self, kind)(dice, directory)
        status, out, err = self.program.run(arguments, directory, SECONDS, GRACE)
        return problems_of(status, out, err, directory), f"{kind} of {name}: {' '.join(arguments)[:300]}", status, err, directory

    def prepare(self, dice, directory, names):
        name = dice.choice(names)
        for file, content in SEEDS[name][1].items():
            write(directory, file, content)
        return name, self.whole[name] if dice.randrange(2) else SEEDS[name][0]

    def entries(self, dice, directory):
        name, text = self.prepare(dice, directory, list(SEEDS))
        for _ in range(dice.choice([1, 1, 1, 2, 4])):
            text = mutate_lines(dice, text)
        write(directory, "case.prm", text)
        return name, ["case.prm"] + LIMIT

    def bytes(self, dice, directory):
        name, text = self.prepare(dice, directory, list(SEEDS))
        write(directory, "case.prm", mutate_bytes(dice, text.encode()))
        return name, ["case.prm"] + LIMIT

    def files(self, dice, directory):
        name, text = self.prepare(dice, directory, [name for name in SEEDS if SEEDS[name][1]])
        write(directory, "case.prm", text)
        for file, content in SEEDS[name][1].items():
            if dice.randrange(3):
                for _ in range(dice.choice([1, 1, 2, 5])):
                    content = mutate_table(dice, content)
                write(directory, file, content)
            else:
                write(directory, file, mutate_bytes(dice, content.encode()))
        return name, ["case.prm"] + LIMIT

    def checkpoint(self, dice, directory):
        name = dice.choice(self.checkpoints)
        before = os.path.join(self.work, f"seed {name}".replace(" ", "_"))
        shutil.rmtree(directory)
        shutil.copytree(before, directory)
        output = os.path.join(directory, "output")
        path = next(os.path.join(output, file) for file in os.listdir(output) if file.startswith("checkpoint_"))
        if dice.randrange(4) == 0:
            path = dice.choice([path, os.path.join(output, "statistics.csv")])
            with open(path, "rb") as file:
                data = file.read()
            write(output, os.path.basename(path), mutate_bytes(dice, data))
        elif checkpoint.h5py:
            checkpoint.mutate(dice, path)
        return name, ["--resume", "output", "--set", f"Run/Number of steps = {STEPS + 1}"]

    def element(self, dice, directory):
        text = POINT
        for _ in range(dice.choice([1, 1, 2, 4])):
            text = mutate_lines(dice, text)
        write(directory, "case.prm", text)
        return "a point", ["--element", "case.prm", "--set", "Element/Steps = 20", "--set", "Output/Directory = output"]

    def arguments(self, dice, directory):
        name, text = self.prepare(dice, directory, list(SEEDS))
        write(directory, "case.prm", text)
        words = ["case.prm"] + LIMIT + ["--set", mutate_lines(dice, "set Run/End time = 1").replace("set ", "", 1)]
        for _ in range(dice.randrange(3)):
            words[dice.randrange(len(words))] = dice.choice(["--set", "--resume", "output", "--list", "--parameters", "", "-", "/",
                                                             "case.prm", ".", "Run/End time", "=", "--set=Run/End time = 1"])
        return name, words


def problems_of(status, out, err, directory):
    if status is None:
        return ["it does not end"]
    problems = [] if status in (0, 1, 2) else [f"exit status {status}"]
    if status and not re.fullmatch(r"talus: [^\n]+\n", err):
        problems.append("stderr is not one message")
    found = RAW.search(err) or RAW.search(out)
    if found:
        problems.append(f"'{found[0]}' is written")
    output = os.path.join(directory, "output")
    for name in sorted(os.listdir(output)) if os.path.isdir(output) else []:
        kind = name.rsplit(".", 1)[-1]
        if name.startswith("failure_") or kind not in ("csv", "vtu"):
            if name.startswith("particles_") and kind == "h5" and status == 0:
                problems += [f"{name}: {problem}" for problem in files.problems_in_hdf5(os.path.join(output, name))]
            continue
        with open(os.path.join(output, name), errors="replace") as file:
            content = file.read()
        if status == 0:  # wrong files of before stay where they are refused
            try:
                found = files.problems_in_csv(content) if kind == "csv" else files.problems_in_vtu(content)
            except Exception as error:
                found = [repr(error)]
            # Nodes that a changed checkpoint does not list as active are in no file.
            problems += [f"{name}: {problem}" for problem in found if problem != "no numbers found"]
    return problems


def main():
    words = sys.argv[1:]
    only = int(words[words.index("--case") + 1]) if "--case" in words else None
    words = words[:words.index("--case")] if only is not None else words
    talus, work, n, seed = words[:4]
    program = Copies(talus, *words[4:])
    cases = Cases(program, os.path.abspath(work), seed)
    n_failed, ends = 0, {0: 0, 1: 0, 2: 0}
    for number in [only] if only is not None else range(int(n)):
        problems, what, status, err, directory = cases.run(number)
        ends[status] = ends.get(status, 0) + 1
        if problems or only is not None:
            n_failed += bool(problems)
            print(f"FAIL case {number}, {what}\n    " + "\n    ".join(problems))
            print("    " + "\n    ".join(err[-1500:].splitlines()[-8:]), flush=True)
        else:
            shutil.rmtree(directory)
    print(f"{n} cases with seed {seed}, {n_failed} wrong; {program.seconds:.0f} s of the processor; exit status: " +
          ", ".join(f"{status} {count} times" for status, count in ends.items()))
    return n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
