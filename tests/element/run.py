#!/usr/bin/env python3
"""Takes single points of materials along paths by talus --element, and compares with closed forms.

Usage: run.py TALUS WORK_DIRECTORY CASE RANKS [MPIRUN ...]

CASE is the name of a function below, or of laws.py, that begins with case_. With f = 1 + d of each step, a logarithmic
strain e in n steps is a sum of n log(1 + d); laws in rate form add up the d = expm1(e/n) instead.
"""
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import laws  # noqa: E402
from point import SOIL, point, surface  # noqa: E402
from program import columns_of, last_particles, main  # noqa: E402

BOUND = 1e-8


def other_principal(angle, c, known, is_greatest):
    """On the surface of Mohr and Coulomb, the least principal stress of the greatest, or the greatest of the least."""
    s, twice_c = surface(angle, c)
    return ((1 + s) * known - twice_c) / (1 - s) if is_greatest else ((1 - s) * known + twice_c) / (1 + s)


def case_triaxial(runs):
    """
    Compression and extension with lateral stresses that are equal (an edge of the pyramid) or not (the faces on both sides
    of it): the strength, and the flow, which is that of the greatest (in extension the least) lateral stress alone where
    they differ, and of both, as they share it, on the edge.
    """
    n, rows = 600, 20
    for angle, psi, c, p in ((30, 0, 0, 1e5), (35, 5, 1e3, 1e5), (20, 20, 2e4, 5e4), (0, 0, 3e4, 1e5)):
        for end in (-0.1, 0.1):
            for apart in (0, 0.1, -0.1, 1e-3, -1e-3, 1e-7, -1e-7):
                name = f"phi {angle}, psi {psi}, c {c:g}, strain {end}, lateral {1 + apart:g} and {1 - apart:g}"
                xx, yy = -p * (1 + apart), -p * (1 - apart)
                start = f"{xx!r}, {yy!r}, {-p!r}, 0, 0, 0"
                s = point(runs, "triaxial", {**SOIL, "Friction angle": angle, "Dilatancy angle": psi, "Cohesion": c},
                          {"Initial stress": start, "Strain": end, "Steps": n}, rows)
                zz = other_principal(angle, c, max(xx, yy) if end < 0 else min(xx, yy), end < 0)
                runs.check(f"{name}: axial stress", s["stress zz"][-1] / zz - 1, BOUND)
                runs.check(f"{name}: lateral stresses",
                           max(max(abs(a / xx - 1), abs(b / yy - 1)) for a, b in zip(s["stress xx"], s["stress yy"])), BOUND)
                d, sin_psi = math.expm1(end / n), math.sin(math.radians(psi)) * (1 if end < 0 else -1)
                lateral = -(1 + sin_psi) / (1 - sin_psi) * d
                grown = {axis: s[f"strain {axis}"][-1] - s[f"strain {axis}"][-2] for axis in ("xx", "yy")}
                if apart == 0:
                    runs.check(f"{name}: flow", (sum(grown.values()) / rows - 2 * math.log1p(lateral / 2)) / abs(d), 1e-6)
                    continue
                flows = "xx" if (xx > yy) == (end < 0) else "yy"
                for axis, strain in grown.items():
                    wanted = math.log1p(lateral) if axis == flows else 0
                    runs.check(f"{name}: flow {axis}", (strain / rows - wanted) / abs(d), 1e-7)


