#!/usr/bin/env python3
"""Runs talus under loads, friction and damping, and compares with closed forms.

Usage: run.py TALUS WORK_DIRECTORY CASE RANKS [MPIRUN ...]

CASE is the name of a function below that begins with case_; its files lie beside this one.
"""
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from program import columns_of, last_particles, main, rms  # noqa: E402


def maxima(times, values):
    """Times and values of the inner maxima, by a parabola through three rows."""
    found = []
    for k in range(1, len(values) - 1):
        if values[k - 1] < values[k] >= values[k + 1]:
            slope, curvature = (values[k + 1] - values[k - 1]) / 2, values[k + 1] - 2 * values[k] + values[k - 1]
            shift = -slope / curvature
            found.append((times[k] + shift * (times[k + 1] - times[k]), values[k] + shift * slope / 2))
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
        return sum(s[f"momentum {axis}"][k] * n for axis, n in direction.items()) / s["mass"][k]

    for mu in (0, 0.2, 0.4):
        s = runs.statistics(prm, f"mu_{mu}", f"Conditions/slope/Friction coefficient = {mu}",
                            f"Bodies/block/Velocity = {velocity}")
        gained = along(s, -1) - along(s, 0)
        across = math.hypot(*(s[f"momentum {axis}"][-1] / s["mass"][-1] - along(s, -1) * n
                              for axis, n in direction.items()))
        wanted = g * (math.sin(angle) - mu * math.cos(angle)) * s["time"][-1] - mu * s["momentum y"][-1] / s["mass"][-1]
        runs.check(f"mu = {mu}: velocity gained {gained:.5g} for {wanted:.5g}", (gained - wanted) / abs(wanted), 1e-3)
        runs.check(f"mu = {mu}: direction", across / start, 5e-3)
    ramped = {axis: f"{g * math.sin(angle) * n} * min(1, 5*t)" for axis, n in direction.items()}
    force = "; ".join(ramped.get(axis, "-9.81 * cos(pi/6)") for axis in ("xyz" if len(direction) > 1 else "xy"))
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


def bed(degrees, dim, kind, mu):
    """Settings of prm/inclined_bed.prm for an angle: a block of .8 by .4 on a bed through (.2, 1.7), as a formula or a polygon."""
    a = math.radians(degrees)
    t, n, start = (math.cos(a), -math.sin(a)), (math.sin(a), math.cos(a)), (0.25323, 1.72653)
    corners = "; ".join(f"{start[0] + s * t[0] + k * n[0]}, {start[1] + s * t[1] + k * n[1]}"
                        for s, k in ((0, 0), (0.8, 0), (0.8, 0.4), (0, 0.4)))
    ground = "; ".join(f"{start[0] + s * t[0] - k * n[0]}, {start[1] + s * t[1] - k * n[1]}"
                       for s, k in ((-1.5, 0), (5, 0), (5, 1.5), (-1.5, 1.5)))
    up = "y" if dim == 2 else "z"
    settings = [f"Bodies/block/Corners = {corners}", f"Obstacles/bed/Friction coefficient = {mu}",
                f"Obstacles/bed/Surface = {kind}"]
    if kind == "formula":
        settings.append(f"Obstacles/bed/Formula = {n[0]} * (x - {start[0]}) + {n[1]} * ({up} - {start[1]})")
    else:
        settings.append(f"Obstacles/bed/Corners = {ground}")
        settings += ["Obstacles/bed/Axis = y", "Obstacles/bed/Ends = -1, 2"] if dim == 3 else []
    return settings, t, n


