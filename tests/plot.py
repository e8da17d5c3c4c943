#!/usr/bin/env python3
"""What contrib/plot reads and draws. Usage: plot.py TALUS ROOT WORK"""
import os
import shutil
import subprocess
import sys

PRM = """\
set Dimension = {dim}
subsection Run
  set Number of steps = 20
end
subsection Grid
  set Upper corner = {upper}
  set Spacing = 0.25
end
subsection Materials
  set Names = rubber
end
subsection Bodies
  set Names = block
  subsection block
    set Lower corner = {low}
    set Upper corner = {high}
    set Velocity = {velocity}
  end
end
subsection Output
  set Step interval = 10
  set Particle fields = velocity, deformation gradient, volume, pressure
end
"""
BLOCKS = {2: dict(upper="2, 2", low="0.5, 0.5", high="1.5, 1.5", velocity="0.2*y; 0"),
          3: dict(upper="2, 2, 2", low="0.5, 0.5, 0.5", high="1.5, 1.5, 1.5", velocity="0.2*y; 0; 0.1*z")}


class Checks:
    def __init__(self):
        self.n_failed = 0

    def __call__(self, name, is_good, text=""):
        self.n_failed += not is_good
        print(f"{'  pass' if is_good else '  FAIL'} {name}{'' if is_good else ': ' + text}")


def run(command, cwd):
    found = subprocess.run(command, cwd=cwd, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           env={**os.environ, "OMP_NUM_THREADS": "1"})
    return found.returncode, found.stdout


def areas_of_domains(check, outputs, np, directory):
    """A parallelogram has the area of its particle, and the fields are those of the file."""
    time, path = outputs.series(directory)[-1]
    particles = outputs.Particles(path, time)
    corners = particles.domains()
    x, y = corners[..., 0], corners[..., 1]
    area = 0.5 * np.abs(np.sum(x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y, axis=1))
    error = np.max(np.abs(area / particles.fields["volume"] - 1))
    check("areas of domains: 2 x 6e-8 of single precision", error < 1e-5, f"{error:.1e}")
    F = {ab: particles.fields["deformation_gradient_" + ab] for ab in ("xx", "xy", "yx", "yy")}
    side = np.sqrt(particles.fields["volume"] / (F["xx"] * F["yy"] - F["xy"] * F["yx"]))
    up = np.stack([side * F["xy"], side * F["yy"]], axis=1)  # what was the edge along y; the block has sheared by 1e-3
    error = np.max(np.abs(corners[:, 3] - corners[:, 0] - up))
    check("edges have followed F", error < 1e-6 * np.max(side), f"{error:.1e}")
    error = np.max(np.abs(corners.mean(axis=1) - particles.places[:, :2]))
    check("domains lie around their particles", error < 1e-14, f"{error:.1e}")
    speed = np.hypot(particles.field("velocity_x"), particles.field("velocity_y"))
    check("a vector's length", np.allclose(speed, particles.field("velocity"), rtol=1e-6))
    times = [time for time, _ in outputs.series(directory)]
    check("three outputs, in their order", len(times) == 3 and times == sorted(times))


def draw(check, command, work):
    """Every kind of picture is written; what is not there is named, with exit status 1."""
    for name, arguments in (("last.png", ["two", "--field", "pressure"]), ("all.pdf", ["two", "--time", "all"]),
                            ("film.gif", ["two", "--time", "all", "--field", "velocity_x"]),
                            ("three.png", ["three", "--field", "pressure"]),
                            ("cut.png", ["three", "--field", "pressure", "--cut", "z=0.9375"]),
                            ("statistics.svg", ["two", "three", "--statistics", "kinetic energy, strain energy"]),
                            ("over.svg", ["two", "--statistics", "kinetic energy", "--over", "strain energy"]),
                            ("element.svg", ["point", "--element", "q, p", "--over", "strain zz"])):
        status, text = run(command + arguments + ["--field", "pressure"] * (name == "all.pdf") + ["--output", name], work)
        check(name, status == 0 and os.path.getsize(os.path.join(work, name)) > 3000, text)
    for words, arguments in (("no field 'nope'. They have:", ["two", "--field", "nope"]), ("no 'nowhere", ["nowhere"]),
                             ("no column 'nope'. It has: time", ["two", "--statistics", "nope"]),
                             ("no column 'nope'. It has: time", ["point", "--element", "q", "--over", "nope"]),
                             ("no particle lies at z=0.1", ["three", "--field", "pressure", "--cut", "z=0.1"]),
                             ("invalid plane value: 'w=1'", ["three", "--cut", "w=1"]),
                             ("invalid interval value: '1'", ["two", "--range", "1"]),
                             ("takes one directory and --time all", ["two", "--output", "film.gif"])):
        status, text = run(command + arguments, work)
        check(words, status != 0 and words in text and "Traceback" not in text, text)


def orders(check, command, work):
    """Errors of 3 h^2 have the order 2."""
    for k, h in enumerate((0.4, 0.2, 0.1)):
        directory = os.path.join(work, f"h{k}")
        os.makedirs(directory)
        with open(os.path.join(directory, "parameters.prm"), "w") as file:
            file.write(f"subsection Grid\n  set Cells = \n  set Spacing = {h}\nend\n")
        with open(os.path.join(directory, "statistics.csv"), "w") as file:
            file.write(f"time [time],error of u [length]\n0,1\n1,{3 * h * h!r}\n")
    status, text = run(command + ["h0", "h1", "h2", "--convergence", "error of u", "--output", "orders.png"], work)
    check("order 2 of 3 h^2", status == 0 and text.count("order 2.00") == 2, text)


def need_numpy():
    """The interpreter that CMake has found may be one without the packages that contrib/ uses; Debian's is not."""
    try:
        import numpy  # noqa: F401
    except ModuleNotFoundError:
        if sys.executable == "/usr/bin/python3":
            raise
        os.execv("/usr/bin/python3", ["/usr/bin/python3", "-B", *sys.argv])


def main():
    need_numpy()
    talus, root, work = sys.argv[1:]
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    check = Checks()
    for dim, name in ((2, "two"), (3, "three")):
        with open(os.path.join(work, f"{name}.prm"), "w") as file:
            file.write(PRM.format(dim=dim, **BLOCKS[dim]))
        status, text = run([talus, f"{name}.prm", "--set", f"Output/Directory = {name}"], work)
        if status:
            sys.exit(f"FAIL {name}.prm: exit status {status}\n{text}")
    status, text = run([talus, "--element", os.path.join(root, "prm", "element", "triaxial.prm"), "--set",
                        "Output/Directory = point"], work)
    if status:
        sys.exit(f"FAIL --element: exit status {status}\n{text}")
    sys.dont_write_bytecode = True
    sys.path.insert(0, os.path.join(root, "contrib", "lib"))
    import numpy as np
    import outputs
    areas_of_domains(check, outputs, np, os.path.join(work, "two"))
    command = [sys.executable, "-B", os.path.join(root, "contrib", "lib", "plot.py")]
    draw(check, command, work)
    orders(check, command, work)
    sys.exit(1 if check.n_failed else 0)


if __name__ == "__main__":
    main()
