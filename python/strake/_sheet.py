# SPDX-License-Identifier: Apache-2.0
"""Sheets of several views."""

from __future__ import annotations

from functools import cached_property

from strake import _core
from strake._arguments import PathLike, Progress, path, run_options
from strake._model import Diagnostic, Model, model_core


class SheetDrawing:
    """A sheet composed for a model."""

    def __init__(self, core: _core.SheetRun) -> None:
        self._core = core

    @cached_property
    def svg(self) -> str:
        """SVG in mm of paper, with the bytes that `strake draw --sheet` writes."""
        return self._core.svg.decode("utf-8")

    def _repr_svg_(self) -> str:
        return self.svg

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper, mm."""
        width, height = self._core.size_mm
        return width, height

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What composing noticed, as views that are empty."""
        return [Diagnostic(*one) for one in self._core.diagnostics]

    def save(self, path_to: PathLike) -> list[Diagnostic]:
        """Writes .svg or .pdf, whole or not at all; returns what of the sheet could not be written as it is, as characters that
        the font of a PDF lacks (docs/formats/pdf.md). Raises: UsageError, OutputError.
        """
        return [Diagnostic(*one) for one in _core.save_sheet(self._core, path(path_to, "path_to"))]

    def __repr__(self) -> str:
        width, height = self.size
        return f"<strake.SheetDrawing of {width:g} x {height:g} mm>"


class Sheet:
    """A file that describes a sheet (docs/sheets.md)."""

    def __init__(self, core: _core.SheetFile, name: str) -> None:
        self._core = core
        self.name = name

    @classmethod
    def read(cls, file: PathLike) -> Sheet:
        """Reads a .toml; templates are looked for beside it. Raises: InputError, with line and column."""
        where = path(file, "file")
        return cls(_core.read_sheet(where), str(where))

    def draw(self, model: Model, threads: int | None = None, progress: Progress | None = None) -> SheetDrawing:
        """Draws its views and puts them on paper. Raises: InputError where they have no room; KeyboardInterrupt."""
        return SheetDrawing(_core.compose_sheet(self._core, model_core(model), run_options(threads, progress)))

    def __repr__(self) -> str:
        return f"<strake.Sheet of {self.name}>"
