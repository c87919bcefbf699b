# SPDX-License-Identifier: Apache-2.0
"""Runs the IFC importer as a program."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from glb_reader import Glb


@dataclass
class Outcome:
    """What came of a conversion."""

    status: int
    lines: list[dict[str, Any]]
    output: Path
    stated: str

    @property
    def glb(self) -> Glb:
        """The scene."""
        assert self.status == 0, (self.lines[-1:], self.stated)
        return Glb(self.output)

    def reported(self, severity: str) -> list[dict[str, Any]]:
        """Returns the diagnostics of a severity."""
        return [line for line in self.lines if line.get("severity") == severity]


def convert(path: Path, threads: int = 2, module: str = "strake.importers.ifc", hash_seed: int | None = None) -> Outcome:
    """Converts a file; scene and report lie beside each other in a new folder."""
    folder = path.parent / f"{path.name}.{threads}.out"
    folder.mkdir(exist_ok=True)
    output, report = folder / "scene.glb", folder / "report.jsonl"
    output.unlink(missing_ok=True)
    arguments = ["--input", str(path), "--output", str(output), "--report", str(report), "--threads", str(threads)]
    seeded = {} if hash_seed is None else {"PYTHONHASHSEED": str(hash_seed)}
    ended = subprocess.run(
        [sys.executable, "-m", module, *arguments], capture_output=True, text=True, timeout=600, check=False, env={**os.environ, **seeded}
    )
    lines = [json.loads(line) for line in report.read_text("utf-8").splitlines()]
    assert {path.name for path in folder.iterdir()} <= {"scene.glb", "report.jsonl"}, "something is left behind"
    return Outcome(ended.returncode, lines, output, ended.stderr)
