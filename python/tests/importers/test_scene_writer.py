# SPDX-License-Identifier: Apache-2.0
"""The scene that importers write."""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from glb_reader import Glb
from strake.importers import Part, SceneWriter, prepare_shape
from strake.importers.shapes import PreparedShape, prepare_shapes, used_corners

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)
RED, GLASS = (1.0, 0.0, 0.0, 1.0), (0.5, 0.6, 0.9, 0.4)


def box(size: float = 100, at: float = 0) -> Part:
    return Part(CORNERS * size + at, FACES, RED)


def moved(x: float, y: float, z: float) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def test_shapes_state_how_far_they_are_from_their_surfaces(tmp_path: Path) -> None:
    triangle = Part(np.eye(3), [[0, 1, 2]])
    with SceneWriter(tmp_path / "s.glb", sag_mm=0.5) as scene:
        for name, sag_mm in (("a", None), ("b", 0.0), ("c", 0.25), ("d", 0.25)):
            scene.object(name, name, scene.shape([triangle], sag_mm=sag_mm))
        for wrong in (-1.0, float("nan"), float("inf")):
            with pytest.raises(ValueError, match="no distance"):
                scene.shape([triangle], sag_mm=wrong)
    glb = Glb(tmp_path / "s.glb")
    assert glb.json["asset"]["extras"]["sag_mm"] == 0.5
    assert [mesh.get("extras") for mesh in glb.json["meshes"]] == [None, {"sag_mm": 0}, {"sag_mm": 0.25}]
    assert glb.node("c")["mesh"] == glb.node("d")["mesh"]


def test_equal_shapes_are_one_mesh_wherever_they_lie_in_their_frames(tmp_path: Path) -> None:
    with SceneWriter(tmp_path / "a.glb") as scene:
        for number, at in enumerate((0.0, 1234.567, 9_876_543.21)):
            scene.object(f"o{number}", "box", scene.shape([box(at=at)]))
        scene.object("other", "box", scene.shape([box(size=101)]))
        assert (scene.object_count, scene.mesh_count) == (4, 2)
    glb = Glb(tmp_path / "a.glb")
    for number, at in enumerate((0.0, 1234.567, 9_876_543.21)):
        low, high = glb.box(f"o{number}")
        assert np.allclose(low, at, atol=2e-4) and np.allclose(high, at + 100, atol=2e-4)


def test_places_far_away_keep_their_micrometres(tmp_path: Path) -> None:
    with SceneWriter(tmp_path / "a.glb") as scene:
        shape = scene.shape([box(at=155_000_000.001)])
        scene.object("far", "far", shape, moved(463_000_000.002, 0.003, 0))
    glb = Glb(tmp_path / "a.glb")
    assert np.abs(glb.accessor(0)).max() <= 50
    assert glb.box("far")[0] == pytest.approx([618_000_000.003, 155_000_000.004, 155_000_000.001], abs=2e-4)


def test_a_turned_placement_is_written_by_columns(tmp_path: Path) -> None:
    turn = moved(10, 20, 30)
    turn[:2, :2] = [[0, -1], [1, 0]]
    with SceneWriter(tmp_path / "a.glb") as scene:
        scene.object("o", "o", scene.shape([Part(CORNERS * [100, 10, 1], FACES)]), turn)
    assert np.allclose(Glb(tmp_path / "a.glb").box("o"), ([0, 20, 30], [10, 120, 31]), atol=1e-3)


def test_colours_split_a_shape_and_become_linear(tmp_path: Path) -> None:
    with SceneWriter(tmp_path / "a.glb") as scene:
        scene.object("o", "o", scene.shape([Part(CORNERS, FACES[:6], (0.5, 0, 1, 1)), Part(CORNERS, FACES[6:], GLASS)]))
    glb = Glb(tmp_path / "a.glb")
    assert [part["material"] for part in glb.json["meshes"][0]["primitives"]] == [0, 1]
    assert glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] == [0.214041, 0, 1, 1]
    assert "alphaMode" not in glb.json["materials"][0] and glb.json["materials"][1]["alphaMode"] == "BLEND"


