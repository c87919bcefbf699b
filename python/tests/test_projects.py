# SPDX-License-Identifier: Apache-2.0
"""Projects, and what is left to the program."""

from pathlib import Path

import pytest

import strake


def test_a_week_of_a_project(tmp_path: Path, ship_file: Path, ship: strake.Model) -> None:
    model = tmp_path / "ship.glb"
    model.write_bytes(ship_file.read_bytes())
    project = strake.Project.create(tmp_path / "ship.strake", model)
    assert project.model().ids.tolist() == ship.ids.tolist()
    document = project.clash(clearance=25, save=tmp_path / "clashes.json")
    assert len(document["results"]) == len(strake.clash(ship, clearance=25))
    assert (tmp_path / "clashes.json").exists()

    listed = project.list("clashes")
    assert len(listed["key"]) == len(document["results"])
    assert project.list("clashes", most=3)["key"].tolist() == listed["key"][:3].tolist()
    project.set_status(listed["key"][0], status="approved", comment="as built", by="test")
    assert project.list("clashes")["status"].tolist().count("approved") == 1

    svg = project.store_view("top", ["--view", "top"])
    assert svg == project.draw("top")
    assert project.draw("top", hidden="dashed") == strake.draw(ship, "top", hidden="dashed").svg
    assert project.list("views")["name"].tolist() == ["top"]

    strake.generate(objects=401, seed=3).save(model)
    changes = project.update()
    assert sum(changes["counts"].values()) > 0
    assert len(project.list("revisions")["id"]) == 2


def test_what_projects_refuse(tmp_path: Path, ship_file: Path) -> None:
    with pytest.raises(strake.InputError):
        strake.Project(ship_file)
    strake.Project.create(tmp_path / "a.strake")
    with pytest.raises(strake.OutputError):
        strake.Project.create(tmp_path / "a.strake")
    with pytest.raises(strake.UsageError, match="list"):
        strake.Project(tmp_path / "a.strake").list("nails")
    with pytest.raises(strake.InputError, match=r"absent\.glb"):
        strake.Project.create(tmp_path / "b.strake", tmp_path / "absent.glb")
    assert not (tmp_path / "b.strake").exists()


def test_the_program_fails(tmp_path: Path) -> None:
    with pytest.raises(strake.UsageError):
        strake.run_program(["draw", "--no-such-option"])
    with pytest.raises(strake.InputError, match=r"absent\.glb"):
        strake.run_program(["info", str(tmp_path / "absent.glb")])
    assert strake.run_program(["info", str(tmp_path / "absent.glb")], check=False).returncode == 3


def test_evaluation(tmp_path: Path) -> None:
    folder = strake.evaluate(tmp_path / "evaluation", scale=0.002, only="iso", threads=2, arguments=["--repeat", "1"])
    assert (folder / "evaluation.json").exists()
