# SPDX-License-Identifier: Apache-2.0
"""What an author of an importer needs: a program that makes of one file one neutral scene.

    from strake.importers import Job, Part, run

    def convert(job: Job) -> None:
        with job.scene(unit_mm=1.0) as scene:
            deck = scene.group("Deck 3")
            box = scene.shape([Part(vertices, triangles, (0.5, 0.5, 0.5, 1.0))])
            scene.object("plate-1", "Plate 1", box, parent=deck, attributes={"Weight": "12 kg"})

    def main() -> int:
        return run(convert)

The program is called `strake-import-SUFFIX`, or `convert` is an entry point of the group `strake.importers` under the name of the
suffix. What it is called with and what it answers is decision 0072. `run_several` makes the program `strake-import-many-SUFFIX`,
which reads several files after it has loaded its libraries once (decision 0126).
"""

import os

# NumPy's library of linear algebra starts a thread for each core when it is loaded, and they look for work for 40 ms of CPU time.
# Importers multiply matrices of four rows.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from strake.importers.command import Job, run
from strake.importers.report import ImportFailed, Report
from strake.importers.scene_writer import Group, SceneWriter
from strake.importers.several import run_several
from strake.importers.shapes import Part, PreparedShape, Shape, prepare_shape

__all__ = [
    "Group",
    "ImportFailed",
    "Job",
    "Part",
    "PreparedShape",
    "Report",
    "SceneWriter",
    "Shape",
    "prepare_shape",
    "run",
    "run_several",
]
