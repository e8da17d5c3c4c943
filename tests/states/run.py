#!/usr/bin/env python3
"""Runs talus where it matters what particles remember: sand that has come loose, initial stresses, the volume of a fluid;
and what tables and files say of particles.

Usage: run.py TALUS WORK_DIRECTORY CASE RANKS [MPIRUN ...]

CASE is the name of a function below that begins with case_; its files lie beside this one.
"""
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE), os.path.join(os.path.dirname(HERE), "errors")]
from files import arrays_of_vtu  # noqa: E402
from program import columns_of, last_particles, main  # noqa: E402

G = 9.81


def mean_of(particles, field):
    mass = sum(p["mass"] for p in particles)
    return sum(p["mass"] * p[field] for p in particles) / mass


def case_path(runs):
    """
    Expanded by 10 % and brought back: nothing is borne before the last step, and what round-off leaves is far below
    the weight of a grain. Forgotten, the way back is elastic: 3 K times .1 in I1 at least.
    """
    K = 1e6 / (3 * (1 - 2 * 0.3))
    for dim in (2, 3):
        directory = runs.run(f"path_{dim}d.prm", f"{dim}d")
        half = columns_of(os.path.join(directory, "particles_00001.csv"))
        end = columns_of(os.path.join(directory, "particles_00002.csv"))
        stress = [abs(s) for table in (half, end) for name in table if name.startswith("stress") for s in table[name]]
        runs.check(f"{dim}D: stress", max(stress), 1e-6)
        runs.check(f"{dim}D: gap in the middle", max(abs(g / 0.1 - 1) for g in half["gap"]), 1e-10)
        runs.check(f"{dim}D: gap at the end", max(end["gap"]), 1e-12)
        # The steps of the way back are those of the way out to second order: (1 - (2 dt)^2)^500.
        runs.check(f"{dim}D: volume", max(abs(J / (1 - 4e-8)**500 - 1) for J in end["volume_ratio"]), 1e-10)
    forgotten = last_particles(runs.run("path_2d.prm", "forgotten", "Materials/sand/Remember loosening = false"))
    runs.check("forgotten: pressure over that of 10 %",
               max(abs(p["stress_xx"] + p["stress_yy"] + p["stress_zz"]) / (3 * K * 0.1) - 1 for p in forgotten), 1e-6)


def check_rest(runs, name, prm, up, height):
    """
    At rest: as dense as it was, to what settles loosely, .05; the floor bears the weight, and no energy was added. The
    centre of gravity is as high as that of sand of this density at least, half of `height`.
    """
    directory = runs.run(prm, name)
    s, particles = columns_of(os.path.join(directory, "statistics.csv")), last_particles(directory)
    ratio = mean_of(particles, "volume_ratio")
    runs.check(f"{name}: mean J {ratio:.4f}", ratio - 1.015, 0.035)
    weight = s["mass"][0] * G
    floor = [f for f in s if f.startswith("reaction") and f.endswith(up)]
    late = range(int(0.75 * len(s["time"])), len(s["time"]))
    borne = sum(sum(s[f][k] for f in floor) for k in late) / len(late)
    runs.check(f"{name}: weight on the floor", borne / weight + 1, 0.02)
    runs.check(f"{name}: kinetic energy over weight times height", s["kinetic energy"][-1] / (weight * height), 1e-4)
    runs.check(f"{name}: energy residual, largest", max(s["energy residual"]) / (weight * height), 1e-6)
    runs.check(f"{name}: centre of gravity {mean_of(particles, up):.4f}", mean_of(particles, up) / (height / 2) - 1, 0.05)


def case_silo_2d(runs):
    check_rest(runs, "silo", "silo_2d.prm", "y", 0.3)


def case_silo_3d(runs):
    check_rest(runs, "silo", "silo_3d.prm", "z", 0.3)


def case_drop(runs):
    """It fills the box: .15 of area on a width of 1, and a heap in the middle is higher than that."""
    directory = runs.run("drop_2d.prm", "drop")
    particles = last_particles(directory)
    ratio = mean_of(particles, "volume_ratio")
    runs.check(f"mean J {ratio:.4f}", ratio - 1.015, 0.035)
    s = columns_of(os.path.join(directory, "statistics.csv"))
    runs.check("energy residual, largest", max(s["energy residual"]) / s["body force work"][-1], 1e-6)
    runs.check("kinetic energy over the work of gravity", s["kinetic energy"][-1] / s["body force work"][-1], 1e-3)


