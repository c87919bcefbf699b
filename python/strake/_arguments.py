# SPDX-License-Identifier: Apache-2.0
"""Arguments as callers write them, checked and as the extension takes them."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

from strake import _core
from strake._errors import UsageError
from strake._numpy import is_array, np, npt, or_of_numpy

Progress: TypeAlias = Callable[[float, str], object]
Length: TypeAlias = float | str
PathLike: TypeAlias = str | os.PathLike[str]
Selection: TypeAlias = "str | Sequence[str] | npt.NDArray[np.bool_]"

MAX_THREADS = 1024
MAX_COUNT = 2**32 - 1
LONGEST_MM = 1e6
"""A kilometre: the longest distance that the program takes."""


def run_options(threads: int | None, progress: Progress | None) -> _core.RunOptions:
    """How a long call runs. Raises: UsageError for a number of threads outside 1 to 1024."""
    if threads is not None:
        threads = thread_count(threads, "threads")
    if progress is not None and not callable(progress):
        raise UsageError(f"{type(progress).__name__} cannot be called", "progress")
    return _core.RunOptions(threads, progress)


def options_of(function: Callable[..., Any], *others: str) -> dict[str, Any]:
    """What a function takes by name alone, with its defaults, but for some others."""
    import inspect  # it is large, and who reads a model does not need it

    parameters = inspect.signature(function).parameters.values()
    return {one.name: one.default for one in parameters if one.kind is one.KEYWORD_ONLY and one.name not in others}


def check_names(given: Mapping[str, Any], options: Mapping[str, Any], function: str) -> None:
    """Raises: TypeError for an argument that a function has not."""
    for name in given:
        if name not in options:
            raise TypeError(f"{function}() has no argument {name!r}")


def thread_count(value: Any, name: str) -> int:
    """A number of threads. Raises: UsageError outside 1 to 1024."""
    if isinstance(value, bool) or not isinstance(value, or_of_numpy((int,), "integer")):
        raise UsageError(f"{shown(value)} is no whole number", name)
    if not 1 <= value <= MAX_THREADS:
        raise UsageError(f"{shown(value)} is no number of threads", name, f"write 1 to {MAX_THREADS}")
    return int(value)


def shown(value: object) -> str:
    """A value as messages show it: in a line, and short."""
    if is_array(value):
        return f"an array of {value.dtype} and shape {value.shape}"
    text = " ".join(repr(value).split())
    return text if len(text) <= 80 else text[:77] + "..."


def number(value: Any, name: str) -> float:
    """A finite number. Raises: UsageError."""
    if isinstance(value, bool) or not isinstance(value, or_of_numpy((int, float), "integer", "floating")):
        raise UsageError(f"{shown(value)} is no number", name)
    try:
        result = float(value)
    except OverflowError:
        result = math.inf
    if not math.isfinite(result):
        raise UsageError(f"{shown(value)} is not finite", name)
    return result


def length(value: Length, name: str) -> float:
    """A length in mm that is not negative. Raises: UsageError."""
    if isinstance(value, str):
        try:
            return _core.length_mm(text(value, name))
        except UsageError as error:
            raise UsageError(error.message, name, error.mend) from None
    mm = number(value, name)
    if mm < 0:
        raise UsageError(f"{value!r} is negative", name, "write 0 or more, in millimetres")
    if mm > LONGEST_MM:
        raise UsageError(f"{value!r} is longer than a kilometre", name, "write millimetres")
    return mm


def optional_length(value: Length | None, name: str) -> float | None:
    """As length(), where None stays None."""
    return None if value is None else length(value, name)


def weld_of(value: Length | None, name: str) -> float | None:
    """How far apart seams are that close; None stays None. Raises: UsageError beyond a metre."""
    mm = optional_length(value, name)
    if mm is not None and mm > 1000:
        raise UsageError(f"{shown(value)} is longer than a metre", name)
    return mm


def count(value: Any, name: str) -> int:
    """A whole number that is not negative. Raises: UsageError."""
    exact = number(value, name)
    if exact < 0 or exact != int(exact):
        raise UsageError(f"{shown(value)} is no count", name, "write a whole number, 0 or more")
    if exact > MAX_COUNT:
        raise UsageError(f"{shown(value)} is too large", name, f"write {MAX_COUNT} at most")
    return int(value)


def truth(value: Any, name: str) -> bool:
    """True or False. Raises: UsageError."""
    if not isinstance(value, or_of_numpy((bool,), "bool_")):
        raise UsageError(f"{shown(value)} is neither True nor False", name)
    return bool(value)


def numbers(value: Any, count: int, name: str, what: str) -> list[float]:
    """So many finite numbers. Raises: UsageError."""
    if isinstance(value, str):
        raise UsageError(f"{shown(value)} is a text", name, f"give {what}")
    try:
        flat = [number(x, name) for x in np.asarray(value, dtype=object).ravel().tolist()]
    except (TypeError, ValueError) as error:
        message = error.message if isinstance(error, UsageError) else str(error)
        raise UsageError(message, name, f"give {what}") from None
    if len(flat) != count:
        raise UsageError(f"{len(flat)} numbers", name, f"give {what}")
    return flat


def text(value: Any, name: str) -> str:
    """A text that can be written. Raises: UsageError."""
    if not isinstance(value, str):
        raise UsageError(f"{shown(value)} is no text", name)
    if "\0" in value or any("\ud800" <= c <= "\udfff" for c in value):
        raise UsageError(f"{shown(value)} has a character that no text has", name)
    return value


def optional_text(value: Any, name: str) -> str:
    """As text(), where None is empty."""
    return "" if value is None else text(value, name)


def one_of(value: Any, words: Sequence[str], name: str) -> str:
    """One of some words. Raises: UsageError."""
    if not isinstance(value, str) or value not in words:
        raise UsageError(f"{shown(value)} is none of the words that it may be", name, f"write {', '.join(words[:-1])} or {words[-1]}")
    return value


def texts(value: str | Iterable[str] | None, name: str) -> list[str]:
    """One text or several. Raises: UsageError."""
    if value is None:
        return []
    if isinstance(value, str):
        return [text(value, name)]
    return [text(one, name) for one in several(value, name, "a text, or several")]


def several(value: Any, name: str, what: str) -> list[Any]:
    """The items of an iterable that is no text. Raises: UsageError."""
    if isinstance(value, (str, bytes)) or not isinstance(value, Iterable):
        raise UsageError(f"{shown(value)} is none", name, f"give {what}")
    return list(value)


def words(value: Any, name: str) -> list[str]:
    """Words of a command line: texts and paths. Raises: UsageError."""
    return [
        str(path(word, name)) if isinstance(word, os.PathLike) else text(word, name) for word in several(value, name, "a list of words")
    ]


def pick(value: Selection | None, objects: int, name: str) -> _core.Pick:
    """Objects of so many: None for all, selections, or an array of truth values with an entry per object."""
    if value is None:
        return _core.Pick([], [])
    if is_array(value):
        if value.dtype != np.bool_ or value.shape != (objects,):
            raise UsageError(
                f"{shown(value)} does not say which of {objects} objects are meant",
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
        given = os.fspath(value)
        text = os.fsdecode(given)
        os.fsencode(text)
    except TypeError:
        raise UsageError(f"{shown(value)} is no path", name) from None
    except UnicodeError:
        raise UsageError(f"{shown(value)} has a character that no path has", name) from None
    if "\0" in text:
        raise UsageError("a path has no null character", name)
    if not text:
        raise UsageError("a path is empty", name)
    return Path(text)


def some_paths(value: PathLike | Iterable[PathLike], name: str) -> list[Path]:
    """One path, several or none. Raises: UsageError."""
    if isinstance(value, (str, bytes, os.PathLike)):
        return [path(value, name)]
    return [path(one, name) for one in several(value, name, "a path, or several")]


def paths(value: PathLike | Iterable[PathLike], name: str) -> list[Path]:
    """One path or several. Raises: UsageError where there are none."""
    given = some_paths(value, name)
    if not given:
        raise UsageError("no file is given", name)
    return given
