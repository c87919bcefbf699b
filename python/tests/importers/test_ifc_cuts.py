# SPDX-License-Identifier: Apache-2.0
"""Openings and half-spaces that manifold3d cuts, and what it leaves to Open CASCADE."""

from __future__ import annotations

import math
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("ifcopenshell")
pytest.importorskip("manifold3d", reason="needs manifold3d: pip install 'strake[ifc]'")

from conversions import convert
from ifc_model import IfcModel
from strake.importers.ifc import conversion, workers
from strake.importers.ifc.chunks import Answer, Chunk, Converted, convert_chunk
from strake.importers.ifc.entity import Model
from strake.importers.ifc.kernels import CUT, EXACT, kernels_for
from strake.importers.ifc.products import choose_products
from strake.importers.ifc.solids import Mesh, Unfit, difference
from strake.importers.ifc.source import open_model
from strake.importers.ifc.workers import Workers
from strake.importers.report import Report
from strake.importers.shapes import PreparedShape

# Of this sag curves do not count where volumes are compared.
FINE_M = 0.00002


def box(low: Sequence[float], high: Sequence[float]) -> Mesh:
    """A box of twelve triangles."""
    corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])], dtype=np.float64)
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [part for a, b, c, d in faces for part in ((a, b, c), (a, c, d))]
    return Mesh(corners, np.array(triangles, dtype=np.int64))


def turned(mesh: Mesh, angle: float) -> Mesh:
    """The mesh, turned about z."""
    c, s = np.cos(angle), np.sin(angle)
    return Mesh(mesh.vertices @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), mesh.triangles)


def measures(meshes: Iterable[Mesh]) -> tuple[float, float]:
    """Volume and area."""
    volume = area = 0.0
    for mesh in meshes:
        a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
        volume += float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)
        area += float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    return volume, area


WALL = box((0, 0, 0), (4000, 200, 2500))


@pytest.mark.parametrize("off", [0.0, 1e-9, -1e-9, 0.003, -0.003])
def test_an_opening_that_ends_nearly_in_a_face_leaves_no_skin(off: float) -> None:
    ((left,),) = difference([WALL], [box((1000, off, 500), (2000, 200 - off, 1500))])
    volume, area = measures([left])
    assert volume == pytest.approx((4000 * 2500 - 1000 * 1000) * 200, rel=1e-9)
    assert area == pytest.approx(2 * (4000 * 2500 - 1000 * 1000) + 2 * (4000 + 2500) * 200 + 4 * 1000 * 200, rel=1e-9)


@pytest.mark.parametrize("off", [0.011, 0.02, 0.05, 0.09, 0.1])
@pytest.mark.parametrize("angle", [0.0, 0.3])
def test_an_opening_that_ends_near_a_face_is_left_to_others(off: float, angle: float) -> None:
    # Open CASCADE takes them for one where they are nearer than 0.1 mm.
    for offset in (off, -off):
        with pytest.raises(Unfit, match="nearly on each other"):
            difference([turned(WALL, angle)], [turned(box((1000, offset, 500), (2000, 200 - offset, 1500)), angle)])
    with pytest.raises(Unfit, match="nearly on each other"):
        difference([WALL], [box((1000, -5, 500), (1500, 205, 1500)), box((1500 + off, -5, 500), (2000, 205, 1500))])
    ((left,),) = difference([WALL], [box((1000, 0.11, 500), (2000, 199.89, 1500))])
    assert measures([left])[0] == pytest.approx(4000 * 2500 * 200 - 1000 * 1000 * 199.78, rel=1e-9)


@pytest.mark.parametrize("length", [4000, 20000])
@pytest.mark.parametrize("angle", [1e-6, 3e-6, 5e-6, 7e-6, 1e-5, 3e-5])
def test_a_wall_that_is_hardly_aslant_keeps_no_skin(length: float, angle: float) -> None:
    opening = box((500, 0, 500), (1500, 200, 1500))
    try:
        ((left,),) = difference([turned(box((0, 0, 0), (length, 200, 2500)), angle)], [turned(opening, angle)])
    except Unfit:
        assert length * angle > 0.009
        return
    assert measures([left])[1] == pytest.approx(2 * (length * 2500 - 1e6) + 2 * (length + 2500) * 200 + 4 * 1000 * 200, rel=1e-6)


