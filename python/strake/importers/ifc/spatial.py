# SPDX-License-Identifier: Apache-2.0
"""Groups of the scene: site, building, storey, space, assembly."""

from __future__ import annotations

from typing import Any

from strake.importers.ifc.attributes import AttributeReader
from strake.importers.ifc.entity import Entity, Model, is_a
from strake.importers.ifc.georeference import map_attributes
from strake.importers.scene_writer import Group, SceneWriter

# Under which name objects inherit the name of what they are in.
_LEVELS = (
    ("IfcSite", "Site"),
    ("IfcBuildingStorey", "Storey"),
    ("IfcBuilding", "Building"),
    ("IfcSpace", "Space"),
    ("IfcFacilityPart", "FacilityPart"),
    ("IfcFacility", "Facility"),
    ("IfcElement", "Assembly"),
)
_MAX_LEVELS = 32


class SpatialGroups:
    """Makes the groups that products need."""

    def __init__(self, model: Model, scene: SceneWriter, attributes: AttributeReader, origin: dict[str, str], parents: Parents) -> None:
        self._scene = scene
        self._parents = parents
        self._origin = origin
        self._attributes = attributes
        self._groups: dict[int, Group] = {}
        # The group of what has this above it, where its chain comes to an end.
        self._above: dict[int, Group] = {}
        self._map = map_attributes(model)

    def above(self, product: Entity) -> Group | None:
        """Returns the group that a product is in."""
        chain: list[Entity] = []
        visited = {product.id()}
        at = first = self._parents.of(product)
        if first is not None and (whole := self._above.get(first.id())) is not None:
            return whole
        while at is not None and at.id() not in visited and len(chain) < _MAX_LEVELS:
            visited.add(at.id())
            if at.is_a("IfcProduct"):
                chain.append(at)
            at = self._parents.of(at)
        group: Group | None = None
        for entity in reversed(chain):
            known = self._groups.get(entity.id())
            if known is None:
                stated = self._of(entity) if group else {**self._origin, **self._of(entity)}
                known = self._scene.group(entity.Name or entity.is_a(), group, stated)
                self._groups[entity.id()] = known
            group = known
        if first is not None and group is not None and at is None:
            self._above[first.id()] = group
        return group

    def _of(self, entity: Entity) -> dict[str, Any]:
        result: dict[str, Any] = {}
        for kind, name in _LEVELS:
            if is_a(entity, kind):
                result[name] = entity.Name or entity.is_a()
                result[f"{name}Id"] = entity.GlobalId
                break
        if isinstance(entity.get("Elevation"), float):
            result["StoreyElevation"] = self._attributes.length(entity.Elevation)
        if entity.is_a("IfcSite"):
            result.update(self._map)
        for name, values in self._attributes.sets_of(entity).items():
            result.setdefault(name, values)
        return result


class Parents:
    """What entities are in or a part of; each is looked for once."""

    def __init__(self) -> None:
        self._known: dict[int, Entity | None] = {}

    def of(self, entity: Entity) -> Entity | None:
        """Returns what an entity is in or a part of."""
        number = entity.id()
        if number not in self._known:
            self._known[number] = parent_of(entity)
        return self._known[number]


def parent_of(entity: Entity) -> Entity | None:
    """Returns what an entity is in or a part of."""
    for inverse, name in (
        ("Decomposes", "RelatingObject"),
        ("Nests", "RelatingObject"),
        ("ContainedInStructure", "RelatingStructure"),
        ("FillsVoids", "RelatingOpeningElement"),
        ("VoidsElements", "RelatingBuildingElement"),
        ("ProjectsElements", "RelatingElement"),
    ):
        for relation in entity.get(inverse) or ():
            parent = relation.get(name)
            if isinstance(parent, Entity):
                # A window is beside its wall, not in it.
                beside = inverse in ("VoidsElements", "FillsVoids")
                return _parent_of_host(parent) if beside else parent
    return None


def _parent_of_host(entity: Entity) -> Entity | None:
    """Returns what the host of an opening is in."""
    for relation in entity.get("VoidsElements") or ():
        host = relation.RelatingBuildingElement
        if host is not None and not host.is_a("IfcFeatureElement"):
            return parent_of(host)
    return None if entity.is_a("IfcFeatureElement") else parent_of(entity)
