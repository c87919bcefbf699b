# SPDX-License-Identifier: Apache-2.0
"""What becomes of chunks, whoever converts them."""

from __future__ import annotations

import os
import resource
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import NamedTuple

from strake.importers.ifc.chunks import Again, Answer, Batch, Chunk, Converted, Remark
from strake.importers.ifc.entity import Model


class Ended(NamedTuple):
    """A chunk is done with. `missing` got no shape of its kernel; `fault` says why where the process did not live."""

    chunk: Chunk
    missing: tuple[int, ...]
    fault: str = ""
    hung: bool = False


Event = Converted | Remark | Again | Ended
Convert = Callable[..., Iterator[list[Answer]]]


def is_tried_again(chunk: Chunk) -> bool:
    """Whether a chunk that a process did not survive is given to another, and watched: its answers were to come together, so that it is
    not known at which product it was."""
    return not chunk.watched and len(chunk.products) > 1


def missing_of(chunk: Chunk, got: set[int]) -> tuple[int, ...]:
    """Returns the products of a chunk that have no shape."""
    return tuple(number for number in chunk.products if number not in got)


def note_answers(answers: Sequence[Answer], got: set[int]) -> None:
    """Keeps up which products have a shape."""
    for answer in answers:
        if isinstance(answer, Converted):
            if not answer.fault:
                got.add(answer.product)
        elif isinstance(answer, Again):
            got -= set(answer.products)


def answers_of(convert: Convert, model: Model, chunk: Chunk, batch: Batch | None = None) -> Iterator[list[Answer]]:
    """Yields the answers to a chunk. Whatever the library raises is a fault of this chunk."""
    try:
        yield from convert(model, chunk) if batch is None else convert(model, chunk, batch=batch)
    except Exception as fault:
        yield [Remark(0, chunk.kernel, f"{type(fault).__name__}: {fault}")]


@contextmanager
def bounded_memory() -> Iterator[None]:
    """Lets this process have half of the machine's memory at most: a few lines of a file may ask for any amount."""
    most = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
