# SPDX-License-Identifier: Apache-2.0
"""Files have the bytes that the program writes, for any number of threads."""

from pathlib import Path
from typing import Any

import pytest

import strake

ROOT = Path(__file__).resolve().parents[2]


def written_by_program(folder: Path, name: str, *arguments: object) -> bytes:
    file = folder / ("program_" + name)
    strake.run_program([*(str(word) for word in arguments), "--quiet", "-o", file])
    return file.read_bytes()


def written_by_save(folder: Path, name: str, result: Any, **options: Any) -> bytes:
    file = folder / ("package_" + name)
    result.save(file, **options)
    return file.read_bytes()


CLASH_RUNS: list[tuple[list[str], dict[str, Any]]] = [
    (["--clearance", "25mm"], {"clearance": 25}),
    (["--clearance", "1in", "--touch-gap", "0.5mm"], {"clearance": "1in", "touch_gap": 0.5}),
    (["--a", "PIP*", "--b", "not PIP*"], {"a": "PIP*", "b": "not PIP*"}),
    (["--a", "PIP*", "--a", "CAB*"], {"a": ["PIP*", "CAB*"]}),
    (["--profile", "ship", "--volumes"], {"profile": "ship", "volumes": True}),
    (["--contacts", "count", "--group-by", "element"], {"contacts": "count", "group_by": "element"}),
    (["--group-by", "assembly", "--group-distance", "2m"], {"group_by": "assembly", "group_distance": "2m"}),
    (["--rules", str(ROOT / "examples/ship_rules.toml")], {"rules": ROOT / "examples/ship_rules.toml"}),
]


@pytest.mark.parametrize(("words", "arguments"), CLASH_RUNS, ids=lambda x: " ".join(x) if isinstance(x, list) else "")
@pytest.mark.parametrize("name", ["clashes.json", "clashes.csv"])
def test_clashes(tmp_path: Path, ship: strake.Model, ship_file: Path, name: str, words: list[str], arguments: dict[str, Any]) -> None:
    expected = written_by_program(tmp_path, name, "clash", ship_file, *words)
    assert written_by_save(tmp_path, name, strake.clash(ship, **arguments)) == expected


@pytest.mark.parametrize("threads", [1, 2, 8])
def test_clashes_on_any_number_of_threads(tmp_path: Path, ship: strake.Model, ship_file: Path, threads: int) -> None:
    expected = written_by_program(tmp_path, "clashes.json", "clash", ship_file, "--threads", "1", "--clearance", "25mm")
    found = strake.clash(strake.load(ship_file, threads=threads), clearance=25, threads=threads)
    assert written_by_save(tmp_path, "clashes.json", found, threads=threads) == expected


def test_clashes_with_attributes_as_columns(tmp_path: Path, ship: strake.Model, ship_file: Path) -> None:
    expected = written_by_program(tmp_path, "clashes.csv", "clash", ship_file, "--columns", "@discipline,@system")
    assert written_by_save(tmp_path, "clashes.csv", strake.clash(ship), columns=["discipline", "system"]) == expected


def test_clashes_of_several_files(tmp_path: Path, ship_file: Path) -> None:
    files = [ship_file]
    for seed in (4, 5):
        files.append(tmp_path / f"ship{seed}.glb")
        strake.generate(objects=200, seed=seed).save(files[-1])
        expected = written_by_program(tmp_path, f"of{seed}.json", "clash", *files)
        assert written_by_save(tmp_path, f"of{seed}.json", strake.clash(strake.load(files))) == expected
    expected = written_by_program(tmp_path, "self.json", "clash", *files, "--self")
    assert written_by_save(tmp_path, "self.json", strake.clash(strake.load(files), within_files=True)) == expected


DRAWINGS: list[tuple[list[str], dict[str, Any]]] = [
    ([], {}),
    (["--view", "top", "--hidden", "dashed", "--scale", "1:100", "--paper", "A1"],
     {"view": "top", "hidden": "dashed", "scale": 100, "paper": "A1"}),
    (["--direction", "1,-2,1", "--up", "0,0,1", "--select", "PIP*", "--title", "pipes & more"],
     {"view": {"direction": (1, -2, 1), "up": (0, 0, 1)}, "select": "PIP*", "title": "pipes & more"}),
    (["--view", "top", "--section", "z=2500mm", "--smooth", "on", "--limits", "0,-4000,0,6000,4000,9000"],
     {"view": {"view": "top", "section": "z=2500mm", "limits": [[0, -4000, 0], [6000, 4000, 9000]]}, "smooth": "on"}),
    (["--eye", "20000,-9000,6000", "--target", "3000,0,3000", "--hidden", "all"],
     {"view": {"eye": (20000, -9000, 6000), "target": (3000, 0, 3000)}, "hidden": "all"}),
    (["--visible-only", "--flush-seams", "off", "--limits", "auto"],
     {"visible_only": True, "flush_seams": False, "view": {"limits": "auto"}}),
]  # fmt: skip


@pytest.mark.parametrize(("words", "arguments"), DRAWINGS, ids=lambda x: " ".join(x) if isinstance(x, list) else "")
@pytest.mark.parametrize("name", ["view.svg", "view.pdf", "view.json"])
def test_drawings(tmp_path: Path, ship: strake.Model, ship_file: Path, name: str, words: list[str], arguments: dict[str, Any]) -> None:
    expected = written_by_program(tmp_path, name, "draw", ship_file, *words)
    drawing = strake.draw(ship, **arguments)
    assert written_by_save(tmp_path, name, drawing) == expected
    if name.endswith(".svg"):
        assert drawing.svg.encode() == expected


@pytest.mark.parametrize("threads", [1, 2, 8])
def test_drawings_on_any_number_of_threads(tmp_path: Path, ship: strake.Model, ship_file: Path, threads: int) -> None:
    expected = written_by_program(tmp_path, "view.svg", "draw", ship_file, "--threads", "1")
    assert strake.draw(ship, threads=threads).svg.encode() == expected


def test_sheet(tmp_path: Path, ship: strake.Model, ship_file: Path) -> None:
    file = ROOT / "examples/ship_sheet.toml"
    expected = written_by_program(tmp_path, "sheet.svg", "draw", ship_file, "--sheet", file)
    sheet = strake.Sheet.read(file).draw(ship)
    assert sheet.svg.encode() == expected
    assert written_by_save(tmp_path, "sheet.svg", sheet) == expected


def test_generated_ship(tmp_path: Path) -> None:
    expected = written_by_program(tmp_path, "ship.glb", "generate", "ship", "--objects", 300, "--seed", 7, "--kind", "dense")
    assert written_by_save(tmp_path, "ship.glb", strake.generate("dense", 300, 7)) == expected