def case_bed(runs, prm, dim, angles):
    """
    A block on a rigid bed that cuts through the cells. Sliding, it gains g (sin - mu cos), but for what it bounces with
    (as in case_incline); where tan is .8 mu, and gravity acts at once, it stays for five seconds.
    """
    g, up = 9.81, "y" if dim == 2 else "z"
    for degrees in angles:
        for kind in ("formula", "polygon"):
            settings, t, n = bed(degrees, dim, kind, 0.2)
            velocity = f"{0.5 * t[0]}; {'' if dim == 2 else '0; '}{0.5 * t[1]}"
            s = runs.statistics(prm, f"{kind}_{degrees}", *settings, f"Bodies/block/Velocity = {velocity}")
            along, across = ([(s["momentum x"][k] * e[0] + s[f"momentum {up}"][k] * e[1]) / s["mass"][k] for k in (0, -1)]
                             for e in (t, n))
            angle = math.radians(degrees)
            wanted = g * (math.sin(angle) - 0.2 * math.cos(angle)) * s["time"][-1] - 0.2 * across[1]
            gained = along[1] - along[0]
            runs.check(f"{kind}, {degrees} degrees: velocity gained {gained:.5g} for {wanted:.5g}",
                       (gained - wanted) / (g * s["time"][-1] * math.sin(angle)), 1e-2)
            runs.check(f"{kind}, {degrees} degrees: velocity across", across[1] / 0.5, 2e-2)
    settings, t, _ = bed(25, dim, "formula", math.tan(math.radians(25)) / 0.8)
    s = runs.statistics(prm, "rest", *settings, f"Bodies/block/Velocity = {'; '.join('0' * dim)}", "Run/End time = 5",
                        "Obstacles/bed/Account time = 0.064", "Output/Time interval = 5", "Output/Statistics interval = 1")
    time = s["time"]
    v = [(s["momentum x"][k] * t[0] + s[f"momentum {up}"][k] * t[1]) / s["mass"][k] for k in range(len(time))]
    way = sum((time[k] - time[k - 1]) * v[k] for k in range(1, len(time)))
    runs.check(f"tan 25 degrees = .8 mu, from gravity at once: way {way:.3g} over the length", way / 0.8, 1e-3)


def case_bed_2d(runs):
    # The file with its formula left out, which polygons do not read.
    with open(os.path.join(HERE, "../../prm/inclined_bed.prm")) as file:
        lines = [line for line in file if "set Formula" not in line]
    path = os.path.join(runs.work, "bed.prm")
    os.makedirs(runs.work, exist_ok=True)
    with open(path, "w") as file:
        file.writelines(lines)
    case_bed(runs, path, 2, (10, 25, 40))


def case_bed_3d(runs):
    case_bed(runs, "bed_3d.prm", 3, (25,))


def case_shelf(runs):
    """Sand runs through a slot between shelves two spacings thick, off the nodes: none passes them, and all lies where it can."""
    h, top, bottom = 0.05, 0.82, 0.715
    left, right = (f"{a}, {bottom}; {b}, {bottom}; {b}, {top}; {a}, {top}" for a, b in ((-0.2, 0.36), (0.64, 1.2)))
    directory = runs.run("../../prm/silo.prm", "shelf", f"Grid/Spacing = {h}", "Run/End time = 0.8", "Output/CSV = true",
                         "Output/Time interval = 0", f"Obstacles/left/Corners = {left}", f"Obstacles/right/Corners = {right}",
                         f"Bodies/fill/Lower corner = 0, {top}", "Bodies/fill/Upper corner = 1, 1.62")
    particles = last_particles(directory)
    below = [p for p in particles if p["y"] < bottom - h]
    runs.check(f"{len(below)} of {len(particles)} have run out", not 0.03 < len(below) / len(particles) < 0.6, 0.5)
    deepest = max(min(top - p["y"], p["y"] - bottom, max(0.36 - p["x"], p["x"] - 0.64)) for p in particles)
    runs.check(f"deepest in a shelf {deepest / h:.2f} h", max(0, deepest) / h, 1)
    # Beside the slot, below the shelves, there is what has come through it and is on its way: a jet, and a heap.
    astray = [p for p in below if abs(p["x"] - 0.5) > 0.14 + 2 * h and p["y"] > 0.6]
    runs.check(f"{len(astray)} beside the jet", len(astray), 0.5)


def case_account(runs):
    """
    A block under the slope's load at once, which makes it vibrate: with accounts it stays where mu > tan 30 degrees, but for
    its elastic sag and what it slides before there is an account. Whether it stays or slides, friction never takes more
    than mu times what the floor has given.
    """
    tau = 6.4 / 36.7  # 64 h/c
    for mu in (0.65, 0.5):
        s = runs.statistics("../../prm/incline.prm", f"mu_{mu}", "Kernel/Boundary treatment = ghost nodes",
                            f"Conditions/slope/Friction coefficient = {mu}", f"Conditions/slope/Account time = {tau}",
                            "Bodies/block/Velocity = 0; 0", "Bodies/block/Initial stress = none", "Run/End time = 1")
        time, v = s["time"], [p / m for p, m in zip(s["momentum x"], s["mass"])]
        way = sum((time[k] - time[k - 1]) * v[k] for k in range(1, len(time)))
        if mu > math.tan(math.pi / 6):
            runs.check(f"mu = {mu}: way {way:.5g}", way, 0.01)
        given = taken = most = 0
        for k in range(1, len(time)):
            given -= mu * s["reaction slope y"][k] * s["step size"][k]
            taken += s["reaction slope x"][k] * s["step size"][k]
            most = max(most, taken / given if given > 0 else 0)
        runs.check(f"mu = {mu}: friction over what the floor has given {most:.6g}", max(0, most - 1), 1e-9)


