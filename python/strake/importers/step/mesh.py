# SPDX-License-Identifier: Apache-2.0
"""Triangles of a shape whose faces share the points of their common edges, so that solids are closed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.GeomAbs import GeomAbs_CurveType, GeomAbs_SurfaceType
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS
from OCP.TopTools import TopTools_IndexedMapOfShape

from strake.importers.step.pieces import found, has_surface

# No farther from the true surface than this, or than such a part of the diagonal of what is smaller than 200 mm.
SAG_MM = 0.1
_SHARE_OF_DIAGONAL = 1 / 2000
_LARGEST_TURN = 0.5


@dataclass(frozen=True)
class Mesh:
    """Triangles, the number of the face that each is of, and how exact they are: None is not known."""

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    faces: NDArray[np.int64]
    faces_without: int
    is_closed: bool
    sag_mm: float | None


def mesh_of(shape: Any, sag_mm: float | None) -> Mesh:
    """Returns the triangles of a shape; `sag_mm` is how far they may lie from it, None for the usual."""
    faces = found(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    is_known = all(has_surface(face) for face in faces)
    is_exact = is_known and _is_flat(shape)
    sag = _sag_of(shape) if sag_mm is None else sag_mm
    # Open CASCADE makes some faces, as whole balls, twice as coarse as requested.
    BRepMesh_IncrementalMesh(shape, sag / 2, False, _LARGEST_TURN, True)
    collected = _Collector()
    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        collected.add(TopoDS.Face_s(explorer.Current()))
        explorer.Next()
    return collected.mesh((0.0 if is_exact else sag) if is_known else None)


class _Collector:
    """Points and triangles of faces. Points on a common edge, and those of a common vertex, become one.

    Faces without surfaces have no edges: of these, points with the same coordinates become one.
    """

    def __init__(self) -> None:
        self._points: list[tuple[float, float, float]] = []
        self._triangles: list[tuple[int, int, int]] = []
        self._faces: list[int] = []
        self._face_count = 0
        self._without = 0
        self._same: list[int] = []
        self._edges, self._vertices = TopTools_IndexedMapOfShape(), TopTools_IndexedMapOfShape()
        self._of_edge: dict[int, list[int]] = {}
        self._of_vertex: dict[int, int] = {}
        self._at: dict[tuple[float, float, float], int] = {}

    def add(self, face: Any) -> None:
        """Adds a face; what has no triangles is counted."""
        number, self._face_count = self._face_count, self._face_count + 1
        location = TopLoc_Location()
        triangulation = BRep_Tool.Triangulation_s(face, location)
        if triangulation is None:
            self._without += 1
            return
        base, place, is_bare = len(self._points), location.Transformation(), not has_surface(face)
        for i in range(1, triangulation.NbNodes() + 1):
            point = triangulation.Node(i).Transformed(place)
            self._points.append((point.X(), point.Y(), point.Z()))
            self._same.append(len(self._same))
            if is_bare:
                self._unite(self._at.setdefault(self._points[-1], len(self._points) - 1), len(self._points) - 1)
        turned = face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        for i in range(1, triangulation.NbTriangles() + 1):
            one = triangulation.Triangle(i)
            a, b, c = (base + one.Value(k) - 1 for k in (1, 2, 3))
            self._triangles.append((a, c, b) if turned else (a, b, c))
            self._faces.append(number)
        explorer = TopExp_Explorer(face, TopAbs_ShapeEnum.TopAbs_EDGE)
        while explorer.More():
            self._join(TopoDS.Edge_s(explorer.Current()), triangulation, location, base)
            explorer.Next()

    def _join(self, edge: Any, triangulation: Any, location: Any, base: int) -> None:
        polygon = BRep_Tool.PolygonOnTriangulation_s(edge, triangulation, location)
        if polygon is None or polygon.NbNodes() == 0:
            return
        nodes = [base + polygon.Node(i) - 1 for i in range(1, polygon.NbNodes() + 1)]
        known = self._of_edge.setdefault(self._edges.Add(edge), nodes)
        if len(known) == len(nodes):
            for one, other in zip(known, nodes, strict=True):
                self._unite(one, other)
        for vertex, node in ((TopExp.FirstVertex_s(edge), nodes[0]), (TopExp.LastVertex_s(edge), nodes[-1])):
            if not vertex.IsNull():
                self._unite(self._of_vertex.setdefault(self._vertices.Add(vertex), node), node)

    def _root(self, point: int) -> int:
        while self._same[point] != point:
            self._same[point] = self._same[self._same[point]]
            point = self._same[point]
        return point

    def _unite(self, one: int, other: int) -> None:
        one, other = self._root(one), self._root(other)
        self._same[max(one, other)] = min(one, other)

    def mesh(self, sag_mm: float | None) -> Mesh:
        """Returns what was added, without triangles that common points leave no area."""
        roots = np.array([self._root(i) for i in range(len(self._same))], dtype=np.int64)
        triangles = np.array(self._triangles, dtype=np.int64).reshape(-1, 3)
        triangles = roots[triangles] if len(triangles) else triangles
        has_area = (triangles[:, 0] != triangles[:, 1]) & (triangles[:, 1] != triangles[:, 2]) & (triangles[:, 2] != triangles[:, 0])
        triangles, faces = triangles[has_area], np.array(self._faces, dtype=np.int64)[has_area]
        points = np.array(self._points, dtype=np.float64).reshape(-1, 3)
        return Mesh(points, triangles, faces, self._without, _is_closed(triangles), sag_mm)


def _is_closed(triangles: NDArray[np.int64]) -> bool:
    """Whether each edge is gone along as often one way as the other."""
    if not len(triangles):
        return False
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    both, counts = np.unique(np.concatenate([edges, edges[:, ::-1]]), axis=0, return_counts=True)
    once, own = np.unique(edges, axis=0, return_counts=True)
    return len(both) == len(once) and bool((counts == 2 * own).all())


def _sag_of(shape: Any) -> float:
    box = Bnd_Box()
    BRepBndLib.Add_s(shape, box)
    if box.IsVoid():
        return SAG_MM
    return min(SAG_MM, max(1e-3, float(np.sqrt(box.SquareExtent())) * _SHARE_OF_DIAGONAL))


def _is_flat(shape: Any) -> bool:
    """Whether all faces are planes with straight edges, so that triangles are the surface."""
    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        if BRepAdaptor_Surface(TopoDS.Face_s(explorer.Current())).GetType() != GeomAbs_SurfaceType.GeomAbs_Plane:
            return False
        explorer.Next()
    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_EDGE)
    while explorer.More():
        edge = TopoDS.Edge_s(explorer.Current())
        if not BRep_Tool.Degenerated_s(edge) and BRepAdaptor_Curve(edge).GetType() != GeomAbs_CurveType.GeomAbs_Line:
            return False
        explorer.Next()
    return True
