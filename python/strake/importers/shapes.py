# SPDX-License-Identifier: Apache-2.0
"""Shapes as the scene has them: small float32 numbers around their own middle."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from strake.importers.diagonals import settled

Color = tuple[float, float, float, float]

# Corners are rounded to 2^-12 mm, a quarter of the grid of the program, so that the same shape at two places of
# its frame, whose doubles differ in the last digits, is one shape.
_STEPS_PER_MM = 4096.0


@dataclass(frozen=True)
class Part:
    """Triangles of one colour. Corners are in the unit of the scene, colours red, green, blue and alpha in sRGB, 0 to 1."""

    vertices: ArrayLike
    triangles: ArrayLike
    color: Color = (0.8, 0.8, 0.8, 1.0)


@dataclass(frozen=True)
class PreparedPart:
    """A part as the file has it."""

    positions: bytes
    indices: bytes
    vertex_count: int
    index_count: int
    low: tuple[float, ...]
    high: tuple[float, ...]
    color: Color


@dataclass(frozen=True)
class PreparedShape:
    """A shape around its middle. Equal shapes have equal keys, wherever in their frames they were."""

    parts: tuple[PreparedPart, ...]
    middle: tuple[float, float, float]
    key: bytes
    sag_mm: float | None = None


@dataclass(frozen=True)
class Shape:
    """A shape of a scene: the number of its mesh, and the middle that was taken from its corners."""

    mesh: int
    middle: tuple[float, float, float]


def prepare_shape(parts: Sequence[Part], unit_mm: float = 1.0, sag_mm: float | None = None) -> PreparedShape:
    """Returns the shape that these parts are together. Needs no scene, so that workers can do it.

    `sag_mm` is how far at most the triangles lie from the surfaces that they stand for: 0 where all faces are flat, None
    where that is not known.
    Raises ValueError where a corner is not finite, a triangle has no such corner, or there is no triangle at all.
    """
    checked = [_checked(part) for part in parts]
    checked = [(vertices, triangles, color) for vertices, triangles, color in checked if len(triangles)]
    if not checked:
        raise ValueError("a shape needs a triangle")
    steps = _STEPS_PER_MM * unit_mm
    low = np.min([vertices.min(axis=0) for vertices, _, _ in checked], axis=0)
    high = np.max([vertices.max(axis=0) for vertices, _, _ in checked], axis=0)
    half = np.round((high - low) / 2 * steps) / steps
    digest = hashlib.blake2b(digest_size=16)
    if sag_mm is not None:
        if not 0 <= sag_mm < math.inf:
            raise ValueError(f"{sag_mm} is no distance from a surface")
        digest.update(repr(float(sag_mm)).encode())
    prepared = []
    for vertices, triangles, color in checked:
        rounded = np.round((vertices - low) * steps) / steps - half
        part = _prepared(rounded, settled(rounded * unit_mm, triangles), color)
        digest.update(repr((part.vertex_count, part.index_count, color)).encode())
        digest.update(part.positions)
        digest.update(part.indices)
        prepared.append(part)
    middle = low + half
    return PreparedShape(tuple(prepared), (float(middle[0]), float(middle[1]), float(middle[2])), digest.digest(), sag_mm)


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


def _checked(part: Part) -> tuple[NDArray[np.float64], NDArray[np.uint32], Color]:
    vertices = np.asarray(part.vertices, dtype=np.float64).reshape(-1, 3)
    triangles: NDArray[Any] = np.asarray(part.triangles).reshape(-1, 3)
    if len(triangles) and (triangles.min() < 0 or triangles.max() >= len(vertices)):
        raise ValueError("a triangle has a corner that does not exist")
    used, numbers = used_corners(triangles.astype(np.int64, copy=False), len(vertices))
    vertices = vertices[used]
    if not np.isfinite(vertices).all():
        raise ValueError("a corner is not a finite number")
    return vertices, numbers, part.color


def _prepared(vertices: NDArray[np.float64], triangles: NDArray[np.uint32], color: Color) -> PreparedPart:
    positions = vertices.astype("<f4") + np.float32(0)  # no negative zeros: equal shapes are equal bytes
    if not np.isfinite(positions).all():
        raise ValueError("a shape is larger than a float32 can say")
    # 65535 is no corner in 16 bits: it restarts strips.
    indices = triangles.astype("<u2" if len(vertices) < 65536 else "<u4")
    return PreparedPart(
        positions.tobytes(),
        indices.tobytes(),
        len(vertices),
        indices.size,
        tuple(float(x) for x in positions.min(axis=0)),
        tuple(float(x) for x in positions.max(axis=0)),
        color,
    )
