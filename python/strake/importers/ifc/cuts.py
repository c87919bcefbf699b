# SPDX-License-Identifier: Apache-2.0
"""Products with openings and cut bodies: the fast kernel makes the bodies, manifold3d cuts them (decision 0121)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from strake.importers.ifc.entity import Entity, Model
from strake.importers.ifc.half_spaces import half_space
from strake.importers.ifc.kernels import FAST, NO_BODY, geometry_settings, shapes_of, slow_items_of
from strake.importers.ifc.solids import Corners, Mesh, Unfit, difference
from strake.importers.shapes import Color, used_corners

_MM_PER_M = 1000.0
_BOOLEANS = ("IfcBooleanClippingResult", "IfcBooleanResult")
_MAX_CUTS = 1000
_MAX_DEPTH = 100


class Cut(NamedTuple):
    """What is left of a product in its own frame, in millimetres, and its placement as the kernel has it."""

    product: int
    pieces: list[tuple[Mesh, Color]]
    placement: Any
    fault: str = ""


@dataclass
class _Plan:
    """How the body of a product, or of an opening, comes about: items, by number, and what is taken from each."""

    openings: list[int] = field(default_factory=list)
    # What the kernel is to make: the items, those within mapped items, and first operands in the place of results.
    items: set[int] = field(default_factory=set)
    clips: dict[int, list[Entity]] = field(default_factory=dict)
    # Boolean results in the place of which the kernel is to find their first operand, by representation.
    replaced: dict[int, dict[int, int]] = field(default_factory=dict)
    styled: dict[int, int] = field(default_factory=dict)


class _Body(NamedTuple):
    items: dict[int, tuple[Mesh, Color]]
    placement: Any


def cut_products(model: Model, products: Sequence[int], sag_m: float, log: Any, color_of: Any) -> Iterator[Cut]:
    """Yields what openings and half-spaces leave of products, or why that is not told."""
    plans: dict[int, _Plan | str] = {}
    for number in products:
        plans[number] = _planned(model, number, with_openings=True)
    for plan in list(plans.values()):
        for opening in plan.openings if isinstance(plan, _Plan) else ():
            if opening not in plans:
                plans[opening] = _planned(model, opening, with_openings=False)
    sound = {number: plan for number, plan in plans.items() if isinstance(plan, _Plan)}
    settings = geometry_settings(sag_m)
    settings.set("disable-opening-subtractions", True)
    bodies: dict[int, _Body | str] = {number: plan for number, plan in plans.items() if isinstance(plan, str)}
    shape_of: dict[int, str] = {}
    with _first_operands(model, sound.values()):
        iterator = shapes_of(model, sorted(sound), settings, FAST, log)
        unit_mm = float(iterator.unit_magnitude()) * _MM_PER_M
        going = iterator.initialize()
        while going:
            element = iterator.get()
            shape_of[element.id] = element.geometry.id
            bodies[element.id] = _body(element, color_of) if element.id not in bodies else "several bodies"
            going = bool(iterator.next())
    bodies.update(_faults(model, log, sound, shape_of))
    for number in products:
        try:
            yield _cut(number, sound, bodies, unit_mm)
        except (AttributeError, IndexError, RuntimeError, TypeError, ValueError) as fault:
            yield Cut(number, [], None, str(fault))


def _cut(number: int, plans: dict[int, _Plan], bodies: dict[int, _Body | str], unit_mm: float) -> Cut:
    body = _whole(number, bodies)
    pieces = _clipped(body, plans[number], unit_mm)
    cutters = []
    for opening in plans[number].openings:
        other = _whole(opening, bodies)
        turned, moved = _relative(body.placement, other.placement)
        for mesh, _ in _clipped(other, plans[opening], unit_mm):
            cutters.append(Mesh(mesh.vertices @ turned.T + moved, mesh.triangles))
    if cutters:
        left = difference([mesh for mesh, _ in pieces], cutters)
        pieces = [(piece, color) for (_, color), some in zip(pieces, left, strict=True) for piece in some]
    return Cut(number, pieces, body.placement)


def _whole(number: int, bodies: dict[int, _Body | str]) -> _Body:
    body = bodies.get(number, "no shape")
    if isinstance(body, str):
        raise Unfit(body)
    return body


def _clipped(body: _Body, plan: _Plan, unit_mm: float) -> list[tuple[Mesh, Color]]:
    """Returns what half-spaces leave of the items of a body."""
    if missing := plan.items - body.items.keys():
        raise Unfit(f"no shape of #{min(missing)}")
    pieces: list[tuple[Mesh, Color]] = []
    for item, (mesh, color) in body.items.items():
        low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
        stated = [half_space(clip, unit_mm, low, high) for clip in plan.clips.get(item, ())]
        cutters = [cutter for cutter in stated if cutter is not None]
        pieces += [(piece, color) for piece in (difference([mesh], cutters)[0] if cutters else [mesh])]
    return pieces


def _relative(frame: NDArray[np.float64], other: NDArray[np.float64]) -> tuple[Corners, Corners]:
    """Returns turn and shift, in millimetres, from one frame to another. They lie near each other, and may lie far out."""
    back = np.linalg.inv(frame[:3, :3])
    return back @ other[:3, :3], back @ (other[:3, 3] - frame[:3, 3]) * _MM_PER_M


def _body(element: Any, color_of: Any) -> _Body | str:
    """Returns the triangles of each item, which has one colour."""
    geometry = element.geometry
    vertices = np.frombuffer(geometry.verts_buffer, dtype=np.float64).reshape(-1, 3) * _MM_PER_M
    triangles = np.frombuffer(geometry.faces_buffer, dtype=np.int32).reshape(-1, 3)
    styles = np.frombuffer(geometry.material_ids_buffer, dtype=np.int32)
    owners = np.frombuffer(geometry.item_ids_buffer, dtype=np.int32)
    colors = [color_of(material) for material in geometry.materials]
    if not len(triangles) or len(owners) != len(triangles) or len(styles) != len(triangles):
        return "no triangles of which the items are known"
    placement = np.array(element.transformation.matrix, dtype=np.float64).reshape(4, 4).T
    if not np.isfinite(placement).all() or not np.isfinite(vertices).all():
        return "a place that is not finite"
    items = {}
    for item in sorted(set(owners.tolist())):
        some = owners == item
        worn = {colors[style] if 0 <= style < len(colors) else None for style in set(styles[some].tolist())}
        color = worn.pop()
        if worn or color is None:
            return "an item of several styles"
        used, numbers = used_corners(triangles[some], len(vertices))
        items[item] = (Mesh(vertices[used], numbers.astype(np.int64)), color)
    return _Body(items, placement)


def _planned(model: Model, number: int, with_openings: bool) -> _Plan | str:
    """Returns the plan for a product; why there is none where it is more than openings and half-spaces."""
    plan = _Plan()
    try:
        product = model.by_id(number)
        if slow := slow_items_of(product):
            return f"{min(slow)}, which the fast kernel does not make"
        if with_openings:
            plan.openings = _openings_of(product)
        elif product.get("HasOpenings"):
            return "an opening that has openings"
        if product.get("HasProjections"):
            return "projections"
        for representation in product.Representation.Representations or ():
            if (representation.RepresentationIdentifier or "Body") in NO_BODY:
                continue
            for item in representation.Items or ():
                _plan_item(model, item, representation.id(), plan)
        return plan
    except (AttributeError, RuntimeError, TypeError, Unfit) as fault:
        return str(fault)


def _openings_of(product: Entity) -> list[int]:
    openings = [relation.RelatedOpeningElement for relation in product.HasOpenings or ()]
    part, depth = product, 0
    # Parts of a whole are cut by what cuts the whole.
    while wholes := _wholes_of(part):
        part, depth = wholes[0], depth + 1
        cutting = [relation.RelatedOpeningElement for relation in part.get("HasOpenings") or ()]
        if len(wholes) > 1 or depth > _MAX_DEPTH or (cutting and (depth > 1 or part.is_a("IfcElementAssembly"))):
            raise Unfit("a part of several wholes, or of an assembly that has openings")
        openings += cutting
    for opening in openings:
        names = [one.RepresentationIdentifier for one in opening.Representation.Representations or ()]
        if [name for name in names if name not in NO_BODY] != ["Body"]:
            raise Unfit("an opening of several bodies")
    return sorted({opening.id() for opening in openings})


def _wholes_of(part: Entity) -> list[Entity]:
    # In IFC2X3 what is nested is among them, too, which has the openings of no other.
    relations = part.get("Decomposes") or ()
    return [relation.RelatingObject for relation in relations if relation.is_a("IfcRelAggregates")]


def _plan_item(model: Model, item: Entity, representation: int, plan: _Plan) -> None:
    if item.is_a("IfcMappedItem"):
        inner = item.MappingSource.MappedRepresentation.Items or ()
        if any(one.is_a() in (*_BOOLEANS, "IfcMappedItem", "IfcCsgSolid") for one in inner):
            raise Unfit("a mapped item that is cut")
        plan.items.update(*map(_made_of, inner))
        return
    if item.is_a() not in _BOOLEANS:
        plan.items.update(_made_of(item))
        return
    clips: list[Entity] = []
    at = item
    while at.is_a() in _BOOLEANS:
        if at.Operator != "DIFFERENCE" or len(clips) >= _MAX_CUTS:
            raise Unfit(f"a Boolean {at.Operator}")
        clips.append(at.SecondOperand)
        if at.id() != item.id() and at.StyledByItem:
            raise Unfit("a style of a step of a cut")
        at = at.FirstOperand
        if _users(model, at) > 1:
            # It stands in the place of this result, with its style and for its cuts alone.
            raise Unfit("a cut of what is used elsewhere, too")
    styled = item.StyledByItem
    if styled and at.StyledByItem:
        raise Unfit("several styles of what is cut")
    if at.id() in plan.clips:
        raise Unfit("two items that are cut out of one")
    plan.items.add(at.id())
    plan.clips[at.id()] = clips[::-1]
    plan.replaced.setdefault(representation, {})[item.id()] = at.id()
    plan.styled.update({style.id(): at.id() for style in styled})


def _made_of(item: Entity) -> list[int]:
    """Returns what the kernel calls the shapes of an item: of surface models each surface is one, and boxes around a body are none."""
    kind = item.is_a()
    if kind == "IfcBoundingBox":
        return []
    if kind == "IfcFaceBasedSurfaceModel":
        return [one.id() for one in item.FbsmFaces]
    if kind == "IfcShellBasedSurfaceModel":
        return [one.id() for one in item.SbsmBoundary]
    return [item.id()]


def _users(model: Model, item: Entity) -> int:
    """Returns how many items and representations are made of an item; styles and layers of it are none."""
    users = model.file.get_inverse(model.file.by_id(item.id()))
    return sum(one.is_a("IfcRepresentation") or (one.is_a("IfcRepresentationItem") and not one.is_a("IfcStyledItem")) for one in users)


@contextmanager
def _first_operands(model: Model, plans: Iterable[_Plan]) -> Iterator[None]:
    """Puts the first operands of Boolean results in their place, for a while."""
    before: dict[int, Any] = {}
    styled: dict[int, Any] = {}
    try:
        for plan in plans:
            for number, operands in plan.replaced.items():
                if number not in before:
                    representation = model.file.by_id(number)
                    before[number] = representation.Items
                    representation.Items = [model.file.by_id(operands.get(item.id(), item.id())) for item in before[number]]
            for number, operand in plan.styled.items():
                if number not in styled:
                    style = model.file.by_id(number)
                    styled[number] = style.Item
                    style.Item = model.file.by_id(operand)
        yield
    finally:
        for number, items in before.items():
            model.file.by_id(number).Items = items
        for number, item in styled.items():
            model.file.by_id(number).Item = item


def _faults(model: Model, log: Any, plans: dict[int, _Plan], shape_of: dict[int, str]) -> dict[int, str]:
    """Returns what is wrong with bodies. What is said of a shape or of an item is said once, however many products have it."""
    faults: dict[int, str] = {}
    reached: dict[int, set[int]] = {}
    for message in log.log_messages():
        if message.severity_string != "ERROR":
            continue
        fault = " ".join(message.message.split())
        named = {int(number) for number in re.findall(r"#(\d+)=", f"{message.product} {message.instance}")}
        if not reached:
            reached = {number: _reached(model, number) for number in plans}
        items = set().union(*(plans[number].items for number in named & plans.keys()))
        shapes = {shape_of[number] for number in named & shape_of.keys()}
        blamed = [
            number
            for number, plan in plans.items()
            if named & reached[number] or items & plan.items or (number in shape_of and shape_of[number] in shapes)
        ]
        faults.update(dict.fromkeys(blamed or plans, fault))
    return faults


def _reached(model: Model, number: int) -> set[int]:
    """Returns the numbers of a product, and of all that its body is made of."""
    whole = model.file.by_id(number).Representation
    return {number, *(one.id() for one in model.file.traverse(whole))}
