# SPDX-License-Identifier: Apache-2.0
"""Faces whose outline touches itself in a point: each of the areas that meet there is made a face of its own.

Kernels skip such a face, or keep a part of it (decision 0118).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from strake.importers.ifc.entity import Model

Item = TypeVar("Item")

# An outline that touches itself has six corners at least.
_LONG_LOOP = re.compile(rb"IFCPOLYLOOP\(\((#\d+(?:,#\d+){5,})\)")
_MAX_TEXT_BYTES = 64 << 20
# What lies between a face and the products that have it, and how much of that is looked at.
_BETWEEN = ("IfcRepresentationItem", "IfcRepresentation", "IfcRepresentationMap", "IfcProductRepresentation")
_MAX_ABOVE = 10_000


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


def split_face(model: Model, number: int, parts: Sequence[Sequence[int]]) -> list[tuple[Any, Any]]:
    """Splits the face of that number in the model into what outlines_of() returned; returns what had it, with its faces before."""
    face = model.by_id(number)
    outline = face.Bounds[0]
    corners = outline.Bound.Polygon
    file: Any = model.file
    faces = []
    for part in parts:
        loop = file.create_entity("IfcPolyLoop", [corners[i].data for i in part])
        bound = file.create_entity("IfcFaceOuterBound", loop, outline.Orientation)
        faces.append(file.create_entity("IfcFace", [bound]))
    before = []
    for owner in file.get_inverse(face.data):
        if owner.is_a("IfcConnectedFaceSet"):
            before.append((owner, owner.CfsFaces))
            owner.CfsFaces = [one for one in owner.CfsFaces if one.id() != number] + faces
    return before


def faces_by_text(model: Model, path: Path) -> dict[int, list[int]]:
    """Returns faces that will be left out since a corner stands twice in their outline, by the numbers of products that have them: of those
    of which all can be split.

    It looks at the text of the file, which takes a hundredth of the time that such a product costs twice, and may miss some.
    """
    if path.stat().st_size > _MAX_TEXT_BYTES:
        return {}
    text = path.read_bytes()
    of_product: dict[int, list[int]] = {}
    for found in _LONG_LOOP.finditer(text):
        corners = found[1].split(b",")
        if len(set(corners)) == len(corners):
            continue
        number = text[text.rfind(b"#", 0, found.start()) + 1 : found.start()].rstrip(b" =")
        try:
            loop = model.file.by_id(int(number))
        except (RuntimeError, ValueError):
            continue  # it stands in a text or in a comment
        for face, products in _above(model, loop).items():
            for product in products:
                of_product.setdefault(product, []).append(face)
    return {product: faces for product, faces in of_product.items() if all(outlines_of(model, face) for face in faces)}


def _above(model: Model, loop: Any) -> dict[int, set[int]]:
    """Returns the faces that a loop bounds, with the products of which they are a part."""
    faces = {face.id(): face for bound in model.file.get_inverse(loop) for face in model.file.get_inverse(bound) if face.is_a("IfcFace")}
    return {number: _products_above(model, face) for number, face in faces.items()}


def _products_above(model: Model, face: Any) -> set[int]:
    products: set[int] = set()
    seen: set[int] = set()
    pending = [face]
    while pending and len(seen) < _MAX_ABOVE:
        for user in model.file.get_inverse(pending.pop()):
            if user.id() in seen:
                continue
            seen.add(user.id())
            if user.is_a("IfcProduct"):
                products.add(user.id())
            elif not user.is_a("IfcStyledItem") and any(user.is_a(kind) for kind in _BETWEEN):
                pending.append(user)
    return products


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