def test_openings_side_by_side_leave_no_skin_between() -> None:
    ((left,),) = difference([WALL], [box((1000, -5, 500), (1500, 205, 1500)), box((1500 + 1e-9, -5, 500), (2000, 205, 1500))])
    ((as_one,),) = difference([WALL], [box((1000, -5, 500), (2000, 205, 1500))])
    assert measures([left]) == pytest.approx(measures([as_one]), rel=1e-9)


def test_a_recess_and_a_wall_in_two() -> None:
    ((recessed,),) = difference([WALL], [box((1000, -5, 500), (2000, 50, 1500))])
    assert measures([recessed])[0] == pytest.approx(4000 * 2500 * 200 - 1000 * 1000 * 50, rel=1e-9)
    (halves,) = difference([WALL], [box((1000, -5, -5), (2000, 205, 2505))])
    assert measures(halves)[0] == pytest.approx(3000 * 2500 * 200, rel=1e-9)
    assert difference([WALL, box((5000, 0, 0), (5100, 100, 100))], [box((-5, -5, -5), (4005, 205, 2505))])[0] == []


def test_bodies_that_are_inside_out_are_turned() -> None:
    inverted = Mesh(WALL.vertices, WALL.triangles[:, ::-1])
    opening = box((1000, -5, 500), (2000, 205, 1500))
    ((left,),) = difference([inverted], [Mesh(opening.vertices, opening.triangles[:, ::-1])])
    assert measures([left])[0] == pytest.approx((4000 * 2500 - 1000 * 1000) * 200, rel=1e-9)


def test_what_cannot_be_decided_for_sure_is_left_to_others() -> None:
    opening = box((1000, -5, 500), (2000, 205, 1500))
    with pytest.raises(Unfit, match="not closed"):
        difference([Mesh(WALL.vertices, WALL.triangles[1:])], [opening])
    with pytest.raises(Unfit, match="not closed"):
        difference([WALL], [Mesh(opening.vertices, opening.triangles[1:])])
    hollow = box((100, 50, 100), (200, 150, 200))
    both = Mesh(np.concatenate([WALL.vertices, hollow.vertices]), np.concatenate([WALL.triangles, hollow.triangles[:, ::-1] + 8]))
    with pytest.raises(Unfit, match="hollow"):
        difference([both], [opening])
    # Aslant no corner can be put into the plane of a face to the last bit.
    flush = box((1000, 0, 500), (2000, 200, 1500))
    with pytest.raises(Unfit, match="aslant"):
        difference([turned(WALL, 0.3)], [turned(flush, 0.3)])
    ((left,),) = difference([turned(WALL, 0.3)], [turned(opening, 0.3)])
    assert measures([left])[0] == pytest.approx((4000 * 2500 - 1000 * 1000) * 200, rel=1e-9)


def shapes(model: Model, numbers: Sequence[int], kernel: str) -> dict[int, tuple[Converted, PreparedShape | None]]:
    """What a kernel makes of products."""
    found: dict[int, tuple[Converted, PreparedShape | None]] = {}
    by_key: dict[bytes, PreparedShape] = {}
    for answer in chain.from_iterable(convert_chunk(model, Chunk(tuple(numbers), kernel), FINE_M)):
        if isinstance(answer, Converted):
            if answer.shape is not None:
                by_key[answer.shape.key] = answer.shape
            found[answer.product] = (answer, by_key.get(answer.key))
    return found


def of_shape(shape: PreparedShape) -> tuple[float, float]:
    """Volume and area of what is prepared for the scene."""
    meshes = []
    for part in shape.parts:
        vertices = np.frombuffer(part.positions, "<f4").reshape(-1, 3).astype(np.float64)
        triangles = np.frombuffer(part.indices, "<u2" if part.vertex_count < 65536 else "<u4").reshape(-1, 3)
        meshes.append(Mesh(vertices, triangles.astype(np.int64)))
    return measures(meshes)


