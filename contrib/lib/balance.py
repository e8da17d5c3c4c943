"""Momentum of particles and nodes and the energies of a manufactured motion over time, beside the exact ones."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import nodes
import numpy as np
from convergence import COLOURS

METHODS = ("CPDI", "CPLS")


def lame(E, nu):
    return E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))


def strain_energy(lam, mu, *stretches):
    """W per reference volume of the neo-Hookean material in plane strain, from its principal stretches in the plane."""
    J = stretches[0] * stretches[1]
    return lam / 2 * np.log(J)**2 + mu / 2 * (stretches[0]**2 + stretches[1]**2 - 2) - mu * np.log(J)


def momentum(result, name):
    """Times and values of the particles, and of the nodes; `name` is 'momentum x' or 'angular momentum z'."""
    columns = result.statistics()
    times, linear, angular = nodes.momenta(result)
    return columns["time"], columns[name], times, angular if name.startswith("angular") else linear[:, "xyz".index(name[-1])]


def defect(result, name):
    """The greatest difference of nodes and particles over the particles' greatest value; statistics hold all times."""
    time, of_particles, times, of_nodes = momentum(result, name)
    return np.max(np.abs(of_nodes - np.interp(times, time, of_particles))) / np.max(np.abs(of_particles))


def with_total(curves):
    return {**curves, "total": curves["kinetic"] + curves["strain"]}


def energies(result):
    columns = result.statistics()
    return columns["time"], with_total({"kinetic": columns["kinetic energy"], "strain": columns["strain energy"]})


def settings(steps):
    """What a run writes of which momenta and energies are drawn, `steps` between its files."""
    return {"Output/Step interval": steps, "Output/Statistics interval": 1}


def draw(path, title, results, name, unit, exact):
    """
    Three panels of the momentum `name` and of energies, and what differs from the exact ones. `results`: {method: result};
    exact(t) gives {"momentum", "kinetic", "strain"} at times t.
    """
    figure, axes = plt.subplots(2, 3, figsize=(10.5, 5.8), layout="constrained")
    (total, kinetic, strain), (defect_axis, total_energy, error) = axes
    panels = {"kinetic": kinetic, "strain": strain, "total": total_energy}
    shown = {method: result for method, result in results.items() if result.status == 0}
    t = np.linspace(0, max(result.statistics()["time"][-1] for result in shown.values()), 400)
    curves = with_total(exact(t))
    total.plot(t, curves["momentum"], "k-", linewidth=0.8, label="exact")
    for energy, axis in panels.items():
        axis.plot(t, curves[energy], "k-", linewidth=0.8)
        axis.set_title(f"{energy} energy [J]", fontsize=9)
    for method, result in shown.items():
        style = {"color": COLOURS[method], "linewidth": 1}
        time, of_particles, times, of_nodes = momentum(result, name)
        total.plot(time, of_particles, "--", label=f"{method}, particles", **style)
        total.plot(times, of_nodes, "o", markersize=2.5, markerfacecolor="none", color=COLOURS[method], label=f"{method}, nodes")
        defect_axis.plot(times, of_nodes - np.interp(times, time, of_particles), **style)
        time, values = energies(result)
        for energy, axis in panels.items():
            axis.plot(time, values[energy], "--", **style)
        error.plot(time, values["total"] - with_total(exact(time))["total"], **style)
    total.set_title(f"{name} [{unit}]", fontsize=9)
    defect_axis.set_title("that of nodes less that of particles", fontsize=9)
    error.set_title("total energy less the exact one [J]", fontsize=9)
    total.legend(fontsize=7)
    for axis in axes.flat:
        axis.grid(alpha=0.3)
        axis.tick_params(labelsize=8)
    for axis in axes[1]:
        axis.set_xlabel("t [s]", fontsize=8)
    figure.suptitle(title, fontsize=11)
    figure.savefig(path, dpi=110)
    plt.close(figure)
