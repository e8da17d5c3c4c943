"""What benchmarks with a manufactured solution share: methods, errors of runs, observed orders, curves."""
import csv
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

METHODS = {
    "linear": {"Kernel/Type": "linear", "Kernel/Boundary treatment": "none", "Transfer/Type": "FLIP"},
    "uGIMP": {"Kernel/Type": "uGIMP", "Kernel/Boundary treatment": "none", "Transfer/Type": "FLIP"},
    "CPDI": {"Kernel/Type": "CPDI", "Transfer/Type": "FLIP"},
    "CPLS": {"Kernel/Type": "CPDI", "Transfer/Type": "CPLS"},
    # Not in the paper. Its own walls are faces of the grid, at which WLS corrects the kernel.
    "TPIC": {"Kernel/Type": "quadratic B-spline", "Transfer/Type": "TPIC", "Kernel/Boundary treatment": "WLS"},
}
COLOURS = {"linear": "tab:gray", "uGIMP": "tab:green", "CPDI": "tab:blue", "CPLS": "tab:red", "TPIC": "tab:purple"}
FIELDS = {"U": "error u", "V": "error v", "S": "error stress"}
UNITS = {"U": "displacement [m]", "V": "velocity [m/s]", "S": "stress [Pa]"}


def errors(result):
    """The rows of verification.csv, of a quarter and of the end of the run: {"T/4": {"U": ...}, "T": ...}."""
    path = result.directory / "verification.csv"
    if result.status != 0 or not path.exists():
        return {when: dict.fromkeys(FIELDS, math.nan) for when in ("T/4", "T")}
    with open(path, newline="") as file:
        rows = [{name.split(" [")[0]: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    return {when: {field: row[column] for field, column in FIELDS.items()} for when, row in zip(("T/4", "T"), rows)}


def order(coarse, fine, ratio=2.):
    """Observed order between two levels of refinement."""
    return math.log(coarse / fine) / math.log(ratio) if coarse > 0 and fine > 0 else math.nan


def mean_order(values, ratio=2.):
    """Observed order between the first and the last of some levels."""
    return order(values[0], values[-1], ratio) / (len(values) - 1)


def level(result):
    """1/h of a run."""
    return int(result.run.label["1/h"])


def case(result, labels):
    return tuple(result.run.label[name] for name in labels)


def by_case(results, labels):
    """{case: {1/h: errors()}}; a case is what the labels of these names are."""
    values = {}
    for result in results:
        values.setdefault(case(result, labels), {})[level(result)] = errors(result)
    return values


def series(values, field, levels, when):
    """A field's errors at some levels of one case."""
    return [values[n][when][field] for n in levels]


def table(results, labels):
    """A row for each run, with the order from the run of the same case and twice the spacing."""
    values = by_case(results, labels)
    rows = []
    for result in results:
        row, here = dict(result.run.label), values[case(result, labels)]
        for when in ("T/4", "T"):
            for field in FIELDS:
                fine = row[f"{field} {when}"] = here[level(result)][when][field]
                coarse = here[level(result) // 2][when][field] if level(result) // 2 in here else math.nan
                row[f"order {field} {when}"] = order(coarse, fine)
        row["failed at"] = result.failure_time()
        row["seconds"] = result.seconds
        rows.append(row)
    return rows


def curves(path, columns, title, slope=2):
    """
    Errors over the spacing, a row for each field. `columns`: (title, "T" or "T/4", {name: (spacings, errors(), style)}).
    """
    figure, axes = plt.subplots(len(FIELDS), len(columns), figsize=(2.6 * len(columns) + 0.8, 7.), sharex="col",
                                squeeze=False, layout="constrained")
    for column, (name, when, lines) in enumerate(columns):
        for row, field in enumerate(FIELDS):
            axis = axes[row, column]
            lowest = math.inf
            for label, (spacings, values, style) in lines.items():
                y = [value[when][field] for value in values]
                axis.loglog(spacings, y, markersize=3, linewidth=1, label=label, **style)
                finite = [value for value in y if value > 0]
                lowest = min([lowest] + finite)
            spacings = np.array(sorted({h for values in lines.values() for h in values[0]}))
            if math.isfinite(lowest):
                axis.loglog(spacings, 0.5 * lowest * (spacings / spacings[0])**slope, "k:", linewidth=1,
                            label=f"order {slope}")
            axis.set_xticks(spacings, [f"1/{round(1 / h)}" for h in spacings])
            axis.set_xticks([], minor=True)
            axis.tick_params(labelsize=7)
            axis.grid(alpha=0.3)
            if column == 0:
                axis.set_ylabel(f"RMS error, {UNITS[field]}", fontsize=9)
        axes[0, column].set_title(f"{name}, {when.replace('T', 't = T', 1)}", fontsize=9)
        axes[-1, column].set_xlabel("spacing h [m]", fontsize=9)
    axes[0, 0].legend(fontsize=6)
    figure.suptitle(title, fontsize=11)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def style(method, dash="-", marker="o"):
    return {"color": COLOURS[method], "linestyle": dash, "marker": marker}
