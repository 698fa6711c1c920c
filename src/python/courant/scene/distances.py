"""Distances of points from surfaces of triangles, and from lines in the plane."""
from __future__ import annotations

import numpy as np

from .shapes import Shape

_MOST_PAIRS = 1_000_000  # of a point and a face at once


def distances(shape: Shape, x: np.ndarray, within: float) -> np.ndarray:
    """Of points (n, 3) from the surface of a shape; infinity where it is farther than `within` [L]. Shape (n,)."""
    out = np.full(len(x), np.inf)
    if not len(x) or not len(shape.faces):
        return out
    dim = shape.dim
    corners = shape.points[shape.faces][:, :, :dim]
    low, high = corners.min(axis=1) - within, corners.max(axis=1) + within
    order = np.argsort(x[:, 0], kind="stable")
    begin, end = np.searchsorted(x[order, 0], low[:, 0]), np.searchsorted(x[order, 0], high[:, 0], side="right")
    count = np.maximum(end - begin, 0)
    ends = np.cumsum(count)
    first = 0
    while first < len(count):
        done = int(ends[first] - count[first])
        last = max(first + 1, int(np.searchsorted(ends, done + _MOST_PAIRS, side="right")))
        some = count[first:last]
        face = np.repeat(np.arange(first, last), some)
        point = order[np.arange(some.sum()) - np.repeat(ends[first:last] - some - done, some) + begin[face]]
        near = np.all((x[point, 1:dim] >= low[face, 1:]) & (x[point, 1:dim] <= high[face, 1:]), axis=1)
        face, point = face[near], point[near]
        np.minimum.at(out, point, _from_faces(corners[face], x[point, :dim]))
        first = last
    out[out > within] = np.inf
    return out


def _from_faces(corners: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Of each point (k, dim) from the face with these corners (k, dim, dim)."""
    sides = range(corners.shape[1] if corners.shape[1] == 3 else 1)
    out: np.ndarray = np.min([_from_lines(corners[:, k], corners[:, (k + 1) % corners.shape[1]], x) for k in sides], axis=0)
    if corners.shape[1] == 2:
        return out
    a = corners[:, 0]
    normal = np.cross(corners[:, 1] - a, corners[:, 2] - a)
    size = np.linalg.norm(normal, axis=1)
    normal /= np.maximum(size, 1e-300)[:, None]
    inside = size > 0  # a triangle may be a line
    for k in sides:
        edge = corners[:, (k + 1) % 3] - corners[:, k]
        inside &= np.einsum("ij,ij->i", np.cross(edge, x - corners[:, k]), normal) >= 0
    return np.where(inside, np.abs(np.einsum("ij,ij->i", x - a, normal)), out)


def _from_lines(a: np.ndarray, b: np.ndarray, x: np.ndarray) -> np.ndarray:
    along = b - a
    part = np.einsum("ij,ij->i", x - a, along) / np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
    out: np.ndarray = np.linalg.norm(x - a - np.clip(part, 0, 1)[:, None] * along, axis=1)
    return out
