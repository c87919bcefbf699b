# SPDX-License-Identifier: Apache-2.0
"""Bodies without what other bodies have in common with them, by manifold3d (decision 0121).

It cuts exactly where faces lie on each other to the last bit, and leaves skins where they do so nearly. So what lies
nearly on a level plane is put on it before, and where faces still lie nearly on each other the cut is left to others.
"""

from __future__ import annotations

import bisect
import importlib.util
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from strake.importers.diagonals import crossed

Corners = NDArray[np.float64]
Triangles = NDArray[np.int64]

# What is no farther apart than this is one place: the distance within which files and kernels say that points are equal.
SNAP_MM = 0.01
# Nearer faces than this Open CASCADE takes for one: an opening that ends so near a face goes through it there, where a skin
# would stay here. It was measured with openings that end 0.09 to 0.11 mm short of the faces of a wall.
_MERGED_MM = 0.1
# Of the normal of a face that is level, and of those of two faces that may lie on each other.
_LEVEL = 0.9999
_ROUNDING_MM = 1e-6
_MAX_PAIRS = 4_000_000
_MIN_MM3 = 1e-6


class Unfit(ValueError):
    """Why a body is not cut here."""


class Mesh(NamedTuple):
    """Triangles of a body, in millimetres. They are seen from outside against the clock."""

    vertices: Corners
    triangles: Triangles


def manifold3d_files() -> list[str]:
    """Returns the file of manifold3d; none where it is not installed. It is loaded only by workers, which may end of it."""
    found = importlib.util.find_spec("manifold3d")
    return [found.origin] if found is not None and found.origin is not None else []


def difference(bodies: Sequence[Mesh], cutters: Sequence[Mesh]) -> list[list[Mesh]]:
    """Returns what cutters leave of each body: its pieces, none where nothing is left.

    Raises Unfit where that cannot be told for sure: bodies that are not closed, or lie nearly on each other.
    """
    from manifold3d import Manifold, OpType

    bodies_of = [_closed(body) for body in bodies]
    tools = [mesh for cutter in cutters for mesh in _closed(cutter)]
    pieces = [piece for body in bodies_of for piece in body]
    moved = _snapped([*pieces, *tools])
    if _lie_nearly_on_each_other(moved, len(pieces)):
        raise Unfit("faces that lie nearly on each other, and aslant or apart")
    solids = [solid_of(mesh) for mesh in moved]
    left = [Manifold.batch_boolean([solid, *solids[len(pieces) :]], OpType.Subtract) for solid in solids[: len(pieces)]]
    meshes = iter([mesh_of(solid) for solid in left])
    return [[mesh for mesh in (next(meshes) for _ in body) if len(mesh.triangles)] for body in bodies_of]


def mesh_of(solid: Any) -> Mesh:
    """Returns the triangles of a solid of manifold3d."""
    mesh = solid.to_mesh64()
    return Mesh(np.array(mesh.vert_properties[:, :3], dtype=np.float64), np.array(mesh.tri_verts, dtype=np.int64))


def _closed(mesh: Mesh) -> list[Mesh]:
    """Returns the parts of a mesh that do not hang together, each closed and its inside within."""
    try:
        solid = solid_of(mesh)
    except Unfit:
        solid = solid_of(_welded(mesh))
    parts = solid.decompose()
    volumes = [part.volume() for part in parts]
    if all(volume > _MIN_MM3 for volume in volumes):
        return [mesh_of(part) for part in parts]
    if all(volume < -_MIN_MM3 for volume in volumes):
        return [Mesh(one.vertices, one.triangles[:, ::-1]) for one in map(mesh_of, parts)]
    raise Unfit("a body with a hollow, or that encloses nothing")


def solid_of(mesh: Mesh) -> Any:
    """Returns the solid of manifold3d that a mesh bounds. Raises Unfit."""
    from manifold3d import Error, Manifold, Mesh64

    solid = Manifold(Mesh64(np.ascontiguousarray(mesh.vertices), np.ascontiguousarray(mesh.triangles.astype(np.uint64))))
    if solid.status() != Error.NoError:
        raise Unfit(f"a body that is not closed ({solid.status().name})")
    return solid


def _welded(mesh: Mesh) -> Mesh:
    """The same with one vertex at each place."""
    vertices, numbers = np.unique(np.round(mesh.vertices / SNAP_MM), axis=0, return_inverse=True)
    triangles = numbers.reshape(-1)[mesh.triangles]
    first = np.zeros(len(vertices), dtype=np.int64)
    first[numbers.reshape(-1)[::-1]] = np.arange(len(mesh.vertices))[::-1]
    flat = (triangles == np.roll(triangles, 1, axis=1)).any(axis=1)
    return Mesh(mesh.vertices[first], triangles[~flat])


