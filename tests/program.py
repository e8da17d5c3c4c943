"""What drivers of the program share: runs of a parameter file, their tables, checks of errors against bounds."""
import csv
import math
import os
import re
import shutil
import subprocess
import sys

from copies import Copies


NOT_COMPARED = re.compile(r"(checkpoint|particles)_\d+\.h5|log\.txt|summary\.json|parameters.*\.prm")


class Runs:
    """Runs files that lie in `here` on some ranks, with directories in `work`, and counts the checks that fail."""

    def __init__(self, talus, work, mpirun, here):
        self.talus, self.work, self.mpirun, self.here, self.n_failed = talus, work, mpirun, here, 0
        self.copies = None

    def start(self, arguments, mpirun=None):
        """Runs the program: exit status and text."""
        mpirun = self.mpirun if mpirun is None else mpirun
        if not mpirun:
            self.copies = self.copies or Copies(self.talus)
            status, out, err = self.copies.run(arguments)
            return status, out + err
        environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
        result = subprocess.run(mpirun + [self.talus] + arguments, env=environment, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True)
        return result.returncode, result.stdout

    def execute(self, prm, name, *settings):
        """Runs a file with "Section/Entry = value"...: its directory, exit status and text."""
        directory = os.path.join(self.work, name)
        shutil.rmtree(directory, ignore_errors=True)
        arguments = [os.path.join(self.here, prm)]
        for setting in settings + (f"Output/Directory = {directory}",):
            arguments += ["--set", setting]
        return (directory, *self.start(arguments))

    def run(self, prm, name, *settings):
        """Runs a file that must succeed and returns its directory."""
        directory, status, text = self.execute(prm, name, *settings)
        if status != 0:
            sys.exit(f"FAIL {name}: exit status {status}\n{text}")
        return directory

    def statistics(self, prm, name, *settings):
        """The columns of the run's statistics by name, without units."""
        return columns_of(os.path.join(self.run(prm, name, *settings), "statistics.csv"))

    def check(self, name, error, bound):
        is_good = abs(error) <= bound
        self.n_failed += not is_good
        print(f"{'  pass' if is_good else '  FAIL'} {name}: error / bound = {abs(error) / bound:.3g} (bound {bound:g})")


def files(directory):
    return sorted(name for name in os.listdir(directory) if not NOT_COMPARED.fullmatch(name))


def content(path):
    with open(path, "rb") as file:
        return re.sub(rb"#This file was generated.*?-->|<!--.*?-->", b"", file.read(), flags=re.DOTALL)  # date and time


def differences(directory, other):
    """Names of files that are not in both, or whose bytes differ."""
    names, others = set(files(directory)), set(files(other))
    return sorted(names ^ others) + sorted(name for name in names & others if content(os.path.join(directory, name)) !=
                                           content(os.path.join(other, name)))


def columns_of(path, with_units=False):
    """The columns of a table by name."""
    with open(path) as file:
        header, *rows = csv.reader(line for line in file if not line.startswith("#"))
    names = header if with_units else [name.split(" [")[0] for name in header]
    return {name: [float(value) for value in column] for name, column in zip(names, zip(*rows))}


def last_particles(directory):
    """The particles at the end of a run, one dict each."""
    name = max(name for name in os.listdir(directory) if name.startswith("particles_") and name.endswith(".csv"))
    columns = columns_of(os.path.join(directory, name))
    return [dict(zip(columns, row)) for row in zip(*columns.values())]


def rms(values):
    return math.sqrt(sum(value**2 for value in values) / len(values))


def main(cases, here):
    """Arguments TALUS WORK_DIRECTORY CASE RANKS [MPIRUN ...]: calls case_CASE(runs); the exit status."""
    talus, work, case, ranks = sys.argv[1:5]
    runs = Runs(talus, work, sys.argv[5:] + ["-n", ranks] if ranks != "1" else [], here)
    cases["case_" + case](runs)
    return runs.n_failed > 0
