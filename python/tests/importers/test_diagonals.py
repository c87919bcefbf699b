# SPDX-License-Identifier: Apache-2.0
"""Of triangulations that are equally good the same one comes out."""

from __future__ import annotations

import random

import numpy as np
import pytest
from numpy.typing import NDArray

from strake.importers.diagonals import settled

# What corners are rounded to.
STEPS_PER_MM = 4096


def fan_at_random(corners: list[int], rng: random.Random) -> list[list[int]]:
    """Returns any triangulation of a convex outline."""
    if len(corners) < 3:
        return []
    first, last = 0, len(corners) - 1
    between = rng.randrange(1, last)
    triangle = [corners[first], corners[between], corners[last]]
    turn = rng.randrange(3)
    return [
        triangle[turn:] + triangle[:turn],
        *fan_at_random(corners[: between + 1], rng),
        *fan_at_random(corners[between:], rng),
    ]


def outline(count: int, x_mm: float, y_mm: float) -> NDArray[np.float64]:
    """Returns the corners of an ellipse, in a plane aslant."""
    angles = np.arange(count) * 2 * np.pi / count + 0.3
    flat = np.stack([np.cos(angles) * x_mm, np.sin(angles) * y_mm, np.full(count, 40.0)], axis=1)
    turn = np.linalg.qr(np.array([[1.0, 2.0, -1.0], [0.5, 1.0, 3.0], [2.0, -1.0, 0.3]]))[0]
    result: NDArray[np.float64] = np.round(flat @ turn * STEPS_PER_MM) / STEPS_PER_MM
    return result


def area(vertices: NDArray[np.float64], triangles: NDArray[np.uint32]) -> float:
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


@pytest.mark.parametrize("count", [4, 5, 12, 30, 64])
@pytest.mark.parametrize("radius_mm", [3.0, 80.0, 4000.0])
def test_all_triangulations_of_a_round_outline_become_one(count: int, radius_mm: float) -> None:
    vertices = outline(count, radius_mm, radius_mm)
    rng = random.Random(count)
    found = set()
    for _ in range(8):
        triangles = fan_at_random(list(range(count)), rng)
        rng.shuffle(triangles)
        given = np.array(triangles, dtype=np.uint32)
        became = settled(vertices, given)
        assert area(vertices, became) == pytest.approx(area(vertices, given), rel=1e-9)
        found.add(became.tobytes())
    assert len(found) == 1
    # All meet in the corner that comes first.
    first = int(np.lexsort(vertices.T[::-1])[0])
    assert (became == first).any(axis=1).all()


def test_the_shorter_diagonal_of_a_kite_is_taken() -> None:
    """Of the long one the circles have the other corner inside."""
    vertices = np.array([[0.0, 0, 0], [50, -10, 0], [100, 0, 0], [50, 10, 0]])
    for rows in ([[3, 0, 1], [1, 2, 3]], [[2, 3, 0], [0, 1, 2]]):
        assert settled(vertices, np.array(rows, dtype=np.uint32)).tolist() == [[0, 1, 3], [1, 2, 3]]


def test_other_faces_of_a_body_keep_their_rows() -> None:
    top = outline(12, 80, 80)
    normal = np.cross(top[1] - top[0], top[2] - top[0])
    vertices = np.concatenate([top, [top.mean(axis=0) - 70 * normal / np.linalg.norm(normal)]])
    sides = [[k, 12, (k + 1) % 12] for k in range(12)]
    for seed in range(4):
        caps = fan_at_random(list(range(12)), random.Random(seed))
        triangles = np.array([*sides[:5], *caps, *sides[5:]], dtype=np.uint32)
        became = settled(vertices, triangles)
        assert np.array_equal(became[:5], triangles[:5]) and np.array_equal(became[15:], triangles[15:])
        assert (became[5:15] < 12).all()


def test_edges_of_three_faces_and_of_faces_that_turn_otherwise_are_left_alone() -> None:
    square = np.array([[0.0, 0, 0], [100, 0, 0], [100, 100, 0], [0, 100, 0], [0, 0, 100]])
    for rows in ([[1, 2, 3], [1, 3, 0], [3, 1, 4]], [[1, 2, 3], [1, 0, 3]]):
        triangles = np.array(rows, dtype=np.uint32)
        assert np.array_equal(settled(square, triangles), triangles)
    sound = np.array([[1, 2, 3], [1, 3, 0]], dtype=np.uint32)
    assert settled(square, sound).tolist() == [[0, 1, 2], [0, 2, 3]]


def test_no_and_single_triangles() -> None:
    for count in (0, 1):
        triangles = np.arange(3 * count, dtype=np.uint32).reshape(-1, 3)
        assert np.array_equal(settled(np.eye(3), triangles), triangles)
