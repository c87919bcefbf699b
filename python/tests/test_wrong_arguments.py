# SPDX-License-Identifier: Apache-2.0
"""Every argument of every function and method, given what makes no sense: the error is in the words of the caller."""

from __future__ import annotations

import inspect
import stat
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import strake

# Of the kind that an argument has none is: each has to be refused, with the name of the argument.
SENSELESS: list[Any] = [object(), float("nan"), -1.5, 10**400, np.zeros((2, 2)), "a\0b", "\ud800", [object()]]
# What makes sense for some arguments.
ODD: list[Any] = [None, 7, -1, 1e300, 10**30, "x", "", b"x", [], {}, np.array(["a"]), True, ["a", 7], (1, 2, 3), {1}]

Call = Callable[..., object]


@pytest.fixture(scope="module")
def calls(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Call, dict[str, Any]]]:
    """Every public function and method by name, and what it needs at least."""
    folder = tmp_path_factory.mktemp("wrong")
    model = strake.generate(objects=100)
    model.save(folder / "ship.glb")
    (folder / "sheet.toml").write_text((Path(__file__).parents[2] / "examples/ship_sheet.toml").read_text())
    sheet = strake.Sheet.read(folder / "sheet.toml")
    project = strake.Project.create(folder / "a.strake", folder / "ship.glb")
    clashes, drawing = strake.clash(model, clearance=25), strake.draw(model)
    triangle = ("t", np.eye(3), [[0, 1, 2]])
    return {
        "clash": (strake.clash, {"model": model}),
        "cluster.clash": (strake.cluster.clash, {"files": folder / "ship.glb"}),
        "draw": (strake.draw, {"model": model}),
        "load": (strake.load, {"files": folder / "ship.glb"}),
        "generate": (strake.generate, {"objects": 100}),
        "evaluate": (strake.evaluate, {"folder": folder / "evaluation", "scale": -1}),
        "run_program": (strake.run_program, {"arguments": ["--version"]}),
        "select": (model.select, {"expression": "PIP*"}),
        "mesh": (model.mesh, {"i": 0}),
        "save": (model.save, {"path_to": folder / "o.glb"}),
        "from_arrays": (strake.Model.from_arrays, {"meshes": [triangle]}),
        "from_trimesh": (strake.Model.from_trimesh, {"scene": SimpleNamespace(vertices=np.eye(3), faces=[[0, 1, 2]], metadata={})}),
        "clashes.save": (clashes.save, {"path_to": folder / "c.json"}),
        "clashes.table": (clashes.table, {}),
        "clashes.save_pictures": (clashes.save_pictures, {"folder": folder / "pictures"}),
        "clashes.save_pair_log": (strake.clash(model, log_pairs=True).save_pair_log, {"path_to": folder / "p.csv"}),
        "drawing.save": (drawing.save, {"path_to": folder / "d.svg"}),
        "sheet.read": (strake.Sheet.read, {"file": folder / "sheet.toml"}),
        "sheet.draw": (sheet.draw, {"model": model}),
        "sheet.save": (sheet.draw(model).save, {"path_to": folder / "s.svg"}),
        "project": (strake.Project, {"file": folder / "a.strake"}),
        "project.create": (strake.Project.create, {"file": folder / "no folder" / "b.strake"}),
        "project.add": (project.add, {"models": folder / "ship.glb"}),
        "project.update": (project.update, {}),
        "project.remove": (project.remove, {}),
        "project.clash": (project.clash, {}),
        "project.list": (project.list, {}),
        "project.set_status": (project.set_status, {"keys": "x", "status": "new"}),
        "project.draw": (project.draw, {"view": "top"}),
        "project.store_view": (project.store_view, {"name": "v"}),
        "project.model": (project.model, {}),
    }


NAMES = [
    *("clash", "draw", "load", "generate", "evaluate", "run_program", "select", "mesh", "save", "from_arrays", "from_trimesh"),
    *("clashes.save", "clashes.table", "clashes.save_pictures", "clashes.save_pair_log"),
    *("drawing.save", "sheet.read", "sheet.draw", "sheet.save", "project", "project.create"),
    *("project.add", "project.update", "project.remove", "project.clash", "project.list", "project.set_status"),
    *("project.draw", "project.store_view", "project.model", "cluster.clash"),
]


def names_of(call: Call) -> list[str]:
    return [name for name, one in inspect.signature(call).parameters.items() if one.kind != inspect.Parameter.VAR_KEYWORD]


