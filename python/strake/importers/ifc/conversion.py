# SPDX-License-Identifier: Apache-2.0
"""All products through the kernels: what one cannot do, the next one tries."""

from __future__ import annotations

import pickle
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, NamedTuple

import numpy as np
from ifcopenshell import ifcopenshell_wrapper
from numpy.typing import NDArray

from strake.importers.ifc.chunks import EMPTY, Again, Chunk, Converted, Remark, convert_chunk
from strake.importers.ifc.ends import Convert, Ended, is_tried_again
from strake.importers.ifc.entity import Entity, Model, number_of
from strake.importers.ifc.here import Here
from strake.importers.ifc.kernels import CUT, EXACT, FAST, SAG_M, geometry_settings, has_body, kernels_for, shapes_of
from strake.importers.ifc.products import CircleFinder
from strake.importers.ifc.solids import manifold3d_files
from strake.importers.ifc.spatial import Parents
from strake.importers.report import Report
from strake.importers.shapes import PreparedShape
from strake.importers.supervision import Attempt

if TYPE_CHECKING:
    from strake.importers.ifc.workers import Workers

# Products of one shape stay together, so that it is made once. How many chunks there are depends on the file alone,
# never on the number of cores: each costs a look at all products.
_MIN_IN_CHUNK = 16
_MAX_CHUNKS = 256
# So many tasks at most are done by this process itself: alone, or where there are others.
_MAX_HERE, _MAX_BESIDE_OTHERS = 2000, 32
# Memory that shapes may have before they go to disk.
_MAX_HELD_BYTES = 64 << 20


class Placed(NamedTuple):
    """The shape of a product and where it is, in millimetres."""

    key: bytes
    middle: tuple[float, float, float]
    placement: bytes
    kernel: str

    def matrix(self) -> NDArray[np.float64]:
        """Returns the 4x4 matrix, rows first."""
        return np.frombuffer(self.placement, dtype=np.float64).reshape(4, 4)


