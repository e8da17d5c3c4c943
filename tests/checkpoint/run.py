#!/usr/bin/env python3
"""Runs that are stopped and resumed, against those that are not. Usage: see main() of program.py."""
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "tests"), os.path.join(ROOT, "tests", "compare")]
import compare  # noqa: E402
import program  # noqa: E402
from cases import all_of  # noqa: E402
from program import differences, files  # noqa: E402

OUTPUT = {"Output/CSV": "true", "Output/Grid": "true", "Output/Step interval": 7, "Output/Statistics interval": 2,
          "Checkpoints/Clock interval": 0}


def ranks(n):
    """The command that starts n ranks; MPIRUN is the end of the arguments."""
    return sys.argv[5:] + ["-n", str(n)] if n > 1 else []


def as_list(settings):
    return [f"{entry} = {value}" for entry, value in settings.items()]


def resume(runs, directory, *settings, mpirun=None):
    """Goes on with a run: exit status and text."""
    arguments = ["--resume", directory]
    for setting in settings:
        arguments += ["--set", setting]
    return runs.start(arguments, mpirun)


def report(runs, name, problems):
    runs.check(name + "".join("\n    " + problem for problem in problems), len(problems), 0.5)


def round_trip(runs, case, more={}):
    """A run, and a copy of it from which it goes on where it was half way: every file is the same to the byte."""
    stop = 2 * (case.steps // 3)
    whole = runs.run(case.prm, case.name + ".whole", *as_list({**case.settings, **OUTPUT, **more}), "Checkpoints/Kept = 9",
                     f"Run/Number of steps = {case.steps}", f"Checkpoints/Step interval = {stop // 2}")
    parts = os.path.join(runs.work, case.name)
    shutil.rmtree(parts, ignore_errors=True)
    shutil.copytree(whole, parts)
    for name in os.listdir(parts):
        if re.match("checkpoint_", name) and int(name[11:19]) > stop:
            os.remove(os.path.join(parts, name))
    status, text = resume(runs, parts)
    problems = [f"exit status {status}: {text}"] if status else differences(whole, parts)
    if f"step {stop}." not in text:
        problems.append(f"it did not go on from step {stop}")
    report(runs, f"{case.name}: {len(files(whole))} files", problems)


def case_boxes(runs):
    """On several ranks every second one."""
    for case in all_of("boxes")[::2 if runs.mpirun else 1]:
        round_trip(runs, case)


def case_others(runs):
    for case in all_of("others"):
        round_trip(runs, case)


def case_balance(runs):
    """Cells shared out anew: well, with the same results, and a run that goes on after it is the same to the byte."""
    for case in all_of("balance"):
        settings = as_list({**case.settings, "Run/Number of steps": case.steps})
        still = runs.run(case.prm, case.name + ".still", *settings, "Run/Largest imbalance = 0")
        moved = runs.run(case.prm, case.name + ".moved", *settings)
        with open(os.path.join(moved, "log.txt")) as file:
            found = re.findall(r"busiest rank had ([\d.]+) times.*and has ([\d.]+) now", file.read())
        bound = 1.1 if "Grid/Cells" in case.settings else 1.3  # on coarse grids it is a matter of a few cells
        runs.check(f"{case.name}: before {', '.join(before for before, _ in found)}; after",
                   max([float(after) for _, after in found], default=9), bound)
        a, b = (program.columns_of(os.path.join(d, "statistics.csv"), with_units=True) for d in (still, moved))
        worst, column = compare.largest_difference(list(a), list(a.values()), list(b.values()))
        runs.check(f"{case.name}: {column}", worst, compare.BOUND)
        round_trip(runs, case, {"Output/Step interval": 30})


def case_directory(runs):
    """Two runs in one directory; files that vanish."""
    prm = "tests/compare/disk_2d.prm"
    settings = ("Run/Courant number = 0.001", "Run/End time = 0.1", "Checkpoints/Step interval = 20")
    directory, process = start(runs, prm, "one", *settings)
    wait_for_rows(directory, process, 30)
    for name, command in (("a second run", [runs.talus, os.path.join(ROOT, prm), "--set", f"Output/Directory = {directory}",
                                            "--set", "Output/Overwrite = true"]),
                          ("a second one that goes on", [runs.talus, "--resume", directory])):
        second = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        runs.check(f"{name}: {second.stdout.strip().splitlines()[-1]}",
                   second.returncode != 1 or not re.search(r"another run writes into the directory '.*': process \d+ on \w+",
                                                           second.stdout) or process.poll() is not None, 0.5)
    os.remove(os.path.join(directory, "statistics.csv"))
    text = process.communicate(timeout=60)[0]
    line = next((line for line in text.splitlines() if line.startswith("talus: ")), text)
    runs.check(f"a file removed: {line}", process.returncode != 2 or "statistics.csv' was removed" not in line, 0.5)
    status, text = resume(runs, directory, "Run/Number of steps = 100000")
    runs.check(f"no table to go on with: {text.strip().splitlines()[-1]}", status != 2 or "cannot read" not in text, 0.5)

    directory, process = start(runs, prm, "stale", *settings)
    wait_for_rows(directory, process, 50)
    for pid in ranks_of(process):
        os.kill(pid, signal.SIGKILL)
    process.communicate()
    status, text = resume(runs, directory, f"Run/Number of steps = {n_rows(directory) + 100}")
    runs.check("the lock of a run that was killed", status != 0 or os.path.exists(os.path.join(directory, "talus.lock")), 0.5)

    directory, process = start(runs, prm, "moved", *settings)
    wait_for_rows(directory, process, 30)
    shutil.rmtree(directory + ".gone", ignore_errors=True)
    os.rename(directory, directory + ".gone")
    text = process.communicate(timeout=60)[0]
    line = next((line for line in text.splitlines() if line.startswith("talus: ")), text)
    runs.check(f"the directory gone: {line}", process.returncode != 2 or "removed" not in line and "Cannot write" not in line, 0.5)


def case_coverage(runs):
    """Each kernel, transfer, material, ... that there is stands in a case that is resumed."""
    texts = []
    for case in all_of("boxes") + all_of("others"):
        with open(case.prm if os.path.isabs(case.prm) else os.path.join(ROOT, case.prm)) as file:
            texts.append(file.read() + "".join(f"set x = {value}\n" for value in case.settings.values()))
    text = "\n".join(texts)
    for line in runs.start(["--list"])[1].splitlines():
        kind, name = re.match(r"(\S+(?: \S+)?)\s{2,}(\S+(?: \S+)*)\s{2,}", line).groups()
        if kind in ("kernel", "boundary treatment", "transfer", "material", "condition"):
            is_default = name in ("linear elastic", "no-slip")
            runs.check(f"{kind} {name}", not re.search(rf"=\s*{re.escape(name)}\s*(#.*)?$", text, re.MULTILINE) and not is_default, .5)
    for load in ("traction", "pressure", "force"):
        runs.check(f"load {load}", not re.search(rf"{load}", text, re.IGNORECASE), 0.5)


def case_undisturbed(runs):
    """A run with a checkpoint after every step is the run without any."""
    prm, settings = os.path.join(ROOT, "tests/compare/walls_2d.prm"), as_list({**OUTPUT, "Run/Number of steps": 60})
    report(runs, "checkpoints", differences(runs.run(prm, "without", *settings),
                                            runs.run(prm, "with", *settings, "Checkpoints/Step interval = 1")))


def case_ranks(runs):
    """On another number of ranks: as the run goes on there, to round-off, and particles cross the ranks' borders."""
    for case in all_of("ranks"):
        limit, stop = f"Run/Number of steps = {case.steps}", case.steps // 2
        settings = as_list({**case.settings, "Output/CSV": "true", "Checkpoints/Step interval": stop})
        whole = runs.run(case.prm, case.name + ".whole", *settings, limit)
        names, expected = program.columns_of(os.path.join(whole, "statistics.csv"), with_units=True), None
        header = list(names)
        expected = [list(column) for column in names.values()]
        for before, after in ((2, 1), (1, 2), (2, 4)):
            name = f"{case.name} {before} to {after}"
            runs.mpirun = ranks(before)
            parts = os.path.join(runs.work, name)
            if after == 4:
                shutil.rmtree(parts, ignore_errors=True)
                shutil.copytree(two, parts)
            else:
                runs.run(case.prm, name, *settings, f"Run/Number of steps = {stop}")
            if after == 1:
                two = os.path.join(runs.work, f"{case.name} on two")
                shutil.rmtree(two, ignore_errors=True)
                shutil.copytree(parts, two)
            status, text = resume(runs, parts, limit, mpirun=ranks(after))
            found = program.columns_of(os.path.join(parts, "statistics.csv"), with_units=True)
            is_same = status == 0 and list(found) == header and len(found[header[0]]) == len(expected[0])
            worst, column = compare.largest_difference(header, expected, list(found.values())) if is_same else (1, text)
            runs.check(f"{name}: {column}", worst, compare.BOUND)
            runs.mpirun = []


def popen(command, environment):
    """The process gives way to the test that watches it: on few cores it would be over before it is seen."""
    return subprocess.Popen(["nice", "-n", "5"] + command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True)


def start(runs, prm, name, *settings):
    """A run that goes on beside the test: its directory and process."""
    directory = os.path.join(runs.work, name)
    shutil.rmtree(directory, ignore_errors=True)
    command = runs.mpirun + [runs.talus, os.path.join(ROOT, prm)]
    for setting in settings + (f"Output/Directory = {directory}",):
        command += ["--set", setting]
    environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    return directory, popen(command, environment)


def n_rows(directory):
    """Rows of the statistics so far."""
    try:
        with open(os.path.join(directory, "statistics.csv")) as file:
            return sum(1 for _ in file) - 1
    except FileNotFoundError:
        return 0


def wait_for_rows(directory, process, n):
    end = time.time() + 60
    while n_rows(directory) < n and process.poll() is None and time.time() < end:
        time.sleep(0.01)


def ranks_of(process):
    """The processes of talus below this one."""
    children = {}
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/stat") as file:
                name, fields = re.fullmatch(r"\d+ \((.*)\) (.*)", file.read().strip(), flags=re.DOTALL).groups()
        except (FileNotFoundError, ProcessLookupError):
            continue
        children.setdefault(int(fields.split()[1]), []).append((int(pid), name))
    found, todo = [], [(process.pid, "mpirun" if process.args[3].endswith("mpirun") else "talus")]
    while todo:
        pid, name = todo.pop()
        found += [pid] if name == "talus" else []
        todo += children.get(pid, [])
    return sorted(found)


def case_signals(runs):
    """A signal ends a run with a checkpoint whose name is on the last line; resumed it is the run without a signal."""
    prm, n_steps = "tests/compare/disk_2d.prm", 800
    settings = as_list({**OUTPUT, "Run/Number of steps": n_steps, "Run/Courant number": 0.05, "Output/Step interval": 150})
    whole = runs.run(os.path.join(ROOT, prm), "whole", *settings)
    to_mpirun = [("SIGUSR1 to mpirun", signal.SIGUSR1, None)] if runs.mpirun else []
    to_ranks = [("SIGTERM", signal.SIGTERM, -1), ("SIGINT", signal.SIGINT, 0), ("SIGUSR1", signal.SIGUSR1, -1)]
    for name, number, rank in to_ranks + to_mpirun:
        directory, process = start(runs, prm, name, *settings)
        wait_for_rows(directory, process, 20)
        os.kill(process.pid if rank is None else ranks_of(process)[rank], number)
        text = process.communicate(timeout=60)[0]
        last = text.splitlines()[-1]
        match = re.fullmatch(r"Checkpoint (.*checkpoint_(\d{8})\.h5)", last)
        runs.check(f"{name}: exit status {process.returncode}, last line '{last}'",
                   process.returncode or not match or not os.path.exists(match.group(1)) or int(match.group(2)) >= n_steps, 0.5)
        with open(os.path.join(directory, "log.txt")) as log:
            *_, end = log.read().splitlines()
        runs.check(f"{name}: log.txt ends with '{end}'", not end.endswith(f" ended: signal {number.value} ({number.name})"), 0.5)
        status, text = resume(runs, directory)
        report(runs, f"{name}, resumed", [f"exit status {status}: {text}"] if status else differences(whole, directory))


def kills(runs, n, seed):
    """Killed at random moments, also while a checkpoint is written, and resumed until the end."""
    random.seed(seed)
    prm, n_steps = "tests/compare/disk_2d.prm", 600
    settings = as_list({**OUTPUT, "Run/Number of steps": n_steps, "Run/Courant number": 0.1, "Checkpoints/Step interval": 5,
                        "Output/Step interval": 150})
    whole = runs.run(os.path.join(ROOT, prm), "whole", *settings)
    n_killed = n_rounds = 0
    while n_killed < n:
        n_rounds += 1
        directory, process = start(runs, prm, f"killed.{n_rounds}", *settings)
        moments = sorted(random.uniform(0.05, 0.9) for _ in range(min(5, n - n_killed)))
        for moment in moments:
            wait_for_rows(directory, process, max(10, int(moment * n_steps / 2)))
            time.sleep(random.uniform(0, 0.02))
            for pid in ranks_of(process):
                os.kill(pid, signal.SIGKILL)
            process.communicate()
            n_killed += 1
            command = runs.mpirun + [runs.talus, "--resume", directory]
            process = popen(command, dict(os.environ, OMP_NUM_THREADS="1"))
        text = process.communicate(timeout=120)[0]
        is_refused = process.returncode and "is at its end" not in text  # killed after its last checkpoint: nothing is left to do
        problems = [f"exit status {process.returncode}: {text}"] if is_refused else differences(whole, directory)
        report(runs, f"killed at {', '.join(f'{moment:.0%}' for moment in moments)}", problems)


def case_killed(runs):
    kills(runs, 3, seed=int(os.environ.get("TALUS_SEED", time.time())))


def case_killed_often(runs):
    kills(runs, 50, seed=1)


def case_h5py(runs):
    """Checkpoints can be read by others: columns in the order of the ranks, attributes, checksums."""
    try:
        import h5py
    except ModuleNotFoundError:
        print("  pass: there is no h5py here, nothing was looked at")
        return
    directory = runs.run(os.path.join(ROOT, "tests/compare/balls_3d.prm"), "run", "Run/Number of steps = 8", "Output/CSV = true",
                         "Output/Particle fields = position, velocity, stress, mass", "Checkpoints/Step interval = 4")
    names = sorted(name for name in os.listdir(directory) if name.endswith(".h5"))
    runs.check(f"the last two are kept: {names}", names != ["checkpoint_00000004.h5", "checkpoint_00000008.h5"], 0.5)
    table = program.last_particles(directory)
    with h5py.File(os.path.join(directory, names[-1]), "r") as file:
        runs.check("step", file.attrs["step"] - 8, 0.5)
        runs.check("parameters", "set Cells = 8, 8, 8" not in file.attrs["parameters"], 0.5)
        particles = file["particles"]
        order = sorted(range(len(particles["id"])), key=lambda k: particles["id"][k])
        for column in table[0]:
            if column in particles:
                values = particles[column][:]
                runs.check(column, max(abs(values[k] - row[column]) for k, row in zip(order, table)), 1e-300)
        runs.check("begins", list(file["begins/particles"]) != sorted(file["begins/particles"]) or
                   file["begins/particles"][-1] != len(table), 0.5)
        carried = sum(particles[name].nbytes for name in particles)
    size = os.path.getsize(os.path.join(directory, names[-1]))
    print(f"       {len(table)} particles: {size} bytes, {size / carried:.2f} times the columns")


if __name__ == "__main__":
    sys.exit(program.main(globals(), HERE))
