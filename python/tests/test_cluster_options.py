# SPDX-License-Identifier: Apache-2.0
"""Options of what is taken in, kept and put first do by tiles what they do on one machine, and each does something."""

import json
import struct
import sys
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from test_cluster import bytes_of, small_tiles

import strake
import strake.cluster

__all__ = ["small_tiles"]

RULES = """
[[exempt]]
name = "even numbers"
a = "even*"
b = "even*"
"""

OPTIONS: list[tuple[list[str], dict[str, Any]]] = [
    (["--sag", "3mm"], {"sag": 3}),
    (["--weld", "2mm"], {"weld": 2}),
    (["--obstructions"], {"obstructions": True}),
    (["--insulation"], {"insulation": True}),
    (["--clearance", "2mm", "--class", "hit, clearance"], {"clearance": 2, "classes": ["hit", "clearance"]}),
    (["--class", "contact"], {"classes": "contact"}),
    (["--group-by", "proximity", "--group-distance", "40mm", "--sort", "size"],
     {"group_by": "proximity", "group_distance": 40, "sort": "size"}),
    (["--group-by", "proximity", "--sort", "volume"], {"group_by": "proximity", "sort": "volume"}),
    (["--rules", "RULES", "--list-exempted"], {"rules": "RULES", "list_exempted": True}),
]  # fmt: skip


def glb(scene: dict[str, Any], binary: bytes) -> bytes:
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + len(binary), len(text), b"JSON")
    return head + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary


def gaping_box() -> tuple[npt.NDArray[np.float32], npt.NDArray[np.uint16]]:
    """A box of six faces that share no corners; one of them stands off by a millimetre."""
    corners, triangles = [], []
    for axis in range(3):
        for side in (-1, 1):
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = np.zeros(3, np.float32)
                corner[[axis, (axis + 1) % 3, (axis + 2) % 3]] = (side * 5 + (axis == 2 and side > 0), u * 5, v * 5)
                corners.append(corner)
            base = len(corners) - 4
            order = (0, 1, 2, 0, 2, 3) if side > 0 else (0, 2, 1, 0, 3, 2)
            triangles += [base + k for k in order]
    return np.array(corners, np.float32), np.array(triangles, np.uint16)


