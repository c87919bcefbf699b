# SPDX-License-Identifier: Apache-2.0
"""What faces a body has: how far its triangles are from them depends on it."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from typing import Any

from strake.importers.ifc.entity import Entity
from strake.importers.ifc.kernels import NO_BODY


class Faces(enum.IntEnum):
    """Kinds of bodies; of several the greatest counts."""

    FLAT = 0
    """All are flat: triangles are the body."""
    CURVED = 1
    """Some may be curved, which the kernel makes triangles of."""
    FACETS = 2
    """The file states facets, which stand for nobody knows what."""


_MAX_DEPTH = 12
_FLAT_SOLIDS = {"IfcBlock", "IfcBoundingBox", "IfcRectangularPyramid"}
_FACETS = {
    "IfcFacetedBrep",
    "IfcFacetedBrepWithVoids",
    "IfcPolygonalFaceSet",
    "IfcTriangulatedFaceSet",
    "IfcTriangulatedIrregularNetwork",
    "IfcFaceBasedSurfaceModel",
    "IfcShellBasedSurfaceModel",
}
_EXTRUSIONS = {"IfcExtrudedAreaSolid", "IfcExtrudedAreaSolidTapered"}
# Profiles of straight lines but for the corners that have a radius.
_STRAIGHT_PROFILES = {
    "IfcAsymmetricIShapeProfileDef",
    "IfcCShapeProfileDef",
    "IfcIShapeProfileDef",
    "IfcLShapeProfileDef",
    "IfcRectangleHollowProfileDef",
    "IfcRectangleProfileDef",
    "IfcTShapeProfileDef",
    "IfcTrapeziumProfileDef",
    "IfcUShapeProfileDef",
    "IfcZShapeProfileDef",
}
_HALF_SPACES = {"IfcHalfSpaceSolid", "IfcBoxedHalfSpace", "IfcPolygonalBoundedHalfSpace"}


def faces_of(product: Entity) -> Faces:
    """Returns what faces a product's body has, with those that its openings cut into it."""
    cutters = [relation.get("RelatedOpeningElement") for relation in product.get("HasOpenings") or ()]
    added = [relation.get("RelatedFeatureElement") for relation in product.get("HasProjections") or ()]
    return _worst(_of_body(part) for part in (product, *cutters, *added) if part is not None)


def _worst(several: Iterable[Faces]) -> Faces:
    return max(several, default=Faces.FLAT)


def _of_body(product: Entity) -> Faces:
    return _worst(
        _of_item(item, 0)
        for representation in getattr(product.Representation, "Representations", None) or ()
        if (representation.RepresentationIdentifier or "Body") not in NO_BODY
        for item in representation.Items or ()
    )


def _of_item(item: Entity, depth: int) -> Faces:
    kind = item.is_a()
    if kind in _FACETS:
        return Faces.FACETS
    if kind in _FLAT_SOLIDS:
        return Faces.FLAT
    if depth >= _MAX_DEPTH:
        return Faces.CURVED
    if kind in _EXTRUSIONS:
        ends = [item.SweptArea, item.get("EndSweptArea")]
        return _flat_if(all(_is_straight_profile(end, depth + 1) for end in ends if end is not None))
    if kind in ("IfcBooleanResult", "IfcBooleanClippingResult"):
        return max(_of_item(item.FirstOperand, depth + 1), _of_item(item.SecondOperand, depth + 1))
    if kind == "IfcCsgSolid":
        return _of_item(item.TreeRootExpression, depth + 1)
    if kind == "IfcMappedItem":
        return _worst(_of_item(one, depth + 1) for one in item.MappingSource.MappedRepresentation.Items or ())
    if kind in _HALF_SPACES:
        edge = item.get("PolygonalBoundary")
        return _flat_if(item.BaseSurface.is_a("IfcPlane") and (edge is None or _is_straight(edge, depth + 1)))
    return Faces.CURVED


def _flat_if(flat: bool) -> Faces:
    return Faces.FLAT if flat else Faces.CURVED


def _is_straight_profile(profile: Entity, depth: int) -> bool:
    kind = profile.is_a()
    if depth >= _MAX_DEPTH:
        return False
    if kind in _STRAIGHT_PROFILES:
        return not any(getattr(profile, name) for name in profile.attribute_names() if name.endswith("Radius"))
    if kind in ("IfcArbitraryClosedProfileDef", "IfcArbitraryProfileDefWithVoids"):
        curves = [profile.OuterCurve, *(profile.get("InnerCurves") or ())]
        return all(_is_straight(curve, depth + 1) for curve in curves)
    if kind == "IfcCompositeProfileDef":
        return all(_is_straight_profile(one, depth + 1) for one in profile.Profiles)
    if kind in ("IfcDerivedProfileDef", "IfcMirroredProfileDef"):
        return _is_straight_profile(profile.ParentProfile, depth + 1)
    return False


def _is_straight(curve: Entity, depth: int) -> bool:
    kind = curve.is_a()
    if kind in ("IfcPolyline", "IfcLine"):
        return True
    if depth >= _MAX_DEPTH:
        return False
    if kind == "IfcIndexedPolyCurve":
        segments: Any = curve.Segments or ()
        return all(isinstance(one, Entity) and one.is_a("IfcLineIndex") for one in segments)
    if kind == "IfcCompositeCurve":
        return all(_is_straight(getattr(one, "ParentCurve", one), depth + 1) for one in curve.Segments)
    if kind == "IfcTrimmedCurve":
        return _is_straight(curve.BasisCurve, depth + 1)
    return False
