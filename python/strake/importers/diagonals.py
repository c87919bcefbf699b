# SPDX-License-Identifier: Apache-2.0
"""Which triangles a flat face is made of, where several triangulations have its corners (decision 0123).

Which one a kernel makes may depend on where in memory it keeps things, so that it differs from run to run. Here each face gets
Delaunay's: no corner lies in the circle through a triangle, as far as the outline allows. Where more than three corners lie on
one circle, as those of a round end do, the triangles meet in the first of them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.int64]
Corners = NDArray[np.float64]

# What lies in one plane, or on one circle, lies off it by as much once corners are rounded, in millimetres.
_ROUNDED_MM = 4 / 4096
# A round flips all pairs of triangles that have none in common. Where that comes to no end, and in faces of more triangles, the
# kernel's stay.
_MAX_ROUNDS = 200
_MAX_TRIANGLES = 5000


class _Pairs(NamedTuple):
    """Triangles that have an edge from a to b in common, and their other corners c and d: the first is a, b, c."""

    first: Numbers
    second: Numbers
    a: Numbers
    b: Numbers
    c: Numbers
    d: Numbers

    def some(self, chosen: NDArray[np.bool_] | Numbers) -> _Pairs:
        return _Pairs(*(of[chosen] for of in (self.first, self.second, self.a, self.b, self.c, self.d)))


def settled(vertices: Corners, triangles: NDArray[np.uint32], ends: Numbers | None = None) -> NDArray[np.uint32]:
    """Returns the triangles, the same whichever triangulation of its flat faces they were. Vertices are in millimetres.

    Triangles that are alone in their plane stay what and where they are. The others have the rows of their face, in the order of
    their corners. `ends` may say where the triangles of one mesh end and those of the next begin, which have no corner in common.
    """
    result = _settled(vertices, triangles)
    if result is not None:
        return result
    if ends is None or len(ends) == 1:
        return triangles
    # One of them comes to no end.
    return np.concatenate([settled(vertices, some) for some in np.split(triangles, ends[:-1])])


def _settled(vertices: Corners, triangles: NDArray[np.uint32]) -> NDArray[np.uint32] | None:
    """The same; nothing where it comes to no end."""
    pairs = _flat_pairs(vertices, triangles.astype(np.int64))
    if not len(pairs.first):
        return triangles
    face = _joined(pairs, len(triangles))
    size = np.bincount(face, minlength=len(face))[face]
    rows = np.flatnonzero((size > 1) & (size <= _MAX_TRIANGLES))
    work, face = triangles[rows].astype(np.int64), face[rows]
    pending = np.arange(len(rows))
    for _ in range(_MAX_ROUNDS):
        some = work[pending]
        wrong, _ = _judged(vertices, _flat_pairs(vertices, some, face[pending]))
        if not len(wrong.first):
            break
        _flip(some, wrong)
        work[pending] = some
        pending = np.flatnonzero(np.isin(face, face[pending[wrong.first]]))
    else:
        return None
    rank = np.empty(len(vertices), dtype=np.int64)
    rank[np.lexsort(vertices.T[::-1])] = np.arange(len(vertices))
    _, circles = _judged(vertices, _flat_pairs(vertices, work, face))
    result: NDArray[np.uint32] = triangles.copy()
    result[rows] = _in_order(_fans(work, circles, rank), face, rank)
    return result


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


def _flat_pairs(vertices: Corners, triangles: Numbers, face: Numbers | None = None) -> _Pairs:
    """Returns the pairs that lie in a plane, where `face` says of which each is, those of one face."""
    pairs = _pairs_of(triangles, len(vertices))
    if face is not None:
        pairs = pairs.some(face[pairs.first] == face[pairs.second])
    a, b, c, d = (vertices[of] for of in (pairs.a, pairs.b, pairs.c, pairs.d))
    normal, turned = crossed(b - a, c - a), crossed(d - a, b - a)
    # So far both diagonals are apart, which is how far another one moves the face.
    across = normal + turned
    return pairs.some((np.abs(_dot(across, c - a)) <= _ROUNDED_MM * _length(across)) & (_dot(normal, turned) > 0))


def _judged(vertices: Corners, pairs: _Pairs) -> tuple[_Pairs, _Pairs]:
    """Returns the pairs that are to have the other diagonal, and those whose four corners lie on a circle."""
    a, b, c, d = (vertices[of] for of in (pairs.a, pairs.b, pairs.c, pairs.d))
    normal, turned = crossed(b - a, c - a), crossed(d - a, b - a)
    across = normal + turned
    size = np.sqrt(np.max([_dot(v, v) for v in (b - a, d - c, c - a, d - a, c - b, d - b)], axis=0, initial=0))
    off = _ROUNDED_MM * size
    # With the other diagonal both are to face the same way, and to be more than lines.
    least = off * _length(across)
    convex = (_dot(crossed(d - a, c - a), across) > least) & (_dot(crossed(c - b, d - b), across) > least)
    # Together the angles at c and d are half a turn where all four lie on a circle, and more where each lies in that of the others.
    sine = _length(normal) * _dot(d - a, d - b) + _length(turned) * _dot(c - a, c - b)
    most = off * size * size
    return pairs.some(convex & (sine < -most)), pairs.some(convex & (np.abs(sine) <= most))


def _fans(triangles: Numbers, circles: _Pairs, rank: Numbers) -> Numbers:
    """Returns the triangles, those of each circle from the first of its corners to each side that does not have it."""
    circle = _joined(circles, len(triangles))
    sides = np.stack([triangles, triangles[:, [1, 2, 0]]], axis=2).reshape(-1, 2)
    of_side = np.repeat(circle, 3)
    within = np.zeros(len(sides), dtype=np.bool_)
    for triangle, start in ((circles.first, circles.a), (circles.second, circles.b)):
        within[3 * triangle + np.argmax(triangles[triangle] == start[:, None], axis=1)] = True
    least = np.full(len(triangles), len(rank), dtype=np.int64)
    np.minimum.at(least, of_side, rank[sides[:, 0]])
    corner = np.empty_like(rank)
    corner[rank] = np.arange(len(rank))
    first = corner[least[of_side]]
    kept = ~within & (sides[:, 0] != first) & (sides[:, 1] != first)
    fans = np.column_stack([first[kept], sides[kept]])
    result: Numbers = triangles.copy()
    # As many as there were, but for what is no outline: a circle with something within it.
    whole = np.bincount(of_side[kept], minlength=len(circle)) == np.bincount(circle, minlength=len(circle))
    rows = np.flatnonzero(whole[circle])
    made = whole[of_side[kept]]
    result[rows[np.argsort(circle[rows], kind="stable")]] = fans[made][np.argsort(of_side[kept][made], kind="stable")]
    return result


def _flip(triangles: Numbers, wrong: _Pairs) -> None:
    """Flips the pairs, of those that have a triangle in common the first."""
    numbers = np.arange(len(wrong.first))
    least = np.full(len(triangles), len(numbers), dtype=np.int64)
    np.minimum.at(least, wrong.first, numbers)
    np.minimum.at(least, wrong.second, numbers)
    now = wrong.some((least[wrong.first] == numbers) & (least[wrong.second] == numbers))
    triangles[now.first] = np.stack([now.a, now.d, now.c], axis=1)
    triangles[now.second] = np.stack([now.d, now.b, now.c], axis=1)


def _joined(pairs: _Pairs, count: int) -> Numbers:
    """Returns for each triangle the first of those that hang together with it by pairs."""
    first: Numbers = np.arange(count)
    while True:
        before = first
        least = np.minimum(first[pairs.first], first[pairs.second])
        first = first.copy()
        np.minimum.at(first, pairs.first, least)
        np.minimum.at(first, pairs.second, least)
        first = first[first]
        if np.array_equal(first, before):
            return first


def _in_order(triangles: Numbers, face: Numbers, rank: Numbers) -> Numbers:
    """Returns the triangles of each face in the order of their corners, in the rows of the face."""
    start = np.argmin(rank[triangles], axis=1)
    turned = np.take_along_axis(triangles, (start[:, None] + np.arange(3)) % 3, axis=1)
    result: Numbers = np.empty_like(triangles)
    result[np.lexsort((np.arange(len(face)), face))] = turned[np.lexsort((*rank[turned].T[::-1], face))]
    return result


def crossed(x: Corners, y: Corners) -> Corners:
    """Returns the cross products of rows, to the bit those of `np.cross`, which takes three times as long for few."""
    result = np.empty_like(x)
    for axis, (one, other) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.subtract(x[:, one] * y[:, other], x[:, other] * y[:, one], out=result[:, axis])
    return result


def _dot(x: Corners, y: Corners) -> NDArray[np.float64]:
    result: NDArray[np.float64] = np.einsum("ij,ij->i", x, y)
    return result


def _length(x: Corners) -> NDArray[np.float64]:
    result: NDArray[np.float64] = np.sqrt(_dot(x, x))
    return result
