"""Draws what runs have written: particles as filled domains, columns of tables over time, convergence."""
import argparse
import pathlib
import shutil
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import outputs  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

FRAMES_PER_SECOND = 12


def chosen(directory, time):
    """The outputs asked for: the last, the nearest to a time, or all."""
    found = outputs.series(directory)
    if time == "all":
        return found
    return [found[-1] if time == "last" else min(found, key=lambda entry: abs(entry[0] - float(time)))]


def in_slab(particles, cut):
    """Those within half a particle of a plane (axis, value), and the two axes that are seen."""
    axis, value = cut
    is_near = np.abs(particles.places[:, axis] - value) <= 0.5 * particles.side() * (1 + 1e-9)
    return is_near, tuple(k for k in range(3) if k != axis)


def project(x, up):
    """Seen from the front, the right and above: horizontal, vertical, nearness."""
    a, b = np.radians(30), np.radians(25)
    if up == "y":
        x = np.stack([x[:, 0], -x[:, 2], x[:, 1]], axis=1)
    turned = np.cos(a) * x[:, 0] - np.sin(a) * x[:, 1]
    depth = np.sin(a) * x[:, 0] + np.cos(a) * x[:, 1]
    return turned, np.cos(b) * x[:, 2] + np.sin(b) * depth, np.sin(b) * x[:, 2] - np.cos(b) * depth


def polygons(particles, cut, up):
    """Corners (n, 4, 2) of what is seen, from back to front, and which particles these are."""
    if particles.dim == 2:
        return particles.domains(), np.arange(len(particles.places))
    if cut:
        seen, axes = in_slab(particles, cut)
        order = np.flatnonzero(seen)
        if len(order) == 0:
            sys.exit(f"contrib/plot: no particle lies at {outputs.AXES[cut[0]]}={cut[1]:g}.")
        return particles.domains(axes)[order], order
    u, v, nearness = project(particles.places, up)
    order = np.argsort(nearness)
    sides = 1.2 * particles.side()[order]  # so that no gap is left between those of the surface
    return outputs.parallelograms(np.stack([u, v], axis=1)[order], np.eye(2) * sides[:, None, None]), order


def draw_particles(axis, particles, arguments, limits, window):
    corners, order = polygons(particles, arguments.cut, arguments.up)
    values = particles.field(arguments.field)[order]
    drawn = PolyCollection(corners, array=values, cmap=arguments.colours, edgecolors="face", linewidths=0.4,
                           rasterized=len(order) > 20000)
    drawn.set_clim(*limits)
    axis.add_collection(drawn)
    axis.set_xlim(window[0], window[1])
    axis.set_ylim(window[2], window[3])
    axis.set_aspect("equal")
    name = f"{particles.directory.name}, " if len(arguments.directories) > 1 else ""
    axis.set_title(f"{name}t = {particles.time:.4g}", fontsize=10)
    return drawn


def common_limits(states, arguments):
    if arguments.range:
        return arguments.range
    values = np.concatenate([state.field(arguments.field) for state in states])
    values = values[np.isfinite(values)]
    low, high = np.percentile(values, (0.5, 99.5)) if len(values) else (0, 1)
    return (low, high) if high > low else (low - 0.5, low + 0.5)


def common_window(states, cut, up):
    corners = np.concatenate([polygons(state, cut, up)[0].reshape(-1, 2) for state in states])
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 0.03 * max(high - low)
    return low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin


