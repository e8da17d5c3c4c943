"""Radial expansion of a ring, Tran et al. (2019), section 4.3."""
import balance
import convergence
import numpy as np
import report
from convergence import METHODS
from runs import Run

TITLE = "manufactured solution, a quarter of a ring expands (2D): orders of linear, uGIMP, CPDI, CPLS, TPIC"

SPEED, DENSITY, MU = 100., 1000., 5e6
INNER, OUTER = 0.4, 0.6
LEVELS = (10, 20, 40, 80, 160)  # 1/h
AMPLITUDES = (1e-4, 0.1)
LABELS = "method", "A"


def run(n, method, amplitude):
    h = 1 / n
    settings = {**METHODS[method], "Grid/Spacing": repr(h), "Run/Step size": repr(0.4 * h / SPEED),
                "Verification/Amplitude": repr(amplitude), "Output/Statistics interval": max(1, n // 10),
                "Bodies/quarter/Particles": f"{round(0.4 * n)}, {round(1.6 * n)}",
                "Grid/Lower corner": f"{-2 * h!r}, {-2 * h!r}"}
    if method == "TPIC":  # its symmetry planes are faces of the grid
        settings["Grid/Lower corner"] = "0, 0"
        settings["Conditions/symmetry/Half spaces"] = ""
        settings["Conditions/symmetry/Boundary ids"] = "0, 2"
    if n == LEVELS[0] and method in balance.METHODS:
        settings.update(balance.settings(steps=1))
    return Run("prm/ring.prm", settings, {"method": method, "A": str(amplitude), "1/h": str(n)})


def runs():
    return [run(n, method, amplitude) for amplitude in AMPLITUDES for method in METHODS for n in LEVELS]


def table(results):
    return convergence.table(results, LABELS)


def exact(t, amplitude=0.1):
    """Momentum along x and energies of the quarter, by the midpoint rule along the radius."""
    R = np.linspace(INNER, OUTER, 2001)
    R = (R[1:] + R[:-1]) / 2
    weight = R * (OUTER - INNER) / len(R)  # of the radius; that of the angle is pi / 2, or 1 for its cosine
    c = np.array([-2, 3 * (INNER + OUTER), -6 * INNER * OUTER]) / (OUTER**2 * (OUTER - 3 * INNER))
    g, slope = np.polyval([*c, 0], R), np.polyval([3 * c[0], 2 * c[1], c[2]], R)
    omega = np.pi * SPEED / (INNER + OUTER)
    u, v = amplitude * np.sin(omega * t), amplitude * omega * np.cos(omega * t)
    W = balance.strain_energy(0, MU, 1 + np.outer(u, slope), 1 + np.outer(u, g / R))
    return {"momentum": DENSITY * v * (weight @ g), "kinetic": np.pi / 4 * DENSITY * v**2 * (weight @ g**2),
            "strain": np.pi / 2 * (W @ weight)}


def figures(results):
    values = convergence.by_case(results, LABELS)
    series = lambda method, amplitude, field, when="T": convergence.series(values[method, amplitude], field, LEVELS, when)
    found = []
    for method in ("CPDI", "CPLS"):
        for coarse, fine, n in zip(series(method, "0.1", "U"), series(method, "0.1", "U")[1:], LEVELS[1:]):
            found.append(report.Figure(f"A = .1, {method}, order of U at T, 1/{n // 2}..1/{n}",
                                       convergence.order(coarse, fine), lower=1.9))
    stress = series("CPLS", "0.1", "S")
    for coarse, fine, n, measured in zip(stress, stress[1:], LEVELS[1:], (1.98, 1.95, 1.65, 0.98)):
        found.append(report.Figure(f"A = .1, CPLS, order of S at T, 1/{n // 2}..1/{n} (prototype {measured})",
                                   convergence.order(coarse, fine), **({"lower": 1.8} if n <= 40 else {})))
    return found


def draw(results, path):
    values = convergence.by_case(results, LABELS)

    def lines(amplitude):
        return {method: ([1 / n for n in LEVELS], [values[method, amplitude][n] for n in LEVELS],
                         convergence.style(method)) for method in METHODS}

    convergence.curves(path, [("A = 1e-4", "T", lines("0.0001")), ("A = .1", "T", lines("0.1")),
                              ("A = .1", "T/4", lines("0.1"))], "Radial expansion of a ring")
    coarse = {result.run.label["method"]: result for result in results
              if convergence.level(result) == LEVELS[0] and result.run.label["A"] == "0.1"}
    balance.draw(path.parent / "ring_balance.png", f"Radial expansion of a ring, A = .1, h = 1/{LEVELS[0]}",
                 {method: coarse[method] for method in balance.METHODS}, "momentum x", "kg m/s", exact)
