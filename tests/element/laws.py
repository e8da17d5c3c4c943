"""Paths of every law but Mohr-Coulomb's, and what the driver itself does; for run.py."""
import math
import os

from point import point, write
from program import columns_of

E, NU = 1e7, 0.3
K, G = E / 3 / (1 - 2 * NU), E / 2 / (1 + NU)
LAMBDA = K - 2 * G / 3
BOUND = 1e-8


def law(kind, **entries):
    return {"Type": kind, "Density": 1600, "Young's modulus": E, "Poisson's ratio": NU,
            **{name.replace("_", " "): value for name, value in entries.items()}}


def added(strains, n, factor=1.):
    """Sum of expm1 of the steps through the list of strains, each a factor of them."""
    return sum(n * math.expm1(factor * (b - a) / n) for a, b in zip([0, *strains], strains))


def root(function, low, high):
    """Of an increasing function."""
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return middle


def case_elastic(runs):
    """Moduli of the rate form: oedometer, uniaxial stress, isotropic, undrained, forth and back."""
    strains, n, p = (-0.02, 0.01, -0.05), 500, 1e5
    through = {"Strain": ", ".join(map(str, strains)), "Steps": n, "Confining pressure": p}
    d = added(strains, n)
    s = point(runs, "oedometer", law("linear elastic"), {**through, "Path": "oedometer"})
    runs.check("oedometer: axial", s["stress zz"][-1] / (-p + (LAMBDA + 2 * G) * d) - 1, BOUND)
    runs.check("oedometer: lateral", s["stress xx"][-1] / (-p + LAMBDA * d) - 1, BOUND)
    runs.check("oedometer: logarithmic strain", s["strain zz"][-1] / strains[-1] - 1, 1e-11)
    runs.check("oedometer: volume ratio", s["volume ratio"][-1] / math.exp(strains[-1]) - 1, 1e-11)
    runs.check("oedometer: time", s["time"][-1] / (0.02 + 0.03 + 0.06) - 1, 1e-12)
    runs.check("oedometer: rows", len(s["step"]) - 1 - 3 * n, 0.5)
    runs.check("oedometer: turning point", s["strain zz"][n] / strains[0] - 1, 1e-11)
    mean = -p + K * d
    deviator = 2 * G * d
    runs.check("oedometer: q", s["q"][-1] / abs(deviator) - 1, BOUND)
    runs.check("oedometer: energy", s["strain energy density"][-1] / (mean**2 / 2 / K + deviator**2 / 6 / G) - 1, BOUND)
    s = point(runs, "triaxial", law("linear elastic"), through)
    runs.check("triaxial: axial", s["stress zz"][-1] / (-p + E * d) - 1, BOUND)
    lateral = sum(n * math.log1p(-NU * math.expm1((b - a) / n)) for a, b in zip([0, *strains], strains))
    runs.check("triaxial: lateral strain", s["strain xx"][-1] / lateral - 1, BOUND)
    s = point(runs, "biaxial", law("linear elastic"), {**through, "Path": "biaxial"})
    runs.check("biaxial: axial", s["stress zz"][-1] / (-p + E / (1 - NU**2) * d) - 1, BOUND)
    s = point(runs, "isotropic", law("linear elastic"), {**through, "Path": "isotropic"})
    runs.check("isotropic: p", s["p"][-1] / (p - 3 * K * d) - 1, BOUND)
    s = point(runs, "undrained", law("linear elastic"), {**through, "Path": "undrained triaxial"})
    runs.check("undrained: volume ratio", max(abs(J - 1) for J in s["volume ratio"]), 1e-12)
    runs.check("undrained: p", s["p"][-1] / (p - K * (d + 2 * added(strains, n, -0.5))) - 1, BOUND)


