"""
Improved moving least squares in one dimension, Tran et al. (2019), section 2.5, Figs. 4 and 5: sin x on [1, 4] from two
points a cell. Formulas of their own, beside which the program's stand in tests/transfer. Nothing is run.
"""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from convergence import order

TITLE = "improved moving least squares (1D): sin x from two points a cell, beside the interpolation of MPM"

CELLS = (20, 40, 80, 160, 320)
SPAN = 1., 4.


def runs():
    return []


def weight(z):
    """Cubic B-spline, distances in spacings."""
    a = np.abs(z)
    return np.where(a < 1, 2 / 3 - a**2 + a**3 / 2, np.where(a < 2, (2 - a)**3 / 6, 0))


def imls(x_i, x_p, h, degree):
    """phi_ip of one node: weighted Gram-Schmidt on 1, z, z^2 with z = (x_p - x_i) / h; dependent ones are dropped."""
    z = (x_p - x_i) / h
    w = weight(z)
    phi = np.zeros_like(z)
    kept = []  # values at the points, value at the node, D
    for power in range(degree + 1):
        q, at_node = z**power, float(power == 0)
        norm = np.sum(w * q * q)
        p = q.copy()
        for other, other_at_node, D in kept:
            coefficient = np.sum(w * q * other) / D
            p -= coefficient * other
            at_node -= coefficient * other_at_node
        D = np.sum(w * p * p)
        if D > 1e-8 * norm:
            kept.append((p, at_node, D))
            phi += w * at_node * p / D
    return phi


def mls(x_i, x_p, h, degree):
    """The same by the moment matrix of monomials."""
    basis = np.vander((x_p - x_i) / h, degree + 1, increasing=True)
    w = weight((x_p - x_i) / h)
    moment = np.einsum("p,pi,pj->ij", w, basis, basis)
    return w * (basis @ np.linalg.solve(moment, np.eye(degree + 1)[0]))


def interpolation(x_i, x_p, h, degree):
    """What MPM with linear kernels does with equal masses."""
    hat = np.maximum(1 - np.abs(x_p - x_i) / h, 0)
    return hat / np.sum(hat)


METHODS = {"MPM": (interpolation, 0), "IMLS linear": (imls, 1), "IMLS quadratic": (imls, 2), "MLS quadratic": (mls, 2)}


def reconstruct(method, n):
    """Nodes and their values from n cells."""
    function, degree = METHODS[method]
    h = (SPAN[1] - SPAN[0]) / n
    nodes = SPAN[0] + h * np.arange(n + 1)
    x_p = SPAN[0] + h / 2 * (np.arange(2 * n) + 0.5)
    return nodes, np.array([function(x_i, x_p, h, degree) @ np.sin(x_p) for x_i in nodes])


def error(method, n):
    nodes, values = reconstruct(method, n)
    return math.sqrt(np.mean((values - np.sin(nodes))**2))


def table(results):
    rows = []
    for method in METHODS:
        errors = [error(method, n) for n in CELLS]
        for k, n in enumerate(CELLS):
            rows.append({"method": method, "cells": str(n), "RMS error": errors[k],
                         "order": order(errors[k - 1], errors[k]) if k else math.nan})
    return rows


def figures(results):
    mean = lambda method: order(error(method, CELLS[0]), error(method, CELLS[-1]), CELLS[-1] / CELLS[0])
    found = [report.near("IMLS linear, order", mean("IMLS linear"), 2.0, 0.1),
             report.near("IMLS quadratic, order (RMS)", mean("IMLS quadratic"), 3.5, 0.1)]
    x_p, nodes = np.array([0.3, 1.7, 2.1, 2.2, 3.6]), np.arange(5.)
    linear = max(abs(imls(x_i, x_p, 1., 1) @ (2 - 3 * x_p) - (2 - 3 * x_i)) for x_i in nodes)
    found.append(report.Figure("IMLS linear, linear field, largest error", linear, upper=1e-12))
    two = np.array([0.9, 1.5])
    difference = max(np.max(np.abs(imls(1.2, two, 1., 2) - imls(1.2, two, 1., 1))), 0)
    found.append(report.Figure("two points, quadratic less linear", difference, upper=1e-12))
    same = max(np.max(np.abs(reconstruct("IMLS quadratic", n)[1] - reconstruct("MLS quadratic", n)[1])) for n in CELLS)
    found.append(report.Figure("IMLS less MLS, largest difference", same, upper=1e-12))
    return found


def draw(results, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for method, marker in (("MPM", "s"), ("IMLS linear", "^"), ("IMLS quadratic", "o")):
        nodes, values = reconstruct(method, CELLS[0])
        left.semilogy(nodes, np.abs(values - np.sin(nodes)), marker=marker, markersize=3, linewidth=0.7, label=method)
    left.set(xlabel="x", title="error at the nodes, 20 cells")
    left.legend(fontsize=7)
    h = [(SPAN[1] - SPAN[0]) / n for n in CELLS]
    for method, style in (("MPM", "s-"), ("IMLS linear", "^-"), ("IMLS quadratic", "o-"), ("MLS quadratic", "x:")):
        right.loglog(h, [error(method, n) for n in CELLS], style, markersize=4, linewidth=1, label=method)
    right.set(xlabel="h", title="RMS error")
    right.legend(fontsize=7)
    figure.savefig(path, dpi=110)
    plt.close(figure)