def case_plane_strain(runs):
    """The stress across the plane is the intermediate one and elastic, nu times the sum of the others' changes."""
    nu = SOIL["Poisson's ratio"]
    for angle, psi, c, p in ((30, 0, 0, 1e5), (35, 5, 1e3, 1e5), (35, 35, 1e3, 1e5), (20, 10, 2e4, 5e4)):
        for end in (-0.1, 0.1):
            name = f"phi {angle}, psi {psi}, c {c:g}, strain {end}"
            s = point(runs, "plane", {**SOIL, "Friction angle": angle, "Dilatancy angle": psi, "Cohesion": c},
                      {"Path": "biaxial", "Confining pressure": p, "Strain": end})
            zz = other_principal(angle, c, -p, end < 0)
            runs.check(f"{name}: axial stress", s["stress zz"][-1] / zz - 1, BOUND)
            runs.check(f"{name}: across", s["stress yy"][-1] / (-p + nu * (zz + p)) - 1, BOUND)
            runs.check(f"{name}: no strain across", s["strain yy"][-1], 1e-14)
            d, sin_psi = math.expm1(end / 1000), math.sin(math.radians(psi)) * (1 if end < 0 else -1)
            grown = s["strain xx"][-1] - s["strain xx"][-2]
            runs.check(f"{name}: flow", (grown - math.log1p(-(1 + sin_psi) / (1 - sin_psi) * d)) / abs(d), 1e-7)


def case_shear(runs):
    """
    In simple shear the deviator (a, b) = ((xx - yy)/2, xy) of radius R moves by dgamma (b, G - a) elastically, with the
    Jaumann rate, and returns along itself: at the end a = R^2/G. With psi = 0 the mean stress of the plane stays; where
    yy is held, it follows from yy, and from R^2 - a^2 = (G - a)(a + R sin psi).
    """
    G = SOIL["Young's modulus"] / 2 / (1 + SOIL["Poisson's ratio"])
    for angle, c, p in ((30, 0, 1e5), (35, 1e3, 1e5), (0, 3e4, 1e5)):
        s, twice_c = surface(angle, c)
        for sign in (1, -1):
            name = f"phi {angle}, c {c:g}, strain {0.5 * sign}"
            t = point(runs, "shear", {**SOIL, "Friction angle": angle, "Cohesion": c},
                      {"Path": "simple shear", "Confining pressure": p, "Strain": 0.5 * sign, "Steps": 5000})
            R = twice_c / 2 + p * s
            a = R * R / G
            runs.check(f"{name}: shear stress", t["stress xy"][-1] / (sign * math.sqrt(R * R - a * a)) - 1, BOUND)
            runs.check(f"{name}: normal stress", t["stress xx"][-1] / (a - p) - 1, BOUND)
            runs.check(f"{name}: gamma", t["gamma xy"][-1] / (0.5 * sign) - 1, 1e-12)
    shear = {"Path": "strain", "Direction": "0,1,0, 0,0,0, 0,0,0", "Held stresses": "yy", "Strain": 0.5, "Steps": 5000}
    for angle, psi, c, p in ((30, 0, 0, 1e5), (35, 5, 1e3, 1e5), (35, 35, 1e3, 1e5)):
        s, twice_c = surface(angle, c)
        sin_psi = math.sin(math.radians(psi))

        def radius(a):
            return twice_c / 2 + (p - a) * s

        low, high = -p / 2, p / 2
        low = max(low, -radius(low))
        for _ in range(200):
            a = (low + high) / 2
            R = radius(a)
            low, high = (a, high) if R * R - a * a > (G - a) * (a + R * sin_psi) else (low, a)
        t = point(runs, "direct", {**SOIL, "Friction angle": angle, "Dilatancy angle": psi, "Cohesion": c},
                  {**shear, "Confining pressure": p})
        name = f"yy held, phi {angle}, psi {psi}"
        runs.check(f"{name}: held", t["stress yy"][-1] / -p - 1, BOUND)
        runs.check(f"{name}: shear stress", t["stress xy"][-1] / math.sqrt(R * R - a * a) - 1, BOUND)
        runs.check(f"{name}: normal stress", t["stress xx"][-1] / (2 * a - p) - 1, BOUND)


