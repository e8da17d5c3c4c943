"""Simple shear of an elastic cube: the benchmark `shear` with a third direction, against 3D finite elements."""
import maps
import report
import shear
from runs import Run

TITLE = "simple shear of an elastic cube (3D), corrected and not, against finite elements"

# The error near the plates without correction over that with it, at least; in 2D it is 10 at this spacing.
GAIN = 5


def runs():
    return [Run("prm/shear_3d.prm", {"Kernel/Boundary treatment": treatment},
                {"h": "1/10", "transfer": "TPIC", "treatment": treatment}) for treatment in shear.TREATMENTS]


table = shear.table


def figures(results):
    uncorrected, corrected = (result.value("stress error rms", "plate") for result in results)
    return [report.Figure("h = 1/10, TPIC, plate rms, uncorrected over corrected", uncorrected / corrected, lower=GAIN)]


def draw(results, path):
    if any(result.status != 0 for result in results):
        return
    particles = results[0].particles()
    fem = maps.image(particles, shear.reference(particles))
    names = ["TPIC, uncorrected", "TPIC, WLS"]
    stresses, errors = (
        [(name, maps.image(result.particles(), field(result.particles()))) for name, result in zip(names, results)]
        for field in (shear.stress, shear.error))
    maps.draw(path, [("von Mises [kPa]", (0, 80, "viridis"), stresses + [("FEM", fem)]),
                     ("stress error [%]", (0, 30, "magma"), errors)], "Shear of a cube, h = 1/10, middle layer")
