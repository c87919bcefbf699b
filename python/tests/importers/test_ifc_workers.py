# SPDX-License-Identifier: Apache-2.0
"""Workers that crash and hang."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator

import pytest

pytest.importorskip("ifcopenshell")

from strake.importers.ifc.chunks import Answer, Chunk, Converted
from strake.importers.ifc.ends import Ended
from strake.importers.ifc.kernels import CUT
from strake.importers.ifc.workers import Workers

CRASHES, HANGS, RAISES, WAITS = 13, 17, 19, 99


def fake(_: object, chunk: Chunk) -> Iterator[list[Answer]]:
    for number in chunk.products:
        if number == CRASHES:
            os.kill(os.getpid(), signal.SIGKILL)
        while number == HANGS:
            pass
        if number == WAITS:
            time.sleep(1000)
        if number == RAISES:
            raise RuntimeError("bad product")
        yield [Converted(number, b"k", (0, 0, 0), b"", None, chunk.kernel)]


@pytest.mark.parametrize("count", [1, 3])
def test_crashes_and_hangs_are_reported_with_what_is_missing(count: int) -> None:
    with Workers(None, count, silent_s=1, convert=fake) as workers:
        for first in range(0, 30, 5):
            workers.add(Chunk(tuple(range(first, first + 5)), "k"))
        events = list(workers.answers())
    got = {event.product for event in events if isinstance(event, Converted)}
    ended = {event.chunk.products[0]: event for event in events if isinstance(event, Ended)}
    assert got == set(range(30)) - {13, 14, 17, 18, 19}
    assert ended[10].missing == (13, 14) and ended[10].fault == "SIGKILL"
    assert ended[15].missing == (17, 18, 19) and "no answer for 1 s" in ended[15].fault and ended[15].hung
    assert ended[0].missing == () and ended[0].fault == ""


def test_a_worker_that_only_waits_has_longer_and_no_end() -> None:
    began = time.monotonic()
    with Workers(None, 1, silent_s=0.3, convert=fake) as workers:
        workers.add(Chunk((WAITS,), "k"))
        ended = [event for event in workers.answers() if isinstance(event, Ended)]
    assert ended[0].hung and time.monotonic() - began > 1.4


def test_each_hang_halves_the_limit_but_those_of_cuts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("strake.importers.ifc.workers.MIN_SILENT_S", 0.25)
    with Workers(None, 1, silent_s=0.5, convert=fake) as workers:
        for kernel in (CUT, CUT, "k", "k"):
            workers.add(Chunk((HANGS,), kernel))
        faults = [event.fault for event in workers.answers() if isinstance(event, Ended)]
    assert faults == ["no answer for 0.5 s"] * 3 + ["no answer for 0.25 s"]


def test_an_exception_ends_the_chunk_and_not_the_worker() -> None:
    with Workers(None, 1, convert=fake) as workers:
        workers.add(Chunk((18, 19, 20), "k"))
        workers.add(Chunk((21,), "k"))
        events = [event for event in workers.answers() if event is not None]
    assert [event.missing for event in events if isinstance(event, Ended)] == [(19, 20), ()]
    assert "bad product" in str(events)
