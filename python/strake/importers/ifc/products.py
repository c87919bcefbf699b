# SPDX-License-Identifier: Apache-2.0
"""Which products become objects, and which are left out because they are no matter."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import NamedTuple

from strake.importers.ifc.entity import Entity, Model, is_a, number_of
from strake.importers.ifc.spatial import Parents
from strake.importers.report import Report

# What is no matter: rooms, holes, what is only drawn, axes, limits between rooms, loads and the members that carry them
# in a calculation. An IfcSite is kept: its body is the ground.
_LEFT_OUT = (
    ("IfcSpace", "spaces"),
    ("IfcExternalSpatialElement", "spaces"),
    ("IfcSpatialZone", "zones"),
    ("IfcFeatureElementSubtraction", "openings"),
    ("IfcSurfaceFeature", "surface features"),
    ("IfcAnnotation", "annotations"),
    ("IfcGrid", "grids"),
    ("IfcVirtualElement", "virtual elements"),
    ("IfcPort", "ports"),
    ("IfcStructuralItem", "structural analysis"),
    ("IfcStructuralActivity", "structural analysis"),
    ("IfcLinearPositioningElement", "alignments"),
    ("IfcReferent", "alignments"),
    ("IfcAlignment", "alignments"),
)


class Products(NamedTuple):
    """The products of a model that should have a body, in the order of their numbers."""

    solid: list[Entity]
    left_out: Counter[str]
    without_body: int


def choose_products(model: Model) -> Products:
    """Returns the products that are to be converted, and counts the others."""
    solid: list[Entity] = []
    left_out: Counter[str] = Counter()
    without_body = 0
    kinds: dict[str, str | None] = {}
    for product in sorted(model.by_type("IfcProduct"), key=number_of):
        if product.get("Representation") is None:
            without_body += 1
            continue
        kind = product.is_a()
        if kind not in kinds:
            kinds[kind] = _left_out_as(product)
        word = kinds[kind]
        if word is None:
            solid.append(product)
        else:
            left_out[word] += 1
    return Products(solid, left_out, without_body)


def _left_out_as(product: Entity) -> str | None:
    for name, word in _LEFT_OUT:
        if is_a(product, name):
            return word
    return None


def report_left_out(products: Products, bodyless: int, report: Report) -> None:
    """Says what is not in the scene, and should not be."""
    if products.left_out:
        counted = ", ".join(f"{count} {word}" for word, count in sorted(products.left_out.items()))
        report.note("ifc-left-out", f"left out, since they are no matter: {counted}")
    if products.without_body:
        report.note("ifc-no-body", f"{products.without_body} products have no shape at all: assemblies, storeys and the like")
    if bodyless:
        report.note("ifc-no-shape-stated", f"{bodyless} products have a shape that is no body: axes, outlines, or of no context")


class CircleFinder:
    """Finds products that are placed relative to themselves, or are parts of themselves: kernels would never end."""

    def __init__(self, parents: Parents) -> None:
        self._parents = parents
        self._good: set[int] = set()

    def fault_of(self, product: Entity) -> str:
        """Returns what is wrong with a product; empty where nothing is."""
        if not self._ends(product.get("ObjectPlacement"), lambda at: at.get("PlacementRelTo")):
            return "it is placed relative to itself"
        if not self._ends(product, self._parents.of):
            return "it is a part of itself"
        return ""

    def _ends(self, start: Entity | None, following: Callable[[Entity], Entity | None]) -> bool:
        passed: set[int] = set()
        at = start
        while at is not None and at.id() not in self._good:
            if at.id() in passed:
                return False
            passed.add(at.id())
            at = following(at)
        self._good |= passed
        return True


class Ids:
    """Lasting ids of products: their GlobalIds, each once."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._used: dict[str, int] = {}
        self._doubles = 0

    def of(self, product: Entity) -> str:
        """Returns the id of a product. To be asked in the order of the file, once for each."""
        guid = getattr(product, "GlobalId", None)
        if not isinstance(guid, str) or not guid:
            guid = f"#{product.id()}"
            self._report.warning("ifc-no-id", f"{product.is_a()} #{product.id()} has no GlobalId: its number stands for it", guid)
        count = self._used.get(guid, 0) + 1
        self._used[guid] = count
        if count == 1:
            return guid
        unique = f"{guid}~{count}"
        while unique in self._used:
            count += 1
            unique = f"{guid}~{count}"
        self._used[unique] = 1
        self._report.warning(
            "ifc-double-id", f"{product.is_a()} #{product.id()} has the GlobalId of another product: it is called {unique}", unique
        )
        return unique
