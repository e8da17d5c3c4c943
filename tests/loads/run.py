#!/usr/bin/env python3
"""Runs talus under loads, friction and damping, and compares with closed forms.

Usage: run.py TALUS WORK_DIRECTORY CASE RANKS [MPIRUN ...]

CASE is the name of a function below that begins with case_; its files lie beside this one.
"""
import csv
import math
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


class Runs:
    def __init__(self, talus, work, mpirun):
        self.talus, self.work, self.mpirun, self.n_failed = talus, work, mpirun, 0

    def run(self, prm, name, *settings):
        """Runs a file with "Section/Entry = value"... and returns its directory."""
        directory = os.path.join(self.work, name)
        shutil.rmtree(directory, ignore_errors=True)
        command = self.mpirun + [self.talus, os.path.join(HERE, prm)]
        for setting in settings + (f"Output/Directory = {directory}",):
            command += ["--set", setting]
        environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
        result = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if result.returncode != 0:
            sys.exit(f"FAIL {name}: exit status {result.returncode}\n{result.stdout}")
        return directory

    def statistics(self, prm, name, *settings):
        """The columns of the run's statistics by name, without units."""
        return columns_of(os.path.join(self.run(prm, name, *settings), "statistics.csv"))

    def check(self, name, error, bound):
        is_good = abs(error) <= bound
        self.n_failed += not is_good
        print(f"{'  pass' if is_good else '  FAIL'} {name}: error / bound = {abs(error) / bound:.3g} (bound {bound:g})")


def columns_of(path):
    with open(path) as file:
        header, *rows = csv.reader(line for line in file if not line.startswith("#"))
    names = [name.split(" [")[0] for name in header]
    return {name: [float(value) for value in column] for name, column in zip(names, zip(*rows))}


def maxima(times, values):
    """Times and values of the inner maxima, by a parabola through three rows."""
    found = []
    for k in range(1, len(values) - 1):
        if values[k - 1] < values[k] >= values[k + 1]:
            slope, curvature = (values[k + 1] - values[k - 1]) / 2, values[k + 1] - 2 * values[k] + values[k - 1]
            found.append((times[k] - slope / curvature * (times[k + 1] - times[k]), values[k] - slope**2 / curvature / 2))
    return found


def case_incline(runs, prm, direction):
    """
    A block slides with g (sin - mu cos) down an incline of 30 degrees. It starts with a speed that keeps its whole
    base sliding while it vibrates; then the friction impulse is mu times the normal impulse, which is the weight's
    but for what the block still bounces with. Where mu > tan 30 degrees it stays, if the slope is not let go at once:
    a shock makes an elastic block hop.
    """
    g, angle, start = 9.81, math.pi / 6, 0.5
    velocity = "; ".join(str(start * direction.get(axis, 0)) for axis in ("xyz" if len(direction) > 1 else "xy"))

    def along(s, k):
        return sum(s[f"momentum_{axis}"][k] * n for axis, n in direction.items()) / s["mass"][k]

    for mu in (0, 0.2, 0.4):
        s = runs.statistics(prm, f"mu_{mu}", f"Conditions/slope/Friction coefficient = {mu}",
                            f"Bodies/block/Velocity = {velocity}")
        gained = along(s, -1) - along(s, 0)
        across = math.hypot(*(s[f"momentum_{axis}"][-1] / s["mass"][-1] - along(s, -1) * n
                              for axis, n in direction.items()))
        wanted = g * (math.sin(angle) - mu * math.cos(angle)) * s["time"][-1] - mu * s["momentum_y"][-1] / s["mass"][-1]
        runs.check(f"mu = {mu}: velocity gained {gained:.5g} for {wanted:.5g}", (gained - wanted) / abs(wanted), 1e-3)
        runs.check(f"mu = {mu}: direction", across / start, 5e-3)
    force = "; ".join("-9.81 * cos(pi/6)" if axis == "y" else f"{g * math.sin(angle) * direction.get(axis, 0)} * min(1, 5*t)"
                      for axis in ("xyz" if len(direction) > 1 else "xy"))
    s = runs.statistics(prm, "rest", "Conditions/slope/Friction coefficient = 0.7", f"Run/Body force = {force}",
                        "Run/End time = 0.4", f"Bodies/block/Velocity = {'; '.join('0' * len(force.split(';')))}")
    time = s["time"]
    way = sum((time[k] - time[k - 1]) * along(s, k) for k in range(1, len(time)))
    free_way = g * math.sin(angle) * (0.2**2 / 6 + 0.2 * 0.2 / 2 + 0.2**2 / 2)
    runs.check("mu = 0.7 from rest: way over that of free sliding", way / free_way, 0.01)


def case_incline_2d(runs):
    case_incline(runs, "../../prm/incline.prm", {"x": 1.})


def case_incline_3d(runs):
    case_incline(runs, "incline_3d.prm", {"x": math.cos(math.radians(35)), "z": math.sin(math.radians(35))})


def case_damping(runs):
    """
    Local damping of the first mode of a bar: force and velocity are one shape, so that it is a single oscillator
    with stiffness k (1 + alpha) while it slows down and k (1 - alpha) while it speeds up. From one passage through
    the middle to the next the kinetic energy falls by (1 - alpha)/(1 + alpha).
    """
    period = 0.2
    for alpha in (0.05, 0.2, 0.5):
        half = period / 4 * (1 / math.sqrt(1 - alpha) + 1 / math.sqrt(1 + alpha))
        s = runs.statistics("bar_2d.prm", f"alpha_{alpha}", f"Run/Local damping = {alpha}", f"Run/End time = {4.4 * half}")
        peaks = maxima(s["time"], s["kinetic energy"])
        runs.check(f"alpha = {alpha}: number of passages less four", len(peaks) - 4, 0.5)
        for n, (time, energy) in enumerate(peaks, 1):
            wanted = s["kinetic energy"][0] * ((1 - alpha) / (1 + alpha))**n
            runs.check(f"alpha = {alpha}: energy after {n} half periods", energy / wanted - 1, 0.02 * n)
            runs.check(f"alpha = {alpha}: time of {n} half periods", time / (n * half) - 1, 0.01)


def main():
    talus, work, case, ranks = sys.argv[1:5]
    runs = Runs(talus, work, sys.argv[5:] + ["-n", ranks] if ranks != "1" else [])
    globals()["case_" + case](runs)
    return runs.n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
