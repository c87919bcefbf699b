# SPDX-License-Identifier: Apache-2.0
"""Clash detection and drawings on several machines (docs/cluster.md).

    from dask.distributed import LocalCluster
    import strake.cluster

    if __name__ == "__main__":  # workers import the script, and would each start a cluster
        with LocalCluster(n_workers=4, threads_per_worker=1, memory_limit="1GiB") as cluster:
            clashes = strake.cluster.clash("ship.glb", scheduler=cluster, memory="1GiB", clearance=25)
        clashes.save("clashes.json")  # the bytes of one machine

The model is cut into tiles on the disk, each of which is a task of its own. Dask places and repeats them; without a
scheduler they run one after the other in this process.
"""

from __future__ import annotations

import re
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from strake import _core
from strake._arguments import PathLike, Progress, Selection, number, path, pick, run_options, shown, text, thread_count, truth
from strake._clash import Clashes, request_of
from strake._drawing import Drawing, draw_request
from strake._errors import Error, InputError, OutputError, UsageError
from strake._model import Model, read_arguments

__all__ = ["clash", "draw"]

# How often a tile is made or tested again before the run gives up.
_MAX_TRIES = 4
# What a worker takes before it has a tile: Python, NumPy, Dask and this package.
_EMPTY_WORKER = 200 * 2**20
_MIN_MEMORY = 2 * _EMPTY_WORKER
_MAX_MEMORY = 2**60
_LOST = "is missing or damaged"
_UNITS = {"": 1, "B": 1, "KB": 10**3, "MB": 10**6, "GB": 10**9, "KIB": 2**10, "MIB": 2**20, "GIB": 2**30}


class _Cut(Protocol):
    """What the files were cut into."""

    @property
    def sizes(self) -> list[tuple[int, int]]:
        """By tile: objects, and bytes that a worker takes."""


_CutT = TypeVar("_CutT", bound=_Cut)
_RunT = TypeVar("_RunT")
# What a worker does: reads one tile, and writes what it finds there beside it.
_Task = Callable[[str, str, int], None]


class _Runner(Protocol):
    """Runs tasks somewhere, and tells of each that has ended."""

    def submit(self, task: _Task, tile: int, tile_file: Path, found: Path, threads: int, name: str) -> None: ...
    def ended(self) -> tuple[int, BaseException | None]: ...


class _InThisProcess:
    """One after the other."""

    def __init__(self) -> None:
        self._waiting: list[tuple[_Task, int, Path, Path, int]] = []

    def submit(self, task: _Task, tile: int, tile_file: Path, found: Path, threads: int, name: str) -> None:
        self._waiting.append((task, tile, tile_file, found, threads))

    def ended(self) -> tuple[int, BaseException | None]:
        task, tile, tile_file, found, threads = self._waiting.pop(0)
        try:
            task(str(tile_file), str(found), threads)
        except Error as error:
            return tile, error
        return tile, None


class _OnDask:
    """On the workers of a cluster. Which does what, and what is done again, is Dask's affair."""

    def __init__(self, client: Any) -> None:
        from distributed import as_completed

        self._client = client
        self._tile_of: dict[Any, int] = {}
        self._completed = as_completed()

    def submit(self, task: _Task, tile: int, tile_file: Path, found: Path, threads: int, name: str) -> None:
        future = self._client.submit(task, str(tile_file), str(found), threads, key=name, retries=2)
        self._tile_of[future.key] = tile
        self._completed.add(future)

    def ended(self) -> tuple[int, BaseException | None]:
        future = next(self._completed)
        tile = self._tile_of.pop(future.key)
        error = future.exception()
        future.release()
        return tile, error


def find_in_tile(tile_file: str, found: str, threads: int) -> None:
    """Finds the clashes of one tile."""
    _core.find_in_tile(Path(tile_file), Path(found), run_options(threads, None))


def draw_in_tile(tile_file: str, found: str, threads: int) -> None:
    """Finds the lines of one tile."""
    _core.draw_in_tile(Path(tile_file), Path(found), run_options(threads, None))


@dataclass(frozen=True)
class _Job(Generic[_CutT, _RunT]):
    """What is made of a model by tiles."""

    cut: Callable[[int, Path, _core.RunOptions], _CutT]  # of the bytes that a tile may take, and where files are kept
    write: Callable[[_CutT, Path, list[int], _core.RunOptions], None]
    task: _Task
    join: Callable[[_CutT, list[Path], _core.RunOptions], _RunT]


