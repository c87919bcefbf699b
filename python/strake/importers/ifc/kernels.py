# SPDX-License-Identifier: Apache-2.0
"""Which kernel of IfcOpenShell makes which shapes, and how fine curved ones are."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import ifcopenshell
import ifcopenshell.geom

from strake.importers.ifc.entity import Entity, Model

# The furthest that a chord is from its curve, in metres.
SAG_M = 0.001
# The largest angle between two chords, in radians: small circles are round, too.
ANGLE = 0.5

# What the fast kernel makes no shape of, by the measures of docs/formats/ifc.md. Of all else its volumes are those of
# the exact one.
_NOT_FAST = {
    "opening",
    "IfcAdvancedBrep",
    "IfcAdvancedBrepWithVoids",
    "IfcBooleanClippingResult",
    "IfcBooleanResult",
    "IfcFixedReferenceSweptAreaSolid",
    "IfcRevolvedAreaSolid",
    "IfcRevolvedAreaSolidTapered",
    "IfcSurfaceCurveSweptAreaSolid",
    "IfcSweptDiskSolid",
    "IfcSweptDiskSolidPolygonal",
}

FAST = "cgal-simple"
EXACT = "opencascade"
# The fast kernel makes the bodies, manifold3d cuts them. No kernel of IfcOpenShell.
CUT = "cgal-simple with manifold3d"
_CUTS = {"opening", "IfcBooleanClippingResult", "IfcBooleanResult"}
# Representations that are no body.
NO_BODY = {"Axis", "Box", "FootPrint", "Plan", "Annotation", "Profile", "CoG", "Clearance", "Lighting", "Reference"}
_MAX_DEPTH = 12

# What is tried for a product, one after the other, until one gives a shape.
AFTER_FAST = (FAST, EXACT, "cgal")
AFTER_EXACT = (EXACT, FAST, "cgal")
AFTER_CUT = (CUT, *AFTER_EXACT)


def geometry_settings(sag_m: float = SAG_M) -> ifcopenshell.geom.settings:
    """Returns the settings that are the same for all kernels."""
    settings = ifcopenshell.geom.settings()
    settings.set("mesher-linear-deflection", sag_m)
    settings.set("mesher-angular-deflection", ANGLE)
    # The short cut of opencascade leaves a wall whole that lies in its opening.
    settings.set("boolean-attempt-2d", False)
    settings.set("weld-vertices", True)
    settings.set("no-normals", True)
    settings.set("use-world-coords", False)
    settings.set("apply-default-materials", True)
    return settings


def shapes_of(model: Model, products: Iterable[int], settings: ifcopenshell.geom.settings, kernel: str, log: Any) -> Any:
    """Returns what goes through the shapes of products, which are given by number. It is yet to be initialized."""
    return ifcopenshell.geom.iterator(
        settings,
        model.file,
        1,
        include=[model.file.by_id(number) for number in products],
        geometry_library=kernel,
        logger=log,
    )


def items_of(product: Entity) -> set[str]:
    """Returns the classes of the items that make a product's body, and of the openings that cut it as `opening`."""
    result: set[str] = set()
    if product.get("HasOpenings"):
        result.add("opening")
    for representation in getattr(product.Representation, "Representations", None) or ():
        if (representation.RepresentationIdentifier or "Body") in NO_BODY:
            continue
        _add_items(representation.Items or (), result, 0)
    return result


def slow_items_of(product: Entity) -> set[str]:
    """Returns the classes of the items that the fast kernel does not make, but for cuts."""
    return items_of(product) & _NOT_FAST - _CUTS


def has_body(product: Entity) -> bool:
    """Whether a product states more than axes, outlines and boxes around it."""
    items = _stated_items(product)
    return items is None or bool(items - {"opening", "IfcBoundingBox"})


def _add_items(items: Iterable[Entity], result: set[str], depth: int) -> None:
    for item in items:
        result.add(item.is_a())
        if depth >= _MAX_DEPTH:
            continue
        inner: list[Entity] = []
        if item.is_a("IfcMappedItem"):
            mapped = getattr(getattr(item, "MappingSource", None), "MappedRepresentation", None)
            inner += getattr(mapped, "Items", None) or ()
        for name in ("FirstOperand", "SecondOperand", "TreeRootExpression", "SweptArea", "Directrix"):
            value = item.get(name)
            if isinstance(value, Entity):
                inner.append(value)
        _add_items(inner, result, depth + 1)


def kernels_for(product: Entity, can_cut: bool) -> tuple[str, ...]:
    """Returns the kernels that are tried for a product, one after the other. `can_cut`: manifold3d is there."""
    slow = (_stated_items(product) or set()) & _NOT_FAST
    if not slow:
        return AFTER_FAST
    return AFTER_CUT if can_cut and slow <= _CUTS else AFTER_EXACT


def _stated_items(product: Entity) -> set[str] | None:
    """Returns the items of a product; None where the file has something else in their place, which is left to the kernels."""
    try:
        return items_of(product)
    except (AttributeError, RuntimeError, TypeError):
        return None
