# SPDX-License-Identifier: Apache-2.0
"""Where IFC files lie on a map, and how exactly their shapes are known: from the file to the model."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("ifcopenshell")

import strake
from conversions import convert
from ifc_model import IfcModel

CUBE = [(x, y, z) for x in (0, 100) for y in (0, 100) for z in (0, 100)]
CUBE_FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
EAST, NORTH, UP = 463000.5, 5428000.25, 110.0


@pytest.fixture(autouse=True)
def importer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Lets `strake.load` find the importer of this Python."""
    folder = tmp_path / "bin"
    folder.mkdir()
    program = folder / "strake-import-ifc"
    program.write_text(f"#!{sys.executable}\nimport sys\nfrom strake.importers.ifc import main\nsys.exit(main())\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}:{os.environ['PATH']}")
    monkeypatch.setenv("STRAKE_CACHE", str(tmp_path / "cache"))


def on_map(model: IfcModel, *numbers: Any, crs: str = "EPSG:25832", map_unit: str | None = "METRE") -> None:
    """States where the model lies."""
    make = model.file.create_entity
    unit = make("IfcSIUnit", UnitType="LENGTHUNIT", Prefix=None, Name=map_unit) if map_unit else None
    make("IfcMapConversion", model.context, make("IfcProjectedCRS", Name=crs, MapUnit=unit), *numbers)


def column(path: Path, *numbers: Any, **more: Any) -> Path:
    """Writes a file with a column of 300 x 300 x 3000 mm around (1000, 2000, 0)."""
    prefix = more.pop("prefix", "MILLI")
    model, mm = IfcModel(prefix=prefix), 1 if prefix else 0.001
    if numbers:
        on_map(model, *numbers, **more)
    body = model.body(model.extrusion((300 * mm, 300 * mm, 3000 * mm)))
    model.product("IfcColumn", "c", body, (1000 * mm, 2000 * mm, 0), model.storey("EG", 0))
    return model.write(path)


def corners(model: strake.Model, i: int = 0) -> Any:
    return model.boxes[i].round(3).tolist()


def test_coordinates_are_local_unless_those_of_the_map_are_requested(tmp_path: Path) -> None:
    file = column(tmp_path / "a.ifc", EAST, NORTH, UP, 0.0, 1.0, 0.001)
    assert corners(strake.load(file)) == [[850, 1850, 0], [1150, 2150, 3000]]
    # A quarter turn: x of the project is north of the map, y is west.
    placed = strake.load(file, georeference=True)
    low = [463000500 - 2150, 5428000250 + 850, 110000]
    high = [463000500 - 1850, 5428000250 + 1150, 113000]
    assert corners(placed) == [low, high]
    codes = [one.code for one in placed.diagnostics]
    assert "ifc-map-scale" not in codes and "map-place-unknown" not in codes
    assert placed.objects[0].attributes["MapConversion.TargetCRS"] == "EPSG:25832"


@pytest.mark.parametrize("angle", [0.3, 2.0, -1.1])
def test_placements_are_turned_in_doubles(tmp_path: Path, angle: float) -> None:
    file = column(tmp_path / "a.ifc", EAST, NORTH, UP, float(np.cos(angle)), float(np.sin(angle)), 0.001 * 0.9996)
    local, placed = strake.load(file), strake.load(file, georeference=True)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]) * 0.9996
    expected = local.mesh(0)[0] @ turn.T + np.array([EAST, NORTH, UP]) * 1000
    np.testing.assert_allclose(placed.mesh(0)[0], expected, rtol=0, atol=2e-6)


def test_a_scale_of_one_between_metres_and_millimetres_is_reported(tmp_path: Path) -> None:
    file = column(tmp_path / "a.ifc", EAST, NORTH, UP, 1.0, 0.0, 1.0)
    placed = strake.load(file, georeference=True)
    assert corners(placed) == [[463001350, 5428002100, 110000], [463001650, 5428002400, 113000]]
    assert "ifc-map-scale" in [one.code for one in placed.diagnostics]


def test_units_of_map_and_project(tmp_path: Path) -> None:
    metres = column(tmp_path / "m.ifc", EAST, NORTH, UP, 1.0, 0.0, None, prefix=None)
    assert corners(strake.load(metres, georeference=True))[0] == [463000500 + 850, 5428000250 + 1850, 110000]
    # Without a unit of its own the map has that of the project.
    own = column(tmp_path / "o.ifc", EAST * 1000, NORTH * 1000, UP * 1000, 1.0, 0.0, None, map_unit=None)
    assert corners(strake.load(own, georeference=True))[0] == [463000500 + 850, 5428000250 + 1850, 110000]


