# SPDX-License-Identifier: Apache-2.0
"""Faces whose outline touches itself in a point: each of the areas that meet there is made a face of its own.

Kernels skip such a face, or keep a part of it (decision 0118).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from strake.importers.ifc.entity import Model

Item = TypeVar("Item")


def outlines_of(model: Model, number: int) -> list[list[int]]:
    """Returns the outlines, by number of corner, into which the face of that number can be split; empty where it cannot, as a
    face that is none."""
    try:
        face = model.by_id(number)
        if face.is_a() != "IfcFace" or len(face.Bounds) != 1 or not face.Bounds[0].Bound.is_a("IfcPolyLoop"):
            return []
        places = [tuple(corner.Coordinates) for corner in face.Bounds[0].Bound.Polygon]
        parts = split_outline(places)
        outlines = [[places[i] for i in part] for part in parts]
        return parts if len(parts) > 1 and _turn_alike(outlines) and _lie_apart(outlines) else []
    except (AttributeError, IndexError, RuntimeError, TypeError, ValueError):
        return []


def split_face(model: Model, number: int, parts: Sequence[Sequence[int]]) -> None:
    """Splits the face of that number in the model into what outlines_of() returned."""
    face = model.by_id(number)
    outline = face.Bounds[0]
    corners = outline.Bound.Polygon
    file: Any = model.file
    faces = []
    for part in parts:
        loop = file.create_entity("IfcPolyLoop", [corners[i].data for i in part])
        bound = file.create_entity("IfcFaceOuterBound", loop, outline.Orientation)
        faces.append(file.create_entity("IfcFace", [bound]))
    for owner in file.get_inverse(face.data):
        if owner.is_a("IfcConnectedFaceSet"):
            owner.CfsFaces = [one for one in owner.CfsFaces if one.id() != number] + faces


def split_outline(places: Sequence[Item]) -> list[list[int]]:
    """Returns the outlines, by number of corner, that one falls into where it comes to a place again; there and back is none."""
    parts: list[list[int]] = []
    path: list[int] = []
    at: dict[Item, int] = {}
    for i, place in enumerate(places):
        first = at.get(place)
        if first is None:
            at[place] = len(path)
            path.append(i)
            continue
        part = path[first:]
        for corner in part[1:]:
            del at[places[corner]]
        del path[first + 1 :]
        parts.append(part)
    parts.append(path)
    return [part for part in parts if len(part) > 2]


def _turn_alike(outlines: Sequence[Sequence[tuple[float, ...]]]) -> bool:
    """Whether all turn in one way, seen from one side: one that turns otherwise is a hole, or a crossing."""
    areas = []
    for outline in outlines:
        corners = np.array(outline, dtype=np.float64) - outline[0]
        areas.append(np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0))
    return all(float(area @ areas[0]) > 0 for area in areas)


def _lie_apart(outlines: Sequence[Sequence[tuple[float, ...]]]) -> bool:
    """Whether no corner of one lies within another: an outline that goes round twice would be two faces, one on the other."""
    flat = [np.array(outline, dtype=np.float64) for outline in outlines]
    corners = flat[0] - flat[0][0]
    area = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    kept = [axis for axis in range(3) if axis != int(np.argmax(np.abs(area)))]
    flat = [outline[:, kept] for outline in flat]
    for i, one in enumerate(flat):
        for k, other in enumerate(flat):
            shared = {tuple(corner) for corner in outlines[k]}
            free = [corner for corner, place in zip(one, outlines[i], strict=True) if tuple(place) not in shared]
            if i != k and any(_is_within(corner, other) for corner in free):
                return False
    return True


def _is_within(point: NDArray[np.float64], outline: NDArray[np.float64]) -> bool:
    following = np.roll(outline, -1, axis=0)
    spans = (outline[:, 1] > point[1]) != (following[:, 1] > point[1])
    a, b = outline[spans], following[spans]
    crossings = a[:, 0] + (point[1] - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return int((crossings > point[0]).sum()) % 2 == 1
