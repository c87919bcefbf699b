# SPDX-License-Identifier: Apache-2.0
"""How an importer is called: `--input FILE --output SCENE.glb --report REPORT.jsonl --threads N [--sag MM]`."""

from __future__ import annotations

import argparse
import gc
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from strake.importers.report import ImportFailed, Report
from strake.importers.scene_writer import SceneTooLarge, SceneWriter
from strake.importers.supervision import Attempt, crash_of


@dataclass
class Job:
    """One import: what to read, where the scene goes, and whom to tell.

    `sag_mm` is the largest distance of triangles from the true surface, where the user says one.
    """

    input: Path
    output: Path
    report: Report
    threads: int = 1
    sag_mm: float | None = None
    made_by: str = "an importer"
    format: str = ""
    unit: str = ""
    depends_on: list[str] = field(default_factory=list)
    map_place: dict[str, Any] | None = None
    attempt: Attempt = field(default_factory=Attempt)
    # What need not be taken apart before the process ends, which gives its memory back at once.
    kept: list[Any] = field(default_factory=list)

    def scene(self, unit_mm: float = 1.0, up: str = "z", sag_mm: float | None = None) -> SceneWriter:
        """Begins the scene; `sag_mm` as SceneWriter has it."""
        return SceneWriter(self.output, unit_mm, up, sag_mm=sag_mm)

    def place_on_map(self, crs: str, to_map: ArrayLike) -> None:
        """Says where the file lies on a map.

        `crs` names its coordinate system, `to_map` is the 4x4 matrix, rows first, from millimetres of the scene with z up
        to millimetres east, north and up. It is applied where the user asks for it.
        """
        matrix = np.asarray(to_map, dtype=np.float64).reshape(4, 4)
        self.map_place = {"crs": crs, "matrix": matrix.T.ravel().tolist()}


Convert = Callable[[Job], None]

# How many objects come before those are looked for that hold each other: importers make many, and few such.
_NEW_OBJECTS = 100_000


def run(convert: Convert, arguments: Sequence[str] | None = None) -> int:
    """Converts the file that the arguments name and returns the exit status.

    `convert` runs in a process of its own where the system can do that: its crash is a line of the report as well.
    """
    parser = argparse.ArgumentParser(description="Makes a neutral scene of a model file, for strake.")
    parser.add_argument("--input", type=Path, required=True, metavar="FILE", help="the model file")
    parser.add_argument("--output", type=Path, required=True, metavar="SCENE.glb", help="the scene that is written")
    parser.add_argument("--report", type=Path, required=True, metavar="REPORT.jsonl", help="the report that is written")
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1, metavar="N", help="how many cores to use")
    parser.add_argument("--sag", type=float, metavar="MM", help="the largest distance of triangles from the true surface")
    options = parser.parse_args(arguments)
    options.report.write_bytes(b"")
    # What is loaded by now stays: no collection need look at it, nor write into pages that processes to come share with this one.
    gc.freeze()
    gc.set_threshold(_NEW_OBJECTS)
    with Report(options.report) as report:
        job = Job(options.input, options.output, report, max(1, options.threads), options.sag)
        crash = crash_of(lambda: _converted(convert, job))
        if crash.name and job.attempt.repeat():
            report.begin_anew()
            crash = crash_of(lambda: _converted(convert, job))
        if crash.name:
            report.error(f"reading it ended with {crash.name}", "the file may be damaged: export it again, or in another version")
        return crash.status


def _converted(convert: Convert, job: Job) -> int:
    try:
        if not job.input.is_file():
            job.report.fail("there is no such file", "give the path of a model file")
        convert(job)
    except ImportFailed as failure:
        job.report.error(failure.message, failure.mend)
        return 1
    except SceneTooLarge as failure:
        job.report.error(str(failure), "split the model into files by storey or discipline")
        return 1
    except MemoryError:
        job.report.error("memory ran out", "use a machine with more of it, or split the model")
        return 1
    except OSError as failure:
        job.report.error(f"{failure.filename or job.input}: {failure.strerror or failure}", "check the file, rights and free space")
        return 1
    except Exception as failure:
        import traceback

        traceback.print_exc(file=sys.stderr)
        job.report.error(f"the importer has a fault: {type(failure).__name__}: {failure}", "report it, with the file if that can be given")
        return 1
    job.report.made_by(job.made_by, job.format, job.unit, {*job.depends_on, *_own_files()}, job.map_place)
    return 0


def _own_files() -> list[str]:
    folders = os.walk(Path(__file__).resolve().parent)
    return [os.path.join(folder, name) for folder, _, names in folders for name in names if name.endswith(".py")]
