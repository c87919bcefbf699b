# SPDX-License-Identifier: Apache-2.0
"""Models as arrays, made of arrays and of trimesh's scenes, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import strake

CUBE_SIDES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
CUBE_TRIANGLES = np.array([corners for a, b, c, d in CUBE_SIDES for corners in ((a, b, c), (a, c, d))])


def cube(at: tuple[float, float, float] = (0, 0, 0), size: float = 100) -> npt.NDArray[np.float64]:
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    return np.array(corners) * size + np.array(at, dtype=float)


def moved(x: float) -> npt.NDArray[np.float64]:
    placement = np.eye(4)
    placement[0, 3] = x
    return placement


def test_objects(ship: strake.Model) -> None:
    assert len(ship) == len(ship.objects) == 400
    first, last = ship.objects[0], ship.objects[-1]
    assert (first.number, last.number) == (0, 399)
    assert [one.id for one in ship.objects[:3]] == list(ship.ids[:3])
    assert list(ship)[7] == ship.objects[7]
    assert first.file == "ship.glb"
    assert first.path.startswith("SHIP-SECTION/")
    assert first.category == "physical"
    assert first.attributes["discipline"]
    with pytest.raises(IndexError):
        ship.objects[400]
    assert "ship.glb" in repr(ship)


def test_arrays(ship: strake.Model) -> None:
    assert ship.boxes.shape == (400, 2, 3)
    assert (ship.boxes[:, 0] <= ship.boxes[:, 1]).all()
    assert ship.placements.shape == (len(ship.object_of_body), 3, 4)
    assert ship.object_of_body.max() == 399
    for i in (0, 100, 399):
        vertices, triangles = ship.mesh(i)
        assert triangles.max() < len(vertices)
        np.testing.assert_allclose(np.array([vertices.min(axis=0), vertices.max(axis=0)]), ship.boxes[i], atol=0.01)


def test_arrays_outlive_their_model() -> None:
    boxes = strake.generate(objects=100).boxes
    clashes = strake.clash(strake.generate(objects=100)).array
    segments = strake.draw(strake.generate(objects=100)).segments
    assert np.isfinite(boxes).all()
    assert (clashes["a"] < clashes["b"]).all()
    assert np.isfinite(segments["a_paper"]).all()


def test_selections(ship: strake.Model) -> None:
    pipes = ship.select("PIP*")
    assert pipes.dtype == np.bool_
    assert [name.startswith("PIP") for name in ship.names] == pipes.tolist()
    assert (ship.select(["PIP*", "not PIP*"])).all()
    with pytest.raises(strake.UsageError, match="column"):
        ship.select("name = ")


def test_files_read_in_another_unit(tmp_path: Path, ship: strake.Model) -> None:
    ship.save(tmp_path / "ship.obj")
    in_mm, in_inches = strake.load(tmp_path / "ship.obj"), strake.load(str(tmp_path / "ship.obj"), unit="in")
    np.testing.assert_allclose(in_inches.boxes, in_mm.boxes * 25.4, atol=0.1)
    np.testing.assert_array_equal(strake.load(tmp_path / "ship.obj", unit=25.4).boxes, in_inches.boxes)
    lying = strake.load([tmp_path / "ship.obj"], up_axis="y")
    np.testing.assert_allclose(lying.boxes[:, 1, 2], in_mm.boxes[:, 1, 1], atol=0.01)


def test_models_of_arrays() -> None:
    vertices = cube()
    model = strake.Model.from_arrays(
        [
            ("left", vertices, CUBE_TRIANGLES),
            ("right", cube((90, 0, 0)), CUBE_TRIANGLES.astype(np.uint8), {"DN": "80"}),
            strake.Mesh("far", vertices, CUBE_TRIANGLES, placement=moved(500), path="STEEL/FRAME 7"),
        ]
    )
    assert list(model.ids) == ["far", "left", "right"]
    assert model.objects[0].path == "STEEL/FRAME 7"
    assert model.objects[2].attributes == {"DN": "80"}
    np.testing.assert_array_equal(model.boxes[0], [[500, 0, 0], [600, 100, 100]])
    found, triangles = model.mesh(1)
    np.testing.assert_array_equal(found, vertices)
    np.testing.assert_array_equal(triangles, CUBE_TRIANGLES)
    (one,) = strake.clash(model)
    assert (one.a_id, one.b_id, one.kind, one.depth) == ("left", "right", strake.Kind.HIT, pytest.approx(10))
    assert model.select("@DN >= 80mm").tolist() == [False, False, True]


def test_mirrored_placements_keep_their_outside() -> None:
    mirrored = np.diag([-1.0, 1, 1, 1])
    vertices, triangles = strake.Model.from_arrays([strake.Mesh("m", cube(), CUBE_TRIANGLES, placement=mirrored)]).mesh(0)
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 == pytest.approx(1e6)


def test_trimesh_there_and_back(ship: strake.Model) -> None:
    trimesh = pytest.importorskip("trimesh")
    again = strake.Model.from_trimesh(ship.to_trimesh())
    assert list(again.ids) == [name for i, name in enumerate(ship.ids) if len(ship.mesh(i)[1])]
    assert strake.clash(again).summary["hit"] == strake.clash(ship).summary["hit"]
    box = strake.Model.from_trimesh(trimesh.creation.box((2, 1, 1)), unit="m")
    np.testing.assert_array_equal(box.boxes[0], [[-1000, -500, -500], [1000, 500, 500]])


WRONG_MESHES: list[tuple[Any, str]] = [
    (("m", np.zeros((4, 2)), [[0, 1, 2]]), "shape"),
    (("m", np.zeros((4, 3), dtype=complex), [[0, 1, 2]]), "complex"),
    (("m", [["a", "b", "c"]], [[0, 0, 0]]), "vertices"),
    (("m", cube(), [[0, 1, 8]]), "corner"),
    (("m", cube(), [[0, 1, -1]]), "corner"),
    (("m", cube(), [[0.0, 1.0, 2.0]]), "whole numbers"),
    (("m", cube() * np.nan, CUBE_TRIANGLES), "finite"),
    (("m", np.full((8, 3), np.inf), CUBE_TRIANGLES), "finite"),
    ((7, cube(), CUBE_TRIANGLES), "no name"),
    (("m", cube(), CUBE_TRIANGLES, {"DN": 80}), "attribute"),
    (strake.Mesh("m", cube(), CUBE_TRIANGLES, placement=np.eye(3)), "placement"),
    (strake.Mesh("m", cube(), CUBE_TRIANGLES, placement=np.eye(4) * np.nan), "finite"),
    (strake.Mesh("m", cube(), CUBE_TRIANGLES, color=(1, 2)), "colour"),
]


@pytest.mark.parametrize(("mesh", "why"), WRONG_MESHES)
def test_meshes_that_are_refused(mesh: Any, why: str) -> None:
    with pytest.raises(strake.UsageError, match=why):
        strake.Model.from_arrays([mesh])


WRONG_CALLS: list[tuple[str, Callable[[strake.Model], object]]] = [
    ("clearance", lambda m: strake.clash(m, clearance=float("nan"))),
    ("clearance", lambda m: strake.clash(m, clearance=-1)),
    ("unit", lambda m: strake.clash(m, clearance="25 parsecs")),
    ("touch_gap", lambda m: strake.clash(m, touch_gap=float("inf"))),
    ("contacts", lambda m: strake.clash(m, contacts="some")),  # type: ignore[arg-type]
    ("group_by", lambda m: strake.clash(m, group_by="colour")),  # type: ignore[arg-type]
    ("profile", lambda m: strake.clash(m, profile="spaceship")),
    ("meant", lambda m: strake.clash(m, a=np.ones(3, dtype=bool))),
    ("bool", lambda m: strake.clash(m, a=np.ones(len(m)))),
    ("regions", lambda m: strake.clash(m, regions=-1)),
    ("threads", lambda m: strake.clash(m, threads=0)),
    ("threads", lambda m: strake.clash(m, threads=10**9)),
    ("progress", lambda m: strake.clash(m, progress=7)),  # type: ignore[arg-type]
    ("itself", lambda m: strake.clash(m, a="PIP*", rules="rules.toml")),
    ("view", lambda m: strake.draw(m, "askew")),
    ("view", lambda m: strake.draw(m, {"colour": "red"})),
    ("direction", lambda m: strake.draw(m, {"direction": (0, 0, 0)})),
    ("finite", lambda m: strake.draw(m, {"direction": (0, float("nan"), 0)})),
    ("up", lambda m: strake.draw(m, {"view": "top", "up": (0, 0, 1)})),
    ("eye", lambda m: strake.draw(m, {"eye": (0, 0, 0)})),
    ("target", lambda m: strake.draw(m, {"eye": (0, 0, 0), "target": (0, 0, 0)})),
    ("limits", lambda m: strake.draw(m, {"limits": [[1, 1, 1], [0, 0, 0]]})),
    ("section", lambda m: strake.draw(m, {"section": "w=3"})),
    ("scale", lambda m: strake.draw(m, scale=0)),
    ("scale", lambda m: strake.draw(m, scale=float("nan"))),
    ("paper", lambda m: strake.draw(m, paper="B5")),
    ("hidden", lambda m: strake.draw(m, hidden="some")),  # type: ignore[arg-type]
    ("select", lambda m: strake.draw(m, select="nothing there")),
    ("pens", lambda m: strake.draw(m, pens={"edge": -1})),
    ("sag", lambda m: m.mesh(0, sag=0)),
    ("kind", lambda m: strake.generate("spaceship")),
    ("100", lambda m: strake.generate(objects=3)),
    ("seed", lambda m: strake.generate(seed=-1)),
    ("unit", lambda m: strake.load("x.stl", unit="parsec")),
    ("up_axis", lambda m: strake.load("x.stl", up_axis="w")),
    ("no file", lambda m: strake.load([])),
    ("path", lambda m: strake.load(7)),  # type: ignore[arg-type]
    (".glb", lambda m: m.save("ship.doc")),
]


@pytest.mark.parametrize(("why", "call"), WRONG_CALLS)
def test_arguments_that_are_refused(ship: strake.Model, why: str, call: Callable[[strake.Model], object]) -> None:
    with pytest.raises(strake.UsageError) as raised:
        call(ship)
    assert why in str(raised.value)
    assert raised.value.code == "usage"


def test_files_that_cannot_be_read_or_written(tmp_path: Path, ship: strake.Model) -> None:
    (tmp_path / "bad.glb").write_bytes(b"glTF and nothing more")
    for name in ("bad.glb", "absent.glb"):
        with pytest.raises(strake.InputError) as raised:
            strake.load(tmp_path / name)
        assert name in raised.value.file
    with pytest.raises(strake.OutputError):
        ship.save(tmp_path / "no folder" / "ship.glb")
    with pytest.raises(strake.InputError):
        strake.clash(ship, rules=tmp_path / "absent.toml")
    with pytest.raises(strake.InputError):
        strake.Sheet.read(tmp_path / "absent.toml")