class ShapeStore:
    """Shapes until the scene is written in its order: small ones as they are, so far as there are few, the others on disk."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._file: IO[bytes] | None = None
        self._places: dict[bytes, tuple[int, int]] = {}
        self._held: dict[bytes, PreparedShape] = {}
        self._held_bytes = 0

    def add(self, shape: PreparedShape) -> None:
        """Keeps a shape, if there is no equal one."""
        if shape.key in self._held or shape.key in self._places:
            return
        size = sum(len(part.positions) + len(part.indices) for part in shape.parts)
        if self._held_bytes + size <= _MAX_HELD_BYTES:
            self._held[shape.key] = shape
            self._held_bytes += size
            return
        if self._file is None:
            self._file = tempfile.TemporaryFile(dir=self._folder)
        data = pickle.dumps(shape, pickle.HIGHEST_PROTOCOL)
        self._file.seek(0, 2)
        self._places[shape.key] = (self._file.tell(), len(data))
        self._file.write(data)

    def get(self, key: bytes) -> PreparedShape:
        """Returns a shape that was added."""
        if key in self._held:
            return self._held[key]
        assert self._file is not None
        offset, size = self._places[key]
        self._file.seek(offset)
        shape = pickle.loads(self._file.read(size))
        assert isinstance(shape, PreparedShape)
        return shape


@dataclass
class Conversion:
    """What became of the products, by number."""

    shapes: ShapeStore
    placed: dict[int, Placed] = field(default_factory=dict)
    failed: dict[int, str] = field(default_factory=dict)
    empty: set[int] = field(default_factory=set)  # of those that failed: all kernels find that nothing is left
    remarks: dict[int, list[tuple[str, str]]] = field(default_factory=dict)
    bodyless: list[int] = field(default_factory=list)
    slow_cuts: int = 0  # products that manifold3d would cut, if it were installed
    made_by: object = None  # it may hold what need not be taken apart

    def remarks_of(self, number: int) -> list[str]:
        """Returns the faults that the kernel found which made the shape; where none did, those of all."""
        placed = self.placed.get(number)
        found = {text for kernel, text in self.remarks.get(number, ()) if placed is None or placed.kernel == kernel}
        return sorted(found)


def tasks_of(model: Model, products: Sequence[Entity]) -> list[tuple[int, ...]]:
    """Returns the products that have a body, by number; those of one shape are together."""
    settings = geometry_settings()
    settings.set("defer-processing-first-element", True)
    iterator = shapes_of(model, map(number_of, products), settings, EXACT, ifcopenshell_wrapper.logger())
    iterator.initialize()
    # The wrapper in Python of this function requests a file that the iterator does not have.
    get_task_products: Any = ifcopenshell_wrapper.iterator.get_task_products
    return sorted(tuple(sorted(product.id() for product in task)) for task in get_task_products(iterator))


def chunks_of(tasks: Sequence[tuple[int, ...]], kernels_of: Mapping[int, tuple[str, ...]]) -> list[Chunk]:
    """Returns the chunks, in the order of the file; each is for one kernel."""
    by_kernel: dict[str, list[tuple[int, ...]]] = {}
    for task in tasks:
        by_kernel.setdefault(kernels_of[task[0]][0], []).append(task)
    most = max(_MIN_IN_CHUNK, len(tasks) // _MAX_CHUNKS)
    chunks = []
    for kernel, numbers in sorted(by_kernel.items()):
        for first in range(0, len(numbers), most):
            chunks.append(Chunk(sum(numbers[first : first + most], ()), kernel))
    return sorted(chunks, key=lambda chunk: chunk.products[0])


def convert_products(
    model: Model,
    products: Sequence[Entity],
    threads: int,
    report: Report,
    folder: Path,
    sag_m: float = SAG_M,
    attempt: Attempt | None = None,
    parents: Parents | None = None,
) -> Conversion:
    """Converts the products, with chords no farther from their curves than `sag_m`. None can harm another, or the import."""
    result = Conversion(ShapeStore(folder))
    circles = CircleFinder(parents or Parents())
    faults = {product.id(): fault for product in products if (fault := circles.fault_of(product))}
    result.failed.update(faults)
    products = [product for product in products if product.id() not in faults]
    try:
        tasks = tasks_of(model, products) if products else []
    except RuntimeError as fault:  # what stands for all products is none, as the units of the project
        report.fail(f"IfcOpenShell makes no shapes of it: {fault}", "export the model as IFC (STEP) again")
    cutting = bool(manifold3d_files())
    kernels_of = {number: kernels for task in tasks for kernels in [kernels_for(model.by_id(task[0]), cutting)] for number in task}
    if not cutting:
        result.slow_cuts = sum(kernels_for(model.by_id(number), True)[0] == CUT for number in kernels_of)
    result.bodyless = [product.id() for product in products if product.id() not in kernels_of]
    convert = partial(convert_chunk, sag_m=sag_m)
    few = len(tasks) <= (_MAX_HERE if threads == 1 else _MAX_BESIDE_OTHERS)
    here = attempt if few and attempt is not None and not attempt.is_careful else None
    with _workers(model, threads, convert) if here is None else Here(model, here, convert) as workers:
        result.made_by = workers
        for chunk in chunks_of(tasks, kernels_of):
            workers.add(chunk)
        for event in workers.answers():
            if isinstance(event, Converted):
                _keep(event, result)
                report.progress(len(result.placed) / len(kernels_of))
            elif isinstance(event, Remark):
                result.remarks.setdefault(event.product, []).append((event.kernel, event.message))
            elif isinstance(event, Again):
                for number in event.products:
                    result.placed.pop(number, None)
            elif isinstance(event, Ended):
                _go_on(event, kernels_of, workers, result)
            else:
                report.alive()
    for product in products:
        if product.id() in result.failed and not has_body(product):
            del result.failed[product.id()]
            result.bodyless.append(product.id())
    return result


def _workers(model: Model, threads: int, convert: Convert) -> Workers:
    # They need several modules that small files do without.
    from strake.importers.ifc.workers import Workers

    return Workers(model, threads, convert=convert)


def _keep(event: Converted, result: Conversion) -> None:
    if event.fault:
        # Workers count it among those without a shape, so that the next kernel tries.
        result.remarks.setdefault(event.product, []).append((event.kernel, event.fault))
        return
    if event.shape is not None:
        result.shapes.add(event.shape)
    result.placed[event.product] = Placed(event.key, event.middle, event.placement, event.kernel)


def _go_on(ended: Ended, kernels_of: dict[int, tuple[str, ...]], workers: Workers | Here, result: Conversion) -> None:
    """Sends what a chunk left behind on: to the next kernel, or after a crash apart from the product that it was at."""
    chunk, missing = ended.chunk, ended.missing
    if ended.fault and missing and is_tried_again(chunk) and not (ended.hung and chunk.kernel == CUT):
        workers.add(Chunk(missing, chunk.kernel, chunk.attempt, watched=True))
        return
    if ended.fault and len(chunk.products) > 1 and missing:
        # Products are converted in their order, so that the first one that is missing is to be suspected.
        # But for cuts, before which all bodies are made: any may have hung.
        suspect, rest = (missing, ()) if ended.hung and chunk.kernel == CUT else (missing[:1], missing[1:])
        if rest:
            workers.add(Chunk(rest, chunk.kernel, chunk.attempt, chunk.watched))
        if not ended.hung:
            workers.add(Chunk(suspect, chunk.kernel, chunk.attempt, chunk.watched))
            return
        missing = suspect  # what hung for so long does not get the same again
    onward: dict[str, list[int]] = {}
    for number in missing:
        kernel_remarks = result.remarks.setdefault(number, [])
        if ended.fault or not any(kernel == chunk.kernel for kernel, _ in kernel_remarks):
            kernel_remarks.append((chunk.kernel, ended.fault or "no shape"))
        following = kernels_of[number][chunk.attempt + 1 :]
        if following:
            onward.setdefault(following[0], []).append(number)
        else:
            _fail(number, result)
    if chunk.kernel == FAST and chunk.attempt == 0 and not ended.fault:
        # Where it says that something went wrong the exact one may do better.
        shapes = {result.placed[number].key for number in chunk.products if number in result.placed and result.remarks_of(number)}
        doubtful = [number for number in chunk.products if number in result.placed and result.placed[number].key in shapes]
        for number in doubtful:
            del result.placed[number]
        onward.setdefault(EXACT, []).extend(doubtful)
    for kernel, numbers in onward.items():
        # They stay together, since they may share shapes.
        if numbers:
            workers.add(Chunk(tuple(sorted(numbers)), kernel, chunk.attempt + 1))


def _fail(number: int, result: Conversion) -> None:
    kernel_remarks = result.remarks[number]
    # A kernel says the same thing several times, each time with more around it.
    longest = dict(sorted(kernel_remarks, key=lambda remark: len(remark[1])))
    result.failed[number] = "; ".join(f"{kernel}: {longest[kernel]}" for kernel in dict.fromkeys(k for k, _ in kernel_remarks))
    # What manifold3d does not cut says nothing of what is left.
    if all(text == EMPTY for kernel, text in kernel_remarks if kernel != CUT):
        result.empty.add(number)
