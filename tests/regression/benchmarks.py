#!/usr/bin/env python3
"""Runs the benchmarks of Nakamura et al. (2023) on coarse grids and compares with closed forms.

Usage: benchmarks.py TALUS WORK_DIRECTORY CASE RANKS [MPIRUN ...]

CASE is the name of a function below that begins with case_; the files are those of prm/. On several ranks the
corrected run is made on one rank as well: the statistics must agree as tests/compare asks for. prm/shear.prm has a
driver of its own.
"""
import math
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE), os.path.join(os.path.dirname(HERE), "compare"), HERE]
from benchmark_checks import G, PRM, TABLES, check_failure, check_sand, check_water, late, mean, run  # noqa: E402
from program import columns_of, last_particles, main, rms  # noqa: E402

PAPER = ("Kernel/Boundary treatment = WLS", "Run/Courant number = 0.1")  # of the dam break


def case_disk(runs, transfer):
    """
    A free disk turns once, h = .1. In each step x += dt W x widens it by 1 + w^2 dt^2, and nothing drives it back,
    since rotation does not strain; w falls with the moment of inertia, so that J^2 = 1 + 2 w^2 sum dt^2. Besides, the
    centrifugal stress widens it by delta = (1 + nu)(1 - 2 nu)/E rho w^2 R^2/2 (the stress' mean is that of the
    virial), which vibrates undamped: J may be off by delta. K = L^2/(2 I) of a rigid rotation. The affine field holds
    the share e = 2 (h^2/3)/(R^2/2) of the angular momentum (D = h^2/3 of cubic splines), and as the disk widens hands
    over e (J - 1) of it. Both relations to 5e-5, of the order of (h/R)^2 times the share that has changed.
    """
    h, radius, omega = 0.1, 0.5, 2 * math.pi
    coarse = (f"Grid/Spacing = {h}", "Grid/Lower corner = -0.8, -0.55", "Grid/Upper corner = 0.8, 0.85")
    delta = 1.3 * 0.4 / 2e7 * 1e3 * (omega * radius)**2 / 2
    share = 2 * h**2 / 3 / (radius**2 / 2)
    s, particles, _ = run(runs, "disk.prm", transfer, *coarse, f"Transfer/Type = {transfer}")
    momentum = max(map(math.hypot, s["momentum x"], s["momentum y"])) / (s["mass"][0] * omega * radius)
    runs.check(f"{transfer}: momentum over M w R", momentum, 1e-12)
    J = mean(p["volume_ratio"] for p in particles)
    L, K = (s[column][-1] / s[column][0] for column in ("angular momentum z", "kinetic energy"))
    widened = math.sqrt(1 + 2 * omega**2 * sum(dt**2 for dt in s["step size"][1:]))
    runs.check(f"{transfer}: volume ratio {J:.6f} for {widened + delta:.6f}", J - widened - delta, delta)
    runs.check(f"{transfer}: (K/K0) J - (L/L0)^2", K * J - L**2, 5e-5)
    runs.check(f"{transfer}: L/L0 - 1 - e (J - 1)/(J + e)", L - 1 - share * (J - 1) / (J + share), 5e-5)
    if transfer == "APIC":
        total = s["total angular momentum z"]
        runs.check("APIC: total angular momentum", max(abs(value / total[0] - 1) for value in total), 1e-10)
    check_failure(runs, "disk.prm", f"{transfer}_uncorrected", 1, *coarse, f"Transfer/Type = {transfer}")


def case_disk_TPIC(runs):
    case_disk(runs, "TPIC")


def case_disk_APIC(runs):
    case_disk(runs, "APIC")