def plot_particles(arguments, target):
    found = [entry for directory in arguments.directories for entry in chosen(directory, arguments.time)]
    is_film = target.suffix in (".gif", ".mp4")
    if len(found) > arguments.panels and not is_film:
        print(f"{arguments.panels} of {len(found)} outputs, evenly chosen; an animation (--output plot.gif) shows all.")
        found = [found[k] for k in np.linspace(0, len(found) - 1, arguments.panels).round().astype(int)]
    states = [outputs.Particles(path, time) for time, path in found]
    limits, window = common_limits(states, arguments), common_window(states, arguments.cut, arguments.up)
    aspect = (window[3] - window[2]) / (window[1] - window[0])
    if is_film:
        return animate(states, arguments, limits, window, target)
    n = len(states)
    columns = min(n, 4 if aspect > 0.8 else 3 if aspect > 0.4 else 2)
    rows = -(-n // columns)
    width = 9. / columns
    height = min(8., (1 if columns == 1 else 0.8) * width * aspect + 0.5)
    figure, axes = plt.subplots(rows, columns, figsize=(9.8, rows * height), squeeze=False, layout="constrained", sharex=True,
                                sharey=True)
    for axis, state in zip(axes.flat, states):
        drawn = draw_particles(axis, state, arguments, limits, window)
    for axis in axes.flat[n:]:
        axis.set_axis_off()
    figure.colorbar(drawn, ax=axes, label=arguments.field, shrink=0.8, aspect=25)
    figure.savefig(target, dpi=arguments.dpi)


def animate(states, arguments, limits, window, target):
    import matplotlib.animation as animation
    if target.suffix == ".mp4" and not shutil.which("ffmpeg"):
        sys.exit("contrib/plot: an .mp4 needs ffmpeg (apt-get install ffmpeg); a .gif does not.")
    aspect = (window[3] - window[2]) / (window[1] - window[0])
    figure, axis = plt.subplots(figsize=(8, min(9., 7 * aspect + 0.8)), layout="constrained")
    figure.colorbar(draw_particles(axis, states[0], arguments, limits, window), ax=axis, label=arguments.field, shrink=0.8)

    def frame(k):
        for old in list(axis.collections):
            old.remove()
        return [draw_particles(axis, states[k], arguments, limits, window)]

    film = animation.FuncAnimation(figure, frame, frames=len(states))
    writer = animation.PillowWriter(fps=FRAMES_PER_SECOND) if target.suffix == ".gif" else animation.FFMpegWriter(
        fps=FRAMES_PER_SECOND)
    film.save(target, writer=writer, dpi=min(arguments.dpi, 110))


def plot_columns(arguments, file, names, target):
    figure, axis = plt.subplots(figsize=(8, 4.5), layout="constrained")
    found_units = []
    for directory in arguments.directories:
        columns, units = outputs.table(directory, file)
        for name in names.split(","):
            values = outputs.column(columns, name, f"{directory}/{file}")
            label = name.strip() if len(arguments.directories) == 1 else f"{pathlib.Path(directory).name}: {name.strip()}"
            axis.plot(outputs.column(columns, arguments.over, f"{directory}/{file}"), values, label=label)
            found_units.append(units[name.strip().replace("_", " ")])
    axis.set_xlabel(f"{arguments.over} [{units[arguments.over.strip().replace('_', ' ')]}]")
    axis.set_ylabel(", ".join(f"[{unit}]" for unit in dict.fromkeys(found_units)))
    axis.legend()
    axis.grid(alpha=0.3)
    figure.savefig(target, dpi=arguments.dpi)


def plot_convergence(arguments, target):
    """The last value of a column of statistics.csv over the grid's spacing, one run a directory, with the order between them."""
    figure, axis = plt.subplots(figsize=(5.5, 4.5), layout="constrained")
    name = arguments.convergence
    points = sorted((outputs.spacing(directory),
                     abs(outputs.column(outputs.table(directory, "statistics.csv")[0], name, f"{directory}/statistics.csv")[-1]))
                    for directory in arguments.directories)
    h, error = np.array(points).T
    axis.loglog(h, error, "o-")
    for k in range(len(h) - 1):
        order = np.log(error[k + 1] / error[k]) / np.log(h[k + 1] / h[k])
        print(f"h = {h[k + 1]:g} to {h[k]:g}: {error[k + 1]:.4g} to {error[k]:.4g}, order {order:.2f}")
        axis.annotate(f"{order:.2f}", (np.sqrt(h[k] * h[k + 1]), np.sqrt(error[k] * error[k + 1])), xytext=(4, -12),
                      textcoords="offset points")
    axis.set_xlabel("spacing of the grid [length]")
    axis.set_ylabel(name)
    axis.grid(alpha=0.3, which="both")
    figure.savefig(target, dpi=arguments.dpi)


def plane(text):
    """Axis and value of `z=0.5`."""
    axis, _, value = text.partition("=")
    return outputs.AXES.index(axis.strip()), float(value)


def interval(text):
    low, high = (float(value) for value in text.split(","))
    return low, high


def parse_arguments():
    parser = argparse.ArgumentParser(prog="contrib/plot", description=__doc__)
    parser.add_argument("directories", nargs="+", metavar="DIRECTORY", help="where a run has written its output")
    parser.add_argument("--field", default="von Mises stress", help="of the particles: a scalar, velocity_x, or a vector's "
                        "length (%(default)s)")
    parser.add_argument("--time", default="last", help="the output nearest to this time, last, or all (%(default)s)")
    parser.add_argument("--panels", type=int, default=12, help="at most so many outputs beside each other (%(default)s)")
    parser.add_argument("--cut", type=plane, help="in 3D, only what lies in a plane: z=0.5")
    parser.add_argument("--up", choices=("y", "z"), default="z", help="in 3D, the axis that points up (%(default)s)")
    parser.add_argument("--range", type=interval, help="of the colours: 0,1e5")
    parser.add_argument("--colours", default="viridis", choices=sorted(matplotlib.colormaps), metavar="MAP", help="a colour map of matplotlib (%(default)s)")
    parser.add_argument("--statistics", metavar="COLUMNS", help="columns of statistics.csv over time, with commas")
    parser.add_argument("--probes", metavar="COLUMNS", help="columns of probes.csv over time, with commas")
    parser.add_argument("--element", metavar="COLUMNS", help="columns of element.csv over time, with commas")
    parser.add_argument("--over", default="time", metavar="COLUMN", help="with --statistics, --probes or --element, the column "
                        "across (%(default)s)")
    parser.add_argument("--convergence", metavar="COLUMN", help="last value of this column of statistics.csv over the spacing of "
                        "each directory's grid")
    parser.add_argument("--output", help="what to write: .png, .pdf, .svg; with --time all also .gif, .mp4 (plot.png)")
    parser.add_argument("--dpi", type=int, default=150, help="points per inch (%(default)s)")
    arguments = parser.parse_args()
    if arguments.panels < 1:
        parser.error("--panels must be positive.")
    arguments.output = pathlib.Path(arguments.output or "plot.png")
    if arguments.output.suffix in (".gif", ".mp4") and (arguments.time != "all" or len(arguments.directories) > 1):
        parser.error("an animation takes one directory and --time all.")
    if arguments.time not in ("last", "all"):
        try:
            float(arguments.time)
        except ValueError:
            parser.error(f"--time wants a number, last or all, not '{arguments.time}'.")
    return arguments


def main():
    arguments = parse_arguments()
    target = arguments.output
    if arguments.statistics:
        plot_columns(arguments, "statistics.csv", arguments.statistics, target)
    elif arguments.probes:
        plot_columns(arguments, "probes.csv", arguments.probes, target)
    elif arguments.element:
        plot_columns(arguments, "element.csv", arguments.element, target)
    elif arguments.convergence:
        plot_convergence(arguments, target)
    else:
        plot_particles(arguments, target)
    print(target)


if __name__ == "__main__":
    main()
