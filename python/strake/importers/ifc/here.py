# SPDX-License-Identifier: Apache-2.0
"""Chunks converted by this process itself, where they are few: processes and what they tell each other take longer (decision 0126).

A crash or a product without an end costs this process, and whoever watches it begins anew with workers.
"""

from __future__ import annotations

import signal
from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import ExitStack

from strake.importers.ifc.chunks import Answer, Batch, Chunk
from strake.importers.ifc.ends import Convert, Ended, Event, answers_of, bounded_memory, missing_of, note_answers
from strake.importers.ifc.entity import Model
from strake.importers.supervision import Attempt

# What works for so long without an answer, in seconds of CPU time, or waits for so long, is left to workers, which know better
# what to do about it.
MAX_SILENT_S = 4.0
_MAX_WAITING_S = 30.0
_TOGETHER_S = 0.5


class Here:
    """Does for chunks what `Workers` do."""

    def __init__(self, model: Model, attempt: Attempt, convert: Convert) -> None:
        self._model = model
        self._attempt = attempt
        self._convert = convert
        self._queue: deque[Chunk] = deque()
        self._limits = ExitStack()
        # Small shapes of several chunks are prepared together.
        self._batch = Batch(_TOGETHER_S, keeps=True)
        self._open: list[Chunk] = []
        self._got: set[int] = set()

    def __enter__(self) -> Here:
        for number in (signal.SIGPROF, signal.SIGALRM):
            signal.signal(number, signal.SIG_DFL)
        self._limits.enter_context(bounded_memory())
        self._attempt.may_be_repeated(True)
        return self

    def __exit__(self, *_: object) -> None:
        _end_after(0, 0)
        self._limits.close()
        self._attempt.may_be_repeated(False)

    def add(self, chunk: Chunk) -> None:
        """Adds a chunk to be converted."""
        self._queue.append(chunk)

    def answers(self) -> Iterator[Event]:
        """Yields what becomes of the chunks, until none is left."""
        _end_after(MAX_SILENT_S, _MAX_WAITING_S)
        while self._queue or self._open:
            if self._queue:
                chunk = self._queue.popleft()
                self._open.append(chunk)
                for answers in answers_of(self._convert, self._model, chunk, self._batch):
                    yield from self._noted(answers)
            if not self._queue or self._batch.is_due():
                yield from self._noted(self._batch.take())
                yield from [Ended(chunk, missing_of(chunk, self._got)) for chunk in self._open]
                self._open.clear()

    def _noted(self, answers: Sequence[Answer]) -> Sequence[Answer]:
        _end_after(MAX_SILENT_S, _MAX_WAITING_S)
        note_answers(answers, self._got)
        return answers


def _end_after(working_s: float, waiting_s: float) -> None:
    """Has the system end this process when so much time has passed, whatever code it is in; 0: never."""
    signal.setitimer(signal.ITIMER_PROF, working_s)
    signal.setitimer(signal.ITIMER_REAL, waiting_s)
