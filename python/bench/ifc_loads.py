# SPDX-License-Identifier: Apache-2.0
"""How long strake takes to read an IFC file for the first time, and IfcOpenShell by its default kernel.

    python ifc_loads.py A.ifc B.ifc+C.ifc [--repeat 3]

Files that are joined by `+` are read together. Each is read in turn by both, as often as asked for, in processes of their own; the
medians count, since neighbours on a busy machine disturb both alike. Seconds of strake are those of `strake.load` without a scene
that is kept, from the start of Python on; those of IfcOpenShell are of opening the file and of its iterator with its tree, without
the start of Python and the loading of its libraries, which a script pays for once.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

LOAD = "import sys, strake; strake.load(sys.argv[1:])"


def by_ifcopenshell(paths: list[Path]) -> None:
    """Reads files as ifc_peers.py does, and prints CPU and wall seconds."""
    import ifcopenshell.geom
    from ifc_peers import read, seconds

    tree = ifcopenshell.geom.tree(backend="opencascade.trianglebvh")
    cpu, wall, _ = seconds(lambda: [read(path, tree, 1) for path in paths])
    print(json.dumps([cpu, wall]))


def told_by(paths: list[Path]) -> tuple[float, float]:
    """CPU and wall seconds of IfcOpenShell, in a process of its own."""
    words = [sys.executable, __file__, "--theirs", "+".join(map(str, paths))]
    ended = subprocess.run(words, capture_output=True, text=True, check=True)
    cpu, wall = json.loads(ended.stdout.splitlines()[-1])
    return float(cpu), float(wall)


def first_load(paths: list[Path]) -> tuple[float, float]:
    """CPU and wall seconds of strake, with those of all processes that it starts."""
    with tempfile.TemporaryDirectory() as cache:
        before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        environment = {**os.environ, "STRAKE_CACHE": cache}
        subprocess.run([sys.executable, "-c", LOAD, *map(str, paths)], env=environment, capture_output=True, check=True)
        wall, after = time.perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


def main() -> int:
    """Prints a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="FILE[+FILE...]")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--theirs", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    together = [[Path(name) for name in files.split("+")] for files in options.files]
    if options.theirs:
        by_ifcopenshell(together[0])
        return 0
    print("| file | strake, CPU s | s | IfcOpenShell, CPU s | s | times faster, CPU | s |\n|---|---|---|---|---|---|---|")
    for paths in together:
        pairs = [(first_load(paths), told_by(paths)) for _ in range(options.repeat)]
        ours, theirs = ([statistics.median(one[who][k] for one in pairs) for k in range(2)] for who in range(2))
        figures = (
            f"{ours[0]:.2f} | {ours[1]:.2f} | {theirs[0]:.2f} | {theirs[1]:.2f} | {theirs[0] / ours[0]:.1f} | {theirs[1] / ours[1]:.1f}"
        )
        print(f"| {' + '.join(path.name for path in paths)} | {figures} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
