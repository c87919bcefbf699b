# SPDX-License-Identifier: Apache-2.0
"""Writes the neutral scene: glTF 2.0 binary with shared meshes, extras and matrices in doubles."""

from __future__ import annotations

import json
import math
import os
import shutil
import struct
import tempfile
from array import array
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import IO, Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from strake.importers.digest import blake2b
from strake.importers.shapes import Color, Part, PreparedPart, PreparedShape, Shape, around_middle, prepare_shape

Attributes = Mapping[str, Any]

_MAX_BYTES = 2**32 - 1
_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963
_FLOAT, _UNSIGNED_SHORT, _UNSIGNED_INT = 5126, 5123, 5125
# Files are made when there is more to write.
_MAX_IN_MEMORY = 4 << 20
_encode_any = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), allow_nan=False).encode
_encode_text = json.encoder.encode_basestring


class Group(NamedTuple):
    """A group of a scene: its number among the groups."""

    number: int


class SceneTooLarge(Exception):
    """The scene has more bytes than a GLB can have."""


class _Encoded(str):
    """Attributes as JSON already."""


def encoded(attributes: Attributes) -> Any:
    """Returns attributes that many objects share as a value that need not be written anew for each."""
    return _Encoded(_json(attributes))


class SceneWriter:
    """Writes one scene. What is added goes to temporary files, so that memory holds a few bytes of each object of a large one.

    Coordinates are in `unit_mm` millimetres, `up` is the axis that points up, `sag_mm` is how far at most triangles lie
    from the surfaces that they stand for, of shapes that do not say so themselves; None where that is not known. Bytes depend
    on what is added and in which order, on nothing else. The file appears when the `with` block ends without an exception.
    """

    def __init__(
        self, path: Path, unit_mm: float = 1.0, up: str = "z", generator: str = "Strake importer", sag_mm: float | None = None
    ) -> None:
        self._path = path
        self._unit_mm = unit_mm
        extras: dict[str, Any] = {"unit_mm": unit_mm, "up_axis": up}
        if sag_mm is not None:
            extras["sag_mm"] = sag_mm
        self._asset = {"version": "2.0", "generator": generator, "extras": extras}
        self._folder = tempfile.TemporaryDirectory(prefix=".strake-scene-", dir=path.parent)
        self._spools: dict[str, IO[bytes]] = {}
        for name in ("nodes", "meshes", "accessors", "positions", "wide", "narrow"):
            self._spools[name] = self._spool()
        self._counts = dict.fromkeys(self._spools, 0)
        self._pieces: dict[bytes, tuple[int, int]] = {}
        self._meshes: dict[bytes, int] = {}
        self._materials: dict[Color, int] = {}
        self._groups: list[tuple[str, int | None, str]] = []
        self._objects_of: dict[int | None, array[int]] = {None: array("Q")}

    def __enter__(self) -> SceneWriter:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        try:
            if kind is None:
                self._finish()
        finally:
            for spool in self._spools.values():
                spool.close()
            self._folder.cleanup()

    @property
    def object_count(self) -> int:
        """How many objects were added."""
        return self._counts["nodes"]

    @property
    def mesh_count(self) -> int:
        """How many different shapes they have."""
        return self._counts["meshes"]

    def group(self, name: str, parent: Group | None = None, attributes: Attributes | None = None) -> Group:
        """Adds a group. Objects inherit its attributes. A group without an object is not written."""
        number = len(self._groups)
        self._groups.append((name, None if parent is None else parent.number, _json(attributes or {})))
        self._objects_of[number] = array("Q")
        return Group(number)

    def shape(self, parts: Sequence[Part], sag_mm: float | None = None) -> Shape:
        """Adds a shape, or finds it where an equal one is there already. Raises ValueError as `prepare_shape` does."""
        return self.add_shape(prepare_shape(parts, self._unit_mm, sag_mm))

    def add_shape(self, shape: PreparedShape) -> Shape:
        """Adds a shape that `prepare_shape` made."""
        mesh = self._meshes.get(shape.key)
        if mesh is None:
            primitives = []
            for part in shape.parts:
                positions, indices = self._piece(part)
                primitives.append({"attributes": {"POSITION": positions}, "indices": indices, "material": self._material(part.color)})
            stated = {} if shape.sag_mm is None else {"extras": {"sag_mm": _whole(float(shape.sag_mm))}}
            mesh = self._add("meshes", {"primitives": primitives, **stated})
            self._meshes[shape.key] = mesh
        return Shape(mesh, shape.middle)

    def known_shape(self, key: bytes, middle: tuple[float, float, float]) -> Shape | None:
        """Returns the shape of that key, where it was added already."""
        mesh = self._meshes.get(key)
        return None if mesh is None else Shape(mesh, middle)

    def object(
        self,
        object_id: str,
        name: str,
        shape: Shape,
        placement: ArrayLike | None = None,
        parent: Group | None = None,
        attributes: Attributes | None = None,
    ) -> None:
        """Adds an object. `placement` is the 4x4 matrix, rows first, that takes the shape's frame to the scene.

        Raises ValueError where it is not finite or no affine transform.
        """
        matrix = _affine(placement)
        matrix = around_middle(matrix, shape.middle)
        node: dict[str, Any] = {"name": name, "mesh": shape.mesh}
        if not np.array_equal(matrix, np.eye(4)):
            node["matrix"] = [_whole(x) for x in matrix.T.ravel().tolist()]
        text = _json(node)[:-1] + ',"extras":{"id":' + _json(object_id)
        if attributes:
            text += ',"attributes":' + _json(attributes)
        number = self._add_text("nodes", text + "}}")
        self._objects_of[None if parent is None else parent.number].append(number)

    def _piece(self, part: PreparedPart) -> tuple[int, int]:
        key = blake2b(part.positions + b"|" + part.indices, digest_size=16).digest()
        known = self._pieces.get(key)
        if known is not None:
            return known
        wide = len(part.indices) == 4 * part.index_count
        indices = self._spools["wide" if wide else "narrow"]
        positions = {
            "bufferView": "positions",
            "byteOffset": self._spools["positions"].tell(),
            "componentType": _FLOAT,
            "count": part.vertex_count,
            "type": "VEC3",
            "min": [_whole(x) for x in part.low],
            "max": [_whole(x) for x in part.high],
        }
        corners = {
            "bufferView": "wide" if wide else "narrow",
            "byteOffset": indices.tell(),
            "componentType": _UNSIGNED_INT if wide else _UNSIGNED_SHORT,
            "count": part.index_count,
            "type": "SCALAR",
        }
        self._spools["positions"].write(part.positions)
        indices.write(part.indices)
        # Views are numbered when it is known which of them there are.
        numbers = self._add("accessors", positions), self._add("accessors", corners)
        self._pieces[key] = numbers
        return numbers

    def _material(self, color: Color) -> int:
        return self._materials.setdefault(color, len(self._materials))

    def _add(self, spool: str, value: Attributes) -> int:
        return self._add_text(spool, _json(value))

    def _add_text(self, spool: str, text: str) -> int:
        file = self._spools[spool]
        if self._counts[spool]:
            file.write(b",")
        file.write(text.encode("utf-8", "replace"))
        self._counts[spool] += 1
        return self._counts[spool] - 1

    def _write_groups(self) -> list[int]:
        """Writes the groups that have something in them behind the objects; returns the nodes at the top."""
        filled = [len(self._objects_of[number]) > 0 for number in range(len(self._groups))]
        for number in reversed(range(len(self._groups))):
            parent = self._groups[number][1]
            if filled[number] and parent is not None:
                filled[parent] = True
        nodes: dict[int, int] = {}
        for number in range(len(self._groups)):
            if filled[number]:
                nodes[number] = self._counts["nodes"] + len(nodes)
        groups_of: dict[int | None, list[int]] = {}
        for number, node in nodes.items():
            groups_of.setdefault(self._groups[number][1], []).append(node)
        for number in nodes:
            name, _, attributes = self._groups[number]
            children = groups_of.get(number, []) + self._objects_of[number].tolist()
            extras = "" if attributes == "{}" else f',"extras":{{"attributes":{attributes}}}'
            self._add_text("nodes", f'{{"name":{_json(name)},"children":{_json(children)}{extras}}}')
        return groups_of.get(None, []) + self._objects_of[None].tolist()

    def _finish(self) -> None:
        roots = self._write_groups()
        views: list[dict[str, int]] = []
        offset = 0
        for name, target in (
            ("positions", _ARRAY_BUFFER),
            ("wide", _ELEMENT_ARRAY_BUFFER),
            ("narrow", _ELEMENT_ARRAY_BUFFER),
        ):
            size = self._spools[name].tell()
            if size == 0:
                continue
            view = {"buffer": 0, "byteOffset": offset, "byteLength": size, "target": target}
            if name == "positions":
                view["byteStride"] = 12
            self._number_view(name, len(views))
            views.append(view)
            offset += size
        padding = -offset % 4
        with self._spool() as text:
            self._write_json(text, roots, views, offset + padding)
            text.write(b" " * (-text.tell() % 4))
            self._assemble(text, offset, padding)

    def _spool(self) -> IO[bytes]:
        """Returns a file that is in memory until it is large."""
        return cast(IO[bytes], tempfile.SpooledTemporaryFile(_MAX_IN_MEMORY, dir=self._folder.name))

    def _number_view(self, name: str, number: int) -> None:
        """Remembers which number the view of that name has."""
        self._counts["view " + name] = number

    def _write_json(self, out: IO[bytes], roots: Sequence[int], views: Sequence[Attributes], size: int) -> None:
        scene: dict[str, Any] = {"name": "model"}
        if roots:
            scene["nodes"] = list(roots)
        out.write(f'{{"asset":{_json(self._asset)},"scene":0,"scenes":[{_json(scene)}]'.encode())
        if self._counts["nodes"]:
            self._copy_list(out, "nodes")
        if views:
            self._copy_list(out, "meshes")
            out.write(f',"materials":[{",".join(_json(_material(c)) for c in self._materials)}]'.encode())
            self._copy_accessors(out)
            out.write(f',"bufferViews":{_json(views)},"buffers":[{{"byteLength":{size}}}]'.encode())
        out.write(b"}\n")

    def _copy_list(self, out: IO[bytes], spool: str) -> None:
        out.write(f',"{spool}":['.encode())
        self._spools[spool].seek(0)
        shutil.copyfileobj(self._spools[spool], out)
        out.write(b"]")

    def _copy_accessors(self, out: IO[bytes]) -> None:
        out.write(b',"accessors":[')
        spool = self._spools["accessors"]
        spool.seek(0)
        names = [(f'"{name}"'.encode(), str(self._counts.get("view " + name, 0)).encode()) for name in ("positions", "wide", "narrow")]
        carried = b""
        while block := spool.read(1 << 20):
            block = carried + block
            cut = block.rfind(b"}") + 1
            block, carried = block[:cut], block[cut:]
            for name, number in names:
                block = block.replace(name, number)
            out.write(block)
        out.write(carried + b"]")

    def _assemble(self, text: IO[bytes], size: int, padding: int) -> None:
        length = text.tell()
        binary = size + padding
        total = 12 + 8 + length + (8 + binary if binary else 0)
        if total > _MAX_BYTES:
            raise SceneTooLarge(f"the scene has {total} bytes, and a GLB at most {_MAX_BYTES}")
        part = Path(self._folder.name) / "scene"
        with part.open("wb") as out:
            out.write(struct.pack("<4sII", b"glTF", 2, total))
            out.write(struct.pack("<I4s", length, b"JSON"))
            text.seek(0)
            shutil.copyfileobj(text, out)
            if binary:
                out.write(struct.pack("<I4s", binary, b"BIN\0"))
                for name in ("positions", "wide", "narrow"):
                    self._spools[name].seek(0)
                    shutil.copyfileobj(self._spools[name], out)
                out.write(b"\0" * padding)
        os.replace(part, self._path)