def case_finite(runs):
    """Laws that follow from F: neo-Hookean, Hooke and Hencky, whatever the steps."""
    for end in (-0.5, 0.3):
        stretch = math.exp(end)
        s = point(runs, "strain", law("neo-Hookean"), {"Path": "oedometer", "Strain": end, "Steps": 50})
        wanted = (LAMBDA * end + G * (stretch**2 - 1)) / stretch
        runs.check(f"neo-Hookean, uniaxial strain {end}", s["stress zz"][-1] / wanted - 1, BOUND)
        energy = (G / 2 * (stretch**2 - 1 - 2 * end) + LAMBDA / 2 * end**2) / stretch
        runs.check(f"neo-Hookean, energy at {end}", s["strain energy density"][-1] / energy - 1, BOUND)
        s = point(runs, "stress", law("neo-Hookean"), {"Strain": end, "Steps": 50})
        b = root(lambda b: LAMBDA * (end + 2 * math.log(b)) + G * (b * b - 1), 0.1, 10)
        J = stretch * b * b
        wanted = (LAMBDA * math.log(J) + G * (stretch**2 - 1)) / J
        runs.check(f"neo-Hookean, uniaxial stress {end}", s["stress zz"][-1] / wanted - 1, BOUND)
        runs.check(f"neo-Hookean, lateral strain {end}", s["strain xx"][-1] / math.log(b) - 1, BOUND)
        s = point(runs, "hooke", law("Hooke"), {"Path": "oedometer", "Strain": end, "Steps": 50})
        runs.check(f"Hooke {end}", s["stress zz"][-1] / ((LAMBDA + 2 * G) * math.expm1(end)) - 1, BOUND)
        s = point(runs, "hencky", law("Hencky", Yield_stress=1e9), {"Path": "oedometer", "Strain": end, "Steps": 50})
        runs.check(f"Hencky {end}", s["stress zz"][-1] / ((LAMBDA + 2 * G) * end / stretch) - 1, BOUND)
        s = point(runs, "undrained", law("Hencky", Yield_stress=5e4),
                  {"Path": "undrained triaxial", "Confining pressure": 1e5, "Strain": end, "Steps": 50})
        theta = root(lambda t: t * math.exp(-t) + 1e5 / K, -0.5, 0.5)
        runs.check(f"Hencky, undrained {end}: p", max(abs(p / 1e5 - 1) for p in s["p"]), BOUND)
        runs.check(f"Hencky, undrained {end}: q", s["q"][-1] / (5e4 * math.exp(-theta)) - 1, BOUND)
    s = point(runs, "shear", law("neo-Hookean"), {"Path": "simple shear", "Strain": 0.7, "Steps": 50})
    runs.check("neo-Hookean, simple shear", s["stress xy"][-1] / (G * 0.7) - 1, BOUND)
    runs.check("neo-Hookean, normal stress in it", s["stress xx"][-1] / (G * 0.49) - 1, BOUND)
    s = point(runs, "order", law("neo-Hookean"), {
        "Names": "stretch, slide", "stretch": {"Path": "oedometer", "Strain": 0.3, "Steps": 50},
        "slide": {"Path": "strain", "Direction": "0,0,1, 0,0,0, 0,0,0", "Strain": 0.7, "Steps": 50}})
    runs.check("neo-Hookean, sheared after a stretch", s["stress xz"][-1] / (G * 0.7 * math.exp(0.3)) - 1, BOUND)
    runs.check("principal stresses", (s["principal stress 1"][-1] + s["principal stress 2"][-1] + s["principal stress 3"][-1])
               / -3 / s["p"][-1] - 1, BOUND)