@dataclass(frozen=True)
class _Where:
    """Where tasks run, and what they may take."""

    scheduler: Any
    folder: PathLike | None
    memory: str | int
    worker_threads: int
    threads: int | None

    def run(self, job: _Job[_CutT, _RunT], progress: Progress | None) -> _RunT:
        options = run_options(self.threads, progress)
        most = (_bytes(self.memory) - _EMPTY_WORKER) // 2
        worker_threads = thread_count(self.worker_threads, "worker_threads")
        with _runner(self.scheduler) as runner, _working_folder(self.folder) as work:
            cut = job.cut(most, work, options)
            run = _Run(job, cut, work, runner, worker_threads, options)
            run.write(range(len(cut.sizes)))
            run.find(range(len(cut.sizes)))
            return run.joined()


def clash(
    files: PathLike | Iterable[PathLike],
    a: Selection | None = None,
    b: Selection | None = None,
    *,
    scheduler: Any = None,
    folder: PathLike | None = None,
    memory: str | int = "1GiB",
    worker_threads: int = 1,
    unit: str | float | None = None,
    up_axis: str | None = None,
    georeference: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
    **test: Any,
) -> Clashes:
    """Finds clashes as strake.clash() does in the model of some files, by tiles: the same bytes.

    Args:
        files: as strake.load() takes them, with `unit`, `up_axis` and `georeference`. They are read one at a time, by this process.
        a, b: selections.
        scheduler: a Dask client, a Dask cluster, or the address of a scheduler, as "tcp://10.0.0.1:8786"; None: the
            tiles are tested one after the other in this process.
        folder: where the tiles are while the run lasts, seen by this process and all workers under one path; None: a
            temporary folder, which workers on this machine see.
        memory: what a worker may take, as "1GiB" or in bytes: tiles are cut so small.
        worker_threads: how many threads a worker uses for a tile.
        threads, progress: of what this process does itself.
        test: what strake.clash() takes besides, but log_pairs.

    The model of the result has all names and no geometry.

    Raises: what strake.clash() does; ImportError where Dask is not installed; OutputError for a folder that cannot be
    made; InputError for a file that changes meanwhile, for tiles that get lost again and again, and for a model whose
    members lie so askew that only a search over all of them at once tells which are near each other.
    """
    for name, some in (("a", a), ("b", b)):
        if isinstance(some, np.ndarray):
            raise UsageError("an array needs a model that is held", name, "give selections")
    if test.get("log_pairs"):
        raise UsageError("the pairs of tiles are not kept", "log_pairs", "leave it out, or test on one machine: strake.clash()")
    request = request_of(0, a, b, **test)
    read = _read_arguments(files, unit, up_axis, georeference)
    job = _Job(
        lambda most, work, options: _core.cut(*read, request, most, work, options),
        _core.write_tiles,
        find_in_tile,
        _core.join_tiles,
    )
    core = _Where(scheduler, folder, memory, worker_threads, threads).run(job, progress)
    return Clashes(core, Model(core.model))


