# SPDX-License-Identifier: Apache-2.0
"""Arguments as callers write them, checked and as the extension takes them."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from strake import _core
from strake._errors import UsageError

Progress: TypeAlias = Callable[[float, str], object]
Length: TypeAlias = float | str
PathLike: TypeAlias = str | os.PathLike[str]
Selection: TypeAlias = str | Sequence[str] | npt.NDArray[np.bool_]

MOST_THREADS = 1024


def run_options(threads: int | None, progress: Progress | None) -> _core.RunOptions:
    """How a long call runs. Raises: UsageError for a number of threads outside 1 to 1024."""
    if threads is not None:
        if isinstance(threads, bool) or not isinstance(threads, (int, np.integer)):
            raise UsageError(f"{threads!r} is no whole number", "threads")
        if not 1 <= threads <= MOST_THREADS:
            raise UsageError(f"{threads} is no number of threads", "threads", f"write 1 to {MOST_THREADS}")
        threads = int(threads)
    if progress is not None and not callable(progress):
        raise UsageError(f"{type(progress).__name__} cannot be called", "progress")
    return _core.RunOptions(threads, progress)


def number(value: Any, name: str) -> float:
    """A finite number. Raises: UsageError."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise UsageError(f"{value!r} is no number", name)
    if not math.isfinite(value):
        raise UsageError(f"{value!r} is not finite", name)
    return float(value)


def length(value: Length, name: str) -> float:
    """A length in mm that is not negative. Raises: UsageError."""
    if isinstance(value, str):
        return _core.length_mm(value)
    mm = number(value, name)
    if mm < 0:
        raise UsageError(f"{value!r} is negative", name, "write 0 or more, in millimetres")
    return mm


def optional_length(value: Length | None, name: str) -> float | None:
    """As length(), where None stays None."""
    return None if value is None else length(value, name)


def numbers(value: Any, count: int, name: str, what: str) -> list[float]:
    """So many finite numbers. Raises: UsageError."""
    if isinstance(value, str):
        raise UsageError(f"{value!r} is a text", name, f"give {what}")
    try:
        flat = [number(x, name) for x in np.asarray(value, dtype=object).ravel().tolist()]
    except TypeError as error:
        raise UsageError(str(error), name, f"give {what}") from error
    if len(flat) != count:
        raise UsageError(f"{len(flat)} numbers", name, f"give {what}")
    return flat


def texts(value: str | Iterable[str] | None, name: str) -> list[str]:
    """One text or several. Raises: UsageError."""
    if value is None:
        return []
    if isinstance(value, str):
        return [value]
    several = list(value)
    for one in several:
        if not isinstance(one, str):
            raise UsageError(f"{one!r} is no text", name)
    return several


def pick(value: Selection | None, objects: int, name: str) -> _core.Pick:
    """Objects of so many: None for all, selections, or an array of truth values with an entry per object."""
    if value is None:
        return _core.Pick([], [])
    if isinstance(value, np.ndarray):
        if value.dtype != np.bool_ or value.shape != (objects,):
            raise UsageError(
                f"an array of {value.dtype} and shape {value.shape} does not say which of {objects} objects are meant",
                name,
                f"give one of bool and shape ({objects},), as Model.select() returns",
            )
        if objects == 0:
            raise UsageError("the model has no objects", name)
        return _core.Pick([], value.tolist())
    selections = texts(value, name)
    if not selections:
        raise UsageError("no selection is given", name, "write None for all objects")
    return _core.Pick(selections, [])


def path(value: PathLike, name: str) -> Path:
    """A path. Raises: UsageError."""
    try:
        text = os.fspath(value)
    except TypeError as error:
        raise UsageError(f"{type(value).__name__} is no path", name) from error
    if "\0" in text:
        raise UsageError("a path has no null character", name)
    return Path(text)


def paths(value: PathLike | Iterable[PathLike], name: str) -> list[Path]:
    """One path or several. Raises: UsageError where there are none."""
    if isinstance(value, (str, os.PathLike)):
        return [path(value, name)]
    try:
        several = [path(one, name) for one in value]
    except TypeError as error:
        raise UsageError(f"{type(value).__name__} is no path", name) from error
    if not several:
        raise UsageError("no file is given", name)
    return several
