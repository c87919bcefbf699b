# SPDX-License-Identifier: Apache-2.0
"""Tests and draws a ship on workers of which two are killed in each run, and compares the bytes with those of one process.

    python killed_workers.py --objects 1000000 --workers 4 --memory 1GiB --folder /tmp/killed

The first worker that gets a tile dies before it has done anything, and the second when all of its tile is done but told. CPU seconds and
peaks of memory are told of each process that lived on. Needs strake[cluster]; docs/cluster.md has figures.
"""

from __future__ import annotations

import argparse
import filecmp
import multiprocessing
import os
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ships_by_tiles import make_ships, print_cost, spent

import strake
import strake.cluster

CLASH: dict[str, Any] = {"clearance": 25}
VIEW: dict[str, Any] = {"view": "iso", "visible_only": True}


def die_once(folder: Path, name: str) -> None:
    """Ends this process as the system ends one that takes too much memory, unless another has died of that name."""
    try:
        (folder / name).touch(exist_ok=False)
    except FileExistsError:
        return
    os.kill(os.getpid(), signal.SIGKILL)


def do_or_die(task: Callable[[str, str, int], None], tile_file: str, found: str, threads: int) -> None:
    """What a worker does, but two of them."""
    folder = Path(tile_file).parents[1]
    die_once(folder, "first.killed")
    task(tile_file, found, threads)
    die_once(folder, "second.killed")


class KillingClient:
    """A Dask client whose workers die."""

    def __init__(self, client: Any) -> None:
        self._submit = client.submit
        client.submit = self.submit

    def submit(self, task: Any, *arguments: Any, **options: Any) -> Any:
        return self._submit(do_or_die, task, *arguments, **options)


def whole_run(file: Path, clashes: Path, drawing: Path) -> None:
    """What one process does without tiles."""
    model = strake.load(file, threads=1)
    strake.clash(model, threads=1, **CLASH).save(clashes, threads=1)
    print_cost("one process, clashes", *spent())
    before = spent()[0]
    strake.draw(model, threads=1, **VIEW).save(drawing, threads=1)
    print_cost("one process, drawing", spent()[0] - before, spent()[1])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--objects", type=int, default=100_000)
    parser.add_argument("--folder", type=Path, required=True, help="where the ship, the tiles and the results are")
    parser.add_argument("--workers", type=int, default=4)
    parser.add_argument("--memory", default="1GiB", help="of a worker")
    given = parser.parse_args()
    from distributed import Client, LocalCluster

    given.folder.mkdir(parents=True, exist_ok=True)
    (file,) = make_ships(given.folder, 1, given.objects)
    results = {name: given.folder / name for name in ("tiled.json", "tiled.svg", "whole.json", "whole.svg")}
    for what, run, result in (
        ("clashes", lambda **where: strake.cluster.clash(file, **CLASH, **where), results["tiled.json"]),
        ("drawing", lambda **where: strake.cluster.draw(file, **VIEW, **where), results["tiled.svg"]),
    ):
        work = given.folder / what
        for old in work.glob("*.killed"):
            old.unlink()
        before, wall = spent()[0], time.perf_counter()
        workers = LocalCluster(n_workers=given.workers, threads_per_worker=1, memory_limit=given.memory, dashboard_address=None)
        with workers as cluster, Client(cluster) as client:
            KillingClient(client)
            run(scheduler=client, folder=work, memory=given.memory, threads=1).save(result, threads=1)
            lived = client.run(spent)
        killed = len(list(work.glob("*.killed")))
        print_cost(
            f"{what}: cut, join, write", spent()[0] - before, spent()[1], f"{time.perf_counter() - wall:.0f} s wall, {killed} killed"
        )
        for number, (cpu, peak) in enumerate(lived.values(), 1):
            print_cost(f"{what}: worker {number}", cpu, peak)
        if killed != 2:
            sys.exit("there were not two to kill: give more objects")
    process = multiprocessing.get_context("spawn").Process(target=whole_run, args=(file, results["whole.json"], results["whole.svg"]))
    process.start()
    process.join()
    for kind in ("json", "svg"):
        if process.exitcode != 0 or not filecmp.cmp(results[f"tiled.{kind}"], results[f"whole.{kind}"], shallow=False):
            sys.exit(f"one process writes another {kind}")
        print(f"{kind}: the {results[f'tiled.{kind}'].stat().st_size} bytes of one process")


if __name__ == "__main__":
    main()