def case_footing(runs):
    """
    The footing, h = .05, on a soil 2.5 x 1.5 that holds Prandtl's mechanism (1.5 wide, .71 deep). Bounds for Q/(c B)
    are those of the benchmark. Finite elements, Q2 with 2 h: widths count with what moves beyond the last node, .145
    of a cell for the elements (5.497, 5.291, 5.218 for .25, .1, .05, over 2 + pi), -h + .8 h for the B-splines: the
    loads' ratio is .49/.5145 = .952, to .025 for what is rounded in these figures. Force by stress: the virial of a
    body at rest, height times force = - sum V stress_yy, to .2 %, and what the body still accelerates: the difference
    of top and bottom forces. Perfect plasticity turns work into yield stress times plastic strain; 1 % is left to the
    filter of the transfer.
    """
    h, height, unit, yield_stress = 0.05, 1.5, 1e4 * 0.5, math.sqrt(3) * 1e4
    small = (f"Grid/Upper corner = 2.5, {height}", f"Bodies/soil/Upper corner = 2.5, {height}",
             f"Conditions/footing/Lower corner = -0.01, {height - 0.01}",
             f"Conditions/footing/Upper corner = {0.5 - h / 4}, {height + 0.01}",
             "Output/Particle fields = stress, volume, equivalent plastic strain")
    elements = (f"FEM reference/Upper corner = 2.5, {height}", "FEM reference/Cells = 25, 15",
                f"FEM reference/Conditions/footing/Lower corner = 0, {height}",
                f"FEM reference/Conditions/footing/Upper corner = 0.5, {height}")
    s, particles, directory = run(runs, "footing_fem.prm", "TPIC", *small, *elements)
    load = late(s, "reaction footing y", 0.9) / unit
    runs.check(f"corrected: Q/(cB) = {load:.4f}", load - 5.09, 0.05)
    slope = load - late(s, "reaction footing y", 0.5) / unit
    runs.check("corrected: slope", slope, 0.10)
    curve = columns_of(os.path.join(directory, "load_curve.csv"))
    reference = curve["force footing y"][-1] / unit
    runs.check(f"finite elements: Q/(cB) = {reference:.4f} for 5.291", reference / 5.291 - 1, 5e-3)
    runs.check("corrected over finite elements", load / reference - 0.49 / 0.5145, 0.025)
    by_stress = -sum(p["volume"] * p["stress_yy"] for p in particles) / height
    top, bottom = s["reaction footing y"][-1], s["reaction bottom y"][-1]
    runs.check("force by stress", by_stress / top - 1, 2e-3 + abs(top + bottom) / top)
    dissipated = yield_stress * sum(p["volume"] * p["equivalent_plastic_strain"] for p in particles)
    gone = -s["energy residual"][-1]
    runs.check("yield stress times plastic strain over the energy that is gone", dissipated / gone - 1, 0.01)
    s = runs.statistics("footing.prm", "TPIC_uncorrected", *small, "Kernel/Boundary treatment = Steffen")
    uncorrected = late(s, "reaction footing y", 0.9) / unit
    runs.check(f"uncorrected: Q/(cB) = {uncorrected:.4f}, at least", 5.38 / uncorrected, 1)
    check_failure(runs, "footing.prm", "APIC_uncorrected", 0.1, *small, "Transfer/Type = APIC")


def case_still_water(runs):
    """
    Water in a tank, 1.2 x .6, h = .06: pressure rho g (H - y), .99 of rho g H in the lowest row, as in the benchmark.
    At the surface a sum over particles is not quite the weight, by up to .2 of a row of cells (tests/loads, layer):
    all pressures may be off by f = .2 h/H of rho g H. This sends the water by d = f g H^2/c^2 up and down, in the
    fundamental mode with at most d pi c/(2 H), 1/sqrt(2) of it in the rms of the water; so large may the speed and
    what is missing at the floor of the weight's impulse be.
    """
    h, depth, sound = 0.06, 0.6, 50
    pressure, time = 1e3 * G * depth, 0.3
    row = 0.2 * h / depth
    speed = row * G * depth / sound * math.pi / 2 / math.sqrt(2)
    still = (f"Grid/Spacing = {h}", "Grid/Upper corner = 1.2, 0.9", f"Run/End time = {time}", "Output/Time interval = 0")
    for transfer in ("APIC", "TPIC"):
        s, particles, _ = run(runs, "dam_break.prm", f"still_{transfer}", *PAPER, *still, f"Transfer/Type = {transfer}")
        floor = mean(p["pressure"] for p in particles if p["y"] < h / 2) / pressure
        runs.check(f"{transfer}: pressure at the floor {floor:.4f}", floor - 0.99, 0.02)
        error = [p["pressure"] / pressure - (1 - p["y"] / depth) for p in particles if 2 * h < p["y"] < depth - 2 * h]
        runs.check(f"{transfer}: pressure more than 2 h inside, rms", rms(error), row)
        fastest = max(math.sqrt(2 * K / m) for K, m in zip(s["kinetic energy"], s["mass"]))
        runs.check(f"{transfer}: speed", fastest, speed)
        impulse = sum(dt * force for dt, force in zip(s["step size"][1:], s["reaction walls y"][1:]))
        runs.check(f"{transfer}: impulse on the floor", impulse / (G * s["mass"][0] * time) + 1, speed / (G * time))


def case_dam(runs):
    """A column of water, 1.2 x .6, h = .06, half way to the far wall."""
    h, depth, sound, time = 0.06, 0.6, 50, 0.3
    s, particles, _ = run(runs, "dam_break.prm", "TPIC", *PAPER, f"Grid/Spacing = {h}",
                          "Grid/Upper corner = 3.24, 1.2", f"Run/End time = {time}", "Output/Time interval = 0")
    check_water(runs, "TPIC", s, particles, 1.2, depth, h, sound)


