# SPDX-License-Identifier: Apache-2.0
"""IFC models that the tests write."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("ifcopenshell")

from conversions import convert
from ifc_model import IfcModel
from strake.importers.ifc import chunks, conversion
from strake.importers.ifc.entity import Model
from strake.importers.ifc.kernels import shapes_of
from strake.importers.ifc.pinched import split_outline
from strake.importers.ifc.source import open_model
from strake.importers.report import Report
from strake.importers.supervision import Attempt

CUBE = [(x, y, z) for x in (0, 100) for y in (0, 100) for z in (0, 100)]
CUBE_FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4", "IFC4X3_ADD2"])
def test_a_wall_with_a_window_on_a_storey(tmp_path: Path, schema: str) -> None:
    model = IfcModel(schema)
    storey = model.storey("Level 2", 3000)
    wall = model.product("IfcWall", "W1", model.body(model.extrusion((4000, 200, 2500))), (0, 0, 3000), storey, Tag="t")
    opening = model.void(wall, model.body(model.extrusion((1000, 400, 1000), (0, 0, 900))))
    window = model.product("IfcWindow", "F1", model.body(model.extrusion((1000, 60, 1000))), (0, 0, 3900))
    model.fill(opening, window)
    model.product("IfcSpace", "room", model.body(model.extrusion((3000, 3000, 2500))))
    model.properties(wall, "Pset_WallCommon", {"FireRating": ("IfcLabel", "F60"), "IsExternal": ("IfcBoolean", True)})
    outcome = convert(model.write(tmp_path / "a.ifc"))
    glb = outcome.glb
    assert glb.ids == [wall.GlobalId, window.GlobalId]
    assert glb.path(wall.GlobalId) == glb.path(window.GlobalId) == ["site", "building", "Level 2"]
    assert glb.volume(wall.GlobalId) == pytest.approx((4000 * 2500 - 1000 * 1000) * 200, rel=1e-6)
    assert glb.box(wall.GlobalId)[0] == pytest.approx([-2000, -100, 3000], abs=1e-3)
    attributes = glb.attributes(wall.GlobalId)
    assert attributes["class"] == "IfcWall" and attributes["Tag"] == "t"
    assert attributes["Pset_WallCommon"] == {"FireRating": "F60", "IsExternal": True}
    assert outcome.reported("note")[0]["message"].endswith("1 openings, 1 spaces")
    assert outcome.reported("skipped") == [] and outcome.reported("warning") == []
    storeys = [node["extras"]["attributes"] for node in glb.nodes if node["name"] == "Level 2"]
    assert storeys == [{"Storey": "Level 2", "StoreyId": storey.GlobalId, "StoreyElevation": "3000 mm"}]
    assert (outcome.lines[-1]["format"], outcome.lines[-1]["unit"]) == (schema, "mm")


def test_mapped_items_and_equal_bodies_are_one_shape(tmp_path: Path) -> None:
    model = IfcModel()
    chair = model.mapped(model.body(model.extrusion((400, 400, 900))))
    seats = [
        model.product("IfcFurniture", f"seat {i}", model.body(model.use(chair), kind="MappedRepresentation"), (i * 1000, 0, 0))
        for i in range(40)
    ]
    posts = [model.product("IfcColumn", f"post {i}", model.body(model.extrusion((100, 100, 3000), (i * 70.1, 0, 0)))) for i in range(3)]
    glb = convert(model.write(tmp_path / "a.ifc")).glb
    assert len({glb.node(seat.GlobalId)["mesh"] for seat in seats}) == 1
    assert len({glb.node(post.GlobalId)["mesh"] for post in posts}) == 1
    assert glb.box(seats[39].GlobalId)[0] == pytest.approx([38800, -200, 0], abs=1e-3)
    assert glb.box(posts[2].GlobalId)[0] == pytest.approx([90.2, -50, 0], abs=1e-3)


@pytest.mark.parametrize(
    ("prefix", "foot", "millimetres", "length", "named"),
    [
        ("MILLI", False, 1, "2500 mm", "mm"),
        (None, False, 1000, "2500 m", "m"),
        ("CENTI", False, 10, "2500 cm", "cm"),
        (None, True, 304.8, "2500 ft", "ft"),
    ],
)
def test_units_of_length(tmp_path: Path, prefix: str | None, foot: bool, millimetres: float, length: str, named: str) -> None:
    model = IfcModel(prefix=prefix, foot=foot)
    beam = model.product("IfcBeam", "b", model.body(model.extrusion((2500, 10, 10))))
    values = {"Length": ("IfcPositiveLengthMeasure", 2500.0000000001), "Area": ("IfcAreaMeasure", 2.5), "N": ("IfcInteger", 3)}
    model.properties(beam, "Qto_BeamBaseQuantities", values)
    outcome = convert(model.write(tmp_path / "a.ifc"))
    low, high = outcome.glb.box(beam.GlobalId)
    assert high[0] - low[0] == pytest.approx(2500 * millimetres, rel=1e-6)
    assert outcome.glb.attributes(beam.GlobalId)["Qto_BeamBaseQuantities"] == {"Length": length, "Area": 2.5, "N": 3}
    assert outcome.lines[-1]["unit"] == named


def test_styles_split_a_shape(tmp_path: Path) -> None:
    model = IfcModel()
    frame, pane = model.extrusion((1000, 60, 100)), model.extrusion((900, 10, 800), (0, 0, 100))
    model.color(frame, 1, 0, 0)
    model.color(pane, 0.2, 0.4, 0.6, 0.75)
    window = model.product("IfcWindow", "w", model.body(frame, pane))
    glb = convert(model.write(tmp_path / "a.ifc")).glb
    parts = glb.json["meshes"][glb.node(window.GlobalId)["mesh"]]["primitives"]
    factors = [glb.json["materials"][part["material"]]["pbrMetallicRoughness"]["baseColorFactor"] for part in parts]
    assert sorted(factor[3] for factor in factors) == [0.25, 1]
    assert [1, 0, 0, 1] in factors


def test_large_coordinates_and_places_on_the_map(tmp_path: Path) -> None:
    model = IfcModel()
    make = model.file.create_entity
    crs = make("IfcProjectedCRS", Name="EPSG:25832")
    make("IfcMapConversion", model.context, crs, 463000.5, 5428000.25, 110.0, 1.0, 0.0)
    far = model.product("IfcColumn", "far", model.body(model.extrusion((300, 300, 3000))), (463_000_123.004, 5_428_000_456.007, 0))
    outcome = convert(model.write(tmp_path / "a.ifc"))
    low, _ = outcome.glb.box(far.GlobalId)
    assert low == pytest.approx([462_999_973.004, 5_428_000_306.007, 0], abs=1e-3)
    assert "ifc-map-conversion" in [line["code"] for line in outcome.reported("note")]


def test_curves_stay_within_a_millimetre(tmp_path: Path) -> None:
    model = IfcModel()
    tanks = {r: model.product("IfcTank", f"r{r}", model.body(model.cylinder(r, 100))) for r in (10, 500, 5000)}
    glb = convert(model.write(tmp_path / "a.ifc")).glb
    for radius, tank in tanks.items():
        triangles = glb.triangles(tank.GlobalId)
        sides = triangles[np.ptp(triangles[:, :, 2], axis=1) > 0]
        middles = (sides + sides[:, [1, 2, 0]]) / 2
        rims = [math.hypot(x, y) for x, y, _ in triangles.reshape(-1, 3) if math.hypot(x, y) > radius / 2]
        assert rims == pytest.approx([radius] * len(rims), abs=1e-2)
        along = [math.hypot(x, y) for x, y, z in middles.reshape(-1, 3) if z in (0, 100)]
        assert min(along) > radius - 1.01


def test_faulty_and_impossible_bodies_cost_only_themselves(tmp_path: Path) -> None:
    model = IfcModel()
    good = model.product("IfcBuildingElementProxy", "good", model.body(model.faceted(CUBE, CUBE_FACES), kind="Brep"))
    vast = model.product("IfcBuildingElementProxy", "vast", model.body(model.extrusion((100, 100, 12345.5))))
    flat = model.product("IfcBuildingElementProxy", "flat", model.body(model.faceted(CUBE, [(0, 0, 0)]), kind="Brep"))
    path = model.write(tmp_path / "a.ifc")
    path.write_text(path.read_text().replace("12345.5", "1E300"))
    outcome = convert(path)
    assert good.GlobalId in outcome.glb.ids
    skipped = {line["object"]: line["message"] for line in outcome.reported("skipped")}
    assert set(skipped) == {vast.GlobalId, flat.GlobalId}
    assert "IfcBuildingElementProxy 'flat'" in skipped[flat.GlobalId]


def test_mapped_items_of_nothing_cost_only_their_product(tmp_path: Path) -> None:
    model = IfcModel()
    chair = model.mapped(model.body(model.extrusion((400, 400, 900))))
    seats = [
        model.product("IfcFurniture", f"seat {i}", model.body(model.use(chair), kind="MappedRepresentation"), (i * 1000, 0, 0))
        for i in range(2)
    ]
    file = model.write(tmp_path / "a.ifc")
    text, count = re.subn(r"(IFCMAPPEDITEM\()#\d+", r"\1$", file.read_text(), count=1)
    assert count == 1
    file.write_text(text)
    outcome = convert(file)
    assert outcome.glb.ids == [seats[1].GlobalId]
    assert "1 products have a shape that is no body" in outcome.reported("note")[-1]["message"]


# Two triangles that meet in a point, as one outline, below and above.
PINCHED = [(x, y, z) for z in (0, 50) for x, y in ((-20, -10), (0, 0), (20, -10), (20, 10), (0, 0), (-20, 10))]
PINCHED_FACES = [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *((i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6))]


def test_outlines_that_touch_themselves_lose_nothing_by_any_product_that_has_them(tmp_path: Path) -> None:
    model = IfcModel()
    wedge = model.mapped(model.body(model.faceted(PINCHED, PINCHED_FACES), kind="Brep"))
    wedges = [
        model.product("IfcFooting", f"wedge {i}", model.body(model.use(wedge), kind="MappedRepresentation"), (i * 100, 0, 0))
        for i in range(3)
    ]
    outcome = convert(model.write(tmp_path / "a.ifc"))
    assert outcome.reported("skipped") == outcome.reported("warning") == []
    assert [outcome.glb.volume(one.GlobalId) for one in wedges] == [pytest.approx(2 * 20 * 10 * 50, rel=1e-6)] * 3
    assert len({outcome.glb.node(one.GlobalId)["mesh"] for one in wedges}) == 1


# The same with one point where they meet, which the text of the file shows.
SEEN_FACES = [(5, 1, 3, 2, 1, 0), (6, 7, 8, 9, 7, 11), *PINCHED_FACES[2:]]


def kernels_asked(monkeypatch: pytest.MonkeyPatch, path: Path) -> tuple[list[tuple[int, ...]], conversion.Conversion]:
    """Converts a file, and returns the products of each call of a kernel."""
    asked: list[tuple[int, ...]] = []

    def noted(model: Model, products: Iterable[int], *more: Any) -> Any:
        asked.append(tuple(products))
        return shapes_of(model, asked[-1], *more)

    monkeypatch.setattr(chunks, "shapes_of", noted)
    with Report(path.parent / "report") as report:
        model = open_model(path, report, path.parent)
        products = [product for product in model.by_type("IfcProduct") if product.get("Representation")]
        made = conversion.convert_products(model, products, 1, report, path.parent, attempt=Attempt())
    return asked, made


def test_outlines_that_touch_themselves_by_the_text_are_made_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shapes = []
    for name, faces, calls in (("seen", SEEN_FACES, 1), ("pinched", PINCHED_FACES, 2)):
        model = IfcModel()
        wedge = model.mapped(model.body(model.faceted(PINCHED, faces), kind="Brep"))
        wedges = [
            model.product("IfcFooting", "w", model.body(model.use(wedge), kind="MappedRepresentation"), (i * 100, 0, 0)) for i in (0, 1)
        ]
        model.product("IfcColumn", "c", model.body(model.extrusion((10, 10, 10))))
        asked, made = kernels_asked(monkeypatch, model.write(tmp_path / f"{name}.ifc"))
        assert len(asked) == calls and not made.failed and not made.remarks
        shapes.append({made.placed[wedge.id()].key for wedge in wedges})
    assert shapes[0] == shapes[1]


def test_a_body_of_which_more_is_wrong_is_what_it_is_without_the_text(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # A hole in the cap touches itself, too, and no such face is split.
    outcomes = []
    for name, faces in (("seen", SEEN_FACES), ("pinched", PINCHED_FACES)):
        model = IfcModel()
        brep = model.faceted(PINCHED, faces)
        make = model.file.create_entity
        points = [make("IfcCartesianPoint", (x, 0.0, z)) for x, z in ((0.0, 60.0), (9.0, 60.0), (0.0, 60.0), (0.0, 70.0))]
        line = make("IfcFace", [make("IfcFaceOuterBound", make("IfcPolyLoop", [points[i] for i in (0, 1, 2, 1)]), True)])
        brep.Outer.CfsFaces = [*brep.Outer.CfsFaces, line]
        model.product("IfcFooting", "w", model.body(brep, kind="Brep"))
        asked, made = kernels_asked(monkeypatch, model.write(tmp_path / f"{name}.ifc"))
        outcomes.append((made.failed.keys(), {(one.key, one.kernel) for one in made.placed.values()}, [*made.remarks.values()], asked[-1]))
    assert outcomes[0] == outcomes[1]
    assert len(outcomes[0][2]) == 1


def test_outlines_fall_apart_where_they_come_to_a_place_again() -> None:
    assert split_outline("abcd") == [[0, 1, 2, 3]]
    assert split_outline("abcadc") == [[0, 1, 2], [0, 4, 5]]
    # There and back is no area; within what was cut off places are free again.
    assert split_outline("abcbdea") == [[0, 1, 4, 5]]
    assert split_outline("xabcayzbx") == [[1, 2, 3], [0, 1, 5, 6, 7]]


def test_double_ids_become_unique_in_a_lasting_way(tmp_path: Path) -> None:
    model = IfcModel()
    body = model.body(model.extrusion((1, 1, 1)))
    for name in ("a", "b", "c"):
        model.product("IfcColumn", name, body, guid="1111111111111111111111")
    outcome = convert(model.write(tmp_path / "a.ifc"))
    assert outcome.glb.ids == ["1" * 22, "1" * 22 + "~2", "1" * 22 + "~3"]
    assert [outcome.glb.node(i)["name"] for i in outcome.glb.ids] == ["a", "b", "c"]
    assert [line["code"] for line in outcome.reported("warning")] == ["ifc-double-id"] * 2


def test_placements_that_go_round_in_circles(tmp_path: Path) -> None:
    model = IfcModel()
    first = model.placed((1, 0, 0))
    first.PlacementRelTo = model.placed((2, 0, 0), first)
    model.product("IfcColumn", "round", model.body(model.extrusion((10, 10, 10))), placement=first)
    good = model.product("IfcColumn", "good", model.body(model.extrusion((10, 10, 11))))
    outcome = convert(model.write(tmp_path / "a.ifc"))
    assert outcome.glb.ids == [good.GlobalId]
    assert "placed relative to itself" in outcome.reported("skipped")[0]["message"]


def test_assemblies_are_groups_and_parts_of_each_other_end(tmp_path: Path) -> None:
    model = IfcModel()
    storey = model.storey("EG", 0)
    make = model.file.create_entity
    stair = make("IfcStair", GlobalId=model.guid(), Name="stair", ObjectPlacement=model.placed())
    make("IfcRelContainedInSpatialStructure", model.guid(), None, None, None, [stair], storey)
    flight = model.product("IfcStairFlight", "flight", model.body(model.extrusion((10, 10, 10))))
    make("IfcRelAggregates", GlobalId=model.guid(), RelatingObject=stair, RelatedObjects=[flight])
    one, two = (model.product("IfcElementAssembly", name, model.body(model.extrusion((10, 10, 9)))) for name in ("one", "two"))
    for above, below in ((one, two), (two, one)):
        make("IfcRelAggregates", GlobalId=model.guid(), RelatingObject=above, RelatedObjects=[below])
    outcome = convert(model.write(tmp_path / "a.ifc"))
    assert outcome.glb.path(flight.GlobalId) == ["site", "building", "EG", "stair"]
    assert {line["object"] for line in outcome.reported("skipped")} == {one.GlobalId, two.GlobalId}
    assert all("part of itself" in line["message"] for line in outcome.reported("skipped"))


def test_material_type_system_and_own_values_before_those_of_the_type(tmp_path: Path) -> None:
    model = IfcModel()
    make = model.file.create_entity
    pipe = model.product("IfcPipeSegment", "p", model.body(model.cylinder(50, 1000)), PredefinedType="NOTDEFINED")
    values = [make("IfcPropertySingleValue", n, None, make("IfcLabel", v), None) for n, v in (("Status", "NEW"), ("Reference", "DN100"))]
    kind = make("IfcPipeSegmentType", GlobalId=model.guid(), Name="DN100", PredefinedType="RIGIDSEGMENT")
    kind.HasPropertySets = [make("IfcPropertySet", model.guid(), None, "Pset_PipeSegmentTypeCommon", None, values)]
    make("IfcRelDefinesByType", model.guid(), None, None, None, [pipe], kind)
    model.properties(pipe, "Pset_PipeSegmentTypeCommon", {"Status": ("IfcLabel", "EXISTING")})
    layers = [make("IfcMaterialLayer", make("IfcMaterial", name), 1.0) for name in ("steel", "wool", "steel")]
    make("IfcRelAssociatesMaterial", model.guid(), None, None, None, [pipe], make("IfcMaterialLayerSet", layers))
    system = make("IfcDistributionSystem", GlobalId=model.guid(), Name="DHW")
    make("IfcRelAssignsToGroup", GlobalId=model.guid(), RelatedObjects=[pipe], RelatingGroup=system)
    make("IfcPresentationLayerAssignment", "M-PIPE", None, [pipe.Representation.Representations[0]])
    attributes = convert(model.write(tmp_path / "a.ifc")).glb.attributes(pipe.GlobalId)
    assert attributes["Pset_PipeSegmentTypeCommon"] == {"Status": "EXISTING", "Reference": "DN100"}
    stated = {name: attributes[name] for name in ("Type", "PredefinedType", "Material", "System", "Layer")}
    assert stated == {"Type": "DN100", "PredefinedType": "RIGIDSEGMENT", "Material": "steel; wool", "System": "DHW", "Layer": "M-PIPE"}


def test_bytes_are_the_same_for_any_number_of_threads(tmp_path: Path) -> None:
    model = IfcModel()
    for i in range(60):
        wall = model.product("IfcWall", f"w{i}", model.body(model.extrusion((1000 + i % 7, 100, 2000))), (0, 300 * i, 0))
        if i % 5 == 0:
            model.void(wall, model.body(model.extrusion((300, 300, 500), (0, 0, 100))))
    path = model.write(tmp_path / "a.ifc")
    outcomes = [convert(path, threads) for threads in (1, 2, 5)]
    assert len({outcome.output.read_bytes() for outcome in outcomes}) == 1
    assert len(outcomes[0].glb.ids) == 60
    reported = [[line for line in outcome.lines if "progress" not in line] for outcome in outcomes]
    assert reported[0] == reported[1] == reported[2]


def test_a_box_around_a_product_is_no_body(tmp_path: Path) -> None:
    model = IfcModel()
    make = model.file.create_entity
    corner = make("IfcCartesianPoint", (0.0, 0.0, 0.0))
    box = make("IfcShapeRepresentation", model.context, "Box", "BoundingBox", [make("IfcBoundingBox", corner, 1.0, 1.0, 1.0)])
    model.product("IfcWall", "w", box)
    assert "no product with a body" in convert(model.write(tmp_path / "a.ifc")).lines[-1]["error"]
    other = model.product("IfcWall", "o", model.body(model.extrusion((100, 100, 100))))
    outcome = convert(model.write(tmp_path / "a.ifc"))
    assert outcome.glb.ids == [other.GlobalId] and outcome.reported("skipped") == []
    assert [line["code"] for line in outcome.reported("note")][-1] == "ifc-no-shape-stated"


def test_walls_of_which_openings_leave_nothing(tmp_path: Path) -> None:
    model = IfcModel()
    wall = model.product("IfcWall", "w", model.body(model.extrusion((1000, 100, 1000))))
    model.void(wall, model.body(model.extrusion((2000, 200, 2000), (0, 0, -500))))
    other = model.product("IfcWall", "o", model.body(model.extrusion((100, 100, 100))))
    outcome = convert(model.write(tmp_path / "a.ifc"))
    assert outcome.glb.ids == [other.GlobalId] and outcome.reported("skipped") == []
    assert [line["code"] for line in outcome.reported("warning")] == ["ifc-cut-away"]
