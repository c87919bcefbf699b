# SPDX-License-Identifier: Apache-2.0
"""The report of an importer: one JSON object on a line, written as the work goes on."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, NoReturn

# Progress is written in steps of this, so that a file of a million objects has no million lines.
_PROGRESS_STEP = 0.005


class ImportFailed(Exception):
    """Nothing comes of the file: why, and what a person can do about it."""

    def __init__(self, message: str, mend: str) -> None:
        super().__init__(message)
        self.message = message
        self.mend = mend


class Report:
    """Writes the lines of the report. Each is on disk when its call returns, whatever becomes of the process then."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._file = path.open("ab", buffering=0)
        self._shown = -1.0
        # Lines that an attempt before this one wrote, which ended in the middle of its work.
        self._said: Counter[bytes] = Counter()

    def __enter__(self) -> Report:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._file.close()

    def progress(self, done: float) -> None:
        """Says how much is done, 0 to 1. It never goes back."""
        done = min(max(done, 0.0), 1.0)
        if done >= self._shown + _PROGRESS_STEP or (done == 1.0 and self._shown < 1.0):
            self._shown = done
            self._line({"progress": round(done, 4)})

    def begin_anew(self) -> None:
        """Has what is there already not said again: the work begins anew."""
        self._said = Counter(self._path.read_bytes().splitlines(keepends=True))

    def alive(self) -> None:
        """Says again how much is done, so that work that takes long at one place does not count as hung."""
        self._line({"progress": round(max(self._shown, 0.0), 4)})

    def note(self, code: str, message: str, object_id: str | None = None) -> None:
        """Says something of the file that is as it should be."""
        self._diagnostic("note", code, message, object_id)

    def warning(self, code: str, message: str, object_id: str | None = None) -> None:
        """Says that something of the file is not quite as it should be, and is in the scene all the same."""
        self._diagnostic("warning", code, message, object_id)

    def skipped(self, code: str, message: str, object_id: str | None = None) -> None:
        """Says that something is not in the scene and should be."""
        self._diagnostic("skipped", code, message, object_id)

    def fail(self, message: str, mend: str) -> NoReturn:
        """Ends the import: raises ImportFailed, of which `run` makes the last line."""
        raise ImportFailed(message, mend)

    def error(self, message: str, mend: str) -> None:
        """Writes the last line of an import of which nothing came."""
        self._line({"error": message, "mend": mend})

    def made_by(
        self, name: str, file_format: str, unit: str, depends_on: Iterable[str] = (), map_place: Mapping[str, Any] | None = None
    ) -> None:
        """Writes the line that ends an import: what read the file, its format and unit, its place on a map, and the files
        of the importer."""
        line: dict[str, Any] = {"made_by": name, "format": file_format, "unit": unit}
        if map_place is not None:
            line["map"] = dict(map_place)
        self._line({**line, "depends_on": sorted(depends_on)})

    def _diagnostic(self, severity: str, code: str, message: str, object_id: str | None) -> None:
        line: dict[str, Any] = {"severity": severity, "code": code}
        if object_id is not None:
            line["object"] = object_id
        line["message"] = message
        self._line(line)

    def _line(self, line: dict[str, Any]) -> None:
        text = json.dumps(line, ensure_ascii=False).encode("utf-8", "replace") + b"\n"
        if self._said[text] > 0:
            self._said[text] -= 1
            return
        self._file.write(text)
