# SPDX-License-Identifier: Apache-2.0
"""Faces whose outline touches itself in a point: each of the areas that meet there is made a face of its own.

Kernels skip such a face, or keep a part of it (decision 0118).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np

from strake.importers.ifc.entity import Model

Item = TypeVar("Item")


def split_face(model: Model, number: int) -> bool:
    """Splits the face of that number in the model; returns whether it could be done."""
    face = model.by_id(number)
    if face.is_a() != "IfcFace" or len(face.Bounds) != 1 or not face.Bounds[0].Bound.is_a("IfcPolyLoop"):
        return False
    outline = face.Bounds[0]
    corners = outline.Bound.Polygon
    places = [tuple(corner.Coordinates) for corner in corners]
    parts = split_outline(places)
    if len(parts) < 2 or not _turn_alike([[places[i] for i in part] for part in parts]):
        return False
    file: Any = model.file
    faces = []
    for part in parts:
        loop = file.create_entity("IfcPolyLoop", [corners[i].data for i in part])
        bound = file.create_entity("IfcFaceOuterBound", loop, outline.Orientation)
        faces.append(file.create_entity("IfcFace", [bound]))
    for owner in file.get_inverse(face.data):
        if owner.is_a("IfcConnectedFaceSet"):
            owner.CfsFaces = [one for one in owner.CfsFaces if one.id() != number] + faces
    return True


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