def test_groups_nest_and_empty_ones_are_not_written(tmp_path: Path) -> None:
    with SceneWriter(tmp_path / "a.glb") as scene:
        site = scene.group("site", attributes={"Site": "S"})
        scene.group("empty", site)
        storey = scene.group("storey", scene.group("building", site))
        scene.object("o", "o", scene.shape([box()]), parent=storey, attributes={"Pset": {"a": 1, "b": {"c": "x"}}})
    glb = Glb(tmp_path / "a.glb")
    assert glb.path("o") == ["site", "building", "storey"]
    assert len(glb.nodes) == 4
    assert glb.attributes("o") == {"Pset": {"a": 1, "b": {"c": "x"}}}
    assert glb.json["asset"]["extras"] == {"unit_mm": 1.0, "up_axis": "z"}


def test_shapes_of_many_corners_have_wide_indices(tmp_path: Path) -> None:
    count = 70_000
    angles = np.linspace(0, 2 * math.pi, count, endpoint=False)
    corners = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(count)]) * 1e6
    fan = np.column_stack([np.zeros(count - 2, int), np.arange(1, count - 1), np.arange(2, count)])
    with SceneWriter(tmp_path / "a.glb") as scene:
        scene.object("narrow", "n", scene.shape([box()]))
        scene.object("wide", "w", scene.shape([Part(corners, fan)]))
        scene.object("narrow 2", "n", scene.shape([box(size=7)]))
    glb = Glb(tmp_path / "a.glb")
    assert len(glb.json["bufferViews"]) == 3
    assert len(glb.triangles("wide")) == count - 2
    assert glb.volume("narrow 2") == pytest.approx(343, rel=1e-4)


@pytest.mark.parametrize(
    ("corners", "faces", "why"),
    [
        (CORNERS, np.zeros((0, 3), int), "needs a triangle"),
        (CORNERS, [[0, 1, 8]], "does not exist"),
        (CORNERS, [[0, 1, -1]], "does not exist"),
        (CORNERS * math.nan, FACES, "finite"),
        (CORNERS * 1e300, FACES, "larger"),
    ],
)
def test_bad_shapes_are_refused(corners: np.ndarray, faces: np.ndarray, why: str) -> None:
    with pytest.raises(ValueError, match=why), np.errstate(all="ignore"):
        prepare_shape([Part(corners, faces)])


def test_bad_placements_are_refused_and_leave_no_file(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="finite"), SceneWriter(tmp_path / "a.glb") as scene:
        scene.object("o", "o", scene.shape([box()]), moved(math.inf, 0, 0))
    assert list(tmp_path.iterdir()) == []


def test_corners_that_no_triangle_uses_do_not_count(tmp_path: Path) -> None:
    shape = prepare_shape([Part(np.vstack([CORNERS, [[math.nan] * 3, [1e9, 0, 0]]]), FACES)])
    assert shape.parts[0].vertex_count == 8


def test_bytes_depend_on_nothing_but_what_is_added(tmp_path: Path) -> None:
    for name in ("a", "b"):
        with SceneWriter(tmp_path / f"{name}.glb") as scene:
            scene.object("o\ud800", "\u00fc \n", scene.shape([box()]), parent=scene.group("g"))
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()


def test_an_empty_scene_is_a_scene(tmp_path: Path) -> None:
    with SceneWriter(tmp_path / "a.glb") as scene:
        scene.group("nothing in it")
    assert Glb(tmp_path / "a.glb").nodes == []


def validator() -> Path | None:
    """Returns the folder with the validator of Khronos, where node and it are installed."""
    usual = Path(__file__).parents[3] / "build" / "npm" / "node_modules" / "gltf-validator"
    folder = Path(os.environ.get("STRAKE_GLTF_VALIDATOR", usual))
    return folder if shutil.which("node") and folder.is_dir() else None


