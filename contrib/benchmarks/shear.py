"""Simple shear of an elastic block, Nakamura et al. (2023), section 5.1, against finite elements."""
import math

import maps
import numpy as np
import report
from runs import Run

TITLE = "simple shear of an elastic block (2D): five transfers, corrected and not, against finite elements"

TRANSFERS = ["FLIP", "PIC", "APIC", "TPIC"]
TREATMENTS = ["Steffen", "WLS"]
# The grid ends at the plates; its margins at the free sides are an odd number of half cells, at least .5 wide.
GRIDS = {"1/20": (0.05, 0.525), "1/40": (0.025, 0.5125)}
# Courant number 1, but FLIP's free edges diverge at that with h = 1/40.
COURANT = {"FLIP": 0.8}

# Acceptance, stress errors in percent: near the plates by spacing, and the same for all spacings.
CORRECTED_RMS = {"1/20": 1.3, "1/40": 0.7}
MLS_MPM_RMS = {"1/20": 2.2, "1/40": 1.2}
CORRECTED_MAX, CORE_RMS, ANY_PARTICLE, UNCORRECTED_RMS = 3, 0.3, 60, (17, 23)
FORCE_DEVIATION = 0.6
ROWS = {"WLS": (1.006, 0.987, 1.002, 1.007), "Steffen": (0.678, 1.214, 1.008, 0.946)}


def settings(h, transfer, treatment):
    spacing, margin = GRIDS[h]
    return {
        "Grid/Spacing": spacing,
        "Grid/Lower corner": f"{-margin}, 0",
        "Grid/Upper corner": f"{1 + margin}, 1",
        "Run/Courant number": COURANT.get(transfer, 1),
        "Transfer/Type": transfer,
        "Kernel/Boundary treatment": treatment,
        "FEM reference/Regions/plate/Where":
            f"(y < {2 * spacing} || y > {1 - 2 * spacing}) && x > 0.25 && x < 0.75",
    }


def runs(spacings=tuple(GRIDS)):
    schemes = [(transfer, treatment) for treatment in TREATMENTS for transfer in TRANSFERS]
    return [Run("prm/shear.prm", settings(h, transfer, treatment),
                {"h": h, "transfer": transfer, "treatment": treatment})
            for h in spacings for transfer, treatment in schemes + [("TPIC", "WLS everywhere")]]


def scheme(result):
    """Its name in the paper."""
    label = result.run.label
    return "MLS-MPM" if label["treatment"] == "WLS everywhere" else label["transfer"]


def force_deviation(result, plate):
    """Mean force on a plate over that of the finite elements, minus one, in percent."""
    return 100 * (result.value("force x", plate) / result.value("reference force x", plate) - 1)


def table(results):
    return [{**result.run.label, "scheme": scheme(result),
             "plate rms %": result.value("stress error rms", "plate"),
             "plate max %": result.value("stress error max", "plate"),
             "core rms %": result.value("stress error rms", "core"),
             "any max %": result.value("stress error max", "all"),
             "force top": result.value("force x", "top"),
             "FEM force top": result.value("reference force x", "top"),
             "top %": force_deviation(result, "top"),
             "bottom %": force_deviation(result, "bottom")} for result in results]


def row_profile(result, n_rows=4):
    """Mean sigma_xy over its reference in the particle rows above the bottom plate, .35 < x < .65."""
    if result.status != 0:
        return [math.nan] * n_rows
    particles = result.particles()
    x, y = np.round(maps.initial_positions(particles), 9).T
    is_middle = (x > 0.35) & (x < 0.65)
    ratios = particles["mean_stress_xy"] / particles["reference_stress_xy"]
    return [np.mean(ratios[is_middle & (y == row)]) for row in np.unique(y)[:n_rows]]


def scheme_figures(result):
    h, transfer, treatment = result.run.label.values()
    rms = result.value("stress error rms", "plate")
    name = f"h = {h}, {scheme(result)}, "
    if treatment == "WLS everywhere":
        return [report.Figure(name + "plate rms", rms, upper=MLS_MPM_RMS[h], unit="%")]
    if treatment == "Steffen":
        return [report.Figure(name + "uncorrected, plate rms", rms, *UNCORRECTED_RMS, unit="%")]
    force = max((force_deviation(result, plate) for plate in ("top", "bottom")), key=abs)
    return [report.Figure(name + "corrected, plate rms", rms, upper=CORRECTED_RMS[h], unit="%"),
            report.Figure(name + "corrected, plate max", result.value("stress error max", "plate"),
                          upper=CORRECTED_MAX, unit="%"),
            report.Figure(name + "corrected, core rms", result.value("stress error rms", "core"),
                          upper=CORE_RMS, unit="%"),
            report.Figure(name + "corrected, every particle", result.value("stress error max", "all"),
                          upper=ANY_PARTICLE, unit="%"),
            report.near(name + "corrected, mean force over FEM - 1", force, 0, FORCE_DEVIATION, "%")]


def figures(results):
    anchor = next((abs(result.value("reference force x", "bottom")) for result in results if result.status == 0),
                  math.nan)
    list_of_figures = [report.near("FEM, 80 x 80 Q2, |Fx|/L", anchor, 25914, 0.0005 * 25914, "N/m")]
    for result in results:
        list_of_figures += scheme_figures(result)
    for result in results:
        h, transfer, treatment = result.run.label.values()
        if h == "1/20" and transfer == "TPIC" and treatment in ROWS:
            for i, (value, expected) in enumerate(zip(row_profile(result), ROWS[treatment])):
                list_of_figures.append(report.near(f"h = {h}, TPIC, {treatment}, sigma_xy in row {i + 1} over FEM",
                                                   value, expected, 0.015))
    return list_of_figures


def panels(results, field):
    """The maps of some runs; the field is a function of a run's particles."""
    pictures = []
    for result in results:
        particles = result.particles() if result.status == 0 else None
        pictures.append((scheme(result), None if particles is None else maps.image(particles, field(particles))))
    return pictures


def stress(particles):
    return maps.von_mises(maps.components(particles, "mean_stress")) / 1e3


def reference(particles):
    return maps.von_mises(maps.components(particles, "reference_stress")) / 1e3


def error(particles):
    return particles["stress_error"]


def draw(results, path):
    h = results[0].run.label["h"]
    here = [result for result in results if result.run.label["h"] == h]
    uncorrected = [result for result in here if result.run.label["treatment"] == "Steffen"]
    corrected = [result for result in here if result.run.label["treatment"] != "Steffen"]
    sound = next((result for result in here if result.status == 0), None)
    if sound is None:
        return
    particles = sound.particles()
    fem = maps.image(particles, reference(particles))
    stresses, errors = (0, 1.6 * np.median(fem), "viridis"), (0, 30, "magma")
    named = lambda word, pictures: [(f"{name}, {word}" if name != "MLS-MPM" else name, p) for name, p in pictures]
    maps.draw(path, [
        ("von Mises [kPa]", stresses, named("uncorrected", panels(uncorrected, stress)) + [("FEM", fem)]),
        ("von Mises [kPa]", stresses, named("WLS", panels(corrected, stress))),
        ("stress error [%]", errors, named("uncorrected", panels(uncorrected, error))),
        ("stress error [%]", errors, named("WLS", panels(corrected, error)))],
        f"Simple shear, h = {h}: mean stress of the material points, and its error against finite elements")
