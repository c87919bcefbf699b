# SPDX-License-Identifier: Apache-2.0
"""Faces of triangles alone that are in no shell: which of them are one thing, and what it is called."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from OCP.BRep import BRep_Tool
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS


@dataclass(frozen=True)
class FaceSet:
    """Faces that are one thing. The name is that of each of them."""

    faces: tuple[Any, ...]
    name: str


def face_sets(faces: list[Any], name_of: Callable[[Any], str]) -> list[FaceSet]:
    """Returns the faces, those together that have one name and hang together by edges, in the order of the file.

    Such faces have no edges that Open CASCADE would know: an edge is two corners of a triangle, by their coordinates.
    """
    joined = _Joined(len(faces))
    points: dict[tuple[float, float, float], int] = {}
    first_with: dict[tuple[str, int, int], int] = {}
    names = [name_of(face) for face in faces]
    for number, (face, name) in enumerate(zip(faces, names, strict=True)):
        for a, b in _edges_of(face, points):
            joined.join(first_with.setdefault((name, min(a, b), max(a, b)), number), number)
    together: dict[int, list[int]] = {}
    for number in range(len(faces)):
        together.setdefault(joined.first_of(number), []).append(number)
    return [FaceSet(tuple(faces[number] for number in numbers), names[first]) for first, numbers in together.items()]


class _Joined:
    """Which numbers are joined, by whichever chain of pairs."""

    def __init__(self, count: int) -> None:
        self._before = list(range(count))

    def first_of(self, number: int) -> int:
        """Returns the least number that it is joined with."""
        while self._before[number] != number:
            self._before[number] = number = self._before[self._before[number]]
        return number

    def join(self, one: int, other: int) -> None:
        one, other = self.first_of(one), self.first_of(other)
        self._before[max(one, other)] = min(one, other)


def _edges_of(face: Any, points: dict[tuple[float, float, float], int]) -> set[tuple[int, int]]:
    """Returns the edges of the triangles of a face; `points` numbers the places that are known."""
    location = TopLoc_Location()
    triangulation = BRep_Tool.Triangulation_s(TopoDS.Face_s(face), location)
    if triangulation is None:
        return set()
    place = location.Transformation()
    numbers = []
    for i in range(1, triangulation.NbNodes() + 1):
        point = triangulation.Node(i).Transformed(place)
        numbers.append(points.setdefault((point.X(), point.Y(), point.Z()), len(points)))
    edges = set()
    for i in range(1, triangulation.NbTriangles() + 1):
        one = triangulation.Triangle(i)
        a, b, c = (numbers[one.Value(k) - 1] for k in (1, 2, 3))
        edges |= {(a, b), (b, c), (c, a)}
    return edges