def test_files_that_do_not_meet_are_reported(tmp_path: Path) -> None:
    one = column(tmp_path / "a.ifc", EAST, NORTH, UP, 1.0, 0.0, 0.001)
    two = column(tmp_path / "b.ifc", EAST + 5, NORTH, UP, 1.0, 0.0, 0.001)
    other = column(tmp_path / "c.ifc", EAST, NORTH, UP, 1.0, 0.0, 0.001, crs="EPSG:28992")
    none = column(tmp_path / "d.ifc")

    def reported(*files: Path, georeference: bool = False) -> list[tuple[str, str, str]]:
        found = strake.load(files, georeference=georeference).diagnostics
        return [(d.code, d.severity, Path(d.where).name) for d in found if d.code.startswith("map-")]

    assert reported(one, two) == reported(two, one) == [("map-place-differs", "note", "b.ifc")]
    assert reported(one, two, georeference=True) == []
    assert len(strake.clash(strake.load([one, two]))) == 1
    assert len(strake.clash(strake.load([one, two], georeference=True))) == 0
    assert reported(one, other) == [] and reported(one, other, georeference=True) == [("map-other", "warning", "c.ifc")]
    assert reported(one, none) == [] and reported(one, none, georeference=True) == [("map-place-unknown", "warning", "d.ifc")]


@pytest.mark.parametrize("numbers", [(EAST, NORTH, UP, 0.0, 0.0, 0.001), (EAST, NORTH, UP, 1.0, 0.0, -1.0)])
def test_conversions_that_are_none(tmp_path: Path, numbers: Any) -> None:
    placed = strake.load(column(tmp_path / "a.ifc", *numbers), georeference=True)
    assert corners(placed) == [[850, 1850, 0], [1150, 2150, 3000]]
    codes = [one.code for one in placed.diagnostics]
    assert "ifc-map-unusable" in codes and "map-place-unknown" in codes


def test_how_far_triangles_are_from_their_surfaces(tmp_path: Path) -> None:
    model = IfcModel()
    wall = model.product("IfcWall", "flat", model.body(model.extrusion((4000, 200, 2500))))
    pierced = model.product("IfcWall", "pierced", model.body(model.extrusion((4000, 250, 2500))), (0, 5000, 0))
    model.void(pierced, model.body(model.cylinder(100, 3000)))
    tank = model.product("IfcTank", "round", model.body(model.cylinder(500, 100)), (0, 9000, 0))
    proxy = model.product("IfcBuildingElementProxy", "facets", model.body(model.faceted(CUBE, CUBE_FACES), kind="Brep"), (0, 12000, 0))
    make = model.file.create_entity
    flat = make("IfcAxis2Placement2D", make("IfcCartesianPoint", (0.0, 0.0)))
    beams = []
    for at, radius in ((15000, None), (18000, 12.0)):
        profile = make("IfcIShapeProfileDef", "AREA", None, flat, 100.0, 200.0, 6.0, 9.0, radius)
        solid = make("IfcExtrudedAreaSolid", profile, model.axes(), make("IfcDirection", (0.0, 0.0, 1.0)), 3000.0)
        beams.append(model.product("IfcBeam", f"beam {radius}", model.body(solid), (0, at, 0)))
    glb = convert(model.write(tmp_path / "a.ifc")).glb
    sags = [glb.json["meshes"][glb.node(p.GlobalId)["mesh"]].get("extras", {}).get("sag_mm") for p in (wall, pierced, tank, proxy, *beams)]
    assert sags == [0, 1, 1, None, 0, 1]


def test_the_sag_that_is_requested_is_kept_and_stated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = IfcModel()
    model.product("IfcWall", "flat", model.body(model.extrusion((4000, 200, 2500))))
    model.product("IfcTank", "round", model.body(model.cylinder(500, 100)), (0, 9000, 0))
    file = model.write(tmp_path / "a.ifc")
    # The bracket of a contact is as wide as the surfaces are unknown.
    triangles, widths = [], []
    for sag in ("", "0.02mm", "5mm"):
        monkeypatch.setenv("STRAKE_IMPORT_SAG", sag)
        loaded = strake.load(file)
        triangles.append([len(loaded.mesh(i)[1]) for i in sorted(range(2), key=lambda i: loaded.names[i])])
        pair = strake.clash(loaded, clearance="20m", touch_gap=0)[0]
        widths.append(round(pair.upper - pair.lower, 2))
    assert [flat for flat, _ in triangles] == [12, 12, 12]
    assert triangles[1][1] > 2 * triangles[0][1] > 2 * triangles[2][1]
    assert widths == [2, 0.04, 10]  # as far on both sides


def test_the_note_of_an_unknown_sag_goes_where_it_is_known(tmp_path: Path) -> None:
    for name, facets in (("known.ifc", False), ("unknown.ifc", True)):
        model = IfcModel()
        model.product("IfcWall", "w", model.body(model.extrusion((4000, 200, 2500))))
        body = model.body(model.faceted(CUBE, CUBE_FACES), kind="Brep") if facets else model.body(model.cylinder(500, 100))
        model.product("IfcTank", "t", body)
        found = strake.clash(strake.load(model.write(tmp_path / name)))
        assert ("unknown-sag" in [one.code for one in found.diagnostics]) == facets
