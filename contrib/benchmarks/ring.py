"""Radial expansion of a ring, Tran et al. (2019), section 4.3."""
import convergence
import report
from convergence import METHODS
from runs import Run

TITLE = "manufactured solution, a quarter of a ring expands (2D): orders of linear, uGIMP, CPDI, CPLS, TPIC"

SPEED = 100.
LEVELS = (10, 20, 40, 80, 160)  # 1/h
AMPLITUDES = (1e-4, 0.1)


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
    return Run("prm/ring.prm", settings, {"method": method, "A": str(amplitude), "1/h": str(n)})


def runs():
    return [run(n, method, amplitude) for amplitude in AMPLITUDES for method in METHODS for n in LEVELS]


def level(result):
    return int(result.run.label["1/h"])


def case(result):
    return result.run.label["method"], result.run.label["A"]


def table(results):
    return convergence.table(results, case, level)


def by_case(results):
    values = {}
    for result in results:
        values.setdefault(case(result), {})[level(result)] = convergence.errors(result)
    return values


def figures(results):
    values = by_case(results)
    series = lambda method, amplitude, field, when="T": [values[method, amplitude][n][when][field] for n in LEVELS]
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
    values = by_case(results)

    def lines(amplitude):
        return {method: ([1 / n for n in LEVELS], [values[method, amplitude][n] for n in LEVELS],
                         convergence.style(method)) for method in METHODS}

    for when, target in (("T", path), ("T/4", path.parent / "ring_quarter.png")):
        convergence.curves(target, [("A = 1e-4", lines("0.0001")), ("A = .1", lines("0.1"))], "Radial expansion of a ring",
                           when)
