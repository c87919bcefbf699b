# SPDX-License-Identifier: Apache-2.0
"""Worker processes that convert chunks, and may crash or hang of a product without harm to the others."""

from __future__ import annotations

import math
import multiprocessing
import os
import time
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path

from strake.importers.ifc.chunks import Answer, Chunk, convert_chunk
from strake.importers.ifc.ends import Convert, Ended, Event, answers_of, bounded_memory, is_tried_again, missing_of, note_answers
from strake.importers.ifc.entity import Model
from strake.importers.ifc.kernels import CUT
from strake.importers.supervision import end_with_parent, signal_name

# How long a worker may work in silence before it counts as hung, in seconds of CPU time: one product takes longer than
# this only where its cuts have no end. Where the machine is busy, or the worker only waits, it is so many times as long.
MAX_SILENT_S = 60.0
_MAX_WAITING = 5.0
# After each that hung it is half as long, down to this.
MIN_SILENT_S = 8.0
_SOON_S = 10.0
_TICK_S = 0.5
# Who is silent for longer is looked at, which takes the system as long as an answer.
_LOOKED_AT_S = 0.1


@dataclass
class _Worker:
    process: BaseProcess
    connection: Connection
    chunk: Chunk | None = None
    got: set[int] = field(default_factory=set)
    heard_at: float = 0.0
    # What it had worked when it was first looked at since; None until then, for most answers come within microseconds.
    cpu_then_s: float | None = None

    def heard(self) -> None:
        """Notes that it said something now."""
        self.heard_at = time.monotonic()
        self.cpu_then_s = None

    def is_silent_for(self, limit_s: float) -> bool:
        """Whether it worked, or at any rate waited, for too long since."""
        silent_s = time.monotonic() - self.heard_at
        if self.cpu_then_s is None and silent_s > _LOOKED_AT_S:
            self.cpu_then_s = _cpu_seconds(self.process.pid)
        if silent_s <= limit_s or self.cpu_then_s is None:
            return False
        cpu_s = _cpu_seconds(self.process.pid)
        return cpu_s == math.inf or cpu_s - self.cpu_then_s > limit_s or silent_s > _MAX_WAITING * limit_s


class Workers:
    """Converts chunks on so many processes. They are forks of this one and share the model with it.

    Chunks may be added while answers come. Close it to end the processes.
    """

    def __init__(self, model: Model, count: int, silent_s: float = MAX_SILENT_S, convert: Convert = convert_chunk) -> None:
        self._model = model
        self._count = count
        self._silent_s = silent_s
        self._convert = convert
        self._queue: deque[Chunk] = deque()
        self._workers: list[_Worker] = []

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self._workers:
            _end(worker)

    def add(self, chunk: Chunk) -> None:
        """Adds a chunk to be converted."""
        self._queue.append(chunk)

    def answers(self) -> Iterator[Event | None]:
        """Yields what the workers say, in no fixed order, until no chunk is left; None now and then when they are silent."""
        while self._queue or any(worker.chunk for worker in self._workers):
            self._hand_out()
            ready = wait([worker.connection for worker in self._workers if worker.chunk], timeout=_TICK_S)
            for worker in [w for w in self._workers if w.connection in ready]:
                yield from self._heard(worker)
            if not ready:
                yield None
            for worker in [w for w in self._workers if w.chunk and w.is_silent_for(self._limit_s(w.chunk))]:
                yield self._hung(worker)

    def _hand_out(self) -> None:
        idle = [worker for worker in self._workers if worker.chunk is None]
        while self._queue and (idle or len(self._workers) < self._count):
            worker = idle.pop() if idle else self._started()
            chunk = self._queue.popleft()
            worker.chunk, worker.got = chunk, set()
            worker.heard()
            try:
                worker.connection.send(chunk)
            except OSError:
                # It died idle; the chunk was not looked at.
                self._forget(worker)
                self._queue.appendleft(chunk)

    def _started(self) -> _Worker:
        context = multiprocessing.get_context("fork")
        ours, theirs = context.Pipe()
        others = [worker.connection for worker in self._workers]
        process = context.Process(target=_work, args=(self._model, self._convert, theirs, [ours, *others], os.getpid()), daemon=True)
        process.start()
        theirs.close()
        worker = _Worker(process, ours)
        self._workers.append(worker)
        return worker

    def _heard(self, worker: _Worker) -> list[Event]:
        try:
            answers: list[Answer] | None = worker.connection.recv()
        except (EOFError, OSError):
            worker.process.join(5)
            code = worker.process.exitcode
            return [self._lost(worker, signal_name(-code) if code is not None and code < 0 else f"exit status {code}")]
        worker.heard()
        chunk = worker.chunk
        assert chunk is not None
        if answers is None:
            worker.chunk = None
            return [Ended(chunk, missing_of(chunk, worker.got))]
        note_answers(answers, worker.got)
        return [*answers]

    def _limit_s(self, chunk: Chunk) -> float:
        """Returns for how long a worker may be silent at a chunk. One of which answers come together is soon begun anew, and watched."""
        return min(self._silent_s, _SOON_S) if is_tried_again(chunk) and chunk.kernel != CUT else self._silent_s

    def _hung(self, worker: _Worker) -> Ended:
        assert worker.chunk is not None
        ended = self._lost(worker, f"no answer for {self._limit_s(worker.chunk):g} s")
        if is_tried_again(ended.chunk):
            return ended._replace(hung=True)
        # Where one product has no end others have none either, and a hundred of them must not take hours. A chunk that is cut
        # goes on as a whole, and says nothing of the kernels that come after.
        if ended.chunk.kernel != CUT:
            self._silent_s = max(min(self._silent_s, MIN_SILENT_S), self._silent_s / 2)
        return ended._replace(hung=True)

    def _lost(self, worker: _Worker, fault: str) -> Ended:
        chunk = worker.chunk
        assert chunk is not None
        self._forget(worker)
        return Ended(chunk, missing_of(chunk, worker.got), fault)

    def _forget(self, worker: _Worker) -> None:
        _end(worker)
        self._workers.remove(worker)


def _cpu_seconds(process: int | None) -> float:
    """Returns the CPU time of a process; infinity where the system does not say it, so that the clock decides."""
    try:
        text = Path(f"/proc/{process}/stat").read_text()
    except OSError:
        return math.inf
    # The name stands in brackets and may have blanks in it.
    user, system = text.rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def _end(worker: _Worker) -> None:
    worker.process.kill()
    worker.process.join()
    worker.connection.close()


def _work(model: Model, convert: Convert, connection: Connection, others: list[Connection], parent: int) -> None:
    end_with_parent(parent)
    for other in others:
        other.close()
    with bounded_memory():
        while True:
            try:
                chunk = connection.recv()
            except EOFError:
                return
            for answers in answers_of(convert, model, chunk):
                connection.send(answers)
            connection.send(None)
