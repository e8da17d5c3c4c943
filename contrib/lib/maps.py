"""Fields of a block of particles as coloured maps, side by side."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def initial_positions(particles):
    axes = [axis for axis in "xyz" if axis in particles]
    return np.stack([particles[axis] - particles["displacement_" + axis] for axis in axes], axis=1)


def components(particles, prefix):
    """Stress tensors as an array (particle, 3, 3) from the columns prefix_xx, ..."""
    stress = np.zeros((len(particles["id"]), 3, 3))
    for i, a in enumerate("xyz"):
        for j, b in enumerate("xyz"):
            column = f"{prefix}_{min(a, b)}{max(a, b)}"
            if column in particles:
                stress[:, i, j] = particles[column]
    return stress


def von_mises(stress):
    deviator = stress - np.trace(stress, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
    return np.sqrt(1.5 * np.sum(deviator**2, axis=(1, 2)))


def image(particles, values):
    """Values on the particles' initial lattice, x to the right and y upwards; in 3D those of the layer z = middle."""
    position = initial_positions(particles)
    if position.shape[1] == 3:
        layers = np.unique(np.round(position[:, 2], 9))
        is_shown = np.isclose(position[:, 2], layers[len(layers) // 2])
        position, values = position[is_shown], values[is_shown]
    columns, rows = (np.unique(np.round(position[:, d], 9), return_inverse=True)[1] for d in (0, 1))
    picture = np.full((rows.max() + 1, columns.max() + 1), np.nan)
    picture[rows, columns] = values
    return picture


def draw(path, rows, title):
    """`rows`: (label, colour range, list of (title, image or None)). Each row has its own colour bar."""
    n = max(len(panels) for _, _, panels in rows)
    figure, axes = plt.subplots(len(rows), n, figsize=(2.15 * n + 1.2, 2.3 * len(rows) + 0.4),
                                squeeze=False, layout="constrained")
    for line, (label, limits, panels) in zip(axes, rows):
        drawn = None
        for axis, panel in zip(line, panels + [None] * (n - len(panels))):
            axis.set_xticks([])
            axis.set_yticks([])
            if panel is None:
                axis.set_axis_off()
                continue
            name, picture = panel
            axis.set_title(name, fontsize=10)
            if picture is None:
                axis.text(0.5, 0.5, "the run failed", ha="center", va="center", transform=axis.transAxes)
                continue
            drawn = axis.imshow(picture, origin="lower", vmin=limits[0], vmax=limits[1], cmap=limits[2],
                                extent=(0, 1, 0, 1), interpolation="nearest")
        if drawn is not None:
            figure.colorbar(drawn, ax=list(line), label=label, extend="max", shrink=0.9, aspect=14)
    figure.suptitle(title, fontsize=12)
    figure.savefig(path, dpi=110)
    plt.close(figure)
