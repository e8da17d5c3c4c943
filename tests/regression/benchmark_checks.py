"""What benchmarks must keep to: all of them, those of water, and those of sand."""
import math
import os
import re

import compare
from program import Runs, columns_of, last_particles

PRM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "prm")
G = 9.81
TABLES = "Output/CSV = true"


def run(runs, prm, name, *settings):
    """Runs one of prm/ and checks what every run keeps: the columns of its statistics, and its particles at the end."""
    settings += (TABLES,)
    directory = runs.run(prm, name, *settings)
    if runs.mpirun:
        alone = Runs(runs.talus, runs.work, [], PRM)
        check_ranks(runs, name, directory, alone.run(prm, name + "_1", *settings))
    s = columns_of(os.path.join(directory, "statistics.csv"))
    check_balance(runs, name, s)
    return s, last_particles(directory), directory


def check_ranks(runs, name, directory, other):
    tables = [columns_of(os.path.join(d, "statistics.csv"), with_units=True) for d in (directory, other)]
    for table in tables:  # the scale of momenta that are zero, as in a body that turns
        mass, energy = table["mass [mass]"][0], max(table["kinetic energy [energy]"])
        table["scale [mass length/time]"] = [math.sqrt(2 * mass * energy)]
    rows, others = (len(table["time [time]"]) for table in tables)
    runs.check(f"{name}: rows of statistics on one rank", rows - others, 0.5)
    difference, column = compare.largest_difference(list(tables[0]), *(list(table.values()) for table in tables))
    runs.check(f"{name}: difference from one rank, in '{column}'", difference, compare.BOUND)


def check_balance(runs, name, s):
    """
    Mass is constant and momentum the sum of all impulses, of weight and conditions: to the round-off of one addition
    per step. Forces of the conditions are the body's on them.
    """
    n = len(s["time"])
    names = [column[len("reaction "):-2] for column in s if column.startswith("reaction ") and column.endswith(" x")]
    weight = {"x": 0, "y": 0 if s["body force work"][-1] == 0 else -G * s["mass"][0]}
    runs.check(f"{name}: mass", max(abs(m / s["mass"][0] - 1) for m in s["mass"]), 1e-12)
    error, passed = 0, 0
    for axis in "xy":
        impulse = 0
        for k in range(1, n):
            forces = [weight[axis]] + [-s[f"reaction {condition} {axis}"][k] for condition in names]
            impulse += s["step size"][k] * sum(forces)
            passed += s["step size"][k] * sum(map(abs, forces))
            gained = s["momentum " + axis][k] + s["lost momentum " + axis][k] - s["momentum " + axis][0]
            error = max(error, abs(gained - impulse))
    if passed > 0:
        runs.check(f"{name}: momentum less impulses, over all impulses", error / passed, 1e-16 * n)


def check_failure(runs, prm, name, latest, *settings):
    """Without correction the run is unstable: exit status 2, with a sentence that says when."""
    _, status, text = runs.execute(prm, name, *settings, "Kernel/Boundary treatment = Steffen")
    runs.check(f"{name}: exit status {status} for 2", status - 2, 0.5)
    says_what = re.search(r"unstable|deforms|volume ratio|left the grid", text)
    says_when = re.search(r"\bt = ([0-9.e+-]*[0-9])", text)
    runs.check(f"{name}: fails at t", float(says_when[1]) if says_what and says_when else math.inf, latest)


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def late(s, column, share):
    """Mean of a column over the steps after a share of the run."""
    return mean(value for time, value in zip(s["time"], s[column]) if time > share * s["time"][-1])


def check_water(runs, name, s, particles, width, depth, h, sound):
    """
    A front is no faster than 2 sqrt(g H), Ritter's limit for shallow water, and the volume changes with the pressure,
    by no more than g H/c^2. The transfer takes what it does not resolve of the motion, the share h/H of the energy,
    and adds none.
    """
    front = max(p["x"] for p in particles) - width
    runs.check(f"{name}: front at {front:.3f} over 2 sqrt(g H) t", front / (2 * math.sqrt(G * depth) * s["time"][-1]), 1)
    runs.check(f"{name}: change of volume", max(abs(V / s["volume"][0] - 1) for V in s["volume"]), G * depth / sound**2)
    share = -s["energy residual"][-1] / s["body force work"][-1]
    runs.check(f"{name}: energy lost, {share:.4f} of the work of gravity", share - h / depth / 2, h / depth / 2)


def check_sand(runs, name, s, particles):
    """
    Gravity gives what the sand has sunk by, and friction takes it: the energy residual is never positive, and hardly
    anything moves at the end. Then the floor bears the weight; .02 is left for the grains at the front that still
    come to rest. Sand that does not dilate (psi = 0) keeps its volume but for what flies.
    """
    mass = s["mass"][0]
    sunk = mass * G * (0.15 - mean(p["y"] for p in particles))
    runs.check(f"{name}: work of gravity", s["body force work"][-1] / sunk - 1, 1e-10)
    runs.check(f"{name}: largest energy residual over this work", max(s["energy residual"]) / sunk, 1e-12)
    runs.check(f"{name}: kinetic energy at the end over this work", s["kinetic energy"][-1] / sunk, 1e-4)
    runs.check(f"{name}: weight on the floor", late(s, "reaction floor y", 0.9) / (mass * G) + 1, 0.02)
    runs.check(f"{name}: mean volume ratio less 1", mean(p["volume_ratio"] for p in particles) - 1, 0.05)
