# SPDX-License-Identifier: Apache-2.0
"""Several files of one importer: each is as if it were alone."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import sysconfig
import time
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork")

# What becomes of a file is what is written in it.
PROGRAM = """
import os, pathlib, signal, subprocess, sys, time
from strake.importers import Job, run_several

def convert(job):
    text = job.input.read_text()
    if text == "crash":
        os.kill(os.getpid(), signal.SIGSEGV)
    if text == "hang":
        subprocess.Popen(["sleep", "600"])
        pathlib.Path("pid").write_text(str(os.getpid()))
        time.sleep(600)
    if text == "starve":
        raise MemoryError
    if text == "block":
        os.mkdir("ended.part")
    print("printed for", text, "in", os.getcwd(), sorted(os.listdir()), flush=True)
    print(sys.stdin.read(), end="", flush=True)
    job.output.write_text("scene of " + text)
    job.made_by = f"toy with {loaded}"

def load():
    global loaded
    loaded = "libraries"
    with open(sys.argv[1], "a") as file:
        file.write("x")

sys.exit(run_several(convert, load))
"""


class Host:
    """A program that reads several files."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.loads = folder / "loads"
        self.process = subprocess.Popen([sys.executable, "-c", PROGRAM, str(self.loads)], stdin=subprocess.PIPE)

    def begin(self, name: str, text: str) -> Path:
        """Begins a file; returns its folder."""
        folder = self.folder / name
        folder.mkdir()
        model = self.folder / f"{name}.toy"
        model.write_text(text)
        arguments = ["--input", str(model), "--output", str(folder / "s.glb"), "--report", str(folder / "r"), "--threads", "1"]
        (folder / "job.json").write_text(json.dumps({"arguments": arguments, "log": str(folder / "log")}))
        self.order("run", folder)
        return folder

    def order(self, word: str, folder: Path) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(f"{word} {folder}\n".encode())
        self.process.stdin.flush()

    def leave(self) -> int:
        """Says nothing more."""
        assert self.process.stdin is not None
        self.process.stdin.close()
        return self.process.wait(30)


def appeared(path: Path) -> Path:
    """Waits for a file."""
    until = time.monotonic() + 60
    while not path.exists() and time.monotonic() < until:
        time.sleep(0.01)
    assert path.exists(), path
    return path


def ended(folder: Path) -> dict[str, Any]:
    """Waits for the end of a file; returns how it ended."""
    result: dict[str, Any] = json.loads(appeared(folder / "ended").read_text())
    return result


def last_line(folder: Path) -> dict[str, Any]:
    result: dict[str, Any] = json.loads((folder / "r").read_text().splitlines()[-1])
    return result


