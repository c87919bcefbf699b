# SPDX-License-Identifier: Apache-2.0
"""Entities of a model, and what of the schemas is taken for granted."""

from __future__ import annotations

import numpy as np
import pytest

ifcopenshell = pytest.importorskip("ifcopenshell")

from strake.importers.ifc import attributes, solids, units  # noqa: E402
from strake.importers.ifc.entity import Model  # noqa: E402

SCHEMAS = ("IFC2X3", "IFC4", "IFC4X3_ADD2")
PROPERTIES = (
    "IfcPropertySingleValue",
    "IfcPropertyEnumeratedValue",
    "IfcPropertyListValue",
    "IfcPropertyBoundedValue",
    "IfcComplexProperty",
)


@pytest.mark.parametrize("schema", SCHEMAS)
def test_properties_have_their_values_where_they_are_looked_for(schema: str) -> None:
    known = ifcopenshell.ifcopenshell_wrapper.schema_by_name(schema)
    for kind in PROPERTIES:
        declared = known.declaration_by_name(kind).as_entity()
        names = [attribute.name() for attribute in declared.all_attributes()]
        assert names[attributes.PROPERTY_NAME] == "Name"
        assert list(declared.subtypes()) == []  # so that the name of the class says it all
        if kind == "IfcPropertySingleValue":
            assert names[units.NOMINAL_VALUE] == "NominalValue" and names[units.UNIT] == "Unit"
    for kind, place in (("IfcPropertySet", attributes.OF_SET), ("IfcComplexProperty", attributes.OF_COMPLEX)):
        declared = known.declaration_by_name(kind).as_entity()
        assert [attribute.name() for attribute in declared.all_attributes()][place] == "HasProperties"


@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4"])
def test_an_attribute_that_a_class_does_not_have_is_nothing_or_an_error(schema: str) -> None:
    file = ifcopenshell.file(schema=schema)
    made = file.create_entity("IfcWall", GlobalId="0000000000000000000001", Name="w")
    relation = file.create_entity(
        "IfcRelDefinesByProperties", GlobalId="0000000000000000000002", RelatedObjects=[made],
        RelatingPropertyDefinition=file.create_entity("IfcPropertySet", GlobalId="0000000000000000000003", Name="s"),
    )  # fmt: skip
    (wall,) = Model(file).by_type("IfcWall")
    assert wall.Name == wall.get("Name") == wall.at(2) == "w"
    assert wall.get("Description", "none") is None  # the class has it, the file states nothing
    assert wall.get("Elevation") is None and wall.get("Elevation", 7) == 7
    with pytest.raises(AttributeError, match="Elevation"):
        _ = wall.Elevation
    assert [one.id() for one in wall.IsDefinedBy] == [one.id() for one in wall.get("IsDefinedBy")] == [relation.id()]
    assert wall.IsDefinedBy[0].RelatedObjects[0].Name == "w"


def test_heights_beside_others_are_those_that_differ_by_little() -> None:
    assert solids._beside_others(np.array([])).tolist() == []
    assert solids._beside_others(np.array([5.0, 5.0])).tolist() == [False, False]
    heights = np.array([300.0, 0.0, 0.05, 100.0, 0.0, 300.1, 200.2, 200.0])
    assert solids._beside_others(heights).tolist() == [True, True, True, False, True, True, False, False]