def draw(
    files: PathLike | Iterable[PathLike],
    view: str | Mapping[str, Any] = "iso",
    *,
    select: Selection | None = None,
    scheduler: Any = None,
    folder: PathLike | None = None,
    memory: str | int = "1GiB",
    worker_threads: int = 1,
    unit: str | float | None = None,
    up_axis: str | None = None,
    georeference: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> Drawing:
    """Draws a view as strake.draw() does of the model in some files, by tiles of the paper: the same bytes.

    Args:
        files, scheduler, folder, memory, worker_threads, unit, up_axis, georeference, threads, progress: as in clash().
        view: as strake.draw() takes it.
        select: a selection, or several; None: all.
        options: what strake.draw() takes besides, but flush_seams=False, centre_lines, hatch, style and single_line; and
            keep_hidden=True, which finds lines that are hidden or clipped though they are not shown, as .json and .view have them.

    An object has its lines in one tile, which also has whatever may hide or cross these: what lies before it along the
    view. Hidden lines that were not asked for are found when the drawing is asked for them, by a second run with the same
    files and scheduler.

    Raises: what strake.draw() and clash() do.
    """
    if isinstance(select, np.ndarray):
        raise UsageError("an array needs a model that is held", "select", "give selections")
    request = draw_request(view, pick(select, 0, "select"), **options)
    read = _read_arguments(files, unit, up_axis, georeference)
    job = _Job(
        lambda most, work, run: _core.cut_drawing(*read, request, most, work, run),
        _core.write_drawing_tiles,
        draw_in_tile,
        _core.join_drawing_tiles,
    )
    where = _Where(scheduler, folder, memory, worker_threads, threads)
    core = where.run(job, progress)
    return Drawing(Model(core.model), request, core, lambda: where.run(job, None))


def _read_arguments(
    files: PathLike | Iterable[PathLike], unit: str | float | None, up_axis: str | None, georeference: bool
) -> tuple[list[Path], float | None, int | None, bool, Path]:
    given, unit_mm, axis, importers = read_arguments(files, unit, up_axis)
    for file in given:
        if _core.is_project(file):
            raise UsageError(f"{file} is a project, and tiles are cut of model files", "files", "give those that it was made of")
    return given, unit_mm, axis, truth(georeference, "georeference"), importers


class _Run(Generic[_CutT, _RunT]):
    """A run over tiles: what is lost is made again."""

    def __init__(
        self,
        job: _Job[_CutT, _RunT],
        cut: _CutT,
        folder: Path,
        runner: _Runner,
        worker_threads: int,
        options: _core.RunOptions,
    ) -> None:
        self._job = job
        self._cut = cut
        self._folder = folder
        self._runner = runner
        self._worker_threads = worker_threads
        self._options = options
        self._tries = [0] * len(cut.sizes)

    def _found(self, tile: int) -> Path:
        return self._folder / f"tile{tile:06}.found"

    def write(self, tiles: Iterable[int]) -> None:
        self._job.write(self._cut, self._folder, list(tiles), self._options)

    def find(self, tiles: Iterable[int]) -> None:
        """Has tiles tested, the largest first."""
        waiting = 0
        for tile in sorted(tiles, key=lambda k: -self._cut.sizes[k][1]):
            self._submit(tile)
            waiting += 1
        while waiting > 0:
            tile, error = self._runner.ended()
            waiting -= 1
            if error is None:
                continue
            if not _is_lost(error) or self._tries[tile] >= _MAX_TRIES:
                raise error
            self.write([tile])
            self._submit(tile)
            waiting += 1

    def _submit(self, tile: int) -> None:
        self._tries[tile] += 1
        name = f"strake-{self._folder.name}-tile{tile}-{self._tries[tile]}"
        self._runner.submit(self._job.task, tile, _core.tile_file(self._folder, tile), self._found(tile), self._worker_threads, name)

    def joined(self) -> _RunT:
        """Puts what was found together."""
        tiles = range(len(self._cut.sizes))
        while True:
            try:
                return self._job.join(self._cut, [self._found(tile) for tile in tiles], self._options)
            except InputError as error:
                tile = _tile_of(error)
                if tile is None or self._tries[tile] >= _MAX_TRIES:
                    raise
                self.find([tile])


def _is_lost(error: BaseException) -> bool:
    return isinstance(error, InputError) and error.message == _LOST


def _tile_of(error: InputError) -> int | None:
    """The tile whose results are lost."""
    named = re.search(r"tile(\d+)\.found$", error.where)
    return int(named[1]) if named and _is_lost(error) else None


@contextmanager
def _working_folder(folder: PathLike | None) -> Iterator[Path]:
    parent = None if folder is None else path(folder, "folder")
    try:
        if parent is not None:
            parent.mkdir(parents=True, exist_ok=True)
        work = Path(tempfile.mkdtemp(prefix="strake-", dir=parent)).resolve()
    except OSError as error:
        raise OutputError(f"no folder can be made there: {error.strerror}", str(parent or tempfile.gettempdir())) from error
    try:
        yield work
    finally:
        shutil.rmtree(work, ignore_errors=True)


@contextmanager
def _runner(scheduler: Any) -> Iterator[_Runner]:
    if scheduler is None:
        yield _InThisProcess()
        return
    if isinstance(scheduler, str):
        text(scheduler, "scheduler")
    elif not hasattr(scheduler, "submit") and not hasattr(scheduler, "scheduler_address"):
        raise UsageError(f"{shown(scheduler)} is none", "scheduler", "give a Dask client, a Dask cluster or an address")
    try:
        from distributed import Client
    except ImportError as error:
        raise ImportError("strake.cluster with a scheduler needs Dask: pip install 'strake[cluster]'") from error
    if isinstance(scheduler, Client):
        yield _OnDask(scheduler)
        return
    try:
        client = Client(scheduler)
    except (OSError, ValueError) as error:
        why = str(error) or type(error).__name__
        raise UsageError(f"no scheduler answers: {why}", "scheduler", "start one, and give its address as tcp://HOST:8786") from error
    with client:
        yield _OnDask(client)


def _bytes(memory: str | int) -> int:
    """What a worker may take. Raises: UsageError."""
    if isinstance(memory, str):
        written = re.fullmatch(r"\s*([0-9.]+)\s*([A-Za-z]*)\s*", memory)
        unit = _UNITS.get(written[2].upper()) if written else None
        if written is None or unit is None or written[1].count(".") > 1 or written[1] == ".":
            raise UsageError(f"{shown(memory)} is no amount of memory", "memory", "write one as '1GiB'")
        size = float(written[1]) * unit
    else:
        size = number(memory, "memory")
    if size < _MIN_MEMORY:
        raise UsageError(f"{shown(memory)} is too little for a worker", "memory", f"give {_MIN_MEMORY // 2**20}MiB or more")
    return int(min(size, _MAX_MEMORY))
