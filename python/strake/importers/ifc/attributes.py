# SPDX-License-Identifier: Apache-2.0
"""What a product states of itself: its class and names, property and quantity sets, material, layer, systems."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ifcopenshell import ifcopenshell_wrapper

from strake.importers.ifc.entity import Entity, Model, number_of
from strake.importers.ifc.units import MEASURES, Units
from strake.importers.scene_writer import encoded

_OWN = ("PredefinedType", "ObjectType", "Tag", "Description", "LongName")
_MAX_DEPTH = 3
# So many sets are kept, for products that share one; most sets are of one product.
_MAX_SETS = 10_000
_QUANTITIES = {
    "IfcQuantityLength": ("LengthValue", "LENGTHUNIT"),
    "IfcQuantityArea": ("AreaValue", "AREAUNIT"),
    "IfcQuantityVolume": ("VolumeValue", "VOLUMEUNIT"),
    "IfcQuantityWeight": ("WeightValue", "MASSUNIT"),
    "IfcQuantityTime": ("TimeValue", "TIMEUNIT"),
    "IfcQuantityCount": ("CountValue", None),
    "IfcQuantityNumber": ("NumberValue", None),
}
# Where all versions have the name of an IfcProperty, and the properties of an IfcPropertySet and an IfcComplexProperty.
PROPERTY_NAME, OF_SET, OF_COMPLEX = 0, 4, 3
_OF_ALL_SETS = {"GlobalId", "OwnerHistory", "Name", "Description"}
# Several names in one value: a pattern finds each.
_BETWEEN = "; "


class AttributeReader:
    """Reads attributes. What many products share is read once."""

    def __init__(self, model: Model, units: Units) -> None:
        self._units = units
        self._tables = model.tables
        self._sets: dict[int, dict[str, Any]] = {}
        self._types: dict[int, dict[str, dict[str, Any]]] = {}
        self._shared: dict[tuple[int, ...], dict[str, Any]] = {}
        self._materials: dict[int, str] = {}
        self._schema: Any = ifcopenshell_wrapper.schema_by_name(model.schema_identifier)
        self._declared: dict[str, list[tuple[str, str]]] = {}
        self._layers = _layers_of_items(model)

    def of(self, product: Entity) -> dict[str, Any]:
        """Returns the attributes of a product; each set of properties is one of them."""
        result: dict[str, Any] = {"class": product.is_a()}
        for name in _OWN:
            value = product.get(name)
            if value not in (None, ""):
                result[name] = value
        defining = product.get("IsDefinedBy") or ()
        definitions, kind = _definitions_in(defining), _type_in((*(product.get("IsTypedBy") or ()), *defining))
        associations = product.get("HasAssociations") or ()
        if kind is not None:
            result["Type"] = kind.Name or kind.is_a()
            if result.get("PredefinedType") in (None, "NOTDEFINED") and kind.get("PredefinedType"):
                result["PredefinedType"] = kind.PredefinedType
        for name, value in (
            ("Material", self._material(associations, kind)),
            ("Layer", self._layer(product)),
            *_assigned(product).items(),
            ("Classification", _joined(_classifications(associations))),
        ):
            if value:
                result[name] = value
        for name, value in self._property_sets(definitions, kind).items():
            result.setdefault(name, value)
        return result

    def sets_of(self, owner: Entity) -> dict[str, Any]:
        """Returns the property and quantity sets of a group: not those of its type, which are about how it is drawn."""
        return self._property_sets(_definitions_in(owner.get("IsDefinedBy") or ()), None)

    def length(self, value: float) -> Any:
        """Returns a length of the project's unit as an attribute."""
        return self._units.length(value)

    def _property_sets(self, definitions: list[Entity], kind: Entity | None) -> dict[str, Any]:
        """Returns the sets of a product and its type, whose values the product's own go before."""
        key = (*(d.id() for d in definitions), -1 if kind is None else -kind.id())
        known = self._shared.get(key)
        if known is None:
            merged = {name: dict(values) for name, values in self._type_sets(kind).items()}
            for definition in definitions:
                name = definition.get("Name")
                if name or not definition.is_a("IfcPropertySetDefinition"):
                    merged.setdefault(name or definition.is_a(), {}).update(self._set(definition))
            known = {name: encoded(values) for name, values in merged.items() if values}
            # Those of a type alone are requested again and again.
            if not definitions:
                self._shared[key] = known
        return known

    def _type_sets(self, kind: Entity | None) -> dict[str, dict[str, Any]]:
        if kind is None:
            return {}
        known = self._types.get(kind.id())
        if known is None:
            known = {}
            for definition in kind.get("HasPropertySets") or ():
                known.setdefault(definition.Name or definition.is_a(), {}).update(self._set(definition))
            self._types[kind.id()] = known
        return known

    def _set(self, definition: Entity) -> dict[str, Any]:
        known = self._sets.get(definition.id())
        if known is None:
            if definition.is_a("IfcElementQuantity"):
                known = self._quantities(definition.Quantities, 0)
            elif definition.is_a("IfcPropertySet"):
                known = self._properties(definition, OF_SET, 0)
            else:
                known = self._predefined(definition)
            if len(self._sets) >= _MAX_SETS:
                self._sets.clear()
            self._sets[definition.id()] = known
        return known

    def _properties(self, owner: Entity, place: int, depth: int) -> dict[str, Any]:
        """Returns the properties that an entity states at a place."""
        result: dict[str, Any] = {}
        properties = owner.data.get_argument(place)
        if not isinstance(properties, tuple):
            properties = owner.at(place)
        for data in properties or ():
            kind = data.is_a()
            if kind == "IfcPropertySingleValue":
                # Nearly all are of this kind.
                value = self._units.single(data)
            else:
                value = self._other_property(kind, Entity(data, self._tables), depth)
            if value not in (None, {}, []):
                result[str(data.get_argument(PROPERTY_NAME))] = value
        return result

    def _other_property(self, kind: str, item: Entity, depth: int) -> Any:
        if kind == "IfcPropertyEnumeratedValue":
            return _single(self._units.value(list(item.EnumerationValues or ())))
        if kind == "IfcPropertyListValue":
            return _single(self._units.value(list(item.ListValues or ()), item.Unit))
        if kind == "IfcPropertyBoundedValue":
            low, high = (self._units.value(bound, item.Unit) for bound in (item.LowerBoundValue, item.UpperBoundValue))
            return {name: bound for name, bound in (("low", low), ("high", high)) if bound is not None}
        if kind == "IfcComplexProperty" and depth < _MAX_DEPTH:
            return self._properties(item, OF_COMPLEX, depth + 1)
        return None

    def _quantities(self, quantities: Iterable[Entity] | None, depth: int) -> dict[str, Any]:
        result: dict[str, Any] = {}
        for item in quantities or ():
            if item.is_a("IfcPhysicalComplexQuantity"):
                if depth < _MAX_DEPTH:
                    result[str(item.Name)] = self._quantities(item.HasQuantities, depth + 1)
                continue
            name, kind = _QUANTITIES.get(item.is_a(), ("", None))
            value = item.get(name) if name else None
            if value is not None:
                result[str(item.Name)] = self._units.value(value, item.Unit, kind)
        return result

    def _predefined(self, definition: Entity) -> dict[str, Any]:
        """Returns the values of a set that the schema itself defines, as IfcDoorLiningProperties."""
        result = {}
        for name, measure in self._simple_attributes(definition.is_a()):
            value = definition.get(name)
            if value is not None and not isinstance(value, (tuple, Entity)):
                result[name] = self._units.value(value, None, MEASURES.get(measure))
        return result

    def _simple_attributes(self, kind: str) -> list[tuple[str, str]]:
        """Returns the attributes of a class that are its own affair, with the names of their types."""
        known = self._declared.get(kind)
        if known is None:
            known = []
            for attribute in self._schema.declaration_by_name(kind).as_entity().all_attributes():
                named = attribute.type_of_attribute().as_named_type()
                if attribute.name() not in _OF_ALL_SETS:
                    known.append((attribute.name(), named.declared_type().name() if named else ""))
            self._declared[kind] = known
        return known

    def _material(self, associations: Iterable[Entity], kind: Entity | None) -> str:
        for own in (True, False):
            for relation in associations if own else (kind.get("HasAssociations") if kind is not None else None) or ():
                if relation.is_a("IfcRelAssociatesMaterial") and (material := relation.get("RelatingMaterial")) is not None:
                    number = material.id()
                    if number not in self._materials:
                        self._materials[number] = _joined(_material_names(material, 0))
                    return self._materials[number]
        return ""

    def _layer(self, product: Entity) -> str:
        if not self._layers:
            return ""
        names = []
        for representation in product.Representation.Representations or ():
            for item in (representation, *(representation.Items or ())):
                names += self._layers.get(item.id(), [])
        return _joined(names)