def plane(model: IfcModel, at: Sequence[float], normal: Sequence[float]) -> Any:
    """An IfcPlane."""
    make = model.file.create_entity
    point = make("IfcCartesianPoint", [float(v) for v in at])
    x = (0.0, 1.0, 0.0) if normal[1] == 0 else (1.0, 0.0, 0.0)
    return make("IfcPlane", make("IfcAxis2Placement3D", point, make("IfcDirection", [float(v) for v in normal]), make("IfcDirection", x)))


def clipped_wall(model: IfcModel, agree: bool, bounded: bool) -> tuple[Any, Any, Any]:
    """A wall 4 m long and 2.5 m high under a roof of 45 degrees; returns the product, the result and what is cut."""
    make = model.file.create_entity
    solid = model.extrusion((4000, 200, 2500))
    base = plane(model, (1000, 0, 2500), (1, 0, 1) if not agree else (-1, 0, -1))
    if bounded:
        points = [make("IfcCartesianPoint", [float(v) for v in at]) for at in ((0, -500), (0, 500), (3000, 500), (3000, -500), (0, -500))]
        half = make("IfcPolygonalBoundedHalfSpace", base, agree, model.axes(), make("IfcPolyline", points))
    else:
        half = make("IfcHalfSpaceSolid", base, agree)
    result = make("IfcBooleanClippingResult", "DIFFERENCE", solid, half)
    return model.product("IfcWall", "w", model.body(result, kind="Clipping"), (1000, 2000, 3000)), result, solid


@pytest.mark.parametrize("agree", [False, True])
@pytest.mark.parametrize("bounded", [False, True])
@pytest.mark.parametrize("prefix", ["MILLI", None])
def test_half_spaces_cut_as_open_cascade_does(agree: bool, bounded: bool, prefix: str | None) -> None:
    model = IfcModel(prefix=prefix)
    wall, _, _ = clipped_wall(model, agree, bounded)
    model.void(wall, model.body(model.extrusion((500, 200, 500), (-1500, 0, 900))))
    read = Model(model.file)
    assert kernels_for(read.by_id(wall.id()), True)[0] == CUT and kernels_for(read.by_id(wall.id()), False)[0] == EXACT
    ours, theirs = (shapes(read, [wall.id()], kernel)[wall.id()] for kernel in (CUT, EXACT))
    assert ours[0].fault == "" and ours[1] is not None and theirs[1] is not None
    unit_mm = 1 if prefix else 1000
    assert of_shape(ours[1])[0] == pytest.approx((4000 * 2500 - 1000 * 1000 / 2 - 500 * 500) * 200 * unit_mm**3, rel=1e-6)
    if unit_mm == 1:  # Open CASCADE's half-spaces end after 200 m
        assert of_shape(ours[1]) == pytest.approx(of_shape(theirs[1]), rel=1e-6)
    assert np.frombuffer(ours[0].placement) == pytest.approx(np.frombuffer(theirs[0].placement))
    assert ours[0].middle == pytest.approx(theirs[0].middle, abs=1e-2 * unit_mm)


@pytest.mark.parametrize("styled", ["result", "operand", "both"])
def test_the_colour_of_what_is_cut_stays(styled: str) -> None:
    model = IfcModel()
    wall, result, solid = clipped_wall(model, False, False)
    if styled != "operand":
        model.color(result, 1, 0, 0)
    if styled != "result":
        model.color(solid, 0, 1, 0)
    read = Model(model.file)
    ours, theirs = (shapes(read, [wall.id()], kernel)[wall.id()] for kernel in (CUT, EXACT))
    assert theirs[1] is not None
    if styled == "both":
        assert "styles" in ours[0].fault
    else:
        assert ours[1] is not None and [part.color for part in ours[1].parts] == [part.color for part in theirs[1].parts]
    # The model is as it was, for the kernels that come after.
    assert model.file.by_id(wall.id()).Representation.Representations[0].Items[0].id() == result.id()
    assert [style.Item.id() for style in model.file.by_type("IfcStyledItem")][:1] == [(solid if styled == "operand" else result).id()]


