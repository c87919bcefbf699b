# SPDX-License-Identifier: Apache-2.0
"""Reads a GLB as a test needs it."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray


class Glb:
    """A scene: its objects by id, with their world corners in millimetres."""

    def __init__(self, path: Path) -> None:
        data = path.read_bytes()
        magic, version, total = struct.unpack_from("<4sII", data)
        assert (magic, version, total) == (b"glTF", 2, len(data))
        length = struct.unpack_from("<I", data, 12)[0]
        self.json: dict[str, Any] = json.loads(data[20 : 20 + length])
        self.binary = data[28 + length :]
        self.nodes: list[dict[str, Any]] = self.json.get("nodes", [])
        self.parent_of = {child: i for i, node in enumerate(self.nodes) for child in node.get("children", ())}
        self.number_of = {node["extras"]["id"]: i for i, node in enumerate(self.nodes) if "mesh" in node}

    @property
    def ids(self) -> list[str]:
        """The ids of the objects in their order."""
        return list(self.number_of)

    def node(self, object_id: str) -> dict[str, Any]:
        """Returns the node of an object."""
        return self.nodes[self.number_of[object_id]]

    def attributes(self, object_id: str) -> dict[str, Any]:
        """Returns what an object states itself."""
        found: dict[str, Any] = self.node(object_id)["extras"].get("attributes", {})
        return found

    def path(self, object_id: str) -> list[str]:
        """Returns the names of the groups above an object, the highest first."""
        names = []
        at = self.number_of[object_id]
        while at in self.parent_of:
            at = self.parent_of[at]
            names.append(self.nodes[at]["name"])
        return names[::-1]

    def accessor(self, number: int) -> NDArray[Any]:
        """Returns the numbers of an accessor, a row for each element."""
        accessor = self.json["accessors"][number]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind = {5126: "<f4", 5123: "<u2", 5125: "<u4"}[accessor["componentType"]]
        width = {"VEC3": 3, "SCALAR": 1}[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return np.frombuffer(self.binary, kind, accessor["count"] * width, start).reshape(-1, width)

    def triangles(self, object_id: str) -> NDArray[np.float64]:
        """Returns the triangles of an object in the scene: n rows of three corners."""
        node = self.node(object_id)
        matrix = np.array(node.get("matrix", np.eye(4).ravel())).reshape(4, 4).T
        result = []
        for part in self.json["meshes"][node["mesh"]]["primitives"]:
            corners = self.accessor(part["attributes"]["POSITION"]).astype(np.float64)
            corners = corners @ matrix[:3, :3].T + matrix[:3, 3]
            result.append(corners[self.accessor(part["indices"]).ravel().reshape(-1, 3)])
        return np.concatenate(result)

    def box(self, object_id: str) -> tuple[list[float], list[float]]:
        """Returns the lowest and the highest corner of an object."""
        corners = self.triangles(object_id).reshape(-1, 3)
        return corners.min(axis=0).tolist(), corners.max(axis=0).tolist()

    def volume(self, object_id: str) -> float:
        """Returns the volume that the triangles of an object enclose."""
        triangles = self.triangles(object_id)
        triangles = triangles - triangles.reshape(-1, 3).mean(axis=0)
        return abs(float(np.einsum("ij,ij->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6))