def case_martin_moyce(runs):
    """
    The front of a column .5 x 1, h = .05, beside the experiment: its mean speed between T = 2.547 and 4.418, and the
    time at which it comes by Z = 2.995 (a shift of T by at most .4). Tables .02 s apart and their interpolation are
    good to .1 %.
    """
    h, a = 0.05, 0.5
    scale = math.sqrt(2 * G / a)
    s, particles, directory = run(runs, "dam_break.prm", "TPIC", *PAPER, "Grid/Upper corner = 4, 1.2",
                                  f"Grid/Spacing = {h}", f"Bodies/column/Upper corner = {a}, {2 * a}",
                                  f"Bodies/column/Surface level = {2 * a}",
                                  "Run/End time = 0.71", "Output/Time interval = 0.02", "Output/Grid = false")
    check_water(runs, "TPIC", s, particles, a, 2 * a, h, 50)
    T, Z = [], []
    for table in sorted(name for name in os.listdir(directory) if re.fullmatch(r"particles_\d+\.csv", name)):
        path = os.path.join(directory, table)
        with open(path) as file:
            T.append(float(re.search(r"time ([0-9.e+-]+)", file.readline())[1]) * scale)
        columns = columns_of(path)
        x = sorted(x for x, y in zip(columns["x"], columns["y"]) if y < 4 * h)
        Z.append(x[round(0.998 * (len(x) - 1))] / a)

    def interpolate(at, xs, ys):
        k = next(k for k in range(1, len(xs)) if xs[k] >= at)
        return ys[k - 1] + (at - xs[k - 1]) / (xs[k] - xs[k - 1]) * (ys[k] - ys[k - 1])

    speed = interpolate(4.418, T, Z) - interpolate(2.547, T, Z)
    measured = 5.881 - 2.995
    runs.check(f"speed of the front over the experiment's, {speed / measured:.3f}", speed / measured - 1, 0.12)
    runs.check("time of Z = 2.995", interpolate(2.995, Z, T) - 2.547, 0.4)


def run_out(particles):
    x = sorted(p["x"] for p in particles)
    return x[int(0.99 * (len(x) - 1))] / 0.1 - 1


def case_column(runs, transfer):
    """The column on the benchmark's own grid, h = .01: its bounds."""
    h, same = 0.01, ("Output/Time interval = 0", f"Transfer/Type = {transfer}")
    s, particles, _ = run(runs, "column.prm", transfer, *same)
    check_sand(runs, transfer, s, particles)
    runs.check(f"{transfer}: run-out {run_out(particles):.3f}", run_out(particles) - 3.3, 0.2)
    height = max(p["y"] for p in particles if p["x"] < 2 * h)
    runs.check(f"{transfer}: height {height:.4f}", height - 0.1375, 0.0075)
    check_failure(runs, "column.prm", f"{transfer}_uncorrected", 0.6, *same)


def case_column_TPIC(runs):
    case_column(runs, "TPIC")


def case_column_APIC(runs):
    case_column(runs, "APIC")


def case_column_cohesion(runs):
    """
    A vertical cut of Coulomb material. The weight in uniaxial compression is in equilibrium, and below yield up to
    H = 2 c'/gamma tan(45 + phi'/2); a plane wedge slides off from 4 c'/gamma tan(45 + phi'/2) on. In plane strain with
    psi = 0 the material mobilises sin phi' = 3 alpha and c' = kappa/cos phi', here 32.99 degrees and .927 c. With 1.25
    times the cohesion of the first bound (then elastic stress_zz is below yield, too) the column stands, with strains
    of elasticity, gamma H/E; with two thirds of the second it falls: .25 s are three times the time of a free fall
    by a quarter of the width. Courant number .5: at 1 grains that fall with cohesion are unstable, and round-off
    doubles in each step.
    """
    weight, depth, tangent = 1400 * G, 0.3, math.tan(math.radians(35))
    root = math.sqrt(9 + 12 * tangent**2)
    angle = math.asin(3 * tangent / root)
    factor = 3 / root / math.cos(angle) * math.tan(math.pi / 4 + angle / 2)  # c'/c tan(45 + phi'/2)
    needed = weight * depth / factor
    for name, cohesion in (("stands", 1.25 * needed / 2), ("falls", needed / 4 / 1.5)):
        s, particles, _ = run(runs, "column.prm", name, "Grid/Spacing = 0.02", "Run/End time = 0.25", "Run/Courant number = 0.5",
                              "Output/Time interval = 0",
                              f"Materials/sand/Cohesion = {cohesion}",
                              "Output/Particle fields = displacement, volume ratio")
        moved = max(math.hypot(p["displacement_x"], p["displacement_y"]) for p in particles)
        if name == "stands":
            runs.check(f"c = {cohesion:.0f} stands: moves by {moved:.2e}", moved, weight * depth / 1e7 * depth)
        else:
            runs.check(f"c = {cohesion:.0f} falls: moves by {moved:.3f}, over a quarter of the width", 0.025 / moved, 1)