def test_one_shape_with_other_openings_is_another(tmp_path: Path) -> None:
    model = IfcModel()
    panel = model.mapped(model.body(model.extrusion((1000, 50, 1000)), model.extrusion((1000, 50, 200), (0, 0, 1200))))
    panels = [
        model.product("IfcPlate", f"p{i}", model.body(model.use(panel), kind="MappedRepresentation"), (i * 2000, 0, 0)) for i in range(4)
    ]
    for i in (1, 2):
        model.void(panels[i], model.body(model.extrusion((100 * i, 200, 100), (0, 0, 400))))
    model.void(panels[3], model.body(model.extrusion((100, 200, 100), (0, 0, 400))))
    outcome = convert(model.write(tmp_path / "a.ifc"))
    volumes = [outcome.glb.volume(one.GlobalId) for one in panels]
    assert volumes == pytest.approx([60e6, 60e6 - 0.5e6, 60e6 - 1e6, 60e6 - 0.5e6], rel=1e-6)
    meshes = [outcome.glb.node(one.GlobalId)["mesh"] for one in panels]
    assert meshes[1] == meshes[3] and len(set(meshes)) == 3
    assert outcome.output.read_bytes() == convert(tmp_path / "a.ifc", threads=1).output.read_bytes()


def vertical_half(model: IfcModel, agree: bool | None, x: float = 1000) -> Any:
    """What lies beyond a plane across x, or before it where the flag agrees."""
    return model.file.create_entity("IfcHalfSpaceSolid", plane(model, (x, 0, 0), (1, 0, 0)), agree)


def faults(model: IfcModel, products: Sequence[Any]) -> list[str]:
    """Why manifold3d does not cut products, which Open CASCADE makes all the same."""
    read = Model(model.file)
    numbers = [product.id() for product in products]
    ours, theirs = (shapes(read, numbers, kernel) for kernel in (CUT, EXACT))
    assert all(theirs[number][1] is not None for number in numbers)
    return [ours[number][0].fault for number in numbers]


@pytest.mark.parametrize("shared", ["body", "opening", "item"])
@pytest.mark.parametrize("bad", ["flat", "sphere", "swept"])
def test_an_item_that_is_not_made_is_missing_from_no_product(shared: str, bad: str) -> None:
    model = IfcModel()
    make = model.file.create_entity
    if bad == "flat":
        item = model.extrusion((100, 400, 0), (1000, 0, 1000))
    elif bad == "sphere":
        item = make("IfcSphere", model.axes((1000, 0, 1000)), 300.0)
    else:
        ends = [make("IfcCartesianPoint", (1000.0, y, 1000.0)) for y in (-500.0, 500.0)]
        item = make("IfcSweptDiskSolid", make("IfcPolyline", ends), 300.0)
    source = model.mapped(model.body(model.extrusion((100, 400, 100), (0, 0, 400)), item))
    products = []
    for i in range(3):
        body, opening = (model.body(model.extrusion(size)) for size in ((4000, 200, 2500), (50, 400, 2000)))
        if shared == "body":
            body = model.body(model.use(source), kind="MappedRepresentation")
        elif shared == "opening":
            opening = model.body(model.use(source), kind="MappedRepresentation")
        else:
            opening = model.body(model.extrusion((100, 400, 100 + i), (0, 0, 400)), item)
        products.append(model.product("IfcPlate", f"p{i}", body, (i * 9000, 0, 0)))
        model.void(products[-1], opening)
    assert all(faults(model, products))