def case_damping(runs):
    """
    Local damping of the first mode of a bar: force and velocity are one shape, so that it is a single oscillator
    with stiffness k (1 + alpha) while it slows down and k (1 - alpha) while it speeds up. From one passage through
    the middle to the next the kinetic energy falls by (1 - alpha)/(1 + alpha).
    """
    period = 0.2
    for alpha in (0.05, 0.2, 0.5):
        half = period / 4 * (1 / math.sqrt(1 - alpha) + 1 / math.sqrt(1 + alpha))
        s = runs.statistics("bar_2d.prm", f"alpha_{alpha}", f"Run/Local damping = {alpha}", "Grid/Spacing = 0.025",
                            f"Run/End time = {4.4 * half}")
        peaks = maxima(s["time"], s["kinetic energy"])
        runs.check(f"alpha = {alpha}: number of passages less four", len(peaks) - 4, 0.5)
        for n, (time, energy) in enumerate(peaks, 1):
            wanted = s["kinetic energy"][0] * ((1 - alpha) / (1 + alpha))**n
            runs.check(f"alpha = {alpha}: energy after {n} half periods", energy / wanted - 1, 0.02 * n)
            runs.check(f"alpha = {alpha}: time of {n} half periods", time / (n * half) - 1, 0.01)


def case_bar(runs, prm, length, stiffness):
    """A bar pulled by a traction of 1000: uniaxial stress, and an extension of traction * x / stiffness."""
    directory = runs.run(prm, "bar")
    particles = last_particles(directory)
    inner = [p for p in particles if 0.15 * length < p["initial_position_x"] < 0.85 * length]
    others = [name for name in particles[0] if name.startswith("stress_") and name not in ("stress_xx", "stress_zz")]
    runs.check("mean stress", sum(p["stress_xx"] for p in inner) / len(inner) / 1000 - 1, 0.01)
    runs.check("rms of stress", rms([p["stress_xx"] / 1000 - 1 for p in inner]), 0.03)
    for name in others:
        runs.check(f"rms of {name}", rms([p[name] / 1000 for p in inner]), 0.03)
    for p in (max(inner, key=lambda p: p["initial_position_x"]),):
        wanted = 1000 * p["initial_position_x"] / stiffness
        runs.check("extension", (p["position_x"] - p["initial_position_x"]) / wanted - 1, 0.01)
    s = columns_of(os.path.join(directory, "statistics.csv"))
    runs.check("reaction over the load", s["reaction support x"][-1] / s["traction pull x"][-1] - 1, 1e-3)


def case_bar_2d(runs):
    case_bar(runs, "../../prm/bar.prm", 1., 1e6 / (1 - 0.3**2))


def case_bar_3d(runs):
    case_bar(runs, "bar_3d.prm", 0.6, 1e6)


def case_pressure(runs, prm, axes):
    """
    A block under pressure on all sides: -p I on the deformed block. The mean is a sum over the surface and exact; in
    the rows of particles below the surface the stress is uneven.
    """
    particles = last_particles(runs.run(prm, "pressure"))
    for a in axes:
        for b in axes:
            if a <= b:
                stress = [p[f"stress_{a}{b}"] / 5e4 + (1 if a == b else 0) for p in particles]
                runs.check(f"mean of stress {a}{b}", sum(stress) / len(stress), 2e-3)
                runs.check(f"rms of stress {a}{b}", rms(stress), 0.06)


def case_pressure_2d(runs):
    case_pressure(runs, "pressure_2d.prm", "xy")


def case_pressure_3d(runs):
    case_pressure(runs, "pressure_3d.prm", "xyz")