@pytest.fixture(scope="session")
def rods(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Cylinders and boxes in each other's way, some obstructions and insulation, as a neutral scene (docs/formats/gltf.md)."""
    along = {"z": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], "y": [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0]}
    nodes: list[dict[str, Any]] = [{"children": list(range(1, 401)), "extras": {"strake": {"is": "frame"}}}]
    for i in range(400):
        facts: dict[str, Any] = {"is": "object"}
        if i % 7 == 0:
            facts["category"] = "obstruction"
        elif i % 5 == 0:
            facts["category"] = "insulation"
        # Beside each upright one, 30 mm from the next, is another, which it overlaps, touches or misses.
        aside = 0.0 if i // 20 % 2 == 0 else 8.5 + 0.5 * (i % 6)
        place = [30.0 * (i % 20) + aside, 30.0 * (i // 40), 10.0 * (i % 3), 1]
        name = f"{'even' if i % 2 == 0 else 'odd'} {i}"
        turn = along["z" if i // 20 % 2 == 0 else "y"]
        nodes.append({"name": name, "mesh": (i + i // 20) % 4, "matrix": [*turn, *place], "extras": {"id": f"/{name}", "strake": facts}})
    cylinders = [{"extras": {"strake": {"shape": i, "primitive": {"kind": "cylinder", "lengths": [5 + 0.1 * i, 28]}}}} for i in range(3)]
    box = {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}], "extras": {"strake": {"shape": 3}}}
    points, triangles = gaping_box()
    bounds = {"min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()}
    scene = {
        "asset": {"version": "2.0", "extras": {"strake": {"scene": 1}}},
        "meshes": [*cylinders, box],
        "nodes": nodes,
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", **bounds},
            {"bufferView": 1, "componentType": 5123, "count": len(triangles), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": points.nbytes},
            {"buffer": 0, "byteOffset": points.nbytes, "byteLength": triangles.nbytes},
        ],
        "buffers": [{"byteLength": points.nbytes + triangles.nbytes}],
    }
    file = tmp_path_factory.mktemp("rods") / "rods.glb"
    file.write_bytes(glb(scene, points.tobytes() + triangles.tobytes()))
    return file


@pytest.mark.parametrize(("words", "arguments"), OPTIONS, ids=lambda x: " ".join(x) if isinstance(x, list) else "")
def test_the_same_as_on_one_machine(
    tmp_path: Path,
    rods: Path,
    small_tiles: list[int],
    monkeypatch: pytest.MonkeyPatch,
    words: list[str],
    arguments: dict[str, Any],
) -> None:
    rules = tmp_path / "rules.toml"
    rules.write_text(RULES)
    words = [str(rules) if word == "RULES" else word for word in words]
    given = {name: rules if value == "RULES" else value for name, value in arguments.items()}
    small_tiles.append(40_000)
    for name in ("clashes.json", "clashes.csv"):
        whole = strake.clash(strake.load(rods), **given)
        assert bytes_of(strake.cluster.clash(rods, **given), tmp_path, name) == bytes_of(whole, tmp_path, name)
    # The option does something, so that a run without it is told apart.
    besides = {name: value for name, value in given.items() if name in ("clearance", "group_by", "group_distance", "rules")}
    assert bytes_of(whole, tmp_path) != bytes_of(strake.clash(strake.load(rods), **besides), tmp_path)
    monkeypatch.setenv("STRAKE_PYTHON", sys.executable)
    files = [tmp_path / "whole_by_program.json", tmp_path / "tiled_by_program.json"]
    strake.run_program(["clash", str(rods), *words, "--quiet", "-o", str(files[0])])
    strake.run_program(["clash", str(rods), *words, "--quiet", "-o", str(files[1]), "--scheduler", "local"])
    assert files[0].read_bytes() == files[1].read_bytes() == bytes_of(whole, tmp_path)


def test_a_drawing_takes_the_same_in(tmp_path: Path, rods: Path, small_tiles: list[int], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("STRAKE_PYTHON", sys.executable)
    words = ["--sag", "2mm", "--obstructions", "--insulation", "--weld", "0.5mm"]
    whole = strake.draw(strake.load(rods), sag=2, obstructions=True, insulation=True, weld=0.5)
    tiled = strake.cluster.draw(rods, sag=2, obstructions=True, insulation=True, weld=0.5)
    assert bytes_of(tiled, tmp_path, "view.svg") == bytes_of(whole, tmp_path, "view.svg")
    assert bytes_of(whole, tmp_path, "view.svg") != bytes_of(strake.draw(strake.load(rods)), tmp_path, "view.svg")
    file = tmp_path / "by_program.svg"
    strake.run_program(["draw", str(rods), *words, "--quiet", "-o", str(file), "--scheduler", "local"])
    assert file.read_bytes() == bytes_of(whole, tmp_path, "view.svg")


def test_what_does_not_go_together(rods: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(strake.UsageError, match="give group_by"):
        strake.cluster.clash(rods, sort="size")
    with pytest.raises(strake.UsageError, match="not listed"):
        strake.cluster.clash(rods, group_by="element", group_contacts=True, classes="hit")
    with pytest.raises(strake.UsageError, match="no rules that exempt"):
        strake.cluster.clash(rods, list_exempted=True)
    with pytest.raises(strake.UsageError, match="log_pairs"):
        strake.cluster.clash(rods, log_pairs=True)
    monkeypatch.setenv("STRAKE_PYTHON", sys.executable)
    words = ["clash", str(rods), "--quiet", "-o", str(tmp_path / "out.json"), "--scheduler", "local"]
    done = strake.run_program([*words, "--class", "hit,some"], check=False)
    assert done.returncode == 2 and "some" in done.stderr
    done = strake.run_program([*words, "--sag", "0.1um"], check=False)
    assert done.returncode == 2 and "finer than the grid" in done.stderr


def test_a_flag_that_is_off_is_off(rods: Path, tmp_path: Path, small_tiles: list[int], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("STRAKE_PYTHON", sys.executable)
    small_tiles.append(40_000)
    for flag in ("--obstructions", "--insulation", "--volumes"):
        files = [tmp_path / "whole.json", tmp_path / "tiled.json"]
        for file, where in zip(files, ([], ["--scheduler", "local"]), strict=True):
            strake.run_program(["clash", str(rods), f"{flag}=false", "--quiet", "-o", str(file), *where])
        assert files[0].read_bytes() == files[1].read_bytes()


def test_wrong_words_are_reported_before_anything_is_cut(rods: Path) -> None:
    with pytest.raises(strake.UsageError, match="'hits' is none of the words"):
        strake.cluster.clash(rods, classes="hits")
    with pytest.raises(strake.UsageError, match="'elements' is none of the words"):
        strake.cluster.clash(rods, group_by="elements")
