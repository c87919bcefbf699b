# SPDX-License-Identifier: Apache-2.0
"""Converts some products; runs in a worker process, which may crash of it."""

from __future__ import annotations

import math
import re
import struct
import time
from collections.abc import Iterator, Sequence, Set
from typing import Any, NamedTuple

import numpy as np
from ifcopenshell import ifcopenshell_wrapper
from numpy.typing import NDArray

from strake.importers.ifc.cuts import cut_products
from strake.importers.ifc.entity import Entity, Model
from strake.importers.ifc.faces import Faces, faces_of
from strake.importers.ifc.kernels import CUT, FAST, SAG_M, geometry_settings, shapes_of
from strake.importers.ifc.pinched import outlines_of, split_face
from strake.importers.ifc.solids import Mesh
from strake.importers.shapes import NO_COLOR, Color, Part, PreparedShape, prepare_shapes

# The fault of a shape without a triangle.
EMPTY = "nothing is left of it"
# What IfcOpenShell says of a face that it leaves out; the instance of the message is the face.
_FACE_LEFT_OUT = "Failed to convert face"
_MM_PER_M = 1000.0
# Answers come together that come within so many seconds: each by itself takes time of both who gives and who gets it.
_TOGETHER_S = 0.05
_MAX_TRIANGLES = 50_000
_MAX_KEPT_TRIANGLES = 300_000


class Chunk(NamedTuple):
    """Products by number, which are converted in one go by one kernel.

    `watched`: each is answered at once, so that after a crash it is known at which the kernel was.
    """

    products: tuple[int, ...]
    kernel: str
    attempt: int = 0
    watched: bool = False


class Converted(NamedTuple):
    """What became of one product. `shape` is there once for each shape of a chunk, `placement` are 16 doubles, rows first."""

    product: int
    key: bytes
    middle: tuple[float, float, float]
    placement: bytes
    shape: PreparedShape | None
    kernel: str
    fault: str = ""


class Remark(NamedTuple):
    """A fault that IfcOpenShell found of a product; product 0: of the chunk."""

    product: int
    kernel: str
    message: str


class Again(NamedTuple):
    """These products are converted once more: what became of them before does not count."""

    products: tuple[int, ...]


Answer = Converted | Remark | Again


def convert_chunk(model: Model, chunk: Chunk, sag_m: float = SAG_M, batch: Batch | None = None) -> Iterator[list[Answer]]:
    """Yields what becomes of each product that gets a shape, then what is to be said of any; the last that is said of one
    counts. Answers come together, but for those of a chunk that is watched, and where they would be long in coming.

    Products may stay in a batch that is given, and are answered when it is taken. Raises whatever IfcOpenShell raises, and may end the
    process.
    """
    log: Any = ifcopenshell_wrapper.logger()
    log.output_format(log.FMT_INMEMORY)
    last = batch is None
    batch = batch or Batch()
    try:
        yield from (_cut if chunk.kernel == CUT else _made)(model, chunk, sag_m, log, batch)
    except Exception:
        # What was made before stays.
        yield [*batch.take()]
        raise
    if last:
        yield [*batch.take()]


def _made(model: Model, chunk: Chunk, sag_m: float, log: Any, batch: Batch) -> Iterator[list[Answer]]:
    pinched = {number: model.pinched[number] for number in chunk.products if number in model.pinched} if chunk.kernel == FAST else {}
    if not pinched:
        yield from _made_twice(model, chunk, sag_m, log, batch)
        return
    before = [one for face in sorted(set().union(*pinched.values())) for one in split_face(model, face, outlines_of(model, face))]
    for converted in _converted_by(model, chunk, sag_m, log, batch):
        yield [*converted]
    remarks = list(_remarks(log, chunk))
    if not any(remark.product in pinched for remark in remarks):
        yield [*batch.take(), *remarks]
        return
    # More is wrong with one of them: as if nothing had been known.
    for owner, faces in reversed(before):
        owner.CfsFaces = faces
    model.pinched = {}
    log.clear()
    yield [*batch.take(), Again(chunk.products)]
    yield from _made_twice(model, chunk, sag_m, log, batch)


def _made_twice(model: Model, chunk: Chunk, sag_m: float, log: Any, batch: Batch) -> Iterator[list[Answer]]:
    """Converts a chunk, and once more what has faces that were left out and could be split."""
    keys: dict[int, bytes] = {}
    for converted in _converted_by(model, chunk, sag_m, log, batch):
        keys.update((one.product, one.key) for one in converted)
        yield [*converted]
    remarks = list(_remarks(log, chunk))
    if not remarks:
        return
    converted = batch.take()
    keys.update((one.product, one.key) for one in converted)
    mended = _mended(model, log, {remark.product for remark in remarks})
    yield [*converted, *(remark for remark in remarks if remark.product not in mended)]
    if mended:
        # What is said of a shape is said of the first that has it.
        shapes = {keys[product] for product in mended if keys.get(product)}
        again = mended | {product for product, key in keys.items() if key in shapes}
        log.clear()
        rest = Chunk(tuple(sorted(again)), chunk.kernel, chunk.attempt, chunk.watched)
        yield [Again(rest.products)]
        for converted in _converted_by(model, rest, sag_m, log, batch):
            yield [*converted]
        yield [*batch.take(), *_remarks(log, rest)]