def case_plastic(runs):
    """Strengths of von Mises and Drucker-Prager, with held lateral stresses."""
    strength, H, n, end = 5e4, 1e6, 1000, -0.05
    for p in (0, 1e5):
        for kind in ("perfect", "linear"):
            s = point(runs, "mises", law("von Mises", Yield_stress=strength, Hardening=kind, Hardening_modulus=H),
                      {"Strain": end, "Steps": n, "Confining pressure": p})
            d = -added([end], n)
            q = strength if kind == "perfect" else (strength + H * d) / (1 + H / E)
            runs.check(f"von Mises, {kind}, p {p}: q", s["q"][-1] / q - 1, BOUND)
            strain = d - q / E
            runs.check(f"von Mises, {kind}, p {p}: plastic strain", s["equivalent plastic strain"][-1] / strain - 1, BOUND)
            work = strength * strain + (H * strain**2 / 2 if kind == "linear" else 0)
            runs.check(f"von Mises, {kind}, p {p}: plastic work", s["plastic work density"][-1] / work - 1, BOUND)
    for angle, psi, c, p in ((30, 0, 0, 1e5), (35, 10, 1e3, 1e5), (25, 25, 2e4, 5e4)):
        t = math.tan(math.radians(angle))
        alpha, kappa = t / math.sqrt(9 + 12 * t * t), 3 * c / math.sqrt(9 + 12 * t * t)
        for end in (-0.1, 0.1):
            s = point(runs, "prager", law("Drucker-Prager", Friction_angle=angle, Dilatancy_angle=psi, Cohesion=c),
                      {"Strain": end, "Confining pressure": p})
            q = (kappa + 3 * alpha * p) / (1 / math.sqrt(3) + math.copysign(alpha, end))
            runs.check(f"Drucker-Prager {angle}, {psi}, {end}: q", s["q"][-1] / q - 1, BOUND)
            runs.check(f"Drucker-Prager {angle}, {psi}, {end}: lateral", s["stress xx"][-1] / -p - 1, BOUND)


def case_wide(runs):
    """
    Steps so wide that the first guess lies at the apex, where no stress can change, or beyond it: the held stresses are met
    all the same, there and back.
    """
    sand = {"Friction_angle": 35, "Dilatancy_angle": 10}
    for name, soil, path, steps, p, strains in (
            ("limit of tension", law("Mohr-Coulomb", Cohesion=1e4, Tension_strength=0, **sand), "triaxial", 10, 1e3, (-0.1, 0.1)),
            ("limit of tension", law("Mohr-Coulomb", Cohesion=1e4, Tension_strength=0, **sand), "biaxial", 10, 1e3, (-0.1, 0.1)),
            ("Drucker-Prager", law("Drucker-Prager", Cohesion=1e3, **sand), "triaxial", 100, 1e3, (-0.1, 0.1)),
            ("Drucker-Prager", law("Drucker-Prager", Cohesion=1e3, **sand), "biaxial", 10, 1e5, (0.1, -0.1)),
            ("dry sand", law("Drucker-Prager", Friction_angle=30), "biaxial", 10, 1e5, (0.1, -0.1)),
            ("dry sand", law("Drucker-Prager", Friction_angle=30), "triaxial", 100, 1e3, (-0.1, 0.1))):
        s = point(runs, "wide", {**soil, "Young's modulus": 2e7},
                  {"Path": path, "Strain": f"{strains[0]}, {strains[1]}", "Steps": steps, "Confining pressure": p})
        runs.check(f"{name}, {path}: {len(s['step']) - 1} steps", len(s["step"]) - 1 - 2 * steps, 0.5)
        runs.check(f"{name}, {path}: held", max(abs(stress / p + 1) for stress in s["stress xx"]), BOUND)


def case_fluid(runs):
    """Pressure by the equation of state, from the density that an initial pressure asks for; viscous stresses."""
    rho, c, mu, rate = 1000., 50., 3., 7.
    fluid = {"Type": "Newtonian fluid", "Density": rho, "Sound speed": c, "Viscosity": mu}
    for p in (0, 2e4):
        s = point(runs, "water", fluid, {"Path": "isotropic", "Strain": -0.02, "Confining pressure": p})
        start = rho + p / c**2
        runs.check(f"from {p}: p", s["p"][-1] / (c**2 * (start * math.exp(0.06) - rho)) - 1, BOUND)
        runs.check(f"from {p}: strain", s["strain zz"][-1] / -0.02 - 1, BOUND)
        s = point(runs, "flow", fluid, {"Path": "simple shear", "Strain": 0.5, "Strain rate": rate, "Confining pressure": p})
        runs.check(f"from {p}: shear stress", s["stress xy"][-1] / (mu * rate) - 1, BOUND)
        runs.check(f"from {p}: p in shear", (s["p"][-1] - p) / c**2 / rho, 1e-12)