def case_apex(runs):
    """Drawn apart on all sides, from stresses around the axis of the pyramid: to its apex, or to the limit of tension."""
    E, nu = SOIL["Young's modulus"], SOIL["Poisson's ratio"]
    for angle, psi, c in ((30, 0, 1e3), (35, 10, 1e4), (35, 35, 1e4)):
        apex = c / math.tan(math.radians(angle))
        law = {**SOIL, "Friction angle": angle, "Dilatancy angle": psi, "Cohesion": c}
        for strength, limit in (("-1", apex), (str(2 * apex), apex), (str(apex / 3), apex / 3), ("0", 0.)):
            for around in ((0, 0, 0), (1, -1, 0), (-1, -1, 2), (0, 1e-9, 0)) if strength == "-1" else ((1, 1, -2),):
                start = ", ".join(repr(-5 * apex + 0.3 * apex * x) for x in around)
                s = point(runs, "apex", {**law, "Tension strength": strength},
                          {"Path": "isotropic", "Initial stress": start + ", 0, 0, 0", "Strain": 0.05, "Steps": 200})
                name = f"phi {angle}, psi {psi}, strength {strength}, from {around}"
                runs.check(f"{name}: stress", max(abs(s[f"stress {k}"][-1] - limit) for k in ("xx", "yy", "zz")) / apex, BOUND)
                runs.check(f"{name}: shear", max(abs(s[f"stress {k}"][-1]) for k in ("xy", "xz", "yz")) / apex, BOUND)
        limit = apex / 3
        s = point(runs, "cut", {**law, "Tension strength": limit}, {"Path": "oedometer", "Strain": 0.01})
        runs.check(f"phi {angle}, cut off: axial stress", s["stress zz"][-1] / limit - 1, BOUND)
        runs.check(f"phi {angle}, cut off: lateral stress", s["stress xx"][-1] / (limit * nu / (1 - nu)) - 1, BOUND)
        s = point(runs, "pull", {**law, "Tension strength": limit}, {"Strain": 0.01})
        runs.check(f"phi {angle}, pulled: stress", s["stress zz"][-1] / limit - 1, BOUND)
        runs.check(f"phi {angle}, pulled: elastic slope", s["stress zz"][1] / (E * math.expm1(1e-5)) - 1 if limit > E * 1e-5
                   else 0, BOUND)


def case_run(runs):
    """A particle in the only cell of a run, whose nodes all have their velocities given, and the point: the same numbers."""
    rate, n, dt = 0.1, 400, 1e-3
    for kind, extra in (("Mohr-Coulomb", {"Friction angle": 20, "Dilatancy angle": 5, "Cohesion": 1e3}),
                        ("Hencky", {"Yield stress": 2e4}), ("neo-Hookean", {}), ("von Mises", {"Yield stress": 2e4})):
        settings = [f"Materials/soil/{entry} = {value}" for entry, value in {"Type": kind, **extra}.items()]
        fields = "position, stress, volume ratio" + ("" if kind == "neo-Hookean" else ", equivalent plastic strain")
        directory = runs.run("cell.prm", "cell", f"Output/Particle fields = {fields}", f"Run/Step size = {dt}", f"Run/End time = {n * dt}",
                             *settings)
        particle = last_particles(directory)[0]
        law = {"Type": kind, "Density": 1000, "Young's modulus": 1e6, "Poisson's ratio": 0.3, **extra}
        s = point(runs, "as_cell", law, {"Path": "strain", "Direction": "0,0.5,0, 0,-1,0, 0,0,0", "Strain": rate * n * dt,
                                         "Strain rate": rate, "Steps": n})
        scale = max(abs(s[f"stress {k}"][-1]) for k in ("xx", "yy", "zz", "xy"))
        for k in ("xx", "yy", "zz", "xy"):
            runs.check(f"{kind}: stress {k}", (particle[f"stress_{k}"] - s[f"stress {k}"][-1]) / scale, 1e-11)
        runs.check(f"{kind}: volume ratio", particle["volume_ratio"] / s["volume ratio"][-1] - 1, 1e-12)
        if kind != "neo-Hookean":
            strain = s["equivalent plastic strain"][-1]
            runs.check(f"{kind}: has flown", 1e-4 / strain, 1)
            runs.check(f"{kind}: plastic strain", particle["equivalent_plastic_strain"] / strain - 1, 1e-10)


if __name__ == "__main__":
    sys.exit(main({**vars(laws), **globals()}, HERE))
