"""
Kernel functions near the edge of the grid, Nakamura et al. (2023), Figs. 3 and 4, in one dimension: formulas of their own,
Eqs. 51 to 63, beside which the program's kernels stand in tests/kernels. Nothing is run.
"""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report

TITLE = "kernel functions near the edge of the grid (1D): what each treatment reproduces"

N = 9  # nodes at 0, 1, ..., the edge at 0; distances in spacings
X = np.linspace(0, 5, 2001)[1:-1]  # inside, away from the other edge
LP = 0.25  # half length of uGIMP's particle
KERNELS = {"quadratic": 1.5, "cubic": 2.0, "uGIMP": 1 + LP}  # half supports
TREATMENTS = ["none", "Steffen", "WLS everywhere", "MLS", "WLS"]
FACTORS = {"quadratic": 4 / 3, "cubic": 3 / 2}  # of Steffen's boundary function


def runs():
    return []


def full(kernel, r):
    """The kernel without edges and its derivative at distances r = x - x_i."""
    a, sign = np.abs(r), np.sign(r)
    if kernel == "quadratic":
        value = np.where(a < 0.5, 0.75 - a**2, np.where(a < 1.5, (1.5 - a)**2 / 2, 0))
        slope = np.where(a < 0.5, -2 * a, np.where(a < 1.5, a - 1.5, 0))
    elif kernel == "cubic":
        value = np.where(a < 1, 2 / 3 - a**2 + a**3 / 2, np.where(a < 2, (2 - a)**3 / 6, 0))
        slope = np.where(a < 1, -2 * a + 1.5 * a**2, np.where(a < 2, -(2 - a)**2 / 2, 0))
    else:
        value = np.where(a < LP, 1 - (a**2 + LP**2) / (2 * LP),
                         np.where(a < 1 - LP, 1 - a, np.where(a < 1 + LP, (1 + LP - a)**2 / (4 * LP), 0)))
        slope = np.where(a < LP, -a / LP, np.where(a < 1 - LP, -1, np.where(a < 1 + LP, -(1 + LP - a) / (2 * LP), 0)))
    return value, slope * sign


def functions(kernel, treatment, x=X):
    """Values and derivatives, (point, node)."""
    offset = np.arange(N) - x[:, None]
    w, dw = full(kernel, -offset)
    if treatment == "none":
        return w, dw
    if treatment == "Steffen":
        w, dw = w.copy(), dw.copy()
        w[:, 0] *= FACTORS[kernel]
        dw[:, 0] *= FACTORS[kernel]
        w[:, 1] = 1 - w[:, 0] - w[:, 2:].sum(axis=1)
        dw[:, 1] = -dw[:, 0] - dw[:, 2:].sum(axis=1)
        return w, dw
    # Weighted least squares about the particle: P = (1, x_i - x), M = sum w P P^T.
    P = np.stack([np.ones_like(offset), offset], axis=2)
    C = np.linalg.inv(np.einsum("pn,pni,pnj->pij", w, P, P))
    value = np.einsum("pi,pni,pn->pn", C[:, 0], P, w)
    slope = np.einsum("pi,pni,pn->pn", C[:, 1], P, w)
    if treatment == "MLS":  # the derivative of the value, that of C included: about a fixed origin P does not depend on x
        h = 1e-5
        slope = (functions(kernel, "WLS everywhere", x + h)[0] - functions(kernel, "WLS everywhere", x - h)[0]) / (2 * h)
    is_near = x[:, None] < KERNELS[kernel] - 1  # a node of the support is missing
    if treatment in ("WLS", "MLS"):
        value, slope = np.where(is_near, value, w), np.where(is_near, slope, dw)
    return value, slope


def errors(kernel, treatment):
    """Largest |sum phi - 1|, |sum phi (x_i - x)|, |sum phi' (x_i - x) - 1|."""
    value, slope = functions(kernel, treatment)
    offset = np.arange(N) - X[:, None]
    return (np.max(np.abs(value.sum(axis=1) - 1)), np.max(np.abs((value * offset).sum(axis=1))),
            np.max(np.abs((slope * offset).sum(axis=1) - 1)))


def schemes():
    return [(kernel, treatment) for kernel in KERNELS for treatment in TREATMENTS
            if treatment != "Steffen" or kernel in FACTORS]


def table(results):
    rows = []
    for kernel, treatment in schemes():
        one, linear, gradient = errors(kernel, treatment)
        rows.append({"kernel": kernel, "treatment": treatment, "sum less 1": one, "linear": linear, "gradient": gradient})
    return rows


def figures(results):
    values = []
    for kernel, treatment in schemes():
        one, linear, gradient = errors(kernel, treatment)
        name = f"{kernel}, {treatment}, "
        # MLS is differenced: 1e-16 / 1e-5 of round-off and the square of the step.
        if treatment.startswith(("WLS", "MLS")):
            values += [report.Figure(name + "sum and linear fields", max(one, linear), upper=1e-13),
                       report.Figure(name + "gradient", gradient, upper=1e-13 if treatment != "MLS" else 1e-8)]
        elif treatment == "Steffen":
            values += [report.Figure(name + "sum", one, upper=1e-13),
                       report.Figure(name + "linear fields, off by", linear, lower=0.1)]
    return values


def draw(results, path):
    shown = [("quadratic", treatment) for treatment in TREATMENTS]
    shown += [("cubic", "Steffen"), ("cubic", "MLS"), ("cubic", "WLS"), ("uGIMP", "none"), ("uGIMP", "WLS")]
    figure, axes = plt.subplots(4, 5, figsize=(12, 7.6), sharex=True, layout="constrained")
    for k, (kernel, treatment) in enumerate(shown):
        block, column = divmod(k, 5)
        for axis, curves in zip(axes[2 * block:2 * block + 2, column], functions(kernel, treatment)):
            axis.plot(X, curves[:, :5], lw=1.2)
            axis.set_xlim(0, 3)
        axes[2 * block, column].set_title(f"{kernel}, {treatment}", fontsize=9)
        axes[2 * block, column].set_ylim(-0.1, 1.1)
        axes[2 * block + 1, column].set_ylim(-1.6, 1.6)
    for row, name in enumerate(["value", "derivative"] * 2):
        axes[row, 0].set_ylabel(name)
    for axis in axes[3]:
        axis.set_xlabel("distance from the edge / h")
    figure.suptitle("Kernel functions of the first nodes at the edge of the grid")
    figure.savefig(path, dpi=110)
    plt.close(figure)