def case_stages(runs):
    """A stress that is prescribed, and stages one after the other: what is held is what the one before has left."""
    final = (-5e4, -8e4, -1e5, 1e3, -2e3, 3e3)
    s = point(runs, "stress", law("linear elastic"),
              {"Path": "stress", "Final stress": ", ".join(map(str, final)), "Steps": 100, "Duration": 3})
    for k, name in enumerate(("xx", "yy", "zz", "xy", "xz", "yz")):
        runs.check(f"stress {name}", s[f"stress {name}"][-1] / final[k] - 1, BOUND)
        runs.check(f"stress {name} half way", s[f"stress {name}"][50] / final[k] * 2 - 1, BOUND)
    runs.check("time", s["time"][-1] / 3 - 1, 1e-12)
    s = point(runs, "uniaxial", law("linear elastic"), {"Path": "stress", "Final stress": "0, 0, 3e5, 0, 0, 0", "Steps": 100})
    runs.check("strain zz", s["strain zz"][-1] / (100 * math.log1p(3e3 / E)) - 1, BOUND)
    runs.check("strain xx", s["strain xx"][-1] / (100 * math.log1p(-NU * 3e3 / E)) - 1, BOUND)
    s = point(runs, "pure_shear", law("linear elastic"), {"Path": "stress", "Final stress": "0, 0, 0, 3e5, 0, 0", "Steps": 100})
    d = 3e3 / 2 / G
    runs.check("strain xy without spin", s["strain xy"][-1] / (50 * (math.log1p(d) - math.log1p(-d))) - 1, BOUND)
    runs.check("strain xx without spin", s["strain xx"][-1] / (50 * (math.log1p(d) + math.log1p(-d))) - 1, 1e-7)
    sand = law("Mohr-Coulomb", Friction_angle=30, Cohesion=1e3)
    s = point(runs, "stages", sand, {
        "Names": "squeeze, load", "squeeze": {"Path": "isotropic", "Strain": -0.002},
        "load": {"Strain": -0.1, "Steps": 500}})
    held, sin = s["stress xx"][1000], math.sin(math.radians(30))
    runs.check("squeezed", held / (3 * K * added([-0.002], 1000)) - 1, BOUND)
    wanted = ((1 + sin) * held - 2e3 * math.cos(math.radians(30))) / (1 - sin)
    runs.check("loaded", s["stress zz"][-1] / wanted - 1, BOUND)
    runs.check("stages", abs(s["stage"][1000] - 1) + abs(s["stage"][1001] - 2), 0.5)
    end_of_path(runs, sand)


def end_of_path(runs, sand):
    """A path that asks for more than the strength ends with its last step in the table."""
    name = os.path.join(runs.work, "end")
    write(name, sand, {"Path": "stress", "Confining pressure": 1e5, "Final stress": "-1e5, -1e5, -6e5, 0, 0, 0", "Steps": 50})
    status, text = runs.start(["--element", name + ".prm"])
    rows = columns_of(os.path.join(name, "element.csv"))
    strength = 2 * (1e3 * math.cos(math.radians(30)) + 1e5 * 0.5) / 0.5
    runs.check("exit status at the strength", status - 2, 0.5)
    runs.check("steps until then", len(rows["step"]) - 1 - math.floor(strength / 1e4), 0.5)
    runs.check("last q", rows["q"][-1] / (1e4 * math.floor(strength / 1e4)) - 1, BOUND)
    runs.check("its step is named", 0 if f"Step {len(rows['step'])}, from share" in text else 1, 0.5)