def case_wave(runs, prm):
    """
    Behind the front stress and velocity are sigma and sigma / (rho c), ahead of it zero. Momentum and energy are
    those of the load, which does the work sigma v per time.
    """
    directory = runs.run(prm, "wave")
    particles = last_particles(directory)
    stress, velocity = 0.1, 0.1 / (10 * 10)
    behind = [p for p in particles if 0.45 < p["position_x"] < 0.95]
    ahead = [p for p in particles if p["position_x"] < 0.15]
    runs.check("mean stress behind", sum(p["stress_xx"] for p in behind) / len(behind) / stress - 1, 5e-3)
    runs.check("rms of stress behind", rms([p["stress_xx"] / stress - 1 for p in behind]), 0.05)
    runs.check("mean velocity behind", sum(p["velocity_x"] for p in behind) / len(behind) / velocity - 1, 5e-3)
    runs.check("rms of stress ahead", rms([p["stress_xx"] / stress for p in ahead]), 1e-3)
    s = columns_of(os.path.join(directory, "statistics.csv"))
    load = s["traction pull x"][-1]
    runs.check("momentum", s["momentum x"][-1] / (load * s["time"][-1]) - 1, 1e-3)
    runs.check("work of the load", s["traction work"][-1] / (load * velocity * s["time"][-1]) - 1, 0.05)


def case_wave_2d(runs):
    case_wave(runs, "wave_2d.prm")


def case_wave_3d(runs):
    case_wave(runs, "wave_3d.prm")


FREE = ("Grid/Upper corner = 1.4, 0.1", "Bodies/bar/Lower corner = 0.2, 0", "Bodies/bar/Upper corner = 1.2, 0.1",
        "Bodies/bar/Velocity = 1e-3 * cos(pi*(x - 0.2)); 0", "Conditions/walls/Boundary ids = 2, 3")


def case_energy(runs):
    """
    Energy residual over the energy put in: a free bar that vibrates, without and with damping, and one that is pulled.
    What remains with FLIP is of the order of the step size; TPIC filters velocities in each step.
    """
    for transfer, bound, damping in (("FLIP", 1e-3, 0), ("FLIP", 1e-3, 0.2), ("TPIC", 0.1, 0)):
        s = runs.statistics("bar_2d.prm", f"{transfer}_{damping}", f"Transfer/Type = {transfer}", *FREE,
                            f"Run/Courant number = {0.005 if transfer == 'FLIP' else 0.05}", "Run/End time = 0.4",
                            f"Run/Local damping = {damping}")
        energy = s["kinetic energy"][0]
        residual = max(map(abs, s["energy residual"]))
        runs.check(f"{transfer}, damping {damping}: largest residual", residual / energy, bound)
        runs.check(f"{transfer}, damping {damping}: energy is left or taken",
                   (s["kinetic energy"][-1] + s["strain energy"][-1] + s["damping energy"][-1]) / energy - 1, bound)
    s = runs.statistics("wave_2d.prm", "pull", "Transfer/Type = FLIP", "Run/Courant number = 0.005",
                        "Tractions/pull/Traction = 0.1 * min(1, 50*t); 0")
    runs.check("FLIP, pulled: largest residual", max(map(abs, s["energy residual"])) / s["traction work"][-1], 1e-3)


def case_layer(runs):
    """
    A layer under its weight, with its stress from the start, stays at rest but for the rows next to the surface: there
    a sum over particles is not quite the weight, and the stress settles by a fraction of the weight of one cell.
    """
    cell = 1e4 * 0.05
    for kind in ("geostatic", "hydrostatic"):
        directory = runs.run("layer_2d.prm", kind, f"Bodies/layer/Initial stress = {kind}")
        s = columns_of(os.path.join(directory, "statistics.csv"))
        speed = max(math.sqrt(2 * k / m) for k, m in zip(s["kinetic energy"], s["mass"]))
        runs.check(f"{kind}: speed over that of free fall", speed / (10 * s["time"][-1]), 1e-4)
        particles = last_particles(directory)
        error = {p["id"]: (p["stress_yy"] + 1e4 * (1 - p["initial_position_y"])) / cell for p in particles}
        runs.check(f"{kind}: greatest error of stress over the weight of a cell", max(map(abs, error.values())), 0.2)
        deep = [error[p["id"]] for p in particles if p["initial_position_y"] < 0.75]
        runs.check(f"{kind}: rms below 5 cells", rms(deep), 0.03)
        ratio = [p["stress_xx"] / p["stress_yy"] for p in particles if p["initial_position_y"] < 0.75]
        K0 = 1 if kind == "hydrostatic" else 0.3 / 0.7
        runs.check(f"{kind}: horizontal over vertical stress", max(abs(r - K0) for r in ratio), 0.01)


if __name__ == "__main__":
    sys.exit(main(globals(), HERE))
