# SPDX-License-Identifier: Apache-2.0
"""How importers are called and what they answer, whatever becomes of them."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from glb_reader import Glb
from strake.importers import Job, Part, Report, __main__, ifc, run

TRIANGLE = Part(np.eye(3), [[0, 1, 2]])


def called(convert: Callable[[Job], None], folder: Path, name: str = "model.xyz") -> tuple[int, list[dict[str, Any]]]:
    """Runs an importer on a small file; returns its status and its report."""
    (folder / name).write_text("model")
    report = folder / "report.jsonl"
    arguments = ["--input", str(folder / name), "--output", str(folder / "s.glb"), "--report", str(report), "--threads", "3"]
    status = run(convert, arguments)
    return status, [json.loads(line) for line in report.read_text("utf-8").splitlines()]


def test_a_conversion_ends_with_who_made_it(tmp_path: Path) -> None:
    def convert(job: Job) -> None:
        assert job.threads == 3
        job.made_by, job.format, job.unit, job.depends_on = "reader 1", "XYZ", "m", ["/lib/reader.so"]
        job.report.progress(0.5)
        job.report.skipped("xyz-bad", "\u00fc is bad", "7")
        with job.scene() as scene:
            scene.object("7", "t", scene.shape([TRIANGLE]))

    status, lines = called(convert, tmp_path)
    assert status == 0
    assert lines[0] == {"progress": 0.5}
    assert lines[1] == {"severity": "skipped", "code": "xyz-bad", "object": "7", "message": "\u00fc is bad"}
    assert {key: lines[-1][key] for key in ("made_by", "format", "unit")} == {"made_by": "reader 1", "format": "XYZ", "unit": "m"}
    assert "/lib/reader.so" in lines[-1]["depends_on"] and any(path.endswith("scene_writer.py") for path in lines[-1]["depends_on"])
    assert Glb(tmp_path / "s.glb").ids == ["7"]


def refuse(job: Job) -> None:
    job.report.fail("no", "try yes")


def crash(_: Job) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def blunder(_: Job) -> None:
    raise KeyError("x")


def starve(_: Job) -> None:
    raise MemoryError


def leave(_: Job) -> None:
    raise SystemExit(3)


@pytest.mark.parametrize(
    ("convert", "error"), [(refuse, "no"), (crash, "SIGKILL"), (blunder, "KeyError"), (starve, "memory"), (leave, "unknown fault")]
)
def test_whatever_goes_wrong_is_the_last_line(tmp_path: Path, convert: Callable[[Job], None], error: str) -> None:
    status, lines = called(convert, tmp_path)
    assert status == 1 and error in lines[-1]["error"] and lines[-1]["mend"]
    assert not (tmp_path / "s.glb").exists()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork")
def test_what_crashes_where_that_was_expected_begins_anew_with_care(tmp_path: Path) -> None:
    calls = tmp_path / "calls"

    def convert(job: Job) -> None:
        with calls.open("a") as file:
            file.write("careful\n" if job.attempt.is_careful else "quick\n")
        for number in range(2):
            job.report.warning("xyz-odd", "said once", str(number))
        job.report.warning("xyz-odd", "said twice")
        job.report.warning("xyz-odd", "said twice")
        job.attempt.may_be_repeated(True)
        if not job.attempt.is_careful:
            os.kill(os.getpid(), signal.SIGKILL)
        job.attempt.may_be_repeated(False)
        with job.scene() as scene:
            scene.object("7", "t", scene.shape([TRIANGLE]))

    status, lines = called(convert, tmp_path)
    assert status == 0 and calls.read_text() == "quick\ncareful\n"
    assert [line["message"] for line in lines[:-1]] == ["said once", "said once", "said twice", "said twice"]
    assert Glb(tmp_path / "s.glb").ids == ["7"]


def expect_a_crash(job: Job) -> None:
    job.attempt.may_be_repeated(True)
    crash(job)


def crash_later(job: Job) -> None:
    job.attempt.may_be_repeated(True)
    job.attempt.may_be_repeated(False)
    crash(job)


@pytest.mark.parametrize("convert", [expect_a_crash, crash_later])
def test_a_second_crash_or_one_that_was_not_expected_ends_it(tmp_path: Path, convert: Callable[[Job], None]) -> None:
    status, lines = called(convert, tmp_path)
    assert status == 1 and [list(line) for line in lines] == [["error", "mend"]]


def test_progress_never_goes_back_and_is_no_flood(tmp_path: Path) -> None:
    with Report(tmp_path / "r") as report:
        for i in range(100_000):
            report.progress(i / 100_000)
        report.progress(0.2)
        report.progress(7)
    shown = [json.loads(line)["progress"] for line in (tmp_path / "r").read_text().splitlines()]
    assert shown == sorted(shown) and shown[-1] == 1 and len(shown) < 250


def test_the_general_program_knows_importers_of_packages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    class Entry:
        value = "package:convert"

        @staticmethod
        def load() -> Callable[[Job], None]:
            return refuse

    monkeypatch.setattr(__main__, "importers", lambda: {"xyz": Entry})
    assert __main__.main(["--list"]) == 0
    assert capsys.readouterr().out == "xyz\tpackage:convert\n"
    (tmp_path / "a.XYZ").write_text("x")
    (tmp_path / "a.abc").write_text("x")
    report = tmp_path / "r"
    for name, error in (("a.XYZ", "no"), ("a.abc", "no importer reads files that end in .abc")):
        arguments = ["--input", str(tmp_path / name), "--output", str(tmp_path / "s.glb"), "--report", str(report)]
        assert __main__.main(arguments) == 1
        assert json.loads(report.read_text().splitlines()[-1])["error"] == error


def test_without_ifcopenshell_the_importer_states_how_to_get_it(tmp_path: Path) -> None:
    (tmp_path / "a.ifc").write_text("x")
    program = "import sys; sys.modules['ifcopenshell'] = None; from strake.importers.ifc import main; sys.exit(main(sys.argv[1:]))"
    arguments = ["--input", str(tmp_path / "a.ifc"), "--output", str(tmp_path / "s.glb"), "--report", str(tmp_path / "r")]
    assert subprocess.run([sys.executable, "-c", program, *arguments], check=False).returncode == 1
    assert "pip install" in json.loads((tmp_path / "r").read_text().splitlines()[-1])["mend"]


def after(lines: str) -> str:
    """What a program of its own prints that runs these lines."""
    ended = subprocess.run([sys.executable, "-c", lines], capture_output=True, text=True, check=True)
    assert ended.stderr == ""
    return ended.stdout.strip()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="counts threads in /proc")
def test_an_importer_has_no_threads_that_it_does_not_use() -> None:
    counted = "print([line.split()[1] for line in open('/proc/self/status') if line.startswith('Threads')][0])"
    assert after(f"import strake.importers; {counted}") == "1"


def test_whoever_says_how_many_threads_algebra_has_is_heeded() -> None:
    lines = "import os; os.environ['OPENBLAS_NUM_THREADS'] = '2'; import strake.importers; print(os.environ['OPENBLAS_NUM_THREADS'])"
    assert after(lines) == "2"


def test_ifcopenshell_is_loaded_without_grammars_and_others_may_load_them() -> None:
    pytest.importorskip("ifcopenshell")
    lines = "import sys; from strake.importers.ifc.library import load_ifcopenshell; load_ifcopenshell()"
    assert after(f"{lines}; print('ifcopenshell' in sys.modules, 'lark' in sys.modules)") == "True False"
    pytest.importorskip("lark")
    assert after(f"import lark; {lines}; print(sys.modules['lark'] is lark)") == "True"
    assert after(f"{lines}; import lark; print(lark.__name__)") == "lark"


@pytest.mark.parametrize(("missing", "mend"), [("No module named 'x'", "pip install"), ("`GLIBCXX_3.4.29' not found", "newer system")])
def test_a_library_that_is_missing_and_one_of_a_newer_system_are_told_apart(
    missing: str, mend: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def load() -> None:
        raise ImportError(missing)

    monkeypatch.setattr(ifc, "load_ifcopenshell", load)
    status, report = called(ifc.import_ifc, tmp_path)
    assert status == 1
    assert missing in report[-1]["error"] and mend in report[-1]["mend"]
