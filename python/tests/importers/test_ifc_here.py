# SPDX-License-Identifier: Apache-2.0
"""Chunks that the process itself converts, and what it does when that ends it."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("ifcopenshell")

from glb_reader import Glb
from ifc_model import IfcModel
from strake.importers import run
from strake.importers.ifc import conversion, here, import_ifc
from strake.importers.ifc.chunks import Again, Answer, Batch, Chunk, Converted, Remark, convert_chunk
from strake.importers.ifc.ends import Ended
from strake.importers.ifc.entity import Model
from strake.importers.ifc.kernels import FAST
from strake.importers.supervision import Attempt, crash_of

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork")

NO_MODEL: Any = None


def made(number: int, chunk: Chunk, fault: str = "") -> Converted:
    return Converted(number, b"k", (0, 0, 0), b"", None, chunk.kernel, fault)


def events(convert: Any, *products: tuple[int, ...]) -> list[Any]:
    with here.Here(NO_MODEL, Attempt(), convert) as chunks:
        for numbers in products:
            chunks.add(Chunk(numbers, "k"))
        return list(chunks.answers())


def test_what_has_no_shape_is_missing_and_an_exception_ends_the_chunk() -> None:
    def convert(_: object, chunk: Chunk, batch: Batch) -> Iterator[list[Answer]]:
        for number in chunk.products:
            if number == 4:
                raise RuntimeError("bad product")
            yield [made(number, chunk, "nothing" if number == 2 else "")]
        if 6 in chunk.products:
            yield [Again((6,)), made(7, chunk)]

    found = events(convert, (1, 2), (3, 4, 5), (6, 7))
    assert [one.missing for one in found if isinstance(one, Ended)] == [(2,), (4, 5), (6,)]
    assert [one.message for one in found if isinstance(one, Remark)] == ["RuntimeError: bad product"]


def works(_: object, chunk: Chunk, batch: Batch) -> Iterator[list[Answer]]:
    while True:
        pass
    yield []


def waits(_: object, chunk: Chunk, batch: Batch) -> Iterator[list[Answer]]:
    signal.pause()
    yield []


@pytest.mark.parametrize(("convert", "name"), [(works, "SIGPROF"), (waits, "SIGALRM")])
def test_what_has_no_end_is_ended_by_the_system(monkeypatch: pytest.MonkeyPatch, convert: Any, name: str) -> None:
    monkeypatch.setattr(here, "MAX_SILENT_S", 0.2)
    monkeypatch.setattr(here, "_MAX_WAITING_S", 0.4 if convert is waits else 60)
    assert crash_of(lambda: len(events(convert, (1,)))).name == name


def test_nothing_ends_a_process_that_has_converted_its_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(here, "MAX_SILENT_S", 0.2)
    events(lambda *_, batch: iter([]), (1,))
    assert signal.getitimer(signal.ITIMER_PROF) == signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


@pytest.mark.parametrize("way", ["crash", "hang"])
def test_a_product_that_ends_the_process_is_lost_to_its_kernel_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, way: str) -> None:
    model = IfcModel()
    columns = [model.product("IfcColumn", f"c{i}", model.body(model.extrusion((10, 10, 10 + i)))) for i in range(6)]
    path = model.write(tmp_path / "a.ifc")
    bad = columns[3].id()
    processes = tmp_path / "processes"

    def ending(read: Model, chunk: Chunk, sag_m: float, batch: Batch | None = None) -> Iterator[list[Answer]]:
        if chunk.kernel == FAST and bad in chunk.products:
            with processes.open("a") as file:
                file.write(f"{'here' if batch else 'worker'} {len(chunk.products)} {chunk.watched}\n")
            while way == "hang" and batch is not None:
                pass
            os.kill(os.getpid(), signal.SIGKILL)
        yield from convert_chunk(read, chunk, sag_m, batch)

    def converted(name: str) -> tuple[list[float], list[str]]:
        output, report = tmp_path / f"{name}.glb", tmp_path / f"{name}.jsonl"
        assert run(import_ifc, ["--input", str(path), "--output", str(output), "--report", str(report), "--threads", "1"]) == 0
        scene = Glb(output)
        volumes = [round(scene.volume(column.GlobalId), 3) for column in columns]
        return volumes, [line for line in report.read_text().splitlines() if "progress" not in line]

    plain = converted("plain")
    monkeypatch.setattr(here, "MAX_SILENT_S", 0.3)
    monkeypatch.setattr(conversion, "convert_chunk", ending)
    assert converted("ended") == plain, "the next kernel makes the same of it"
    # Here, with all in one answer, then one by one until it is known which it is.
    assert processes.read_text().splitlines() == [
        "here 6 False", "worker 6 False", "worker 6 True", "worker 5 True", "worker 4 True", "worker 3 True", "worker 1 True",
    ]  # fmt: skip