def call_with(call: Call, needed: dict[str, Any], name: str, value: Any) -> None:
    if inspect.signature(call).parameters[name].kind == inspect.Parameter.VAR_POSITIONAL:
        call(value)
    else:
        call(**{**needed, name: value})


@pytest.mark.parametrize("function", NAMES)
def test_what_has_no_sense_is_refused_by_its_name(calls: dict[str, tuple[Call, dict[str, Any]]], function: str) -> None:
    call, needed = calls[function]
    for name in names_of(call):
        for value in SENSELESS:
            if (function, name) == ("mesh", "i") and isinstance(value, int):
                continue  # a number, of no object
            with pytest.raises(strake.UsageError) as raised:
                call_with(call, needed, name, value)
            reported = str(raised.value)
            assert name in reported, (name, value, reported)
            assert "incompatible function" not in reported and len(reported) < 400 and "\n" not in reported


@pytest.mark.parametrize("function", NAMES)
def test_whatever_comes_the_error_is_one_that_can_be_foreseen(
    calls: dict[str, tuple[Call, dict[str, Any]]], function: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    call, needed = calls[function]
    for name in names_of(call):
        for number, value in enumerate(ODD):
            here = tmp_path / f"{name}{number}"
            here.mkdir()
            monkeypatch.chdir(here)
            if (function, name) in (("project.create", "file"), ("evaluate", "scale"), ("cluster.clash", "scheduler")):
                continue  # these may well be meant
            try:
                call_with(call, needed, name, value)
            except (strake.Error, IndexError) as error:
                assert "incompatible function" not in str(error)
                assert "\n" not in str(error)


def test_what_the_library_refuses_has_the_name_of_the_argument() -> None:
    model = strake.generate(objects=100)
    for where, call in (
        ("view", lambda: strake.draw(model, "isoo")),
        ("clearance", lambda: strake.clash(model, clearance="25")),
        ("objects", lambda: strake.generate(objects=5)),
    ):
        with pytest.raises(strake.UsageError) as raised:
            call()
        assert raised.value.where == where


def test_indices_that_are_none(calls: dict[str, tuple[Call, dict[str, Any]]]) -> None:
    model = strake.generate(objects=100)
    for sequence in (model.objects, strake.clash(model)):
        for index in (None, "a", 1.5):
            with pytest.raises(TypeError, match="by its number"):
                sequence[index]  # type: ignore[call-overload]
        with pytest.raises(IndexError):
            sequence[10**30]


def test_memory_that_runs_out_is_a_memory_error() -> None:
    assert issubclass(strake.OutOfMemory, MemoryError)


def test_a_project_of_no_models_leaves_no_file(tmp_path: Path) -> None:
    file = tmp_path / "a.strake"
    for models in (None, 7, [None], tmp_path / "absent.glb", ["a\0b"]):
        with pytest.raises(strake.Error):
            strake.Project.create(file, models)  # type: ignore[arg-type]
        assert list(tmp_path.iterdir()) == []


def test_a_program_that_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = tmp_path / "text"
    text.write_text("no program\n")
    for given, why in ((tmp_path / "absent", "there is no file"), (tmp_path, "there is no file"), (text, "may not be run")):
        monkeypatch.setenv("STRAKE_PROGRAM", str(given))
        with pytest.raises(strake.UsageError, match=why) as raised:
            strake.run_program(["--version"])
        assert raised.value.where == "STRAKE_PROGRAM" and raised.value.mend
    text.chmod(text.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("STRAKE_PROGRAM", str(text))
    with pytest.raises(strake.UsageError, match="cannot be run"):
        strake.run_program(["--version"])


def test_a_project_is_read_as_a_file(tmp_path: Path, ship_file: Path, ship: strake.Model) -> None:
    model = tmp_path / "ship.glb"
    model.write_bytes(ship_file.read_bytes())
    strake.Project.create(tmp_path / "a.strake", model)
    model.unlink()
    loaded = strake.load(tmp_path / "a.strake")
    assert loaded.ids.tolist() == ship.ids.tolist()
    assert "ship.glb" in repr(loaded) and "400 objects" in repr(loaded)
    for arguments, name in (({"unit": "mm"}, "unit"), ({"up_axis": "z"}, "up_axis"), ({"georeference": True}, "georeference")):
        with pytest.raises(strake.UsageError, match="is a project") as raised:
            strake.load(tmp_path / "a.strake", **arguments)
        assert raised.value.where == name
    with pytest.raises(strake.UsageError, match="read alone"):
        strake.load([tmp_path / "a.strake", ship_file])
