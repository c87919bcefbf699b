# SPDX-License-Identifier: Apache-2.0
"""Progress, interrupts, other threads, and a light import."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator

import pytest

import strake


def test_progress_is_reported_from_the_calling_thread(large_ship: strake.Model) -> None:
    reported: list[tuple[float, str]] = []
    threads: set[int] = set()

    def progress(fraction: float, step: str) -> None:
        reported.append((fraction, step))
        threads.add(threading.get_ident())

    strake.clash(large_ship, progress=progress)
    assert reported[0] == (0.0, "clash")
    assert reported[-1] == (1.0, "clash")
    assert all(0 <= fraction <= 1 for fraction, _ in reported)
    assert len({step for _, step in reported}) > 1
    assert threads == {threading.get_ident()}


def test_what_progress_raises_ends_the_call(large_ship: strake.Model) -> None:
    def progress(fraction: float, step: str) -> None:
        if step != "clash":
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        strake.clash(large_ship, clearance=26, progress=progress)
    assert len(strake.clash(large_ship, a="PIP*", clearance=26)) > 0


@pytest.fixture
def ctrl_c() -> Iterator[None]:
    """Ctrl-C as a terminal has it: a shell has what runs in the background ignore it, and Python then leaves it so."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_interrupts(large_ship: strake.Model, ctrl_c: None) -> None:
    def interrupt(fraction: float, step: str) -> None:
        os.kill(os.getpid(), signal.SIGINT)

    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        strake.clash(large_ship, clearance=27, progress=interrupt)
    assert time.monotonic() - start < 60


def test_other_threads_run_meanwhile(large_ship: strake.Model) -> None:
    counted, over = 0, threading.Event()

    def count() -> None:
        nonlocal counted
        while not over.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    strake.clash(large_ship, clearance=28)
    over.set()
    thread.join()
    assert counted > 10


def test_calls_on_one_model_at_the_same_time(ship: strake.Model) -> None:
    expected = strake.clash(ship, clearance=25).hash
    hashes: list[str] = []

    def find() -> None:
        hashes.append(strake.clash(ship, clearance=25, threads=2).hash)

    threads = [threading.Thread(target=find) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert hashes == [expected] * 4


def test_import_is_light() -> None:
    heavy = ("pandas", "pyarrow", "trimesh", "ifcopenshell")
    code = f"import sys, strake; print([name for name in {heavy} if name in sys.modules], strake.__version__)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("[] ")
    program = strake.run_program(["--version"]).stdout
    assert program.split() == ["strake", strake.__version__]