def _snapped(meshes: Sequence[Mesh]) -> list[Mesh]:
    """Puts all corners that are nearly in the plane of a level face into it; of several such planes the first counts."""
    vertices = np.concatenate([mesh.vertices for mesh in meshes])
    corners = np.concatenate([mesh.vertices[mesh.triangles] for mesh in meshes])
    normals = _normals(corners)
    for axis in range(3):
        level = (np.abs(normals[:, axis]) > _LEVEL) & (np.ptp(corners[:, :, axis], axis=1) < SNAP_MM)
        heights = np.array(_apart(corners[level, 0, axis].tolist()))
        if len(heights):
            of_vertices = vertices[:, axis]
            above = np.searchsorted(heights, of_vertices).clip(1, max(len(heights) - 1, 1))
            below = heights[above - 1]
            above = heights[above.clip(0, len(heights) - 1)]
            nearest = np.where(of_vertices - below <= above - of_vertices, below, above)
            vertices[:, axis] = np.where(np.abs(nearest - of_vertices) <= SNAP_MM, nearest, of_vertices)
    ends = np.cumsum([len(mesh.vertices) for mesh in meshes])
    return [Mesh(part, mesh.triangles) for part, mesh in zip(np.split(vertices, ends[:-1]), meshes, strict=True)]


def _apart(numbers: Iterable[float]) -> list[float]:
    """Returns those that are farther than SNAP_MM from all before them, in rising order."""
    kept: list[float] = []
    for number in dict.fromkeys(numbers):
        at = bisect.bisect(kept, number)
        if all(abs(number - other) > SNAP_MM for other in kept[max(at - 1, 0) : at + 1]):
            kept.insert(at, number)
    return kept


def _normals(corners: Corners) -> Corners:
    """Returns the unit normals of triangles; zero where there is none."""
    cross = crossed(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.sqrt(np.add.reduce(cross * cross, axis=1, keepdims=True))
    normals: Corners = np.divide(cross, length, out=np.zeros_like(cross), where=length > 0)
    return normals


def _lie_nearly_on_each_other(meshes: Sequence[Mesh], bodies: int) -> bool:
    """Whether a face of a cutter lies nearly in one plane with a face of a body, or of another cutter, near by.

    Level faces that are in one plane to the last bit do not count.
    """
    corners = np.concatenate([mesh.vertices[mesh.triangles] for mesh in meshes])
    owner = np.repeat(np.arange(len(meshes)), [len(mesh.triangles) for mesh in meshes])
    normals = _normals(corners)
    some = normals.any(axis=1)
    corners, owner, normals = corners[some], owner[some], normals[some]
    flat = np.ptp(corners, axis=1) == 0
    aslant = np.flatnonzero(~flat.any(axis=1))
    of_cutter = owner >= bodies
    faces = _Faces(corners, owner, normals)
    if faces.any_near(aslant[of_cutter[aslant]], np.arange(len(owner))) or faces.any_near(np.flatnonzero(of_cutter), aslant):
        return True
    for axis in range(3):
        level = np.flatnonzero(flat[:, axis])
        if len(level) < 2:
            continue
        doubtful = level[_beside_others(corners[level, 0, axis])]
        if faces.any_near(doubtful[of_cutter[doubtful]], doubtful, axis):
            return True
    return False


def _beside_others(heights: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which heights have others beside them that are not equal and yet taken for one."""
    rising = np.sort(heights)
    different = rising[np.concatenate([[True], rising[1:] != rising[:-1]])[: len(rising)]]
    numbers = np.searchsorted(different, heights)
    gaps = np.concatenate([[np.inf], np.diff(different), [np.inf]])
    beside: NDArray[np.bool_] = (np.minimum(gaps[:-1], gaps[1:]) <= _MERGED_MM + _ROUNDING_MM)[numbers]
    return beside


class _Faces(NamedTuple):
    """Triangles, by which body each is of."""

    corners: Corners
    owner: NDArray[np.int64]
    normals: Corners

    def any_near(self, these: NDArray[np.int64], those: NDArray[np.int64], axis: int | None = None) -> bool:
        """Whether any of these lies nearly in one plane with one of those near by, of another body.

        `axis`: all are level there, and equal ones do not count.
        """
        if not len(these) or not len(those):
            return False
        if len(these) * len(those) > _MAX_PAIRS:
            raise Unfit("cutters of too many faces that lie aslant or nearly on each other")
        like = np.abs(self.normals[these] @ self.normals[those].T) > _LEVEL
        first, second = np.nonzero(like & (self.owner[these][:, None] != self.owner[those][None, :]))
        one, other = these[first], those[second]
        if not len(one):
            return False
        low, high = self.corners.min(axis=1) - _MERGED_MM, self.corners.max(axis=1) + _MERGED_MM
        near = ((low[one] <= high[other]) & (low[other] <= high[one])).all(axis=1)
        if axis is not None:
            near &= self.corners[one, 0, axis] != self.corners[other, 0, axis]
        one, other = one[near], other[near]
        return bool((self._in_plane(one, other) | self._in_plane(other, one)).any())

    def _in_plane(self, these: NDArray[np.int64], of: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Whether all corners of triangles are nearly in the planes of others."""
        heights = np.einsum("nij,nj->ni", self.corners[these] - self.corners[of][:, :1], self.normals[of])
        near: NDArray[np.bool_] = (np.abs(heights) <= _MERGED_MM + _ROUNDING_MM).all(axis=1)
        return near
