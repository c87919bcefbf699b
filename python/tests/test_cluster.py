# SPDX-License-Identifier: Apache-2.0
"""Clashes and drawings by tiles have the bytes of one machine, whatever gets lost on the way."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from test_same_as_program import CLASH_RUNS, DRAWINGS

import strake
import strake.cluster
from strake import _core

RULES = """
[sets]
pipes = "PIP*"

[[discipline]]
name = "piping"
select = "set(pipes)"

[[discipline]]
name = "steel"
select = "BEA* or PLA* or FRA*"

[matrix]
name = "by disciplines"

[matrix.cells.piping]
piping = "not checked"
steel = { clearance = "40mm" }

[[test]]
name = "pipes against the rest"
a = "set(pipes)"
b = "not set(pipes)"
clearance = "30mm"

[[test]]
name = "large hits"
clearance = "5mm"
min_volume = "1cm3"

[[exempt]]
name = "beams and meshes"
a = "BEA*"
b = "type = mesh"

[[same_assembly]]
name = "one room"
level = 4

[[same_assembly]]
name = "one room again"
level = 4

[[connected]]
name = "joints"
ends_within = "5mm"
among = "set(pipes)"

[[allowed]]
name = "pipes through anything"
a = "PIP*"
b = "*"
max_depth = "1m"

