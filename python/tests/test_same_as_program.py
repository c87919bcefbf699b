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
    (["--profile", "ship", "--list-exempted", "--class", "hit,contact"],
     {"profile": "ship", "list_exempted": True, "classes": ["hit", "contact"]}),
    (["--sag", "0.01mm", "--weld", "0.5mm", "--obstructions", "--insulation", "--group-by", "element", "--sort", "size"],
     {"sag": 0.01, "weld": "0.5mm", "obstructions": True, "insulation": True, "group_by": "element", "sort": "size"}),
]  # fmt: skip


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


FORMS: list[tuple[str, list[str], dict[str, Any]]] = [
    ("c.csv", ["--csv", "excel-comma"], {"csv": "excel-comma"}),
    ("c.xlsx", [], {}),
    ("c.html", ["--page-geometry", "near"], {"page_geometry": "near"}),
    ("c.bcf", ["--bcf-version", "3.0", "--bcf-max-topics", "7", "--bcf-contacts", "--bcf-date", "2026-01-31", "--bcf-author", "Ann"],
     {"bcf_version": "3.0", "bcf_most": 7, "bcf_contacts": True, "bcf_date": "2026-01-31", "bcf_author": "Ann"}),
    ("c.xml", [], {}),
    ("c.svg", [], {}),
    ("c.glb", [], {}),
    ("c.joints.csv", [], {}),
    ("c.ifcclash.json", [], {}),
]  # fmt: skip


@pytest.mark.parametrize(("name", "words", "arguments"), FORMS, ids=lambda x: x if isinstance(x, str) else "")
def test_forms_of_clashes(
    tmp_path: Path, ship: strake.Model, ship_file: Path, name: str, words: list[str], arguments: dict[str, Any]
) -> None:
    expected = written_by_program(tmp_path, name, "clash", ship_file, *words)
    assert written_by_save(tmp_path, name, strake.clash(ship), **arguments) == expected


def test_pictures_and_pair_log(tmp_path: Path, ship: strake.Model, ship_file: Path) -> None:
    written_by_program(tmp_path, "c.json", "clash", ship_file, "--clearance", "100mm", "--pictures", tmp_path / "a", "--top-pictures", 3,
                       "--log-pairs", tmp_path / "a.csv")  # fmt: skip
    clashes = strake.clash(ship, clearance=100, log_pairs=True)
    drawn, left_out = clashes.save_pictures(tmp_path / "b", most=3)
    assert drawn == 3 and left_out > 0
    clashes.save_pair_log(tmp_path / "b.csv")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    names = sorted(file.name for file in (tmp_path / "a").iterdir())
    assert len(names) == 4 and names == sorted(file.name for file in (tmp_path / "b").iterdir())
    for name in names:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    with pytest.raises(strake.UsageError, match="log_pairs=True"):
        strake.clash(ship).save_pair_log(tmp_path / "c.csv")


def test_page_of_a_drawing(tmp_path: Path, ship: strake.Model, ship_file: Path) -> None:
    expected = written_by_program(tmp_path, "view.html", "draw", ship_file, "--view", "top")
    assert written_by_save(tmp_path, "view.html", strake.draw(ship, "top")) == expected


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
    (["--view", "front", "--hidden", "dashed", "--hidden-layers", "two", "--centre-lines", "on"],
     {"view": "front", "hidden": "dashed", "hidden_layers": "two", "centre_lines": True}),
    (["--section", "z=2500mm", "--view", "top", "--hatch", "30deg,80mm: PIP*", "--hatch", "off", "--centre-lines", "4mm"],
     {"view": {"view": "top", "section": "z=2500mm"}, "hatch": ["30deg,80mm: PIP*", "off"], "centre_lines": 4}),
    (["--visible-only", "--flush-seams", "off", "--limits", "auto"],
     {"visible_only": True, "flush_seams": False, "view": {"limits": "auto"}}),
    (["--style", "name=PIPES,color=#c00000,pen=0.35mm,line=dash-dot: PIP*", "--style", "line=3mm 1mm: *", "--hidden", "all"],
     {"style": ["name=PIPES,color=#c00000,pen=0.35mm,line=dash-dot: PIP*", "line=3mm 1mm: *"], "hidden": "all"}),
    (["--thin", "on", "--break-lines", "on", "--limits", "0,-4000,0,6000,4000,9000", "--view", "top"],
     {"thin": True, "break_lines": True, "view": {"view": "top", "limits": (0, -4000, 0, 6000, 4000, 9000)}}),
    (["--thin", "2mm+dxf", "--view", "left", "--scale", "1:100"], {"view": "left", "thin": "2mm+dxf", "scale": "1:100"}),
    (["--thin", "1.5mm", "--single-line", "120mm", "--view", "top"], {"view": "top", "thin": 1.5, "single_line": 120}),
    (["--single-line", "DN50", "--centre-lines", "on", "--select", "PIP*"],
     {"single_line": "DN50", "centre_lines": True, "select": "PIP*"}),
]  # fmt: skip


@pytest.mark.parametrize(("words", "arguments"), DRAWINGS, ids=lambda x: " ".join(x) if isinstance(x, list) else "")
@pytest.mark.parametrize("name", ["view.svg", "view.pdf", "view.dxf", "view.json"])
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