def _affine(placement: ArrayLike | None) -> NDArray[np.float64]:
    matrix: NDArray[np.float64] = np.eye(4) if placement is None else np.array(placement, dtype=np.float64).reshape(4, 4)
    if not np.isfinite(matrix).all():
        raise ValueError("a placement is not finite")
    if not np.array_equal(matrix[3], (0, 0, 0, 1)):
        raise ValueError("the last row of a placement must be 0, 0, 0, 1")
    return matrix


def _whole(number: float) -> float | int:
    """Returns the number so that it is written shortly: 1 and not 1.0, 0 and not -0.0."""
    return int(number) if number.is_integer() and abs(number) < 1e15 else number


def _linear(share: float) -> float:
    share = min(max(share, 0.0), 1.0)
    return round(share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4, 6)


def _material(color: Color) -> dict[str, Any]:
    red, green, blue, alpha = color
    material: dict[str, Any] = {
        "pbrMetallicRoughness": {
            "baseColorFactor": [_linear(red), _linear(green), _linear(blue), round(min(max(alpha, 0.0), 1.0), 6)],
            "metallicFactor": 0,
            "roughnessFactor": 0.8,
        },
        "doubleSided": True,
    }
    if alpha < 1:
        material["alphaMode"] = "BLEND"
    return material


def _json(value: Any) -> str:
    """Writes short values, which most are, itself: json.dumps makes an encoder for each."""
    kind = type(value)
    if kind is _Encoded:
        return str(value)
    if kind is str:
        return _encode_text(value)
    if kind is int or (kind is float and math.isfinite(value)):
        return repr(value)
    if kind is dict and all(type(key) is str for key in value):
        return "{" + ",".join([f"{_encode_text(key)}:{_json(one)}" for key, one in value.items()]) + "}"
    return _encode_any(value)
