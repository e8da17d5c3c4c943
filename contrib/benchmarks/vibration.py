"""Axis-aligned vibration, Tran et al. (2019), section 4.2: a bar, a square and a cube."""
import convergence
import report
from convergence import METHODS
from runs import Run

TITLE = "manufactured solution, axis-aligned vibration (bar, square, cube): orders of linear, uGIMP, CPDI, CPLS, TPIC"

SPEED = 100.
LEVELS = {"bar": (8, 16, 32, 64, 128, 256, 512), "square": (8, 16, 32, 64), "cube": (8, 16, 32)}
AMPLITUDES = (1e-4, 0.1)
PER_AXIS = (1, 2, 3)  # particles per cell and direction


def numbers(*values):
    return ", ".join(f"{value!r}" for value in values)


def geometry(kind, n, method):
    """Grid, body and walls: two cells of grid beyond the walls, or none where a method has its walls at the grid's faces."""
    h = 1 / n
    beyond = 0 if method == "TPIC" else 2 * h
    dim = 3 if kind == "cube" else 2
    low, high = [-beyond] * dim, [1 + beyond] * dim
    body = [1.] * dim
    planes = [f"{axis} {side}" for axis in "xyz"[:1 if kind == "bar" else dim] for side in ("<= 0", ">= 1")]
    ids = "0, 1" if kind == "bar" else "0, 1, 2, 3" if dim == 2 else "0, 1, 2, 3, 4, 5"
    if method == "TPIC":
        planes = []
    if kind == "bar":  # one cell of material on a grid that reaches beyond it; nothing moves along y
        low[1], high[1], body[1] = -2 * h, 3 * h, h
        planes.append(f"y >= {low[1]!r}")
    walls = {"Conditions/walls/Half spaces": ", ".join(planes)}
    if method == "TPIC":
        walls["Conditions/walls/Boundary ids"] = ids
    name = "cube" if kind == "cube" else "square"
    return {"Grid/Lower corner": numbers(*low), "Grid/Upper corner": numbers(*high), "Grid/Spacing": repr(h),
            f"Bodies/{name}/Upper corner": numbers(*body), **walls}


def run(kind, n, method, amplitude=0.1, per_axis=2):
    name = "cube" if kind == "cube" else "square"
    settings = {**METHODS[method], **geometry(kind, n, method), "Run/Step size": repr(0.4 / n / SPEED),
                "Verification/Amplitude": repr(amplitude), "Output/Statistics interval": max(1, n // 8),
                f"Bodies/{name}/Particles per cell and direction": per_axis}
    if kind == "bar":
        settings["Verification/Directions"] = "x"
    if method == "uGIMP":
        settings["Kernel/Half length"] = repr(0.5 / per_axis)
    prm = "prm/vibration_3d.prm" if kind == "cube" else "prm/vibration.prm"
    return Run(prm, settings, {"kind": kind, "method": method, "A": str(amplitude), "ppc": str(per_axis**2),
                               "1/h": str(n)})


def runs():
    bars = [run("bar", n, method, amplitude, per_axis) for amplitude in AMPLITUDES for per_axis in PER_AXIS
            for method in METHODS for n in LEVELS["bar"]]
    squares = [run("square", n, method) for method in METHODS for n in LEVELS["square"]]
    cubes = [run("cube", n, method) for method in ("CPDI", "CPLS", "TPIC") for n in LEVELS["cube"]]
    return bars + squares + cubes


def level(result):
    return int(result.run.label["1/h"])


def case(result):
    label = result.run.label
    return label["kind"], label["method"], label["A"], label["ppc"]


def table(results):
    return convergence.table(results, case, level)


def by_case(results):
    values = {}
    for result in results:
        values.setdefault(case(result), {})[level(result)] = convergence.errors(result)
    return values


def figures(results):
    values = by_case(results)
    series = lambda case, field, levels, when="T/4": [values[case][n][when][field] for n in levels]
    found = []
    fine = (128, 256, 512)
    cpls, cpdi = ("bar", "CPLS", "0.1", "4"), ("bar", "CPDI", "0.1", "4")
    for when in ("T/4", "T"):
        for field in "UVS":
            order = convergence.mean_order(series(cpls, field, fine, when))
            # Velocities are half a step late: first order in the step, except where the acceleration is zero, at T.
            found.append(report.Figure(f"bar, A = .1, 4 a cell, CPLS, order of {field} at {when}, 1/128..1/512", order,
                                       lower=0.9 if (field, when) == ("V", "T/4") else 1.9))
    for field, upper in (("V", 1.5), ("S", 1.3)):
        found.append(report.Figure(f"bar, A = .1, 4 a cell, CPDI, order of {field} at T, 1/128..1/512",
                                   convergence.mean_order(series(cpdi, field, fine, "T")), upper=upper))
    for field, lower in (("V", 2), ("S", 5)):
        found.append(report.Figure(f"bar, A = .1, 4 a cell, 1/512, {field} of CPDI over CPLS at T",
                                   series(cpdi, field, fine, "T")[-1] / series(cpls, field, fine, "T")[-1], lower=lower))
    one = [("bar", method, "0.1", "1") for method in ("CPDI", "CPLS")]
    for field, lower in (("U", 5), ("V", 4), ("S", 8)):
        found.append(report.Figure(f"bar, A = .1, 1 a cell, 1/256, {field} of CPDI over CPLS at T",
                                   series(one[0], field, [256], "T")[0] / series(one[1], field, [256], "T")[0],
                                   lower=lower))
    for method in METHODS:
        for field in "UVS":
            order = convergence.mean_order(series(("bar", method, "0.0001", "4"), field, fine, "T"))
            found.append(report.near(f"bar, A = 1e-4, 4 a cell, {method}, order of {field} at T", order, 2, 0.1))
    for kind, levels in (("square", (16, 32, 64)), ("cube", (8, 16, 32))):
        for field in "UVS":
            order = convergence.mean_order(series((kind, "CPLS", "0.1", "4"), field, levels, "T"))
            found.append(report.Figure(f"{kind}, A = .1, CPLS, order of {field} at T", order, lower=1.9))
    return found


def draw(results, path):
    values = by_case(results)

    def lines(kind, amplitude, per_cells, methods=METHODS):
        marks = {"1": ("--", "s"), "4": ("-", "o"), "9": (":", "^")}
        found = {}
        for method in methods:
            for per_cell in per_cells:
                errors = values[kind, method, amplitude, per_cell]
                name = method if len(per_cells) == 1 else f"{method}, {per_cell} a cell"
                found[name] = ([1 / n for n in errors], list(errors.values()), convergence.style(method, *marks[per_cell]))
        return found

    for when, target in (("T", path), ("T/4", path.parent / "vibration_quarter.png")):
        convergence.curves(target, [("bar, A = 1e-4", lines("bar", "0.0001", "4")), ("bar, A = .1", lines("bar", "0.1", "4")),
                                    ("bar, A = .1", lines("bar", "0.1", "149", ("CPDI", "CPLS"))),
                                    ("square, A = .1", lines("square", "0.1", "4"))],
                           "Axis-aligned vibration", when)
