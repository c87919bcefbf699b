# SPDX-License-Identifier: Apache-2.0
"""What `strake clash --scheduler` and `strake draw --scheduler` do: the program starts this in its place (docs/cluster.md)."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import strake
from strake import _core, cluster
from strake._errors import Error, UsageError

# Exit codes of the program.
_CODES = {"usage": 2, "input": 3, "output": 3, "internal": 5, "memory": 6, "cancelled": 130}

_Value = str | bool | float | list[float] | list[str]


def _switch(word: str) -> bool:
    return word == "on"


def _thinning(word: str) -> str | bool:
    return {"on": True, "off": False}.get(word, word)


def _angle(word: str) -> float:
    try:
        return float(word.removesuffix("deg"))
    except ValueError:
        raise UsageError(f"{word!r} is no angle", mend="write degrees") from None


def _millimetres(word: str) -> float:
    """A coordinate in mm, or with its unit."""
    with suppress(ValueError):
        return float(word)
    negative = word.startswith("-")
    mm = _core.length_mm(word[1:] if negative else word)
    return -mm if negative else mm


def _lengths(word: str) -> str | list[float]:
    return word if word == "auto" else [_millimetres(one.strip()) for one in word.split(",")]


def _listed(word: str) -> list[str]:
    return [one.strip() for one in word.split(",")]


def _whole(word: str) -> int:
    try:
        return int(word)
    except ValueError:
        raise UsageError(f"{word!r} is no whole number") from None


@dataclass(frozen=True)
class _Option:
    """An option of the program, and the argument of the package that it is."""

    name: str
    value: Callable[[str], _Value] | None = str  # None: a flag
    repeats: bool = False


_INPUT = {
    "--unit": _Option("unit"),
    "--up-axis": _Option("up_axis"),
    "--georeference": _Option("georeference", None),
    "--threads": _Option("threads", _whole),
    "--scheduler": _Option("scheduler"),
    "--worker-memory": _Option("memory"),
    "--worker-threads": _Option("worker_threads", _whole),
    "--tile-folder": _Option("folder"),
    "--sag": _Option("sag"),
    "--weld": _Option("weld"),
    "--obstructions": _Option("obstructions", None),
    "--insulation": _Option("insulation", None),
}
_CLASH = _INPUT | {
    "--a": _Option("a", repeats=True),
    "--b": _Option("b", repeats=True),
    "--self": _Option("within_files", None),
    "--rules": _Option("rules"),
    "--profile": _Option("profile"),
    "--clearance": _Option("clearance"),
    "--touch-gap": _Option("touch_gap"),
    "--touch-overlap": _Option("touch_overlap"),
    "--contact-distance": _Option("contact_distance"),
    "--thickness-cap": _Option("thickness_cap", _switch),
    "--curves": _Option("curves", None),
    "--contacts": _Option("contacts"),
    "--volumes": _Option("volumes", None),
    "--regions": _Option("regions", _whole),
    "--group-by": _Option("group_by"),
    "--group-distance": _Option("group_distance"),
    "--group-contacts": _Option("group_contacts", None),
    "--sort": _Option("sort"),
    "--class": _Option("classes", _listed),
    "--list-exempted": _Option("list_exempted", None),
}
_VIEW = {
    "--view": _Option("view"),
    "--direction": _Option("direction"),
    "--up": _Option("up"),
    "--eye": _Option("eye", _lengths),
    "--target": _Option("target", _lengths),
    "--near": _Option("near"),
    "--field-of-view": _Option("field_of_view", _angle),
    "--limits": _Option("limits", _lengths),
    "--section": _Option("section", repeats=True),
}
_DRAW = _INPUT | {
    "--select": _Option("select", repeats=True),
    "--uncut": _Option("uncut", repeats=True),
    "--hidden": _Option("hidden"),
    "--hidden-layers": _Option("hidden_layers"),
    "--thin": _Option("thin", _thinning),
    "--break-lines": _Option("break_lines", _switch),
    "--visible-only": _Option("visible_only", None),
    "--stage": _Option("stage"),
    "--intersections": _Option("intersections"),
    "--own-polylines": _Option("own_polylines"),
    "--smooth": _Option("smooth"),
    "--flush-seams": _Option("flush_seams", _switch),
    "--sharp-angle": _Option("sharp_angle", _angle),
    "--contact-distance": _Option("contact_distance"),
    "--scale": _Option("scale"),
    "--paper": _Option("paper"),
    "--title": _Option("title"),
}


@dataclass
class _Words:
    """A command line, taken apart."""

    files: list[str] = field(default_factory=list)
    outputs: list[str] = field(default_factory=list)
    given: dict[str, Any] = field(default_factory=dict)  # by the program's name of the option
    quiet: bool = False

    def arguments(self, options: dict[str, _Option]) -> dict[str, Any]:
        return {options[word].name: value for word, value in self.given.items() if word in options}


def _as_typed(error: Error, options: dict[str, _Option]) -> Error:
    """The error in the words of the command line: the package tells of arguments, and the program has options."""
    if not isinstance(error, UsageError):
        return error
    word_of = {option.name: word for word, option in options.items()} | {"files": "FILE", "path_to": "--output"}
    # Names of several words are no words of a sentence; what is in quotes stands there as it was given.
    names = "|".join(name for name in word_of if "_" in name)

    def in_program_words(text: str) -> str:
        return re.sub(rf"(?<![\w'\"/])(?:{names})(?![\w'\"/])", lambda name: word_of[name[0]], text)

    where = word_of.get(error.where, error.where)
    option_mend = re.fullmatch(r"(give|leave out) (\w+)(?: or (\w+))?", error.mend)
    if option_mend and all(name in word_of for name in option_mend.groups()[1:] if name):
        mend = f"{option_mend[1]} {' or '.join(word_of[name] for name in option_mend.groups()[1:] if name)}"
    else:
        mend = in_program_words(error.mend)
    return type(error)(in_program_words(error.message), where, mend)


# What turns a flag of the program off, as "--volumes=false".
_OFF = ("false", "off", "no", "disable", "f", "n", "0", "-")


def _taken_apart(words: Sequence[str], verb: str, options: dict[str, _Option]) -> _Words:
    taken, rest = _Words(), list(words)
    while rest:
        word = rest.pop(0)
        if word == "--":
            taken.files += rest
            break
        if not word.startswith("-") or word == "-":
            taken.files.append(word)
            continue
        name, joined, value = word.partition("=") if word.startswith("--") else (word[:2], word[2:], word[2:])
        if name == "--quiet":
            taken.quiet = True
            continue
        option = options.get(name)
        if name in ("-o", "--output"):
            taken.outputs.append(value if joined else rest.pop(0))
        elif option is None:
            raise UsageError(
                f"strake {verb} has it on one machine only", name, f"leave it out, or --scheduler; docs/cluster.md lists {verb}'s"
            )
        elif option.value is None:
            # The program has read the words before, and its flags take values.
            if value.lower() in _OFF:
                taken.given.pop(name, None)
            else:
                taken.given[name] = True
        else:
            _add(taken, name, option, value if joined else rest.pop(0))
    if not taken.outputs:
        raise UsageError("no file is named for the result", "-o", f"add -o, as 'strake {verb} ... --scheduler ADDRESS -o FILE'")
    return taken


def _add(taken: _Words, name: str, option: _Option, word: str) -> None:
    assert option.value is not None
    try:
        value = option.value(word)
    except UsageError as error:
        raise UsageError(error.message, name, error.mend) from None
    if option.repeats:
        taken.given.setdefault(name, []).append(value)
    else:
        taken.given[name] = value


class _Line:
    """The progress of a run, drawn over itself on a terminal."""

    def __init__(self, quiet: bool) -> None:
        self._shown = not quiet and sys.stderr.isatty()

    def __call__(self, fraction: float, step: str) -> None:
        if self._shown:
            sys.stderr.write(f"\r\x1b[K{step} {fraction:.0%}")
            sys.stderr.flush()

    def clear(self) -> None:
        if self._shown:
            sys.stderr.write("\r\x1b[K")


def main(words: Sequence[str]) -> int:
    """Does what a command line of the program says, and returns its exit code."""
    line = _Line("--quiet" in words)
    try:
        _run(words, line)
    except Error as error:
        return _ended(str(_as_typed(error, _options_of(words[0]))), _CODES[error.code], line)
    except ImportError as error:
        return _ended(str(error), _CODES["usage"], line)
    except KeyboardInterrupt:
        return _ended("cancelled", _CODES["cancelled"], line)
    return 0


def _ended(why: str, code: int, line: _Line) -> int:
    line.clear()
    sys.stderr.write(f"strake: error: {why}\n")
    return code


def _options_of(verb: str) -> dict[str, _Option]:
    return _CLASH if verb == "clash" else _DRAW | _VIEW


def _run(words: Sequence[str], line: _Line) -> None:
    verb = words[0]
    taken = _taken_apart(words[1:], verb, _options_of(verb))
    if taken.given.get("--scheduler") == "local":
        del taken.given["--scheduler"]
    if verb == "clash":
        clashes = cluster.clash(taken.files, progress=line, **taken.arguments(_CLASH))
        _write(clashes, taken, line)
        _report(", ".join(f"{count} {name}" for name, count in clashes.summary.items() if count), taken, line)
        return
    view = taken.arguments(_VIEW)
    arguments = taken.arguments(_DRAW)
    # As on one machine, all files are of one drawing.
    arguments["keep_hidden"] = "visible_only" not in arguments and not all(_core.shows_ink(Path(file)) for file in taken.outputs)
    drawing = cluster.draw(taken.files, view or "iso", progress=line, **arguments)
    _write(drawing, taken, line)
    _report(repr(drawing).strip("<>").removeprefix("strake."), taken, line)


def _write(result: strake.Clashes | strake.Drawing, taken: _Words, line: _Line) -> None:
    for file in taken.outputs:
        result.save(file)
        _report(f"written: {file}", taken, line)


def _report(what: str, taken: _Words, line: _Line) -> None:
    line.clear()
    if not taken.quiet:
        with suppress(OSError):
            sys.stderr.write(what + "\n")
