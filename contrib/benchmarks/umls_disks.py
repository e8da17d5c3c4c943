"""Two elastic disks collide on triangles: Cao et al., energy, momentum and the stress in a centre; P1 and C1 UMLS beside."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshes
import numpy as np
import report
from matplotlib.tri import Triangulation
from runs import Run

TITLE = "two elastic disks collide on Delaunay meshes: energy, momentum, stress of UMLS, C1 UMLS and P1"

SIZES = {"coarse": (0.05, 1e-3), "fine": (0.025, 5e-4)}  # edge of the mesh, step
CENTRES = {"lower": 0.2, "upper": 0.8}
CASES = (("UMLS", "FLIP", "coarse"), ("UMLS", "APIC", "coarse"), ("C1 UMLS", "FLIP", "coarse"), ("P1", "FLIP", "coarse"),
         ("UMLS", "FLIP", "fine"))


def make(size):
    """Mesh and particles of one size."""
    h, _ = SIZES[size]
    meshes.make("square", 2, f"disks_{size}", h=h, size=1.3, corner=-0.15)
    points, areas = meshes.centroids(meshes.make("disk", 2, f"disk_{size}", h=h / 2))
    for body, centre in CENTRES.items():
        meshes.write_points(meshes.DIRECTORY / f"disk_{body}_{size}.txt", points + centre, areas)


def runs():
    for size in SIZES:
        make(size)
    return [Run("prm/umls_disks.prm",
                {"Kernel/Type": kernel, "Transfer/Type": transfer, "Grid/File": f"prm/meshes/disks_{size}.msh",
                 "Grid/Spacing": SIZES[size][0], "Run/Step size": SIZES[size][1],
                 **{f"Bodies/{body}/File": f"prm/meshes/disk_{body}_{size}.txt" for body in CENTRES}},
                {"kernel": kernel, "transfer": transfer, "mesh": size}) for kernel, transfer, size in CASES]


def numbers(result):
    """Kinetic energy at the end over the first, time of its minimum, greatest change of momentum over a disk's, of energy."""
    if result.status != 0:
        return dict.fromkeys(("recovered", "time of minimum", "drift", "greatest energy", "energy at end"), math.nan)
    columns = result.statistics()
    K, E = columns["kinetic energy"], columns["kinetic energy"] + columns["strain energy"]
    change = np.hypot(columns["momentum x"] - columns["momentum x"][0], columns["momentum y"] - columns["momentum y"][0])
    disk = columns["mass"][0] / 2 * math.sqrt(2 * K[0] / columns["mass"][0])
    return {"recovered": K[-1] / K[0], "time of minimum": columns["time"][np.argmin(K)], "drift": np.max(change) / disk,
            "greatest energy": np.max(E) / E[0], "energy at end": E[-1] / E[0]}


def table(results):
    return [{**result.run.label, **numbers(result), "seconds": result.seconds} for result in results]


def figures(results):
    by = {tuple(result.run.label.values()): numbers(result) for result in results}
    of = by["UMLS", "FLIP", "fine"]
    found = [report.Figure("UMLS, fine: kinetic energy recovered", of["recovered"], 0.84, 0.9),
             report.Figure("UMLS, fine: time of its minimum", of["time of minimum"], 1.93, 2.06, "s"),
             report.Figure("UMLS, fine: drift of momentum", of["drift"], upper=1e-10)]
    return found


def draw(results, path):
    by = {tuple(result.run.label.values()): result for result in results}
    figure = plt.figure(figsize=(11, 6), layout="constrained")
    space = figure.add_gridspec(3, 4, height_ratios=(1, 1, 0.12))
    axes = np.array([[figure.add_subplot(space[row, column]) for column in range(4)] for row in range(2)])
    shown = by["UMLS", "FLIP", "fine"]
    nodes, triangles = meshes.read_triangles(meshes.DIRECTORY / "disks_fine.msh")
    for axis, time in zip(axes[0], (0, 1.5, 2, 3.25)):
        if time == 0:
            axis.triplot(Triangulation(*nodes.T, triangles), color="0.8", lw=0.3)
        particles = shown.particles(time)
        drawn = axis.scatter(particles["x"], particles["y"], s=1.5, c=particles["stress_xx"] + particles["stress_yy"],
                             vmin=-400, vmax=400, cmap="coolwarm", linewidths=0)
        axis.set(title=f"t = {time} s", xlim=(-0.15, 1.15), ylim=(-0.15, 1.15), aspect="equal", xticks=[], yticks=[])
    figure.colorbar(drawn, ax=axes[0], label="stress xx + yy [Pa]", shrink=0.8, extend="both")
    for (kernel, transfer, size), result in by.items():
        if result.status != 0:
            continue
        columns = result.statistics()
        K0, name = columns["kinetic energy"][0], f"{kernel}, {transfer}, {size}"
        dash = "-" if size == "fine" else "--"
        axes[1, 0].plot(columns["time"], columns["kinetic energy"] / K0, dash, lw=1, label=name)
        axes[1, 1].plot(columns["time"], (columns["kinetic energy"] + columns["strain energy"]) / K0, dash, lw=1)
        axes[1, 2].semilogy(columns["time"], np.hypot(columns["momentum x"], columns["momentum y"]) + 1e-18, dash, lw=1)
        probe = result.columns("probes.csv")
        axes[1, 3].plot(probe["time"], probe["centre_stress_xx"], dash, lw=1)
    axes[1, 0].plot((3.5, 3.5), (0.84, 0.9), "k", lw=5, solid_capstyle="butt", label="bound of UMLS, FLIP, fine",
                    clip_on=False)
    for axis, title in zip(axes[1], ("kinetic energy / first", "kinetic + strain energy / first", "|momentum| [kg m/s]",
                                     "stress xx, lower centre [Pa]")):
        axis.set_title(title, fontsize=10)
        axis.set(xlabel="t [s]", xlim=(0, 3.5))
    axes[1, 1].set_ylim(0.8, 1.02)
    legend = figure.add_subplot(space[2, :])
    legend.axis("off")
    legend.legend(*axes[1, 0].get_legend_handles_labels(), loc="center", ncol=5, fontsize=9, frameon=False)
    figure.savefig(path, dpi=130)
    plt.close(figure)