def _layers_of_items(model: Model) -> dict[int, list[str]]:
    result: dict[int, list[str]] = {}
    for layer in model.by_type("IfcPresentationLayerAssignment"):
        for item in layer.AssignedItems or ():
            result.setdefault(item.id(), []).append(str(layer.Name or ""))
    return result


def _definitions_in(relations: Iterable[Entity]) -> list[Entity]:
    definitions: list[Entity] = []
    for relation in relations:
        if relation.is_a("IfcRelDefinesByProperties"):
            definition = relation.get("RelatingPropertyDefinition")
            if definition is None:
                continue
            if definition.is_a("IfcPropertySetDefinitionSet"):
                definitions += definition.wrappedValue
            else:
                definitions.append(definition)
    return sorted(definitions, key=number_of)


def _type_in(relations: Iterable[Entity]) -> Entity | None:
    # IFC2x3 has the relation among those of properties.
    for relation in relations:
        if relation.is_a("IfcRelDefinesByType"):
            kind: Entity | None = relation.RelatingType
            return kind
    return None


def _assigned(product: Entity) -> dict[str, str]:
    names: dict[str, list[str]] = {"System": [], "Zone": [], "Group": []}
    for relation in product.get("HasAssignments") or ():
        if not relation.is_a("IfcRelAssignsToGroup") or (group := relation.get("RelatingGroup")) is None:
            continue
        kind = "Zone" if group.is_a("IfcZone") else "System" if group.is_a("IfcSystem") else "Group"
        names[kind].append(group.Name or group.is_a())
    return {kind: _joined(found) for kind, found in names.items()}


def _classifications(associations: Iterable[Entity]) -> list[str]:
    names = []
    for relation in associations:
        if relation.is_a("IfcRelAssociatesClassification") and (reference := relation.get("RelatingClassification")) is not None:
            names.append(
                getattr(reference, "Identification", None)
                or getattr(reference, "ItemReference", None)
                or getattr(reference, "Name", None)
                or ""
            )
    return names


def _material_names(material: Entity, depth: int) -> list[str]:
    if depth > _MAX_DEPTH:
        return []
    for single in ("ForLayerSet", "ForProfileSet", "Material"):
        inner = material.get(single)
        if isinstance(inner, Entity):
            return _material_names(inner, depth + 1)
    names: list[str] = []
    for several in ("MaterialLayers", "MaterialProfiles", "MaterialConstituents", "Materials"):
        for inner in material.get(several) or ():
            names += _material_names(inner, depth + 1)
    return names or [material.get("Name") or material.get("LayerSetName") or ""]


def _joined(names: Iterable[str]) -> str:
    return _BETWEEN.join(dict.fromkeys(name for name in names if name))


def _single(values: list[Any]) -> Any:
    return values[0] if len(values) == 1 else _joined(str(value) for value in values)
