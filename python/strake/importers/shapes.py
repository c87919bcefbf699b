# SPDX-License-Identifier: Apache-2.0
"""Shapes as the scene has them: small float32 numbers around their own middle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from strake.importers.diagonals import settled
from strake.importers.digest import blake2b

Color = tuple[float, float, float, float]
NO_COLOR: Color = (0.8, 0.8, 0.8, 1.0)

# Corners are rounded to 2^-12 mm, a quarter of the grid of the program, so that the same shape at two places of
# its frame, whose doubles differ in the last digits, is one shape.
_STEPS_PER_MM = 4096.0
# So many triangles of small shapes are looked at together. Those of large ones take their time one by one as well.
_MAX_TOGETHER = 16384


class Part(NamedTuple):
    """Triangles of one colour. Corners are in the unit of the scene, colours red, green, blue and alpha in sRGB, 0 to 1."""

    vertices: ArrayLike
    triangles: ArrayLike
    color: Color = NO_COLOR


class PreparedPart(NamedTuple):
    """A part as the file has it."""

    positions: bytes
    indices: bytes
    vertex_count: int
    index_count: int
    low: tuple[float, ...]
    high: tuple[float, ...]
    color: Color


class PreparedShape(NamedTuple):
    """A shape around its middle. Equal shapes have equal keys, wherever in their frames they were."""

    parts: tuple[PreparedPart, ...]
    middle: tuple[float, float, float]
    key: bytes
    sag_mm: float | None = None


class Shape(NamedTuple):
    """A shape of a scene: the number of its mesh, and the middle that was taken from its corners."""

    mesh: int
    middle: tuple[float, float, float]


def prepare_shape(parts: Sequence[Part], unit_mm: float = 1.0, sag_mm: float | None = None) -> PreparedShape:
    """Returns the shape that these parts are together. Needs no scene, so that workers can do it.

    `sag_mm` is how far at most the triangles lie from the surfaces that they stand for: 0 where all faces are flat, None
    where that is not known.
    Raises ValueError where a corner is not finite, a triangle has no such corner, or there is no triangle at all.
    """
    shape = prepare_shapes([(parts, sag_mm)], unit_mm)[0]
    if isinstance(shape, ValueError):
        raise shape
    return shape


def prepare_shapes(shapes: Sequence[tuple[Sequence[Part], float | None]], unit_mm: float = 1.0) -> list[PreparedShape | ValueError]:
    """Does for several shapes, each with its sag, what `prepare_shape` does for one; where that raises an error this returns it.

    Small shapes take a tenth of the time together: most of it are calls, not numbers.
    """
    result: list[PreparedShape | ValueError] = []
    group: list[_Piece] = []
    first, triangles = 0, 0
    for number, (parts, sag_mm) in enumerate(shapes):
        fault: ValueError | None = None
        if sag_mm is not None and not 0 <= sag_mm < math.inf:
            fault = ValueError(f"{sag_mm} is no distance from a surface")
        pieces = [piece for part in parts if len((piece := _Piece.of(part, number, sag_mm)).triangles)]
        fault = fault or next(filter(None, (piece.fault() for piece in pieces)), None)
        count = sum(len(piece.triangles) for piece in pieces)
        if triangles + count > _MAX_TOGETHER and group:
            result[first:] = _together(group, result[first:], first, unit_mm)
            group, first, triangles = [], number, 0
        result.append(fault or ValueError("a shape needs a triangle"))
        if fault is None:
            group += pieces
            triangles += count
    if group:
        result[first:] = _together(group, result[first:], first, unit_mm)
    return result


def used_corners(triangles: NDArray[np.integer[Any]], corner_count: int) -> tuple[NDArray[np.int64], NDArray[np.uint32]]:
    """Returns which corners triangles have, in rising order, and the triangles with the numbers that these have among them."""
    is_used = np.zeros(corner_count, dtype=bool)
    is_used[triangles] = True
    used: NDArray[np.int64] = np.flatnonzero(is_used)
    number_of: NDArray[np.uint32] = np.zeros(corner_count, dtype=np.uint32)
    number_of[used] = np.arange(len(used), dtype=np.uint32)
    return used, number_of[triangles]


def around_middle(placement: NDArray[np.float64], middle: Sequence[float]) -> NDArray[np.float64]:
    """Returns the placement of a shape whose corners count from its middle."""
    result: NDArray[np.float64] = placement.copy()
    result[:3, 3] += placement[:3, :3] @ np.asarray(middle)
    return result


class _Piece(NamedTuple):
    """A part of a shape: its corners, those that triangles have and no others, its triangles by number of corner."""

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int64]
    color: Color
    shape: int
    sag_mm: float | None

    @staticmethod
    def of(part: Part, shape: int, sag_mm: float | None) -> _Piece:
        vertices: NDArray[np.float64] = np.asarray(part.vertices, dtype=np.float64).reshape(-1, 3)
        triangles: NDArray[np.int64] = np.asarray(part.triangles).reshape(-1, 3).astype(np.int64, copy=False)
        return _Piece(vertices, triangles, part.color, shape, sag_mm)

    def fault(self) -> ValueError | None:
        if self.triangles.min() < 0 or self.triangles.max() >= len(self.vertices):
            return ValueError("a triangle has a corner that does not exist")
        if not np.isfinite(self.vertices).all() and not np.isfinite(self.vertices[self.triangles]).all():
            return ValueError("a corner is not a finite number")
        return None


def _together(
    pieces: Sequence[_Piece], before: list[PreparedShape | ValueError], first: int, unit_mm: float
) -> list[PreparedShape | ValueError]:
    """Returns the shapes of these pieces in the places of what stands there, of which the first has the number `first`."""
    steps = _STEPS_PER_MM * unit_mm
    counts = [len(piece.vertices) for piece in pieces]
    sizes = [len(piece.triangles) for piece in pieces]
    starts = np.cumsum([0, *counts])
    triangles = np.concatenate([piece.triangles for piece in pieces]) + np.repeat(starts[:-1], sizes)[:, None]
    used, numbers = used_corners(triangles, int(starts[-1]))
    corners = np.concatenate([piece.vertices for piece in pieces])[used]
    starts = np.searchsorted(used, starts)
    shapes = [piece.shape for piece in pieces]
    heads = [k for k, shape in enumerate(shapes) if not k or shape != shapes[k - 1]]
    low = np.minimum.reduceat(corners, starts[heads], axis=0)
    high = np.maximum.reduceat(corners, starts[heads], axis=0)
    half = np.round((high - low) / 2 * steps) / steps
    of_corner = np.repeat(np.arange(len(heads)), np.diff([*starts[heads].tolist(), len(corners)]))
    rounded = np.round((corners - low[of_corner]) * steps) / steps - half[of_corner]
    ends = np.cumsum(sizes)
    numbers = settled(rounded * unit_mm, numbers, ends)
    positions = rounded.astype("<f4") + np.float32(0)  # no negative zeros: equal shapes are equal bytes
    lows = np.minimum.reduceat(positions, starts[:-1], axis=0).tolist()
    highs = np.maximum.reduceat(positions, starts[:-1], axis=0).tolist()
    prepared = [
        _prepared(positions[begin:end], rows - np.uint32(begin), tuple(least), tuple(most), piece.color)
        for piece, begin, end, rows, least, most in zip(
            pieces, starts[:-1].tolist(), starts[1:].tolist(), np.split(numbers, ends[:-1]), lows, highs, strict=True
        )
    ]
    result = list(before)
    for head, following, middle in zip(heads, [*heads[1:], len(pieces)], (low + half).tolist(), strict=True):
        result[shapes[head] - first] = _shape_of(prepared[head:following], middle, pieces[head].sag_mm)
    return result


def _prepared(
    positions: NDArray[np.float32], triangles: NDArray[np.uint32], low: tuple[float, ...], high: tuple[float, ...], color: Color
) -> PreparedPart:
    # 65535 is no corner in 16 bits: it restarts strips.
    indices = triangles.astype("<u2" if len(positions) < 65536 else "<u4")
    return PreparedPart(positions.tobytes(), indices.tobytes(), len(positions), indices.size, low, high, color)


def _shape_of(parts: Sequence[PreparedPart], middle: Sequence[float], sag_mm: float | None) -> PreparedShape | ValueError:
    digest = blake2b(digest_size=16)
    if sag_mm is not None:
        digest.update(repr(float(sag_mm)).encode())
    for part in parts:
        if not all(map(math.isfinite, (*part.low, *part.high))):
            return ValueError("a shape is larger than a float32 can say")
        digest.update(repr((part.vertex_count, part.index_count, part.color)).encode())
        digest.update(part.positions)
        digest.update(part.indices)
    x, y, z = middle
    return PreparedShape(tuple(parts), (x, y, z), digest.digest(), sag_mm)
