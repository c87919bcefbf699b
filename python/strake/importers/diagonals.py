# SPDX-License-Identifier: Apache-2.0
"""Which triangles a flat face is made of, where several triangulations have its corners (decision 0123).

Which one a kernel makes may depend on where in memory it keeps things, so that it differs from run to run. Here each face gets
Delaunay's: no corner lies in the circle through a triangle, as far as the outline allows. Where more than three corners lie on
one circle, as those of a round end do, the triangles meet in the first of them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.int64]
Corners = NDArray[np.float64]

# What lies in one plane, or on one circle, lies off it by as much once corners are rounded, in millimetres.
_ROUNDED_MM = 4 / 4096
# A round flips all pairs of triangles that have none in common. Where that comes to no end nothing is changed.
_MOST_ROUNDS = 1000


@dataclass(frozen=True)
class _Pairs:
    """Triangles that have an edge from a to b in common, and their other corners c and d: the first is a, b, c."""

    first: Numbers
    second: Numbers
    a: Numbers
    b: Numbers
    c: Numbers
    d: Numbers

    def some(self, chosen: NDArray[np.bool_] | Numbers) -> _Pairs:
        return _Pairs(*(of[chosen] for of in (self.first, self.second, self.a, self.b, self.c, self.d)))


def settled(vertices: Corners, triangles: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Returns the triangles, the same whichever triangulation of its flat faces they were. Vertices are in millimetres.

    Triangles that are alone in their plane stay what and where they are. The others have the rows of their face, in the order of
    their corners.
    """
    work = triangles.astype(np.int64)
    pairs, _ = _in_planes(vertices, work, None)
    if not len(pairs.first):
        return triangles
    rank = np.empty(len(vertices), dtype=np.int64)
    rank[np.lexsort(vertices.T[::-1])] = np.arange(len(vertices))
    face = _faces(pairs, len(work))
    rows = np.unique(np.concatenate([pairs.first, pairs.second]))
    work, face = work[rows], face[rows]
    for _ in range(_MOST_ROUNDS):
        pairs, wrong = _in_planes(vertices, work, rank)
        if not wrong.any():
            result: NDArray[np.uint32] = triangles.copy()
            result[rows] = _in_order(work, face, rank)
            return result
        _flip(work, pairs.some(wrong))
    return triangles


def _pairs_of(triangles: Numbers, vertices: int) -> _Pairs:
    """Returns the pairs of triangles that are alone at an edge, and run along it in opposite ways."""
    start, end = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
    across = triangles[:, [2, 0, 1]].ravel()
    key = np.minimum(start, end) * vertices + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    same = np.concatenate([[False], key[order][1:] == key[order][:-1], [False]])
    alone = np.flatnonzero(same[1:-1] & ~same[:-2] & ~same[2:])
    one, other = order[alone], order[alone + 1]
    opposite = start[one] == end[other]
    one, other = one[opposite], other[opposite]
    return _Pairs(one // 3, other // 3, start[one], end[one], across[one], across[other])


def _in_planes(vertices: Corners, triangles: Numbers, rank: Numbers | None) -> tuple[_Pairs, NDArray[np.bool_]]:
    """Returns the pairs that lie in a plane, and which of them are to have the other diagonal. `rank`: that of each vertex."""
    pairs = _pairs_of(triangles, len(vertices))
    a, b, c, d = (vertices[of] for of in (pairs.a, pairs.b, pairs.c, pairs.d))
    along = b - a
    normal, turned = np.cross(along, c - a), np.cross(d - a, along)
    twice, other = _length(normal), _length(turned)
    # So far both diagonals are apart, which is how far another one moves the face.
    across = normal + turned
    flat = (np.abs(_dot(across, c - a)) <= _ROUNDED_MM * _length(across)) & (_dot(normal, turned) > 0)
    pairs = pairs.some(flat)
    if rank is None or not len(pairs.first):
        return pairs, np.zeros(len(pairs.first), dtype=np.bool_)
    a, b, c, d, across, twice, other = (of[flat] for of in (a, b, c, d, across, twice, other))
    size = np.sqrt(np.max([_dot(v, v) for v in (b - a, d - c, c - a, d - a, c - b, d - b)], axis=0))
    off = _ROUNDED_MM * size
    # With the other diagonal both are to face the same way, and to be more than lines.
    least = off * _length(across)
    convex = (_dot(np.cross(d - a, c - a), across) > least) & (_dot(np.cross(c - b, d - b), across) > least)
    # Together the angles at c and d are half a turn where all four lie on a circle, and more where each lies in that of the others.
    sine = twice * _dot(d - a, d - b) + other * _dot(c - a, c - b)
    near = np.abs(sine) <= off * size * size
    later = np.minimum(rank[pairs.c], rank[pairs.d]) < np.minimum(rank[pairs.a], rank[pairs.b])
    return pairs, convex & np.where(near, later, sine < 0)


def _flip(triangles: Numbers, wrong: _Pairs) -> None:
    """Flips the pairs, of those that have a triangle in common the first."""
    numbers = np.arange(len(wrong.first))
    least = np.full(len(triangles), len(numbers), dtype=np.int64)
    np.minimum.at(least, wrong.first, numbers)
    np.minimum.at(least, wrong.second, numbers)
    now = wrong.some((least[wrong.first] == numbers) & (least[wrong.second] == numbers))
    triangles[now.first] = np.stack([now.a, now.d, now.c], axis=1)
    triangles[now.second] = np.stack([now.d, now.b, now.c], axis=1)


def _faces(pairs: _Pairs, count: int) -> Numbers:
    """Returns for each triangle the first of those that hang together with it by pairs."""
    face: Numbers = np.arange(count)
    while True:
        before = face
        least = np.minimum(face[pairs.first], face[pairs.second])
        face = face.copy()
        np.minimum.at(face, pairs.first, least)
        np.minimum.at(face, pairs.second, least)
        face = face[face]
        if np.array_equal(face, before):
            return face


def _in_order(triangles: Numbers, face: Numbers, rank: Numbers) -> Numbers:
    """Returns the triangles of each face in the order of their corners, in the rows of the face."""
    start = np.argmin(rank[triangles], axis=1)
    turned = np.take_along_axis(triangles, (start[:, None] + np.arange(3)) % 3, axis=1)
    result: Numbers = np.empty_like(triangles)
    result[np.lexsort((np.arange(len(face)), face))] = turned[np.lexsort((*rank[turned].T[::-1], face))]
    return result


def _dot(x: Corners, y: Corners) -> NDArray[np.float64]:
    result: NDArray[np.float64] = np.einsum("ij,ij->i", x, y)
    return result


def _length(x: Corners) -> NDArray[np.float64]:
    result: NDArray[np.float64] = np.sqrt(_dot(x, x))
    return result