@pytest.mark.parametrize("kind", ["IfcFaceBasedSurfaceModel", "IfcShellBasedSurfaceModel"])
def test_surface_models_are_cut_and_boxes_around_bodies_are_none(kind: str) -> None:
    model = IfcModel()
    corners = [(x, y, z) for x in (0, 1000) for y in (0, 200) for z in (0, 1000)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    shell = model.faceted(corners, faces).Outer
    around = model.file.create_entity("IfcBoundingBox", model.file.create_entity("IfcCartesianPoint", (0.0, 0.0, 0.0)), 1e3, 2e2, 1e3)
    wall = model.product("IfcWall", "w", model.body(model.file.create_entity(kind, [shell]), around, kind="SurfaceModel"))
    model.void(wall, model.body(model.extrusion((100, 800, 100), (500, 0, 400))))
    ours = shapes(Model(model.file), [wall.id()], CUT)[wall.id()][1]
    assert ours is not None and of_shape(ours)[0] == pytest.approx(990_000 * 200, rel=1e-6)


def test_what_is_stated_of_an_item_is_reported_its_product(tmp_path: Path) -> None:
    model = IfcModel()
    wall = model.product("IfcWall", "w", model.body(model.extrusion((4000, 200, 2500))))
    model.void(wall, model.body(model.extrusion((100, 200, 0), (0, 0, 400)), model.extrusion((100, 200, 100), (500, 0, 400))))
    whole = model.product("IfcWall", "v", model.body(model.extrusion((4000, 200, 2500))), (0, 9000, 0))
    model.void(whole, model.body(model.extrusion((100, 200, 100))))
    read = Model(model.file)
    ours = shapes(read, [wall.id(), whole.id()], CUT)
    assert ours[wall.id()][0].fault and not ours[whole.id()][0].fault
    outcome = convert(model.write(tmp_path / "a.ifc"))
    assert "Non-positive extrusion height" in str(outcome.reported("warning"))


def test_what_several_results_cut_is_left_to_others() -> None:
    model = IfcModel()
    make = model.file.create_entity
    solid = model.extrusion((4000, 200, 2500))
    halves = [make("IfcBooleanClippingResult", "DIFFERENCE", solid, vertical_half(model, agree)) for agree in (False, True)]
    assert all(faults(model, [model.product("IfcWall", "w", model.body(*halves, kind="Clipping"))]))
    for half, red in zip(halves, (1, 0), strict=True):
        model.color(half, red, 0, 1 - red)
    walls = [model.product("IfcWall", "w", model.body(half, kind="Clipping")) for half in halves]
    walls.append(model.product("IfcWall", "w", model.body(halves[0], solid, kind="Clipping")))
    assert all(faults(model, walls))
    # A plain product with the same body keeps its colour.
    plain = model.product("IfcWall", "w", model.body(solid))
    model.void(plain, model.body(model.extrusion((100, 500, 100), (0, 0, 400))))
    ours = shapes(Model(model.file), [wall.id() for wall in [*walls, plain]], CUT)[plain.id()][1]
    theirs = shapes(Model(model.file), [plain.id()], EXACT)[plain.id()][1]
    assert ours is not None and theirs is not None
    assert [part.color for part in ours.parts] == [part.color for part in theirs.parts]
    # A step of a cut that is the body of another product.
    model = IfcModel()
    make = model.file.create_entity
    inner = make("IfcBooleanClippingResult", "DIFFERENCE", model.extrusion((4000, 200, 2500)), vertical_half(model, False))
    outer = make("IfcBooleanClippingResult", "DIFFERENCE", inner, vertical_half(model, True, -1000))
    walls = [model.product("IfcWall", "w", model.body(result, kind="Clipping")) for result in (outer, inner)]
    assert faults(model, walls)[0]


@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4"])
@pytest.mark.parametrize("relation", ["IfcRelAggregates", "IfcRelNests"])
def test_what_cuts_a_whole_cuts_its_parts_and_not_what_is_nested(schema: str, relation: str) -> None:
    model = IfcModel(schema=schema)
    make = model.file.create_entity
    whole = make("IfcWall", GlobalId=model.guid(), ObjectPlacement=model.placed())
    part = model.product("IfcBuildingElementPart", "p", model.body(model.extrusion((4000, 200, 2500))))
    make(relation, GlobalId=model.guid(), RelatingObject=whole, RelatedObjects=[part])
    model.void(whole, model.body(model.extrusion((500, 400, 500))), (1000, 0, 1000))
    model.void(part, model.body(model.extrusion((300, 400, 300))), (-1000, 0, 1000))
    read = Model(model.file)
    ours, theirs = (shapes(read, [part.id()], kernel)[part.id()][1] for kernel in (CUT, EXACT))
    assert ours is not None and theirs is not None
    assert of_shape(ours) == pytest.approx(of_shape(theirs), rel=1e-6)
    taken = 300 * 300 + (500 * 500 if relation == "IfcRelAggregates" else 0)
    assert of_shape(ours)[0] == pytest.approx((4000 * 2500 - taken) * 200, rel=1e-6)


@pytest.mark.parametrize(("agree", "x"), [(None, 1000), (False, 1e300), (False, 2e12), (True, -2e12)])
def test_a_half_space_without_a_side_or_far_out_is_left_to_others(agree: bool | None, x: float) -> None:
    model = IfcModel()
    result = model.file.create_entity(
        "IfcBooleanClippingResult", "DIFFERENCE", model.extrusion((4000, 200, 2500)), vertical_half(model, agree, x)
    )
    wall = model.product("IfcWall", "w", model.body(result, kind="Clipping"))
    fault = shapes(Model(model.file), [wall.id()], CUT)[wall.id()][0].fault
    assert ("side" if agree is None else "too far out") in fault


BOUNDARIES = [
    ([(0, -500), (1500, 500), (1500, -500), (0, 400)], False),  # a bow-tie
    ([(0, -500), (0, 400), (1500, -500), (1500, 500)], False),
    ([(0, -500), (1500, -500), (1500, 500), (0, 500), (0, -500), (1500, -500), (1500, 500), (0, 500)], False),  # twice round
    ([(0, -500), (1500, -500), (1500, 500), (1500, -500), (1500, 500), (0, 500)], False),  # there and back
    ([(0, -500), (750, 0), (1500, -500), (1500, 500), (750, 0), (0, 500)], False),  # it touches itself in a point
    ([(0, -500), (1500, -500), (1500, 500), (750, 500), (750, 0), (500, 0), (500, 500), (0, 500)], True),
    ([(0, -500), (700, -500), (1500, -500), (1500, 500), (0, 500)], True),  # a corner on a straight side
]


@pytest.mark.parametrize(("boundary", "simple"), BOUNDARIES)
@pytest.mark.parametrize("turn", [1, -1])
def test_a_boundary_that_crosses_itself_is_left_to_others(boundary: list[tuple[float, float]], simple: bool, turn: int) -> None:
    model = IfcModel()
    make = model.file.create_entity
    outline = boundary[::turn]
    points = [make("IfcCartesianPoint", [float(v) for v in at]) for at in [*outline, outline[0]]]
    half = make("IfcPolygonalBoundedHalfSpace", plane(model, (0, 0, 2000), (0, 0, 1)), False, model.axes(), make("IfcPolyline", points))
    solid = model.extrusion((4000, 200, 2500))
    wall = model.product("IfcWall", "w", model.body(make("IfcBooleanClippingResult", "DIFFERENCE", solid, half), kind="Clipping"))
    read = Model(model.file)
    ours, theirs = (shapes(read, [wall.id()], kernel)[wall.id()] for kernel in (CUT, EXACT))
    if not simple:
        assert "crosses itself" in ours[0].fault
        return
    assert ours[1] is not None and theirs[1] is not None
    assert of_shape(ours[1]) == pytest.approx(of_shape(theirs[1]), rel=1e-6)


def test_what_openings_take_away_aslant_is_cut_away(tmp_path: Path) -> None:
    model = IfcModel()
    model.product("IfcSlab", "s", model.body(model.extrusion((100, 100, 100))))
    wall = model.product("IfcWall", "w", model.body(model.extrusion((4000, 200, 2500))))
    for entity in (wall, model.void(wall, model.body(model.extrusion((4000, 200, 2500))))):
        entity.Representation.Representations[0].Items[0].Position = model.axes(x=(math.cos(0.3), math.sin(0.3), 0))
    assert "aslant" in shapes(Model(model.file), [wall.id()], CUT)[wall.id()][0].fault
    outcome = convert(model.write(tmp_path / "a.ifc"))
    assert [line["code"] for line in outcome.reported("warning")] == ["ifc-cut-away"]


def test_a_cut_that_hangs_is_made_by_open_cascade_with_all_beside_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = IfcModel()
    walls = [model.product("IfcWall", "w", model.body(model.extrusion((4000, 200, 2500))), (0, i * 900, 0)) for i in range(3)]
    for wall in walls:
        model.void(wall, model.body(model.extrusion((1000, 400, 1000), (0, 0, 900))))

    def hanging(read: Model, chunk: Chunk, sag_m: float) -> Iterator[list[Answer]]:
        while chunk.kernel == CUT:
            pass
        yield from convert_chunk(read, chunk, sag_m)

    monkeypatch.setattr(conversion, "convert_chunk", hanging)
    monkeypatch.setattr(workers, "Workers", partial(Workers, silent_s=2))
    read = Model(model.file)
    with Report(tmp_path / "report") as report:
        made = conversion.convert_products(read, [read.by_id(wall.id()) for wall in walls], 1, report, tmp_path)
    assert [made.placed[wall.id()].kernel for wall in walls] == [EXACT] * 3
    assert [made.remarks[wall.id()] for wall in walls] == [[(CUT, "no answer for 2 s")]] * 3


def test_without_manifold3d_open_cascade_cuts_and_a_note_reports_it(tmp_path: Path) -> None:
    model = IfcModel()
    wall = model.product("IfcWall", "w", model.body(model.extrusion((4000, 200, 2500))))
    model.void(wall, model.body(model.extrusion((1000, 400, 1000), (0, 0, 900))))
    path = model.write(tmp_path / "a.ifc")
    report = tmp_path / "report.jsonl"
    code = "import sys; sys.modules['manifold3d'] = None; from strake.importers.ifc import main; sys.exit(main(sys.argv[1:]))"
    arguments = ["--input", str(path), "--output", str(tmp_path / "a.glb"), "--report", str(report), "--threads", "1"]
    subprocess.run([sys.executable, "-c", code, *arguments], check=True, timeout=300)
    assert "1 products with openings or half-spaces" in report.read_text() and "pip install 'strake[ifc]'" in report.read_text()
    outcome = convert(path)
    assert "ifc-slow-cuts" not in [line["code"] for line in outcome.reported("note")]
    assert any("manifold3d" in name for name in outcome.lines[-1]["depends_on"])


DATA = Path(os.environ.get("STRAKE_DATA", "")) / "ifc"


@pytest.mark.skipif("STRAKE_DATA" not in os.environ, reason="needs STRAKE_DATA")
@pytest.mark.parametrize(
    ("name", "cut"),
    [
        ("ThatOpen_engine_web-ifc/duplex.ifc", 33),
        ("ThatOpen_engine_web-ifc/AC20-FZK-Haus.ifc", 9),
        ("ThatOpen_engine_web-ifc/Office_A_20110811.ifc", 64),
        ("opensourceBIM_TestFiles/doubleguids.ifc", 4),
    ],
)
def test_cuts_of_real_models_are_those_of_open_cascade(tmp_path: Path, name: str, cut: int) -> None:
    with tempfile.TemporaryDirectory() as folder, Report(tmp_path / "report") as report:
        model = open_model(DATA / name, report, Path(folder))
    numbers = [product.id() for product in choose_products(model).solid if kernels_for(product, True)[0] == CUT]
    ours, theirs = (shapes(model, numbers, kernel) for kernel in (CUT, EXACT))
    fit = [number for number in numbers if ours[number][1] is not None]
    assert len(fit) >= cut
    for number in fit:
        mine, other = ours[number][1], theirs[number][1]
        assert mine is not None and other is not None
        (volume, area), (volume_there, area_there) = of_shape(mine), of_shape(other)
        assert volume == pytest.approx(volume_there, rel=1e-5, abs=area_there * 1e-3), model.by_id(number)
        assert area == pytest.approx(area_there, rel=1e-4), model.by_id(number)
        assert sorted(part.color for part in mine.parts) == sorted(part.color for part in other.parts)
