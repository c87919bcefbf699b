# SPDX-License-Identifier: Apache-2.0
"""How long a million results take on their way to NumPy, pandas and files: python million_rows.py [RESULTS].

Cubes in a lattice, each within a millimetre of 26 others. CPU seconds of the process, all threads together, and the wall's.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

import numpy as np

import strake

T = TypeVar("T")
PAIRS_PER_CUBE = 13
SIDES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def timed(what: str, call: Callable[[], T]) -> T:
    wall, cpu = time.perf_counter(), time.process_time()
    made = call()
    print(f"{what:<28}{time.perf_counter() - wall:8.3f} s wall {time.process_time() - cpu:8.3f} s CPU")
    return made


def lattice(results: int) -> strake.Model:
    side = round((results / PAIRS_PER_CUBE) ** (1 / 3)) + 1
    corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]) * 100.0
    triangles = np.array([three for a, b, c, d in SIDES for three in ((a, b, c), (a, c, d))])
    meshes = []
    for i, at in enumerate(np.ndindex(side, side, side)):
        placement = np.eye(3, 4)
        placement[:, 3] = np.array(at) * 100.5
        meshes.append(strake.Mesh(f"cube {i:07}", corners, triangles, placement=placement))
    return strake.Model.from_arrays(meshes)


def main() -> None:
    model = timed("from_arrays()", lambda: lattice(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000))
    clashes = timed("clash()", lambda: strake.clash(model))
    rows = timed("Clashes.array", lambda: clashes.array)
    if len(rows) != clashes.summary["contact"] or not (rows["distance"] <= 1).all():
        sys.exit("the array is not what was found")
    print(f"{len(model)} objects, {len(rows)} results, {rows.nbytes / 1e6:.0f} MB")
    timed("sum of a column", rows["distance"].sum)
    timed("columns()", clashes.columns)
    with TemporaryDirectory() as folder:
        timed("save('x.csv')", lambda: clashes.save(Path(folder) / "x.csv"))


if __name__ == "__main__":
    main()
