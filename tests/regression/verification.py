#!/usr/bin/env python3
"""Manufactured solutions: errors and observed orders of CPLS and CPDI at the end of the run.

Usage: verification.py TALUS WORK_DIRECTORY CASE RANKS [MPIRUN ...]

The bounds of the orders are those of contrib/reproduce vibration and ring. CPDI has lost its order there; that it has
not been lost by a slip of ours is seen in its small motion, in which it agrees with CPLS.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import program

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FIELDS = {"U": "error u", "V": "error v", "S": "error stress"}


def errors(runs, prm, name, *settings):
    """Errors at the end of a run."""
    columns = program.columns_of(os.path.join(runs.run(prm, name, *settings), "verification.csv"))
    return {field: columns[column][-1] for field, column in FIELDS.items()}


def check_orders(runs, name, levels, bounds):
    """The mean order over levels that halve the spacing: its shortfall to 2 over what it may lack."""
    for field, bound in bounds.items():
        order = math.log2(levels[0][field] / levels[-1][field]) / (len(levels) - 1)
        runs.check(f"{name}, order of {field} = {order:.3f}", max(2 - order, 0), 2 - bound)


def case_vibration(runs):
    def bar(n, transfer, amplitude):
        h = 1 / n
        return errors(runs, "vibration.prm", f"{transfer}.{amplitude}.{n}", f"Transfer/Type = {transfer}",
                      f"Verification/Amplitude = {amplitude}", "Verification/Directions = x", f"Grid/Spacing = {h}",
                      f"Grid/Lower corner = {-2 * h}, {-2 * h}", f"Grid/Upper corner = {1 + 2 * h}, {3 * h}",
                      f"Bodies/square/Upper corner = 1, {h}", f"Run/Step size = {0.004 * h}",
                      f"Conditions/walls/Half spaces = x <= 0, x >= 1, y >= {-2 * h}")

    # On coarser grids U and S, which pass through zero at the end, fall faster and then slower than they should.
    check_orders(runs, "CPLS, A = .1", [bar(n, "CPLS", 0.1) for n in (128, 256, 512)], dict.fromkeys("UVS", 1.9))
    small = {transfer: [bar(n, transfer, 1e-4) for n in (64, 128, 256)] for transfer in ("CPLS", "FLIP")}
    for transfer, name in (("CPLS", "CPLS"), ("FLIP", "CPDI")):
        check_orders(runs, f"{name}, A = 1e-4", small[transfer], dict.fromkeys("UVS", 1.9))


def case_ring(runs):
    def ring(n):
        h = 1 / n
        return errors(runs, "ring.prm", str(n), f"Grid/Spacing = {h}", f"Grid/Lower corner = {-2 * h}, {-2 * h}",
                      f"Bodies/quarter/Particles = {round(0.4 * n)}, {round(1.6 * n)}", f"Run/Step size = {0.004 * h}")

    check_orders(runs, "CPLS, A = .1", [ring(n) for n in (10, 20, 40)], {"U": 1.9, "S": 1.8})


if __name__ == "__main__":
    sys.exit(program.main(globals(), os.path.join(ROOT, "prm")))
