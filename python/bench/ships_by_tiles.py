# SPDX-License-Identifier: Apache-2.0
"""What ships that lie side by side, each a file of its own, take by tiles, process by process.

    python ships_by_tiles.py --ships 10 --objects 1000000 --tiles-only --contacts count --folder /tmp/ships

The files are made one after the other where they are not there yet, then cut, tested by Dask's workers and joined as strake.cluster.clash()
does it. Without --tiles-only another process tests all of it at once, and the bytes are compared. CPU seconds and peaks of memory
are told of each process. Needs strake[cluster]; docs/cluster.md has figures.
"""

from __future__ import annotations

import argparse
import filecmp
import multiprocessing
import os
import resource
import struct
import sys
import time
from pathlib import Path
from typing import Any

import strake
import strake.cluster

# No ship is as wide.
METRES_APART = 1000
# The ships do not touch each other: pairs of one file are what there is to be found.
WITHIN_FILES = True


def spent(who: int = resource.RUSAGE_SELF) -> tuple[float, float]:
    """CPU seconds, and the peak of memory in MiB."""
    usage = resource.getrusage(who)
    peak = usage.ru_maxrss
    if who == resource.RUSAGE_SELF:
        # What getrusage() has of a process that was started by a large one is the peak of that one.
        status = Path("/proc/self/status").read_text(encoding="ascii")
        peak = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM:"))
    return usage.ru_utime + usage.ru_stime, peak / 1024


def print_cost(what: str, cpu: float, peak: float, rest: str = "") -> None:
    print(f"{what:<28}{cpu:9.1f} s CPU{peak:9.0f} MiB{'  ' if rest else ''}{rest}", flush=True)


def move(file: Path, metres: int, into: Path) -> None:
    """Writes a copy of a generated GLB whose root stands that far aside."""
    root = b'"nodes":[\n{'
    with file.open("rb") as source, into.open("wb") as target:
        magic, version, size, text_size, kind = struct.unpack("<4sIII4s", source.read(20))
        start = source.read(4096)
        if start.count(root) != 1 or magic != b"glTF":
            sys.exit(f"{file} is no GLB that strake generate wrote")
        place = f'"translation":[0,0,{metres}],'.encode()
        place += b" " * (-len(place) % 4)
        target.write(struct.pack("<4sIII4s", magic, version, size + len(place), text_size + len(place), kind))
        target.write(start.replace(root, root + place))
        while block := source.read(1 << 22):
            target.write(block)


def make_ships(folder: Path, ships: int, objects: int) -> list[Path]:
    files = [folder / f"ship{number:03}of{objects}.glb" for number in range(ships)]
    for number, file in enumerate(files):
        if file.exists():
            continue
        made, part = file.with_suffix(".made.glb"), file.with_suffix(".part")
        words = ["generate", "ship", "--objects", str(objects), "--seed", str(number + 1), "--quiet", "-o", str(made)]
        strake.run_program(words)
        move(made, METRES_APART * number, part)
        made.unlink()
        os.replace(part, file)
    return files


def whole_run(files: list[Path], output: Path, test: dict[str, Any]) -> None:
    """What one process does without tiles."""
    strake.clash(strake.load(files, threads=1), threads=1, within_files=WITHIN_FILES, **test).save(output, threads=1)
    print_cost("one process, no tiles", *spent())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ships", type=int, default=2)
    parser.add_argument("--objects", type=int, default=100_000, help="of each ship")
    parser.add_argument("--folder", type=Path, required=True, help="where the ships, the tiles and the results are")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--memory", default="1GiB", help="of a worker")
    parser.add_argument("--contacts", choices=("list", "count", "off"), default="list")
    parser.add_argument("--clearance", default="25mm")
    parser.add_argument("--tiles-only", action="store_true", help="do not test all of it at once for comparison")
    given = parser.parse_args()
    from distributed import Client, LocalCluster

    given.folder.mkdir(parents=True, exist_ok=True)
    files = make_ships(given.folder, given.ships, given.objects)
    print_cost("making ships, the largest", *spent(resource.RUSAGE_CHILDREN))
    test = {"clearance": given.clearance, "contacts": given.contacts}
    tiled, whole = given.folder / "tiled.json", given.folder / "whole.json"
    started, wall = spent()[0], time.perf_counter()
    workers = LocalCluster(n_workers=given.workers, threads_per_worker=1, memory_limit=given.memory, dashboard_address=None)
    with workers as cluster, Client(cluster) as client:
        clashes = strake.cluster.clash(
            files, scheduler=client, folder=given.folder, memory=given.memory, threads=1, within_files=WITHIN_FILES, **test
        )
        of_workers = client.run(spent)
    found = spent()[0]
    clashes.save(tiled, threads=1)
    print_cost("cut and join", found - started, spent()[1], f"{time.perf_counter() - wall:.0f} s wall")
    for number, (cpu, peak) in enumerate(of_workers.values(), 1):
        print_cost(f"worker {number}", cpu, peak)
    print_cost("writing JSON", spent()[0] - found, spent()[1])
    print(f"{len(clashes.model)} objects, {clashes.summary}, {tiled.stat().st_size / 1e6:.1f} MB")
    if given.tiles_only:
        return
    process = multiprocessing.get_context("spawn").Process(target=whole_run, args=(files, whole, test))
    process.start()
    process.join()
    if process.exitcode != 0 or not filecmp.cmp(tiled, whole, shallow=False):
        sys.exit("one process does not find what the tiles found")
    print("the bytes are those of one process")


if __name__ == "__main__":
    main()