def case_column_friction(runs):
    """
    The floor with friction, h = .02, at Courant number .5 (at 1 nodes of the floor chatter near the end, which
    multiplies round-off): in no step more than mu times the normal force, which only presses; friction takes energy;
    the sand runs out farther than on a floor where nothing slides. mu = .2, less than what the sand would bear there
    (.35).
    """
    mu, coarse = 0.2, ("Grid/Spacing = 0.02", "Run/Courant number = 0.5", "Output/Time interval = 0")
    s, particles, _ = run(runs, "column_friction.prm", "friction", *coarse, "Run/End time = 1.2",
                          f"Conditions/floor/Friction coefficient = {mu}")
    check_sand(runs, "friction", s, particles)
    normal = [-force for force in s["reaction floor y"]]
    runs.check("floor pulls, over the weight", max(-force for force in normal) / (G * s["mass"][0]), 1e-12)
    runs.check("tangential force over mu times the normal force",
               max(abs(force) / N for force, N in zip(s["reaction floor x"], normal) if N > 0), mu)
    taken = -s["condition work"][-1] / s["body force work"][-1]
    runs.check(f"friction takes {taken:.3f} of the work of gravity", taken - 0.5, 0.5)
    others = last_particles(runs.run("column.prm", "no_slip", *coarse, TABLES))
    runs.check(f"run-out of no-slip over {run_out(particles):.3f}", run_out(others) / run_out(particles), 1)


def case_taylor(runs):
    """
    The rod on a coarse grid, h = .8, a quarter and the whole of it: halves of a symmetric body do not know of each other,
    so that length, foot and energies are the same (round-off grows where material buckles, .2 % is the benchmark's
    bound). Length and radius are those of the benchmark to a spacing. Plastic flow keeps the volume but for the pressure
    that yield stresses leave behind; what the energy has lost is sigma_0 e + H e^2/2 per volume and what the transfer has
    filtered, of TPIC about a tenth on this grid.
    """
    h, radius = 0.8, 3.2
    coarse = (f"Grid/Spacing = {h}", "Grid/Upper corner = 8, 8, 33.6", "Output/Time interval = 0", TABLES)
    s, particles, _ = run(runs, "taylor.prm", "quarter", *coarse, "Output/Statistics interval = 1")
    directory = runs.run("taylor.prm", "whole", *coarse, "Grid/Lower corner = -8, -8, 0",
                         "Conditions/symmetry/Boundary ids = 4")
    whole, others = columns_of(os.path.join(directory, "statistics.csv")), last_particles(directory)

    def size(table):
        """Height of the highest particle, and of the lowest layer the greatest distance from the axis."""
        low = min(p["z"] - p["displacement_z"] for p in table)
        foot = max(math.hypot(p["x"], p["y"]) for p in table if p["z"] - p["displacement_z"] < low + 1e-6)
        return max(p["z"] for p in table), foot

    (length, foot), (whole_length, whole_foot) = size(particles), size(others)
    runs.check("whole over quarter: particles", len(others) / len(particles) - 4, 1e-12)
    runs.check("whole over quarter: mass", whole["mass"][0] / s["mass"][0] - 4, 1e-12)
    runs.check("whole over quarter: length", whole_length / length - 1, 2e-3)
    runs.check("whole over quarter: foot", whole_foot / foot - 1, 2e-3)
    runs.check("whole over quarter: lost energy", whole["energy residual"][-1] / s["energy residual"][-1] / 4 - 1, 2e-3)
    runs.check(f"length {length:.3f}", length - 21.5, h)
    runs.check(f"foot {foot:.3f}", foot - 7.1, h)
    volume = sum(p["volume"] for p in particles)
    runs.check("change of volume", volume / s["volume"][0] - 1, 3 * 0.4 / (117 / (3 * (1 - 2 * 0.35))))
    flow = sum(p["volume"] * (0.4 * e + 0.1 * e**2 / 2) for p in particles for e in (p["equivalent_plastic_strain"],))
    gone = s["kinetic energy"][0] - s["kinetic energy"][-1] - s["strain energy"][-1]
    runs.check(f"plastic work over the energy that is gone, {flow / gone:.3f}", flow / gone - 0.9, 0.1)
    runs.check("largest energy residual over the energy", max(s["energy residual"]) / s["kinetic energy"][0], 1e-3)


if __name__ == "__main__":
    sys.exit(main(globals(), PRM))
