"""Runs of the program, and what they leave behind."""
import concurrent.futures
import csv
import dataclasses
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import time
from typing import Optional

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
TALUS = ROOT / os.environ.get("TALUS_BUILD", "build") / "talus"


@dataclasses.dataclass
class Run:
    """
    One parameter file with changes; `label` holds what tells it from its sisters, by column of the table. `ranks`: where the
    run asks for a number of its own.
    """
    prm: str
    settings: dict
    label: dict
    ranks: Optional[int] = None

    @property
    def name(self):
        return "-".join(str(value).replace(" ", "_").replace("/", "_") for value in self.label.values())


class Result:
    """What a run has left in its directory. Values of a failed run are NaN."""

    def __init__(self, run, directory, status, seconds):
        self.run, self.directory, self.status, self.seconds = run, directory, status, seconds
        self.comparison = {}
        table = directory / "comparison.csv"
        if status == 0 and table.exists():
            with open(table, newline="") as file:
                self.comparison = {(row["quantity"], row["name"]): float(row["value"]) for row in csv.DictReader(file)}

    def value(self, quantity, name):
        return self.comparison.get((quantity, name), math.nan)

    @property
    def message(self):
        """The line in which the program says why it failed."""
        lines = [line for line in (self.directory / "output.txt").read_text().splitlines() if line.startswith("talus: ")]
        return lines[-1] if lines else f"exit status {self.status}"

    def particles(self, time=None):
        """The columns of the last particle table by name, in the order of the ids; or of the one closest to a time."""
        paths = sorted(self.directory.glob("particles_*.csv"))
        path = paths[-1] if time is None else min(paths, key=lambda path: abs(table_time(path) - time))
        with open(path) as file:
            lines = (line for line in file if not line.startswith("#"))
            names = next(lines).strip().split(",")
            values = np.loadtxt(lines, delimiter=",", ndmin=2)
        values = values[np.argsort(values[:, names.index("id")])]
        return {name: values[:, column] for column, name in enumerate(names)}

    def statistics(self):
        """The columns of statistics.csv by name, without units."""
        return {name.replace("_", " "): values for name, values in self.columns("statistics.csv").items()}

    def columns(self, name):
        """The columns of a table in the run's directory by name, without units."""
        with open(self.directory / name) as file:
            lines = (line for line in file if not line.startswith("#"))
            names = [name.split(" [")[0] for name in next(lines).strip().split(",")]
            values = np.loadtxt(lines, delimiter=",", ndmin=2)
        return {name: values[:, column] for column, name in enumerate(names)}

    @property
    def has_failed(self):
        """Ended by a criterion of failure, in one sentence: what is expected of some runs."""
        return self.status == 2

    def failure_time(self):
        """When the run failed, as its message says; NaN if it did not."""
        found = re.search(r"\bt = ([0-9.eE+-]+)", self.message) if self.has_failed else None
        return float(found[1].rstrip(".,")) if found else math.nan


def table_time(path):
    """The time in the first line of a particle table."""
    with open(path) as file:
        found = re.search(r"time ([0-9.eE+-]+)", file.readline())
    return float(found[1]) if found else math.inf


def command(prm, settings, ranks=1):
    line = []
    if ranks > 1:
        line = ["mpirun", "--oversubscribe", "-n", str(ranks)]
        if os.geteuid() == 0:  # in containers; mpirun refuses otherwise
            line.insert(1, "--allow-run-as-root")
    line += [str(TALUS), str(prm)]
    for entry, value in settings.items():
        line += ["--set", f"{entry} = {value}"]
    return line


def execute(run, directory, ranks=1):
    """Runs it, with all it says in output.txt."""
    directory = pathlib.Path(directory) / run.name
    directory.mkdir(parents=True, exist_ok=True)
    settings = {**run.settings, "Output/Directory": directory, "Output/Overwrite": "true", "Output/CSV": "true"}
    start = time.perf_counter()
    # What the program writes goes beside its own files, which it replaces.
    finished = subprocess.run(command(ROOT / run.prm, settings, run.ranks or ranks), cwd=ROOT, text=True,
                              env={**os.environ, "OMP_NUM_THREADS": "1"},
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    (directory / "output.txt").write_text(finished.stdout)
    result = Result(run, directory, finished.returncode, time.perf_counter() - start)
    (directory / "run.json").write_text(json.dumps({"status": result.status, "seconds": round(result.seconds, 2)}) + "\n")
    return result


def recall(run, directory):
    """What an earlier call of `execute` has left."""
    directory = pathlib.Path(directory) / run.name
    try:
        ended = json.loads((directory / "run.json").read_text())
    except FileNotFoundError:
        stop(f"there is no '{directory}/run.json': this run has not been made, or not to its end. Leave --evaluate out.")
    return Result(run, directory, ended["status"], ended["seconds"])


def execute_all(runs, directory, jobs=2, ranks=1):
    """All runs, `jobs` at a time, with a line for each that ends; the results in the order of the runs."""
    directory = pathlib.Path(directory).resolve()
    done = 0
    print(f"{len(runs)} runs, {jobs} at a time; their files go to {directory}", flush=True)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(execute, run, directory, ranks) for run in runs]
        for future in concurrent.futures.as_completed(futures):
            result = future.result()
            done += 1
            ending = "" if result.status == 0 else "  FAILED: " + result.message
            print(f"  [{done:2}/{len(runs)}] {result.run.name:28} {result.seconds:6.1f} s{ending}", flush=True)
    return [future.result() for future in futures]


def default_jobs():
    return min(2, os.cpu_count() or 1)


def stop(message):
    sys.exit(f"{pathlib.Path(sys.argv[0]).stem}: {message}")
