# SPDX-License-Identifier: Apache-2.0
"""Projects: models, tests, results and decisions in one file."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from strake import _core
from strake._arguments import Length, PathLike, Progress, count, path, paths, run_options, some_paths, text, texts, words
from strake._clash import clearance_text
from strake._errors import InputError, UsageError
from strake._model import Model
from strake._numpy import np, npt
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
        where, given = path(file, "file"), some_paths(models, "models")
        _core.create_project(where)
        try:
            project = cls(where)
            if given:
                project.add(given)
        except BaseException:
            for end in ("", "-wal", "-shm"):
                Path(f"{where}{end}").unlink(missing_ok=True)
            raise
        return project

    def add(self, models: PathLike | Iterable[PathLike]) -> dict[str, Any]:
        """Adds model files, and returns what changed (schemas/project-changes.schema.json)."""
        return self._change(["project", "add", self.path, *paths(models, "models")])

    def update(self, models: PathLike | Iterable[PathLike] = ()) -> dict[str, Any]:
        """Reads again the files that changed, or takes these in the place of those that they match.

        Returns what changed (schemas/project-changes.schema.json).
        """
        return self._change(["project", "update", self.path, *some_paths(models, "models")])

    def remove(self, *labels: str) -> dict[str, Any]:
        """Takes model files out, by their labels."""
        given = texts(labels, "labels")
        if not given:
            raise UsageError("no label is given", "labels", "list('files') has them")
        return self._change(["project", "remove", self.path, *given])

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
        command = ["clash", "--project", str(self.path), "--json", "--quiet", *words(arguments, "arguments")]
        if clearance is not None:
            command.append(f"--clearance={clearance_text(clearance)}")
        if rules is not None:
            command.append(f"--rules={path(rules, 'rules')}")
        for file in some_paths(save, "save"):
            command.append(f"--output={file}")
        document: dict[str, Any] = json.loads(run_program(command).stdout)
        return document

    def list(self, kind: str = "clashes", most: int = 0) -> dict[str, npt.NDArray[Any]]:
        """Returns a list as columns by name.

        Args:
            kind: "files", "shapes", "revisions", "tests", "runs", "clashes" or "views".
            most: how many rows at most; 0: all.

        Columns of whole numbers are int64, others with numbers float64 (NaN where there is none), the rest objects.
        """
        names, rows = _core.project_list(self.path, text(kind, "kind"), count(most, "most"), run_options(None, None))
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
        if status is None and comment is None and assignee is None:
            raise UsageError("there is nothing to set", "status", "give status, comment or assignee")
        command = ["clash", "set", "--project", str(self.path), "--quiet"]
        for name, value in (("status", status), ("comment", comment), ("assignee", assignee), ("by", by)):
            if value is not None:
                command.append(f"--{name}={text(value, name)}")
        run_program([*command, "--", *wanted])

    def draw(self, view: str, hidden: str = "off") -> str:
        """Returns the SVG of a stored view; only what changed since is solved again."""
        with tempfile.TemporaryDirectory() as folder:
            into = Path(folder) / "view.svg"
            command = ["draw", "--project", str(self.path), f"--stored={text(view, 'view')}", f"--hidden={text(hidden, 'hidden')}"]
            run_program([*command, "--quiet", "--output", str(into)])
            return into.read_text(encoding="utf-8")

    def store_view(self, name: str, arguments: Sequence[str] = ("--view", "iso")) -> str:
        """Remembers a view by the arguments of `strake draw`, and returns its SVG."""
        with tempfile.TemporaryDirectory() as folder:
            into = Path(folder) / "view.svg"
            command = ["draw", "--project", str(self.path), f"--save={text(name, 'name')}", "--quiet", "--output", str(into)]
            run_program([*command, *words(arguments, "arguments")])
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
