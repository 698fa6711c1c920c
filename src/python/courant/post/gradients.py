"""Derivatives of fields at particles, exact for linear fields also at surfaces and walls."""

from __future__ import annotations

import numpy as np

from .particles import spline_shape

_LEAST = 1e-2  # of the moments' eigenvalues over the largest one: with less, neighbours lie in a line or a sheet


def gradients(x: np.ndarray, V: np.ndarray, h: np.ndarray, values: np.ndarray) -> np.ndarray:
    """d values_a / d x_b at each particle; shape (n, components, dim). x: (n, dim) [L]; V: (n,) m/rho; h: (n,) [L]; values: (n, components).

    Least squares over the neighbours within 2 h: the g for which sum_j V_j W_ij |f_j - f_i - g (x_j - x_i)|^2 is least, with W the cubic spline.
    It is the renormalised derivative of SPH with W instead of -W'/r; linear fields come out to rounding, on one side of a surface too, at first
    order in h otherwise. Along directions in which a particle has no neighbours (a row of particles, a drop alone) it is 0, as nothing is known.
    Source: Randles and Libersky, Comput. Methods Appl. Mech. Eng. 139 (1996), section 3 (renormalisation); Lancaster and Salkauskas, Math.
    Comput. 37 (1981) (least squares).
    """
    from scipy.spatial import cKDTree


    n, dim = x.shape
    if n < 2:
        return np.zeros((n, values.shape[1], dim))
    a, b = cKDTree(x).query_pairs(2 * float(h.max()), output_type="ndarray").T
    i, j = np.concatenate((a, b)), np.concatenate((b, a))
    apart = x[j] - x[i]
    weight = V[j] * spline_shape(np.sqrt((apart**2).sum(axis=1)) / h[i]) / h[i] ** (dim + 2)
    rise, M, B = values[j] - values[i], np.empty((n, dim, dim)), np.empty((n, values.shape[1], dim))
    for q in range(dim):
        moment = weight * apart[:, q]
        for p in range(dim):
            M[:, p, q] = np.bincount(i, moment * apart[:, p], n)
        for c in range(values.shape[1]):
            B[:, c, q] = np.bincount(i, moment * rise[:, c], n)
    size, axes = np.linalg.eigh(M)  # in rising order
    known = size > _LEAST * size[:, -1:]
    inverse = np.where(known, 1 / np.where(known, size, 1), 0)
    return np.einsum("ncq,nqe,ne,npe->ncp", B, axes, inverse, axes)


def vorticity(x: np.ndarray, V: np.ndarray, h: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """curl v at each particle; (n,) about z where x is (n, 2), else (n, 3) [1/T]. velocity: (n, 2) or (n, 3) [L/T]; see `gradients`."""
    dim = x.shape[1]
    g = gradients(x, V, h, velocity[:, :dim])
    if dim == 2:
        return g[:, 1, 0] - g[:, 0, 1]
    return np.column_stack((g[:, 2, 1] - g[:, 1, 2], g[:, 0, 2] - g[:, 2, 0], g[:, 1, 0] - g[:, 0, 1]))


def vorticity_of_active(x: np.ndarray, V: np.ndarray, h: np.ndarray, velocity: np.ndarray, active: np.ndarray) -> np.ndarray:
    """The same for all particles of a state, NaN where they are not active or have no volume; (n,) in the plane, (n, 3) in space."""
    flat = len(x) > 0 and bool((x[:, 2] == x[0, 2]).all())
    on = active & np.isfinite(V) & (V > 0) & np.isfinite(x).all(axis=1) & np.isfinite(velocity).all(axis=1)
    out = np.full(len(x) if flat else (len(x), 3), np.nan)
    out[on] = vorticity(x[on, : 2 if flat else 3], V[on], h[on], velocity[on])
    return out