@pytest.mark.skipif(validator() is None, reason="needs node, and npm's gltf-validator: scripts/npm.sh")
def test_the_validator_of_khronos_finds_no_fault(tmp_path: Path) -> None:
    with SceneWriter(tmp_path / "a.glb") as scene:
        deck = scene.group("deck", attributes={"x": 1})
        scene.object("a", "a", scene.shape([box(at=1e6 / 3)]), moved(0.1, 0.2, 0.3), deck)
        scene.object("b", "b", scene.shape([Part(CORNERS, FACES, GLASS)]), parent=deck)
    script = (
        "const v = require(process.argv[1]), fs = require('fs');"
        "v.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])))"
        ".then(r => console.log(JSON.stringify(r.issues)))"
    )
    command = ["node", "-e", script, str(validator()), str(tmp_path / "a.glb")]
    issues = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_corners_that_no_triangle_has_are_left_out() -> None:
    used, triangles = used_corners(np.array([[7, 2, 4], [4, 2, 9]]), 11)
    assert used.tolist() == [2, 4, 7, 9]
    assert triangles.tolist() == [[2, 0, 1], [1, 0, 3]]
    assert triangles.dtype == np.uint32
    plain = prepare_shape([Part(CORNERS, FACES, RED)])
    spread = np.full((3 * len(CORNERS), 3), math.nan)
    spread[1::3] = CORNERS
    # What nothing refers to says nothing, not even where it is no number.
    for integer in (np.int32, np.uint32, np.uint64, np.int64):
        assert prepare_shape([Part(spread, (3 * FACES + 1).astype(integer), RED)]) == plain


def test_a_part_without_triangles_is_none() -> None:
    assert prepare_shape([Part(np.zeros((0, 3)), []), box()]) == prepare_shape([box()])


def lid(count: int) -> Part:
    """A flat outline of so many corners, as a fan of triangles."""
    angles = np.arange(count) * 2 * np.pi / count
    corners = np.stack([np.cos(angles) * 100, np.sin(angles) * 60, np.full(count, 5.0)], axis=1)
    return Part(corners, [[0, i, i + 1] for i in range(1, count - 1)], GLASS)


def test_shapes_that_are_prepared_together_are_those_of_each_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    given: list[tuple[list[Part], float | None]] = [
        ([box()], None),
        ([lid(9), box(3, 1e6)], 0.0),
        ([Part(np.zeros((0, 3)), [])], None),
        ([box(at=math.nan)], 0.0),
        ([lid(40), lid(5)], 0.25),
        ([box(), Part(CORNERS, [[0, 1, 8]])], None),
        ([Part(CORNERS * 1e300, FACES)], None),
        ([box()], -1.0),
        ([], None),
        ([lid(200)], 1.0),
        ([box()], None),
    ]
    with np.errstate(all="ignore"):
        alone = [prepare_shapes([one], 25.4)[0] for one in given]
        for most in (1, 60, 100_000):
            monkeypatch.setattr("strake.importers.shapes._MAX_TOGETHER", most)
            together = prepare_shapes(given, 25.4)
            assert [str(shape) for shape in together] == [str(shape) for shape in alone]
    assert [isinstance(shape, PreparedShape) for shape in alone] == [True, True, False, False, True, False, False, False, False, True, True]
    assert prepare_shapes([]) == []


def test_a_face_that_is_never_settled_keeps_no_other_from_it(monkeypatch: pytest.MonkeyPatch) -> None:
    alone = prepare_shape([box()])
    monkeypatch.setattr("strake.importers.diagonals._MAX_ROUNDS", 3)
    assert prepare_shape([box()]) == alone
    slow = prepare_shape([lid(40)])
    monkeypatch.setattr("strake.importers.diagonals._MAX_ROUNDS", 200)
    assert prepare_shape([lid(40)]) != slow, "it needs more rounds"
    monkeypatch.setattr("strake.importers.diagonals._MAX_ROUNDS", 3)
    assert prepare_shapes([([box()], None), ([lid(40)], None), ([box()], None)]) == [alone, slow, alone]


def test_a_scene_of_more_than_memory_is_to_hold_has_the_same_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, most in (("a", 1 << 20), ("b", 50)):
        monkeypatch.setattr("strake.importers.scene_writer._MAX_IN_MEMORY", most)
        with SceneWriter(tmp_path / f"{name}.glb") as scene:
            for number in range(20):
                scene.object(f"o{number}", "box", scene.shape([box(number + 1)]), moved(number, 0.5, 0))
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.glb", "b.glb"]