def lives(process: int) -> bool:
    """Whether a process runs; one that only waits for its parent does not."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def has_gone(process: int) -> bool:
    """Waits for the end of a process; returns whether it came."""
    until = time.monotonic() + 30
    while lives(process) and time.monotonic() < until:
        time.sleep(0.01)
    return not lives(process)


def test_libraries_are_loaded_once_and_each_file_has_its_folder_and_log(tmp_path: Path) -> None:
    host = Host(tmp_path)
    folders = [host.begin(name, name) for name in ("a", "b", "c")]
    for folder in folders:
        assert ended(folder) == {"status": 0}
        assert (folder / "s.glb").read_text() == f"scene of {folder.name}"
        assert last_line(folder)["made_by"] == "toy with libraries"
        assert (folder / "log").read_text() == f"printed for {folder.name} in {folder} ['log', 'r']\n", "nothing of the order is left"
    assert host.loads.read_text() == "x"
    assert host.leave() == 0


def test_what_goes_wrong_with_one_file_is_nothing_to_the_others(tmp_path: Path) -> None:
    host = Host(tmp_path)
    bad = {text: host.begin(text, text) for text in ("crash", "starve", "hang")}
    good = host.begin("good", "good")
    assert ended(bad["crash"]) == {"status": 1} and "SIGSEGV" in last_line(bad["crash"])["error"]
    assert ended(bad["starve"]) == {"status": 1} and "memory" in last_line(bad["starve"])["error"]
    assert ended(good) == {"status": 0}
    process = int(appeared(bad["hang"] / "pid").read_text())
    host.order("end", bad["hang"])
    assert ended(bad["hang"]) == {"signal": 9}
    assert has_gone(process)
    assert ended(host.begin("later", "later")) == {"status": 0}
    assert host.leave() == 0


def test_an_end_that_cannot_be_told_is_told_by_the_end_of_all(tmp_path: Path) -> None:
    host = Host(tmp_path)
    hanging = int(appeared(host.begin("hang", "hang") / "pid").read_text())
    host.begin("block", "block")
    assert host.process.wait(30) == 1
    assert not (tmp_path / "block" / "ended").exists()
    assert has_gone(hanging)


def test_what_is_wrong_with_an_importer_stands_in_the_log(tmp_path: Path) -> None:
    host = Host(tmp_path)
    folder = tmp_path / "a"
    folder.mkdir()
    words = ["--input", str(tmp_path), "--output", str(folder / "s.glb"), "--report", str(tmp_path / "none" / "r"), "--threads", "1"]
    (folder / "job.json").write_text(json.dumps({"arguments": words, "log": str(folder / "log")}))
    host.order("run", folder)
    assert ended(folder) == {"status": 1}
    assert "FileNotFoundError" in (folder / "log").read_text()
    assert host.leave() == 0


def test_all_files_end_with_who_ordered_them(tmp_path: Path) -> None:
    host = Host(tmp_path)
    process = int(appeared(host.begin("h", "hang") / "pid").read_text())
    assert host.leave() == 0
    assert has_gone(process)


def test_orders_that_are_none_are_answered_or_passed_over(tmp_path: Path) -> None:
    host = Host(tmp_path)
    for name, text in (("none", None), ("empty", "{}"), ("torn", '{"arguments": [')):
        folder = tmp_path / name
        folder.mkdir()
        if text is not None:
            (folder / "job.json").write_text(text)
        host.order("run", folder)
        assert ended(folder) == {"status": 2}
    host.order("dance", tmp_path)
    host.order("run", tmp_path / "nowhere")
    host.order("end", tmp_path / "nowhere")
    wrong = tmp_path / "wrong"
    wrong.mkdir()
    (wrong / "job.json").write_text(json.dumps({"arguments": ["--dance"], "log": str(wrong / "log")}))
    host.order("run", wrong)
    assert ended(wrong) == {"status": 2} and "--input" in (wrong / "log").read_text()
    assert ended(host.begin("good", "good")) == {"status": 0}
    assert host.leave() == 0


def test_files_that_the_installed_program_imports_together_have_the_bytes_of_each_alone(tmp_path: Path) -> None:
    pytest.importorskip("ifcopenshell")
    from conversions import convert
    from ifc_model import IfcModel

    programs = Path(sysconfig.get_path("scripts"))
    files, alone = [], []
    for number in range(3):
        model = IfcModel()
        wall = model.product("IfcWall", f"wall {number}", model.body(model.extrusion((4000, 200, 2500 + number))))
        model.void(wall, model.body(model.extrusion((1000, 400, 1000), (0, 0, 900))))
        files.append(model.write(tmp_path / f"{number}.ifc"))
        alone.append(convert(files[-1], threads=1).output.read_bytes())
    (tmp_path / "bad.ifc").write_text("nothing of the kind")
    host = subprocess.Popen([programs / "strake-import-many-ifc"], stdin=subprocess.PIPE)
    assert host.stdin is not None
    folders = []
    for file in (*files, tmp_path / "bad.ifc"):
        folders.append(tmp_path / f"of {file.stem}")
        folders[-1].mkdir()
        words = ["--input", str(file), "--output", str(folders[-1] / "s.glb"), "--report", str(folders[-1] / "r"), "--threads", "1"]
        (folders[-1] / "job.json").write_text(json.dumps({"arguments": words, "log": str(folders[-1] / "log")}))
        host.stdin.write(f"run {folders[-1]}\n".encode())
    host.stdin.flush()
    assert [ended(folder) for folder in folders] == [{"status": 0}] * 3 + [{"status": 1}]
    assert [(folder / "s.glb").read_bytes() for folder in folders[:3]] == alone
    assert "no IFC" in last_line(folders[3])["error"]
    host.stdin.close()
    assert host.wait(30) == 0
