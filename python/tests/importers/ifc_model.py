# SPDX-License-Identifier: Apache-2.0
"""Small IFC models that tests make."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.guid

Entity = Any


class IfcModel:
    """A model of one building; lengths are in the unit of the project."""

    def __init__(self, schema: str = "IFC4", prefix: str | None = "MILLI", foot: bool = False) -> None:
        self.file: Any = ifcopenshell.file(schema=schema)
        self.count = 0
        make = self.file.create_entity
        units = [make("IfcSIUnit", UnitType="LENGTHUNIT", Prefix=prefix, Name="METRE")]
        if foot:
            zero = make("IfcDimensionalExponents", 1, 0, 0, 0, 0, 0, 0)
            factor = make("IfcMeasureWithUnit", make("IfcLengthMeasure", 0.3048), units[0])
            units = [make("IfcConversionBasedUnit", zero, "LENGTHUNIT", "FOOT", factor)]
        units.append(make("IfcSIUnit", UnitType="AREAUNIT", Name="SQUARE_METRE"))
        self.context = make(
            "IfcGeometricRepresentationContext",
            ContextType="Model",
            CoordinateSpaceDimension=3,
            Precision=1e-5,
            WorldCoordinateSystem=self.axes(),
        )
        self.project = make(
            "IfcProject",
            GlobalId=self.guid(),
            Name="project",
            RepresentationContexts=[self.context],
            UnitsInContext=make("IfcUnitAssignment", Units=units),
        )
        self.site = self.spatial("IfcSite", "site", self.project)
        self.building = self.spatial("IfcBuilding", "building", self.site)

    def guid(self) -> str:
        """Returns the next id, which is the same in each run."""
        self.count += 1
        return f"0{self.count:021d}"

    def axes(self, at: Sequence[float] = (0, 0, 0), x: Sequence[float] = (1, 0, 0)) -> Entity:
        """Returns axes at a point, z up."""
        make = self.file.create_entity
        return make(
            "IfcAxis2Placement3D",
            make("IfcCartesianPoint", [float(v) for v in at]),
            make("IfcDirection", (0.0, 0.0, 1.0)),
            make("IfcDirection", [float(v) for v in x]),
        )

    def placed(self, at: Sequence[float] = (0, 0, 0), within: Entity = None, x: Sequence[float] = (1, 0, 0)) -> Entity:
        """Returns a placement."""
        return self.file.create_entity("IfcLocalPlacement", within, self.axes(at, x))

    def spatial(self, kind: str, name: str, above: Entity, **attributes: Any) -> Entity:
        """Adds a site, a building, a storey."""
        entity = self.file.create_entity(kind, GlobalId=self.guid(), Name=name, ObjectPlacement=self.placed(), **attributes)
        self.file.create_entity("IfcRelAggregates", GlobalId=self.guid(), RelatingObject=above, RelatedObjects=[entity])
        return entity

    def storey(self, name: str, elevation: float) -> Entity:
        """Adds a storey."""
        return self.spatial("IfcBuildingStorey", name, self.building, Elevation=float(elevation))

    def extrusion(self, size: Sequence[float], at: Sequence[float] = (0, 0, 0)) -> Entity:
        """Returns a box with its lower middle at a point."""
        make = self.file.create_entity
        flat = make("IfcAxis2Placement2D", make("IfcCartesianPoint", (0.0, 0.0)))
        profile = make("IfcRectangleProfileDef", "AREA", None, flat, float(size[0]), float(size[1]))
        return make("IfcExtrudedAreaSolid", profile, self.axes(at), make("IfcDirection", (0.0, 0.0, 1.0)), float(size[2]))

    def cylinder(self, radius: float, height: float) -> Entity:
        """Returns an upright cylinder."""
        make = self.file.create_entity
        flat = make("IfcAxis2Placement2D", make("IfcCartesianPoint", (0.0, 0.0)))
        profile = make("IfcCircleProfileDef", "AREA", None, flat, float(radius))
        return make("IfcExtrudedAreaSolid", profile, self.axes(), make("IfcDirection", (0.0, 0.0, 1.0)), float(height))

    def faceted(self, corners: Sequence[Sequence[float]], faces: Sequence[Sequence[int]]) -> Entity:
        """Returns a faceted boundary representation."""
        make = self.file.create_entity
        points = [make("IfcCartesianPoint", [float(v) for v in corner]) for corner in corners]
        bounds = [make("IfcFaceOuterBound", make("IfcPolyLoop", [points[i] for i in face]), True) for face in faces]
        return make("IfcFacetedBrep", make("IfcClosedShell", [make("IfcFace", [bound]) for bound in bounds]))

    def body(self, *items: Entity, kind: str = "SweptSolid") -> Entity:
        """Returns a representation of items."""
        return self.file.create_entity("IfcShapeRepresentation", self.context, "Body", kind, list(items))

    def mapped(self, representation: Entity) -> Entity:
        """Returns the source of mapped items."""
        return self.file.create_entity("IfcRepresentationMap", self.axes(), representation)

    def use(self, source: Entity, at: Sequence[float] = (0, 0, 0)) -> Entity:
        """Returns a mapped item."""
        make = self.file.create_entity
        target = make("IfcCartesianTransformationOperator3D", None, None, make("IfcCartesianPoint", [float(v) for v in at]), 1.0, None)
        return make("IfcMappedItem", source, target)

    def product(self, kind: str, name: str, body: Entity, at: Sequence[float] = (0, 0, 0), within: Entity = None, **more: Any) -> Entity:
        """Adds a product, in the storey `within`."""
        make = self.file.create_entity
        placement = more.pop("placement", None) or self.placed(at)
        product = make(
            kind,
            GlobalId=more.pop("guid", None) or self.guid(),
            Name=name,
            ObjectPlacement=placement,
            Representation=make("IfcProductDefinitionShape", None, None, [body]),
            **more,
        )
        if within is not None:
            make("IfcRelContainedInSpatialStructure", self.guid(), None, None, None, [product], within)
        return product

    def void(self, product: Entity, body: Entity, at: Sequence[float] = (0, 0, 0)) -> Entity:
        """Cuts an opening into a product."""
        opening = self.product("IfcOpeningElement", "opening", body, placement=self.placed(at, product.ObjectPlacement))
        self.file.create_entity("IfcRelVoidsElement", self.guid(), None, None, None, product, opening)
        return opening

    def fill(self, opening: Entity, product: Entity) -> None:
        """Puts a product into an opening."""
        self.file.create_entity("IfcRelFillsElement", self.guid(), None, None, None, opening, product)

    def properties(self, owner: Entity, name: str, values: dict[str, tuple[str, Any]]) -> None:
        """Adds a property set; values are pairs of measure and number."""
        make = self.file.create_entity
        single = [make("IfcPropertySingleValue", key, None, make(kind, value), None) for key, (kind, value) in values.items()]
        definition = make("IfcPropertySet", self.guid(), None, name, None, single)
        make("IfcRelDefinesByProperties", self.guid(), None, None, None, [owner], definition)

    def color(self, item: Entity, red: float, green: float, blue: float, clear: float = 0.0) -> None:
        """Gives an item a style."""
        make = self.file.create_entity
        shading = make("IfcSurfaceStyleRendering", make("IfcColourRgb", None, red, green, blue), clear, ReflectanceMethod="FLAT")
        make("IfcStyledItem", item, [make("IfcSurfaceStyle", None, "BOTH", [shading])], None)

    def write(self, path: Path) -> Path:
        """Writes the file."""
        self.file.write(str(path))
        return path