[[allowed]]
name = "pipes again"
a = "PIP*"
b = "*"
max_depth = "1m"
"""


def bytes_of(result: strake.Clashes | strake.Drawing, folder: Path, name: str = "clashes.json") -> bytes:
    file = folder / name
    result.save(file)
    return file.read_bytes()


@pytest.fixture
def small_tiles(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[int]]:
    """Tiles of few objects, as the memory of workers alone would never cut such small ships."""
    tiles: list[int] = []

    def cut_small(whole_cut: Any, usual: int) -> Any:
        def cut(*arguments: Any) -> Any:
            made = whole_cut(*arguments[:6], tiles[0] if tiles else usual, *arguments[7:])
            sizes = made.sizes
            assert len(sizes) > 3
            assert sum(objects for objects, _ in sizes) > min(made.objects, 60)  # some are in several tiles
            return made

        return cut

    monkeypatch.setattr(_core, "cut", cut_small(_core.cut, 80_000))
    monkeypatch.setattr(_core, "cut_drawing", cut_small(_core.cut_drawing, 200_000))
    yield tiles


@pytest.mark.parametrize(("words", "arguments"), CLASH_RUNS, ids=lambda x: " ".join(x) if isinstance(x, list) else "")
@pytest.mark.parametrize("max_bytes", [25_000, 80_000])
def test_same_bytes(
    tmp_path: Path,
    ship: strake.Model,
    ship_file: Path,
    small_tiles: list[int],
    max_bytes: int,
    words: list[str],
    arguments: dict[str, Any],
) -> None:
    small_tiles.append(max_bytes)
    whole = strake.clash(ship, **arguments)
    tiled = strake.cluster.clash(ship_file, **arguments)
    for name in ("clashes.json", "clashes.csv"):
        assert bytes_of(tiled, tmp_path, name) == bytes_of(whole, tmp_path, name)
    assert tiled.diagnostics == whole.diagnostics
    assert len(tiled) > 0


@pytest.mark.parametrize("kind", ["slender", "dense", "repeated", "unlike", "turned"])
def test_same_bytes_of_other_ships(tmp_path: Path, small_tiles: list[int], kind: str) -> None:
    file = tmp_path / "ship.glb"
    strake.generate("usual" if kind == "turned" else kind, objects=900, seed=7, turned=kind == "turned").save(file)
    arguments: dict[str, Any] = {"clearance": "40mm", "profile": "ship", "volumes": True, "group_by": "proximity"}
    whole = strake.clash(strake.load(file), **arguments)
    assert bytes_of(strake.cluster.clash(file, **arguments), tmp_path) == bytes_of(whole, tmp_path)


def test_same_bytes_of_several_files_and_rules(tmp_path: Path, small_tiles: list[int]) -> None:
    rules = tmp_path / "rules.toml"
    rules.write_text(RULES)
    files = [tmp_path / name for name in ("b.glb", "a.glb", "c.glb")]
    for seed, file in enumerate(files):
        strake.generate(objects=400, seed=seed).save(file)
    for arguments in ({"rules": rules}, {"within_files": True, "clearance": 10}, {}):
        whole = strake.clash(strake.load(files), **arguments)
        tiled = strake.cluster.clash(files, **arguments)
        assert bytes_of(tiled, tmp_path) == bytes_of(whole, tmp_path)
        assert tiled.model.diagnostics == whole.model.diagnostics


# What tiles refuse, as test_drawings_that_make_no_sense() has it.
NOT_BY_TILES = {"centre_lines", "hatch", "style", "single_line"}
TILED_DRAWINGS = [
    (words, options) for words, options in DRAWINGS if options.get("flush_seams", True) and not NOT_BY_TILES & set(options)
] + [
    (["uncut"], {"view": {"section": "z=2500mm"}, "uncut": "BEA*", "hidden": "all", "smooth": "tangent"}),
    (["far"], {"view": {"view": "front", "limits": "auto"}, "visible_only": True, "sag": 0.05}),
    (["local"], {"stage": "local", "intersections": "off", "own_polylines": "hidden", "contact_distance": 2}),
]


@pytest.mark.parametrize(("words", "arguments"), TILED_DRAWINGS, ids=lambda x: " ".join(x) if isinstance(x, list) else "")
def test_drawings(
    tmp_path: Path, ship: strake.Model, ship_file: Path, small_tiles: list[int], words: list[str], arguments: dict[str, Any]
) -> None:
    whole = strake.draw(ship, **arguments)
    tiled = strake.cluster.draw(ship_file, **arguments)
    for name in ("view.svg", "view.json", "view.view"):
        assert bytes_of(tiled, tmp_path, name) == bytes_of(whole, tmp_path, name)
    assert tiled.diagnostics == whole.diagnostics
    assert len(tiled.segments) > 0


def test_drawings_of_several_files(tmp_path: Path, small_tiles: list[int]) -> None:
    files = [tmp_path / name for name in ("b.glb", "a.glb", "c.glb")]
    for seed, (file, kind) in enumerate(zip(files, ("usual", "slender", "unlike"), strict=True)):
        strake.generate(kind, objects=300, seed=seed).save(file)
    for view in ("iso", {"direction": (3, -1, 2), "section": ["x>9m", "z=3m"]}):
        whole = strake.draw(strake.load(files), view, select="not CAB*")
        tiled = strake.cluster.draw(files, view, select="not CAB*")
        assert bytes_of(tiled, tmp_path, "view.json") == bytes_of(whole, tmp_path, "view.json")
        assert tiled.model.diagnostics == whole.model.diagnostics


def test_a_drawing_with_lost_tiles(
    tmp_path: Path, ship: strake.Model, ship_file: Path, small_tiles: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    solve, join = _core.draw_in_tile, _core.join_drawing_tiles
    finished: list[str] = []

    def solve_with_losses(tile: Path, found: Path, options: Any) -> None:
        finished.append(tile.name)
        if len(finished) == 2:
            tile.unlink()
        solve(tile, found, options)

    def join_with_losses(cut: Any, found: list[Path], options: Any) -> Any:
        if "join" not in finished:
            finished.append("join")
            found[1].write_bytes(found[1].read_bytes()[:-7])
        return join(cut, found, options)

    monkeypatch.setattr(_core, "draw_in_tile", solve_with_losses)
    monkeypatch.setattr(_core, "join_drawing_tiles", join_with_losses)
    tiled = strake.cluster.draw(ship_file, hidden=True)
    assert bytes_of(tiled, tmp_path, "view.svg") == bytes_of(strake.draw(ship, hidden=True), tmp_path, "view.svg")
    assert len(finished) == len(set(finished)) + 2  # a tile and a result


def test_drawings_that_make_no_sense(tmp_path: Path, ship: strake.Model, ship_file: Path) -> None:
    with pytest.raises(strake.UsageError, match="flush seams"):
        strake.cluster.draw(ship_file, flush_seams=False)
    for name, value in {"centre_lines": True, "hatch": "off: PIP*", "style": "color=#ff0000: *", "single_line": 60}.items():
        assert name in NOT_BY_TILES
        with pytest.raises(strake.UsageError, match=f"{name}: this is not drawn by tiles"):
            strake.cluster.draw(ship_file, **{name: value})  # type: ignore[arg-type]
    with pytest.raises(strake.UsageError, match="selections"):
        strake.cluster.draw(ship_file, select=ship.select("PIP*"))  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="no argument 'scael'"):
        strake.cluster.draw(ship_file, scael=50)
    with pytest.raises(strake.UsageError, match="picks no object"):
        strake.cluster.draw(ship_file, select="NONE*")
    with pytest.raises(strake.UsageError, match="sharp_angle"):
        strake.cluster.draw(ship_file, sharp_angle=400)


def test_a_lost_tile_and_a_lost_result_are_made_again(
    tmp_path: Path, ship: strake.Model, ship_file: Path, small_tiles: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    find, join = _core.find_in_tile, _core.join_tiles
    finished: list[str] = []

    def find_with_losses(tile: Path, found: Path, options: Any) -> None:
        finished.append(tile.name)
        if len(finished) == 2:
            tile.unlink()
        if len(finished) == 3:
            part = next(iter(tile.parent.glob(f"{tile.stem}.file*")))
            part.write_bytes(part.read_bytes()[:-7])
        find(tile, found, options)

    def join_with_losses(cut: Any, found: list[Path], options: Any) -> Any:
        if "join" not in finished:
            finished.append("join")
            found[1].unlink()
            damaged = bytearray(found[2].read_bytes())
            damaged[len(damaged) // 2] ^= 1
            found[2].write_bytes(damaged)
        return join(cut, found, options)

    monkeypatch.setattr(_core, "find_in_tile", find_with_losses)
    monkeypatch.setattr(_core, "join_tiles", join_with_losses)
    tiled = strake.cluster.clash(ship_file, clearance=25)
    assert bytes_of(tiled, tmp_path) == bytes_of(strake.clash(ship, clearance=25), tmp_path)
    assert len(finished) == len(set(finished)) + 4  # two tiles and two results


def test_tiles_that_are_always_lost_are_an_error(
    tmp_path: Path, ship_file: Path, small_tiles: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    find = _core.find_in_tile

    def find_nothing(tile: Path, found: Path, options: Any) -> None:
        tile.unlink()
        find(tile, found, options)

    monkeypatch.setattr(_core, "find_in_tile", find_nothing)
    with pytest.raises(strake.InputError, match="is missing or damaged"):
        strake.cluster.clash(ship_file, folder=tmp_path / "work")
    assert not list((tmp_path / "work").iterdir())


def test_files_that_change_meanwhile(tmp_path: Path, small_tiles: list[int], monkeypatch: pytest.MonkeyPatch) -> None:
    files = [tmp_path / "a.glb", tmp_path / "b.glb"]
    for seed, file in enumerate(files):
        strake.generate(objects=300, seed=seed).save(file)
    whole = strake.clash(strake.load(files))
    write = _core.write_tiles

    def write_late(cut: Any, folder: Path, *others: Any) -> None:
        strake.generate(objects=301, seed=0).save(files[0])
        if lost:
            for kept in folder.glob("*.strake-kept"):
                kept.unlink()
        write(cut, folder, *others)

    monkeypatch.setattr(_core, "write_tiles", write_late)
    # Each file is read once: what it says later on is for the next run.
    lost = False
    assert bytes_of(strake.cluster.clash(files), tmp_path) == bytes_of(whole, tmp_path)
    strake.generate(objects=300, seed=0).save(files[0])
    lost = True
    with pytest.raises(strake.InputError, match="changed while it was cut"):
        strake.cluster.clash(files)


def test_what_makes_no_sense(tmp_path: Path, ship: strake.Model, ship_file: Path) -> None:
    with pytest.raises(strake.UsageError, match="amount of memory"):
        strake.cluster.clash(ship_file, memory="much")
    with pytest.raises(strake.UsageError, match="too little"):
        strake.cluster.clash(ship_file, memory="1MiB")
    with pytest.raises(strake.UsageError, match="selections"):
        strake.cluster.clash(ship_file, ship.select("PIP*"))  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="no argument 'clearence'"):
        strake.cluster.clash(ship_file, clearence=25)
    with pytest.raises(strake.UsageError, match="worker_threads"):
        strake.cluster.clash(ship_file, worker_threads=0)
    with pytest.raises(strake.OutputError, match="no folder can be made"):
        strake.cluster.clash(ship_file, folder=ship_file)
    project = strake.Project.create(tmp_path / "ship.strake")
    with pytest.raises(strake.UsageError, match="is a project"):
        strake.cluster.clash([ship_file, project.path])
    assert len(strake.cluster.clash(ship_file, memory="1" + "0" * 400)) > 0
    for folder in ("x", "y"):
        (tmp_path / folder).mkdir()
        strake.generate(objects=200, seed=len(folder)).save(tmp_path / folder / "ship.glb")
    namesakes = [tmp_path / "x" / "ship.glb", tmp_path / "y" / "ship.glb"]
    with pytest.raises(strake.UsageError, match="one name"):
        strake.cluster.clash(namesakes, "PIP*")
    whole = strake.clash(strake.load(namesakes))
    assert bytes_of(strake.cluster.clash(namesakes), tmp_path) == bytes_of(whole, tmp_path)


def test_the_package_brings_it() -> None:
    code = "import strake; print(strake.cluster.clash.__module__)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "strake.cluster\n"


def test_the_documented_script(tmp_path: Path, ship: strake.Model) -> None:
    pytest.importorskip("distributed")
    page = Path(__file__).resolve().parents[2] / "docs/cluster.md"
    ship.save(tmp_path / "ship.glb")
    (tmp_path / "script.py").write_text(page.read_text().split("```python\n")[1].split("```")[0])
    subprocess.run([sys.executable, "script.py"], cwd=tmp_path, check=True, timeout=300)
    assert (tmp_path / "clashes.json").read_bytes() == bytes_of(strake.clash(ship, clearance=25), tmp_path, "whole.json")


def test_a_scheduler_that_is_none(ship_file: Path) -> None:
    pytest.importorskip("distributed")
    with pytest.raises(strake.UsageError, match="no scheduler answers"):
        strake.cluster.clash(ship_file, scheduler="tcp://127.0.0.1:1x")


def test_without_dask(ship_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ImportError, match=r"pip install 'strake\[cluster\]'"):
        strake.cluster.clash(ship_file, scheduler="tcp://127.0.0.1:1")


def _kill_then_do(task: Any, tile_file: str, found: str, threads: int) -> None:
    """What a worker does, but the first two that come end as if they had run out of memory."""
    for name in ("first", "second"):
        try:
            (Path(tile_file).parents[1] / f"{name}.killed").touch(exist_ok=False)
        except FileExistsError:
            continue
        os.kill(os.getpid(), signal.SIGKILL)
    task(tile_file, found, threads)


@pytest.fixture
def through_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """The program starts this Python, which has the package."""
    monkeypatch.setenv("STRAKE_PYTHON", sys.executable)


@pytest.mark.parametrize(("words", "arguments"), CLASH_RUNS, ids=lambda x: " ".join(x) if isinstance(x, list) else "")
def test_the_program_clashes_by_tiles(
    tmp_path: Path, through_python: None, ship_file: Path, words: list[str], arguments: dict[str, Any]
) -> None:
    whole, tiled = tmp_path / "whole.json", tmp_path / "tiled.json"
    strake.run_program(["clash", ship_file, *words, "--quiet", "-o", whole])
    done = strake.run_program(["clash", ship_file, *words, "--scheduler", "local", f"--output={tiled}", "--quiet"])
    assert (done.stdout, done.stderr) == ("", "")
    assert tiled.read_bytes() == whole.read_bytes()


@pytest.mark.parametrize(("words", "arguments"), TILED_DRAWINGS[:-3], ids=lambda x: " ".join(x) if isinstance(x, list) else "")
def test_the_program_draws_by_tiles(
    tmp_path: Path, through_python: None, ship_file: Path, words: list[str], arguments: dict[str, Any]
) -> None:
    strake.run_program(["draw", ship_file, *words, "-o", tmp_path / "whole.svg", "-o", tmp_path / "whole.json"])
    files = ["-o", tmp_path / "tiled.svg", "-o", tmp_path / "tiled.json"]
    done = strake.run_program(["draw", ship_file, *words, "--scheduler", "local", "--worker-memory", "500MiB", *files])
    assert "visible lines" in done.stderr
    for name in ("svg", "json"):
        assert (tmp_path / f"tiled.{name}").read_bytes() == (tmp_path / f"whole.{name}").read_bytes()


def test_what_the_program_refuses_by_tiles(tmp_path: Path, through_python: None, ship_file: Path) -> None:
    def ended(*words: object) -> tuple[int, str]:
        done = strake.run_program([str(word) for word in words], check=False)
        return done.returncode, done.stderr

    out = tmp_path / "out.json"
    code, reported = ended("clash", ship_file, "--scheduler", "local")
    assert code == 2 and "no file is named" in reported
    code, reported = ended("clash", ship_file, "--scheduler", "local", "-o", out, "--fail-on", "hit")
    assert code == 2 and "--fail-on: strake clash has it on one machine only" in reported
    code, reported = ended("draw", ship_file, "--scheduler", "local", "-o", out, "--flush-seams", "off")
    assert code == 2 and "flush seams" in reported
    code, reported = ended("draw", ship_file, "--scheduler", "local", "-o", out, "--near", "much", "--eye", "1,2,3", "--target", "9,9,9")
    assert code == 2 and "near" in reported
    code, reported = ended("clash", tmp_path / "none.glb", "--scheduler", "local", "-o", out)
    assert code == 3 and "none.glb" in reported
    code, reported = ended("clash", ship_file, "--scheduler", "tcp://127.0.0.1:1x", "-o", out)
    assert code == 2 and ("no scheduler answers" in reported or "strake[cluster]" in reported)
    assert not out.exists()


# Words that the package refuses, with what the program tells of them.
WRONG_WORDS = [
    ("clash", ["--worker-memory", "1MiB"], "--worker-memory: '1MiB' is too little for a worker"),
    ("clash", ["--worker-memory", "much"], "--worker-memory: 'much' is no amount of memory"),
    ("clash", ["--sort", "size"], "--sort: only groups have a size (give --group-by)"),
    ("clash", ["--group-distance", "10mm"], "--group-distance: there are no groups (give --group-by)"),
    ("clash", ["--list-exempted"], "--list-exempted: there are no rules that exempt (give --rules or --profile)"),
    ("clash", ["--a", "NONE*", "--clearance", "@"], "--clearance: "),
    ("draw", ["--flush-seams", "off"], "--flush-seams: drawings by tiles have the flush seams"),
    ("draw", ["--sharp-angle", "400"], "--sharp-angle: it is no angle between two faces"),
    ("draw", ["--select", "NONE*"], "--select: "),
    ("draw", ["--own-polylines", "some"], "--own-polylines: "),
    ("draw", ["--near", "much", "--eye", "1,2,3", "--target", "9,9,9"], "--near: "),
]


@pytest.mark.parametrize(("verb", "words", "reported"), WRONG_WORDS, ids=lambda x: " ".join(x) if isinstance(x, list) else "")
def test_the_program_reports_its_own_words(
    tmp_path: Path, through_python: None, ship_file: Path, verb: str, words: list[str], reported: str
) -> None:
    done = strake.run_program([verb, ship_file, *words, "--scheduler", "local", "-o", tmp_path / "out.json"], check=False)
    assert done.returncode == 2
    assert done.stderr.startswith(f"strake: error: {reported}")
    assert not re.search(r"(?<![\w'])[a-z]+_[a-z_]+", done.stderr)


def test_no_module_comes_from_the_folder_of_the_run(
    tmp_path: Path, through_python: None, ship_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "numpy.py").write_text("raise SystemExit('taken from beside the model')\n")
    monkeypatch.chdir(tmp_path)
    done = strake.run_program(["clash", str(ship_file), "--scheduler", "local", "--quiet", "-o", "out.json"], check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_python_without_the_package(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, ship_file: Path) -> None:
    words = ["clash", str(ship_file), "--scheduler", "local", "-o", str(tmp_path / "out.json")]
    monkeypatch.setenv("STRAKE_PYTHON", str(tmp_path / "python9"))
    done = strake.run_program(words, check=False)
    assert done.returncode == 2 and "cannot be run" in done.stderr and "STRAKE_PYTHON" in done.stderr
    bare = tmp_path / "bare"
    bare.write_text(f'#!/bin/sh\nexec {sys.executable} -I -S "$@"\n')
    bare.chmod(0o755)
    monkeypatch.setenv("STRAKE_PYTHON", str(bare))
    done = strake.run_program(words, check=False)
    assert done.returncode == 2 and "pip install 'strake[cluster]'" in done.stderr
    assert "Traceback" not in done.stderr


def test_killed_workers(
    tmp_path: Path, ship: strake.Model, ship_file: Path, small_tiles: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    distributed = pytest.importorskip("distributed")
    cloudpickle = pytest.importorskip("cloudpickle")
    whole = bytes_of(strake.clash(ship, clearance=25), tmp_path)
    workers = distributed.LocalCluster(n_workers=2, threads_per_worker=1, memory_limit="512MiB", dashboard_address=None)
    with workers as cluster, distributed.Client(cluster) as client:
        assert bytes_of(strake.cluster.clash(ship_file, scheduler=client, clearance=25), tmp_path) == whole
        submit = client.submit
        cloudpickle.register_pickle_by_value(sys.modules[__name__])  # workers do not see this file

        def submit_killer(task: Any, *arguments: Any, **options: Any) -> Any:
            return submit(_kill_then_do, task, *arguments, **options)

        monkeypatch.setattr(client, "submit", submit_killer)
        tiled = strake.cluster.clash(ship_file, scheduler=client, folder=tmp_path / "work", clearance=25)
        drawn = strake.cluster.draw(ship_file, "top", scheduler=client, folder=tmp_path / "drawn")
        assert bytes_of(drawn, tmp_path, "view.json") == bytes_of(strake.draw(ship, "top"), tmp_path, "view.json")
    assert bytes_of(tiled, tmp_path) == whole
    for name in ("work", "drawn"):
        assert len(list(tmp_path.glob(f"{name}/*.killed"))) == 2