class Batch:
    """Products that have a shape of a kernel, until they are answered together."""

    def __init__(self, together_s: float = _TOGETHER_S, keeps: bool = False) -> None:
        self._together_s = together_s
        self._began = time.monotonic()
        self._products: list[tuple[int, str, bytes, str]] = []
        self._new: dict[str, tuple[Sequence[Part], float | None]] = {}
        self._known: dict[str, tuple[bytes, tuple[float, float, float]] | str] = {}
        self._triangles = 0
        self._number = 0
        # Calls of kernels of which it is not worth the time to take apart what they hold, for a process that ends soon.
        self._keeps = keeps
        self._kept: list[Any] = []
        self._kept_triangles = 0

    def keep(self, iterator: Any) -> None:
        """Has what a kernel holds taken apart later: not at all, where the process ends before, and there is little of it."""
        if self._keeps and self._kept_triangles < _MAX_KEPT_TRIANGLES:
            self._kept.append(iterator)

    def next_number(self) -> int:
        """Returns a number that no other call gets."""
        self._number += 1
        return self._number

    def has(self, name: str) -> bool:
        """Whether there is a shape of that name."""
        return name in self._new or name in self._known

    def add_shape(self, name: str, parts: Sequence[Part], sag_mm: float | None) -> None:
        """Adds a shape; one without a triangle is none."""
        if parts:
            self._new[name] = parts, sag_mm
            count = sum(np.size(part.triangles) // 3 for part in parts)
            self._triangles += count
            self._kept_triangles += count
        else:
            self._known[name] = EMPTY

    def add(self, product: int, name: str, placement: bytes, kernel: str) -> None:
        """Adds a product of a shape; without a placement it has none that is finite."""
        self._products.append((product, name, placement, kernel))

    def is_due(self) -> bool:
        """Whether those who wait should get what there is."""
        return self._triangles > _MAX_TRIANGLES or time.monotonic() - self._began > self._together_s

    def take(self) -> list[Converted]:
        """Returns what becomes of the products, and begins anew."""
        shapes = dict(zip(self._new, prepare_shapes([*self._new.values()]), strict=True))
        for name, made in shapes.items():
            self._known[name] = str(made) if isinstance(made, ValueError) else (made.key, made.middle)
        answers = []
        for product, name, placement, kernel in self._products:
            known = self._known[name]
            if isinstance(known, str) or not placement:
                fault = known if isinstance(known, str) else "its placement is not finite"
                answers.append(Converted(product, b"", (0, 0, 0), b"", None, kernel, fault))
                continue
            sent = shapes.pop(name, None)
            new = sent if isinstance(sent, PreparedShape) else None
            answers.append(Converted(product, *known, placement, new, kernel))
        # A shape of which no product is placed yet comes with the first that is.
        self._new = {name: self._new[name] for name, made in shapes.items() if isinstance(made, PreparedShape)}
        self._products = []
        self._triangles = 0
        self._began = time.monotonic()
        return answers


def _converted_by(model: Model, chunk: Chunk, sag_m: float, log: Any, batch: Batch) -> Iterator[list[Converted]]:
    iterator = shapes_of(model, chunk.products, geometry_settings(sag_m), chunk.kernel, log)
    # Names of shapes are those of this iterator.
    own = f"{batch.next_number()} "
    going = iterator.initialize()
    while going:
        element = iterator.get()
        name, product = own + element.geometry.id, element.id
        if not batch.has(name):
            batch.add_shape(name, _parts(element.geometry), _sag_mm(model.by_id(product), sag_m))
        batch.add(product, name, _placement(element.transformation.matrix), chunk.kernel)
        if chunk.watched or batch.is_due():
            yield batch.take()
        going = bool(iterator.next())
    batch.keep(iterator)


def _cut(model: Model, chunk: Chunk, sag_m: float, log: Any, batch: Batch) -> Iterator[list[Answer]]:
    for cut in cut_products(model, chunk.products, sag_m, log, _color):
        fault = cut.fault or (EMPTY if not cut.pieces else "")
        if fault:
            yield [Converted(cut.product, b"", (0, 0, 0), b"", None, chunk.kernel, fault)]
            continue
        name = f"cut {cut.product}"
        batch.add_shape(name, _parts_of_pieces(cut.pieces), _sag_mm(model.by_id(cut.product), sag_m))
        batch.add(cut.product, name, _placement(cut.placement.T.ravel().tolist()), chunk.kernel)
        if chunk.watched or batch.is_due():
            yield [*batch.take()]


def _placement(matrix: Sequence[float]) -> bytes:
    """Returns a matrix of the kernel, column by column and in metres, as answers have it; nothing where it is not finite."""
    if not all(map(math.isfinite, matrix)):
        return b""
    rows = [matrix[4 * column + row] for row in range(4) for column in range(4)]
    for at in (3, 7, 11):
        rows[at] *= _MM_PER_M
    return struct.pack("=16d", *rows)


def _parts_of_pieces(pieces: Sequence[tuple[Mesh, Color]]) -> list[Part]:
    """Returns the triangles of each colour."""
    parts = []
    for color in dict.fromkeys(color for _, color in pieces):
        meshes = [mesh for mesh, worn in pieces if worn == color]
        first = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
        triangles = [mesh.triangles + before for mesh, before in zip(meshes, first, strict=False)]
        parts.append(Part(np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(triangles), color))
    return parts


def _mended(model: Model, log: Any, doubtful: Set[int]) -> set[int]:
    """Splits the faces that the kernel left out of these products; returns the products of which all could be split."""
    faces_of_product: dict[int, set[int]] = {}
    parts_of: dict[int, list[list[int]]] = {}
    for message in log.log_messages():
        product, face = (re.match(r"#(\d+)=", text) for text in (message.product, message.instance))
        if product is None or face is None or int(product[1]) not in doubtful or not message.message.startswith(_FACE_LEFT_OUT):
            continue
        number = int(face[1])
        if number not in parts_of:
            parts_of[number] = outlines_of(model, number)
        faces_of_product.setdefault(int(product[1]), set()).add(number)
    # Faces of others stay as they are: another kernel may get these products from another process.
    mended = {number for number, faces in faces_of_product.items() if all(parts_of[face] for face in faces)}
    for face_number in sorted({face for number in mended for face in faces_of_product[number]}):
        split_face(model, face_number, parts_of[face_number])
    return mended


def _sag_mm(product: Entity, sag_m: float) -> float | None:
    """Returns how far the triangles are from the surfaces at most: what the kernel was asked for where any is curved."""
    try:
        faces = faces_of(product)
    except (AttributeError, RuntimeError):
        return None  # something that its body must have is not there
    return {Faces.FLAT: 0.0, Faces.CURVED: sag_m * _MM_PER_M, Faces.FACETS: None}[faces]


def _parts(geometry: Any) -> Sequence[Part]:
    """Returns the triangles of each style; nothing where there are none."""
    if len(geometry.faces_buffer) == 0:
        return []
    vertices: NDArray[np.float64] = np.frombuffer(geometry.verts_buffer, dtype=np.float64).reshape(-1, 3) * _MM_PER_M
    triangles: NDArray[np.int64] = np.frombuffer(geometry.faces_buffer, dtype=np.int32).reshape(-1, 3).astype(np.int64)
    styles: NDArray[np.int32] = np.frombuffer(geometry.material_ids_buffer, dtype=np.int32)
    colors = [_color(material) for material in geometry.materials]
    if len(styles) != len(triangles) or not colors:
        return [Part(vertices, triangles)]
    by_color: dict[Color, list[int]] = {}
    for style in sorted(set(styles.tolist())):
        color = colors[style] if 0 <= style < len(colors) else NO_COLOR
        by_color.setdefault(color, []).append(style)
    if len(by_color) == 1:
        return [Part(vertices, triangles, next(iter(by_color)))]
    return [Part(vertices, triangles[np.isin(styles, numbers)], color) for color, numbers in by_color.items()]


def _color(style: Any) -> Color:
    red, green, blue = (round(min(max(float(x), 0.0), 1.0), 4) for x in style.diffuse.components)
    clear = float(style.transparency) if style.has_transparency() else 0.0
    alpha = 1.0 if math.isnan(clear) else round(1.0 - min(max(clear, 0.0), 1.0), 4)
    # What cannot be seen at all is a body all the same.
    return (red, green, blue, max(alpha, 0.05))


def _remarks(log: Any, chunk: Chunk) -> Iterator[Remark]:
    for message in log.log_messages():
        if message.severity_string != "ERROR":
            continue
        text = " ".join(message.message.split())
        # Some messages name their product as the instance they are about.
        named = [int(number) for number in re.findall(r"#(\d+)=", f"{message.product} {message.instance}")]
        about = [number for number in named if number in chunk.products]
        if not about and len(chunk.products) == 1:
            about = [chunk.products[0]]
        if about:
            yield Remark(about[0], chunk.kernel, text.removesuffix(" Failed to convert:"))
