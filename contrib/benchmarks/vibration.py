"""Axis-aligned vibration, Tran et al. (2019), section 4.2: a bar, a square and a cube, and symmetric parts of them."""
import balance
import convergence
import numpy as np
import report
from convergence import METHODS
from runs import Run

TITLE = "manufactured solution, axis-aligned vibration (bar, square, cube): orders of linear, uGIMP, CPDI, CPLS, TPIC"

SPEED, DENSITY = 100., 1000.
LEVELS = {"bar": (8, 16, 32, 64, 128, 256, 512), "square": (8, 16, 32, 64), "quadrant": (32, 64, 128), "cube": (8, 16, 32),
          "octant": (16, 32, 64), "octant, half the step": (32, 64, 128)}
AMPLITUDES = (1e-4, 0.1)
# Without particles that cross cells, linear kernels have an error of 1.957 A^2 at T/4 whatever the spacing: see doc/cpls.md.
TINY = 1e-6
PAPER = ("linear", "uGIMP", "CPDI", "CPLS")  # methods
FINE = (128, 256, 512)
PER_AXIS = (1, 2, 3)  # particles per cell and direction
HALVINGS = (1, 2, 3, 4)  # of the step, of bars with GAIN cells
COARSE, GAIN = 8, 64
LABELS = "kind", "method", "A", "ppc"


def numbers(*values):
    return ", ".join(f"{value!r}" for value in values)


def geometry(kind, n, method):
    """
    Grid, body and walls: two cells of grid beyond the walls, or none where a method has its walls at the grid's faces.
    Halves of an edge move symmetrically: a quadrant is a quarter of the square, an octant an eighth of the cube.
    """
    h = 1 / n
    beyond = 0 if method == "TPIC" else 2 * h
    dim = 3 if kind in ("cube", "octant") else 2
    edge = 0.5 if kind in ("quadrant", "octant") else 1.
    low, high, body = [-beyond] * dim, [edge + beyond] * dim, [edge] * dim
    planes = [f"{axis} {side}" for axis in "xyz"[:1 if kind == "bar" else dim] for side in ("<= 0", f">= {edge!r}")]
    ids = "0, 1" if kind == "bar" else "0, 1, 2, 3" if dim == 2 else "0, 1, 2, 3, 4, 5"
    if method == "TPIC":
        planes = []
    if kind == "bar":  # one cell of material on a grid that reaches beyond it; nothing moves along y
        low[1], high[1], body[1] = -2 * h, 3 * h, h
        planes.append(f"y >= {low[1]!r}")
    walls = {"Conditions/walls/Half spaces": ", ".join(planes)}
    if method == "TPIC":
        walls["Conditions/walls/Boundary ids"] = ids
    name = "cube" if dim == 3 else "square"
    return {"Grid/Lower corner": numbers(*low), "Grid/Upper corner": numbers(*high), "Grid/Spacing": repr(h),
            f"Bodies/{name}/Upper corner": numbers(*body), **walls}