def case_initial_stress(runs):
    """Refused where the law would lose it in the first step; at rest where it is carried."""
    for name, settings, words in (
            ("neo-Hookean", (), r"layer_2d.prm:2\d: entry 'Initial stress' in section 'Bodies/layer'.*linear elastic"),
            ("fluid", ("Materials/ground/Type = Newtonian fluid", "Bodies/layer/Rest stress ratio = 0.5"),
             r"Bodies/layer.*nothing but pressure.*hydrostatic")):
        _, status, text = runs.execute("layer_2d.prm", name, *settings)
        runs.check(f"{name}: exit status {status} for 1", status - 1, 0.5)
        runs.check(f"{name}: message", not re.search(words, text), 0.5)
    for name, *settings in (("linear elastic",), ("Newtonian fluid",),
                            ("Drucker-Prager", "Materials/ground/Friction angle = 35")):
        directory = runs.run("layer_2d.prm", name.replace(" ", "_"), f"Materials/ground/Type = {name}", *settings)
        s = columns_of(os.path.join(directory, "statistics.csv"))
        fall = s["mass"][0] * (10 * s["time"][-1])**2 / 2
        runs.check(f"{name}: kinetic energy over that of a free fall", max(s["kinetic energy"]) / fall, 1e-4)


def case_far(runs):
    """Places in files keep their digits: a particle table holds all of them, a VTU file the same."""
    directory = runs.run("far_2d.prm", "far")
    near = runs.run("far_2d.prm", "near", "Grid/Lower corner = 0, 0", "Grid/Upper corner = 8, 8",
                    "Bodies/block/Lower corner = 2, 0", "Bodies/block/Upper corner = 6, 4")
    far_table, near_table = (columns_of(os.path.join(d, "particles_00000.csv")) for d in (directory, near))
    for axis in "xy":
        name = f"displacement_{axis}"
        # The last digit of a place is 9e-10, and displacements are differences of places.
        runs.check(f"{name}, far and near", max(abs(a - b) for a, b in zip(far_table[name], near_table[name])), 4e-9)
    arrays = arrays_of_vtu(os.path.join(directory, "particles_00000.vtu"))
    points = list(zip(arrays["points"][::3], arrays["points"][1::3]))
    by_id = dict(zip(arrays["id"], points))
    runs.check("places less 256", len(set(points)) - 256, 0.5)
    runs.check("places of the table", sum(by_id[i] != (x, y) for i, x, y in zip(*(far_table[c] for c in ("id", "x", "y")))), 0.5)
    nodes = arrays_of_vtu(os.path.join(directory, "grid_00000.vtu"))["points"]
    runs.check("nodes less 17 x 17", len(set(zip(nodes[::3], nodes[1::3]))) - 17 * 17, 0.5)
    runs.check("body and material", max(arrays["body"] + arrays["material"] + far_table["body"] + far_table["material"]), 0.5)


def case_mirror_reaction(runs):
    """Of a body at rest the nodal forces are the reactions: 7500 on the floor, K0 rho g H^2/2 on the sides."""
    K0 = 0.3 / 0.7
    for treatment in ("mirror", "WLS"):
        s = runs.statistics("box_3d.prm", treatment, f"Kernel/Boundary treatment = {treatment}")
        n = len(s["time"])
        for column, wanted in (("floor z", -7500), ("left x", -K0 * 2e4 * 0.75**2 / 2 * 0.5),
                               ("back y", K0 * 2e4 * 0.75**2 / 2)):
            for kind in ("nodal force", "reaction"):
                value = sum(s[f"{kind} {column}"][1:]) / (n - 1)
                runs.check(f"{treatment}: {kind} {column} {value:.1f} for {wanted:.1f}", value / wanted - 1, 0.01)


def case_water(runs):
    """
    Water that splashes: single drops are stretched without end. Each particle's J is rho_ref / rho, no energy is added,
    and what falls is not lost.
    """
    for transfer in ("TPIC", "APIC", "FLIP"):
        directory = runs.run("water_2d.prm", transfer, f"Transfer/Type = {transfer}")
        particles = last_particles(directory)
        runs.check(f"{transfer}: J rho less rho_ref", max(abs(p["volume_ratio"] * p["density"] - 1) for p in particles), 1e-12)
        runs.check(f"{transfer}: p of the volume",
                   max(abs(p["pressure"] / 400 - (p["density"] - 1)) for p in particles), 1e-12)
        s = columns_of(os.path.join(directory, "statistics.csv"))
        runs.check(f"{transfer}: energy residual over the work of gravity",
                   max(s["energy residual"]) / max(s["body force work"]), 1e-3)


if __name__ == "__main__":
    sys.exit(main(globals(), HERE))
