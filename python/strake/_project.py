# SPDX-License-Identifier: Apache-2.0
"""Projects: models, tests, results and decisions in one file."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from strake import _core
from strake._arguments import Length, PathLike, Progress, length, path, paths, run_options, texts
from strake._errors import InputError, UsageError
from strake._model import Model
from strake._program import run_program


class Project:
    """A project file (docs/project.md). What changes it is done by the program, in one transaction each."""

    def __init__(self, file: PathLike) -> None:
        """Opens a project. Raises: InputError where the file is none."""
        self.path = path(file, "file")
        if not _core.is_project(self.path):
            raise InputError("it is no project", str(self.path), "Project.create() makes one")

    @classmethod
    def create(cls, file: PathLike, models: PathLike | Iterable[PathLike] = ()) -> Project:
        """Makes a project, with what model files hold. Raises: OutputError where the file exists; InputError."""
        where = path(file, "file")
        _core.create_project(where)
        project = cls(where)
        given = [models] if isinstance(models, (str, os.PathLike)) else list(models)
        if given:
            try:
                project.add(given)
            except Exception:
                where.unlink()
                raise
        return project

    def add(self, models: PathLike | Iterable[PathLike]) -> dict[str, Any]:
        """Adds model files, and returns what changed (schemas/project-changes.schema.json)."""
        return self._change(["project", "add", self.path, *paths(models, "models")])

    def update(self, models: PathLike | Iterable[PathLike] = ()) -> dict[str, Any]:
        """Reads again the files that changed, or takes these in the place of those that they match.

        Returns what changed (schemas/project-changes.schema.json).
        """
        given = [path(models, "models")] if isinstance(models, (str, os.PathLike)) else [path(m, "models") for m in models]
        return self._change(["project", "update", self.path, *given])

    def remove(self, *labels: str) -> dict[str, Any]:
        """Takes model files out, by their labels."""
        return self._change(["project", "remove", self.path, *labels])

    def _change(self, words: Sequence[str | os.PathLike[str]]) -> dict[str, Any]:
        changes: dict[str, Any] = json.loads(run_program([*words, "--json", "--quiet"]).stdout)
        return changes

    def clash(
        self,
        save: PathLike | Iterable[PathLike] = (),
        clearance: Length | None = None,
        rules: PathLike | None = None,
        arguments: Sequence[str] = (),
    ) -> dict[str, Any]:
        """Tests the model; only what changed since the last run is tested again, and all of it is remembered.

        Args:
            save: .json and .csv files of the result.
            clearance, rules: as in strake.clash().
            arguments: further ones of `strake clash`, as "--profile=ship".

        Returns: the document of schemas/clash.schema.json.
        """
        words: list[str | os.PathLike[str]] = ["clash", "--project", self.path, "--json", "--quiet", *arguments]
        if clearance is not None:
            words += ["--clearance", clearance if isinstance(clearance, str) else f"{length(clearance, 'clearance')!r}mm"]
        if rules is not None:
            words += ["--rules", path(rules, "rules")]
        for file in [save] if isinstance(save, (str, os.PathLike)) else save:
            words += ["--output", path(file, "save")]
        document: dict[str, Any] = json.loads(run_program(words).stdout)
        return document

    def list(self, kind: str = "clashes", most: int = 0) -> dict[str, npt.NDArray[Any]]:
        """Returns a list as columns by name.

        Args:
            kind: "files", "shapes", "revisions", "tests", "runs", "clashes" or "views".
            most: how many rows at most; 0: all.

        Columns of whole numbers are int64, others with numbers float64 (NaN where there is none), the rest objects.
        """
        if most < 0:
            raise UsageError(f"{most} is no count", "most")
        names, rows = _core.project_list(self.path, kind, most, run_options(None, None))
        return {name: _column([row[i] for row in rows]) for i, name in enumerate(names)}

    def set_status(
        self,
        keys: str | Sequence[str],
        status: str | None = None,
        comment: str | None = None,
        assignee: str | None = None,
        by: str | None = None,
    ) -> None:
        """Decides about clashes, by their keys (docs/statuses.md).

        Args:
            keys: as results have them.
            status: "new", "active", "reviewed", "approved" or "resolved".
            comment, assignee: why, and who sees to it; "" takes it back.
            by: who decides; None: the user.
        """
        wanted = texts(keys, "keys")
        if not wanted:
            raise UsageError("no clash is named", "keys")
        words = ["clash", "set", "--project", str(self.path), "--quiet"]
        for name, value in (("status", status), ("comment", comment), ("assignee", assignee), ("by", by)):
            if value is not None:
                words.append(f"--{name}={value}")
        run_program([*words, "--", *wanted])

    def draw(self, view: str, hidden: str = "off") -> str:
        """Returns the SVG of a stored view; only what changed since is solved again."""
        with tempfile.TemporaryDirectory() as folder:
            into = Path(folder) / "view.svg"
            words = ["draw", "--project", str(self.path), "--stored", view, "--hidden", hidden, "--quiet"]
            run_program([*words, "--output", str(into)])
            return into.read_text(encoding="utf-8")

    def store_view(self, name: str, arguments: Sequence[str] = ("--view", "iso")) -> str:
        """Remembers a view by the arguments of `strake draw`, and returns its SVG."""
        with tempfile.TemporaryDirectory() as folder:
            into = Path(folder) / "view.svg"
            run_program(["draw", "--project", self.path, "--save", name, "--quiet", "--output", into, *arguments])
            return into.read_text(encoding="utf-8")

    def model(self, threads: int | None = None, progress: Progress | None = None) -> Model:
        """Returns its model, without reading the files again."""
        return Model(_core.project_model(self.path, run_options(threads, progress)))

    def __repr__(self) -> str:
        return f"<strake.Project of {self.path}>"


def _column(values: Sequence[Any]) -> npt.NDArray[Any]:
    kinds = {type(value) for value in values}
    if kinds == {int}:
        return np.array(values, dtype=np.int64)
    if kinds and kinds <= {int, float, type(None)} and kinds != {type(None)}:
        return np.array([np.nan if value is None else value for value in values], dtype=np.float64)
    return np.array(values, dtype=object)