def run(kind, n, method, amplitude=0.1, per_axis=2, halvings=0):
    name = "cube" if kind in ("cube", "octant") else "square"
    settings = {**METHODS[method], **geometry(kind, n, method), "Run/Step size": repr(0.4 / n / SPEED / 2**halvings),
                "Verification/Amplitude": repr(amplitude), "Output/Statistics interval": max(1, n // 8) * 2**halvings,
                f"Bodies/{name}/Particles per cell and direction": per_axis}
    if kind == "bar":
        settings["Verification/Directions"] = "x"
    if kind == "quadrant" and n == COARSE:
        settings.update(balance.settings(steps=1))
    if method == "uGIMP":
        settings["Kernel/Half length"] = repr(0.5 / per_axis)
    prm = "prm/vibration_3d.prm" if name == "cube" else "prm/vibration.prm"
    label = kind if halvings == 0 else f"{kind}, dt/{2**halvings}"
    return Run(prm, settings, {"kind": label, "method": method, "A": str(amplitude), "ppc": str(per_axis**2), "1/h": str(n)})


def runs():
    bars = [run("bar", n, method, amplitude, per_axis) for amplitude in AMPLITUDES for per_axis in PER_AXIS
            for method in METHODS for n in LEVELS["bar"]]
    bars += [run("bar", n, method, TINY) for method in PAPER for n in FINE]
    squares = [run("square", n, method) for method in METHODS for n in LEVELS["square"]]
    quadrants = [run("quadrant", COARSE, method) for method in balance.METHODS]
    quadrants += [run("quadrant", n, "CPLS") for n in LEVELS["quadrant"]]
    halved = [run("bar", GAIN, method, halvings=k) for method in balance.METHODS for k in HALVINGS]
    cubes = [run("cube", n, method) for method in ("CPDI", "CPLS", "TPIC") for n in LEVELS["cube"]]
    octants = [run("octant", n, "CPLS") for n in LEVELS["octant"]]
    octants += [run("octant", n, "CPLS", per_axis=1, halvings=1) for n in LEVELS["octant, half the step"]]
    return bars + squares + quadrants + halved + cubes + octants


def table(results):
    return convergence.table(results, LABELS)


def exact(t, amplitude=0.1):
    """Momentum along x and energies of the quadrant, by the midpoint rule."""
    X = (np.arange(200) + 0.5) / 400
    u, v = amplitude * np.sin(np.pi * SPEED * t), amplitude * np.pi * SPEED * np.cos(np.pi * SPEED * t)
    stretch = 2 * np.pi * np.outer(u, np.cos(2 * np.pi * X))
    lam, mu = balance.lame(1e7, 0.3)
    W = balance.strain_energy(lam, mu, 1 + stretch[:, :, None], 1 - stretch[:, None, :])
    sine = np.sin(2 * np.pi * X)
    return {"momentum": DENSITY / 4 * v * np.mean(sine), "kinetic": DENSITY / 4 * v**2 * np.mean(sine**2),
            "strain": np.mean(W, axis=(1, 2)) / 4}


def energy_at_end(result):
    """Kinetic and strain energy at T over the first; 1 in the exact solution."""
    _, values = balance.energies(result)
    return values["total"][-1] / values["total"][0]


def figures(results):
    values = convergence.by_case(results, LABELS)
    series = lambda case, field, levels, when="T/4": convergence.series(values[case], field, levels, when)
    found = []
    cpls, cpdi = ("bar", "CPLS", "0.1", "4"), ("bar", "CPDI", "0.1", "4")
    for when in ("T/4", "T"):
        for field in "UVS":
            order = convergence.mean_order(series(cpls, field, FINE, when))
            # Velocities are half a step late: first order in the step, except where the acceleration is zero, at T.
            found.append(report.Figure(f"bar, A = .1, 4 a cell, CPLS, order of {field} at {when}, 1/128..1/512", order,
                                       lower=0.9 if (field, when) == ("V", "T/4") else 1.9))
    for field, upper in (("V", 1.5), ("S", 1.3)):
        found.append(report.Figure(f"bar, A = .1, 4 a cell, CPDI, order of {field} at T, 1/128..1/512",
                                   convergence.mean_order(series(cpdi, field, FINE, "T")), upper=upper))
    for field, lower in (("V", 2), ("S", 5)):
        found.append(report.Figure(f"bar, A = .1, 4 a cell, 1/512, {field} of CPDI over CPLS at T",
                                   series(cpdi, field, FINE, "T")[-1] / series(cpls, field, FINE, "T")[-1], lower=lower))
    one = [("bar", method, "0.1", "1") for method in ("CPDI", "CPLS")]
    for field, lower in (("U", 5), ("V", 4), ("S", 8)):
        found.append(report.Figure(f"bar, A = .1, 1 a cell, 1/256, {field} of CPDI over CPLS at T",
                                   series(one[0], field, [256], "T")[0] / series(one[1], field, [256], "T")[0],
                                   lower=lower))
    # Where errors of h^2 rule, for linear kernels down to 1/128; V comes to its order from below.
    for amplitude, levels, tolerance in ((1e-4, (32, 64, 128), 0.15), (TINY, FINE, 0.05)):
        for method in PAPER:
            for field in "UVS":
                order = convergence.mean_order(series(("bar", method, str(amplitude), "4"), field, levels, "T"))
                found.append(report.near(f"bar, A = {amplitude:g}, 4 a cell, {method}, order of {field} at T, 1/{levels[0]}.."
                                         f"1/{levels[-1]}", order, 2, tolerance))
    found.append(report.near("bar, A = 1e-4, 1/512, linear, U at T/4 over A^2",
                             series(("bar", "linear", "0.0001", "4"), "U", [512])[0] / 1e-8, 1.957, 0.02))
    # The octant with 1 a cell and half the step: a cube is stable with less than a square, and reaches its order there.
    for kind, per_cell, levels in (("quadrant", "4", LEVELS["quadrant"]),
                                   ("octant, dt/2", "1", LEVELS["octant, half the step"])):
        for field, when in [("U", "T"), ("V", "T"), ("S", "T")] + [("U", "T/4"), ("S", "T/4")] * (per_cell == "1"):
            order = convergence.mean_order(series((kind, "CPLS", "0.1", per_cell), field, levels, when))
            found.append(report.Figure(f"{kind}, A = .1, CPLS, order of {field} at {when}, 1/{levels[0]}..1/{levels[-1]}",
                                       order, lower=1.9))
    by = {(*convergence.case(result, LABELS), convergence.level(result)): result for result in results}
    for method in balance.METHODS:  # the energy that it gains in impacts with small steps, it does not gain here
        ends = [energy_at_end(by[kind, method, "0.1", "4", GAIN]) for kind in ("bar", f"bar, dt/{2**HALVINGS[-1]}")]
        found.append(report.Figure(f"bar, A = .1, {method}, 1/{GAIN}, energy at T over K0, dt/16 less dt", ends[1] - ends[0],
                                   -1e-3, 1e-3))
    return found


def draw(results, path):
    values = convergence.by_case(results, LABELS)

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
        convergence.curves(target, [("bar, A = 1e-4", when, lines("bar", "0.0001", "4")),
                                    ("bar, A = .1", when, lines("bar", "0.1", "4")),
                                    ("1 (dashed), 4, 9 (dotted) a cell", when, lines("bar", "0.1", "149", ("CPDI", "CPLS"))),
                                    ("square, A = .1", when, lines("square", "0.1", "4"))], "Axis-aligned vibration")
    quadrants = {(result.run.label["kind"], result.run.label["method"]): result for result in results
                 if convergence.level(result) == COARSE}
    balance.draw(path.parent / "vibration_balance.png",
                 f"Vibration of a square, A = .1, h = 1/{COARSE}, 4 a cell: one of its four quadrants",
                 {method: quadrants["quadrant", method] for method in balance.METHODS}, "momentum x", "kg m/s", exact)
