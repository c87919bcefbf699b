# SPDX-License-Identifier: Apache-2.0
"""Half-spaces of Boolean results, as bodies that reach beyond what they cut."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from strake.importers.ifc.entity import Entity
from strake.importers.ifc.solids import Corners, Mesh, Unfit, mesh_of, solid_of

_BEYOND_MM = 1000.0
_MIN_LENGTH = 1e-9
# Beyond this doubles of millimetres are coarser than what lies near a face.
_MAX_MM = 1e12
# Segments of a boundary, of which each is compared with each.
_MAX_SEGMENTS = 2000


class Axes(NamedTuple):
    """A place and directions x, y, z, as rows."""

    place: Corners
    directions: Corners


def half_space(entity: Entity, unit_mm: float, low: Corners, high: Corners) -> Mesh | None:
    """Returns the part of a half-space that counts for what lies in a box, in millimetres; None where it has none.

    Raises Unfit for one that is bounded by curves or by what crosses itself, whose surface is no plane, or that does not state
    its side.
    """
    margin = _BEYOND_MM + float(np.linalg.norm(high - low))
    kind = entity.is_a()
    if kind == "IfcHalfSpaceSolid":
        solid = _box(low - margin, high + margin)
    elif kind == "IfcPolygonalBoundedHalfSpace":
        solid = _prism(entity, unit_mm, low - margin, high + margin)
    else:
        raise Unfit(f"a cut by {kind}")
    if not entity.BaseSurface.is_a("IfcPlane"):
        raise Unfit(f"a cut by {entity.BaseSurface.is_a()}")
    plane = axes_of(entity.BaseSurface.Position, unit_mm)
    if entity.AgreementFlag is not True and entity.AgreementFlag is not False:
        raise Unfit("a half-space that does not state its side")
    # Where the flag agrees the normal leads out of the matter.
    inward = -plane.directions[2] if entity.AgreementFlag else plane.directions[2]
    cut = mesh_of(solid.trim_by_plane(inward.tolist(), float(inward @ plane.place)))
    return cut if len(cut.triangles) else None


def axes_of(placement: Entity, unit_mm: float) -> Axes:
    """Returns the axes of an IfcAxis2Placement3D."""
    place = np.array(placement.Location.Coordinates, dtype=np.float64) * unit_mm
    if place.shape != (3,) or not (np.abs(place) <= _MAX_MM).all():
        raise Unfit("a place that is too far out")
    z = _direction(placement.Axis, (0.0, 0.0, 1.0))
    x = _direction(placement.RefDirection, (1.0, 0.0, 0.0))
    x = _unit(x - z * (x @ z))
    return Axes(place, np.array([x, np.cross(z, x), z]))


def _direction(entity: Entity | None, otherwise: tuple[float, float, float]) -> Corners:
    return _unit(np.array(otherwise if entity is None else entity.DirectionRatios, dtype=np.float64))


def _unit(vector: Corners) -> Corners:
    length = float(np.linalg.norm(vector))
    if vector.shape != (3,) or not _MIN_LENGTH < length < np.inf:
        raise Unfit("axes that have no direction")
    result: Corners = vector / length
    return result


def _solid(mesh: Mesh) -> Any:
    solid = solid_of(mesh)
    if solid.volume() <= 0:
        raise Unfit("a half-space whose boundary crosses itself")
    return solid


def _box(low: Corners, high: Corners) -> Any:
    return _solid(_extruded(np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]]), low[2], high[2]))


def _prism(entity: Entity, unit_mm: float, low: Corners, high: Corners) -> Any:
    boundary = entity.PolygonalBoundary
    if not boundary.is_a("IfcPolyline"):
        raise Unfit(f"a half-space bounded by {boundary.is_a()}")
    outline: list[NDArray[np.float64]] = []
    for point in boundary.Points:
        place = np.array(point.Coordinates[:2], dtype=np.float64) * unit_mm
        if not outline or np.abs(place - outline[-1]).max() > _MIN_LENGTH:
            outline.append(place)
    if len(outline) > 1 and np.abs(outline[0] - outline[-1]).max() <= _MIN_LENGTH:
        outline.pop()
    if len(outline) < 3:
        raise Unfit("a half-space bounded by no area")
    if not _is_simple(np.array(outline)):
        raise Unfit("a half-space whose boundary crosses itself")
    axes = axes_of(entity.Position, unit_mm)
    box = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    heights = (box - axes.place) @ axes.directions[2]
    prism = _extruded(np.array(outline), float(heights.min()), float(heights.max()))
    return _solid(Mesh(prism.vertices @ axes.directions + axes.place, prism.triangles))


def _is_simple(outline: NDArray[np.float64]) -> bool:
    """Whether segments meet at their common corners only. Triangles of any other outline are those of something else."""
    count = len(outline)
    if count > _MAX_SEGMENTS or not (np.abs(outline) <= _MAX_MM).all():
        raise Unfit("a half-space bounded by too much")
    following = np.roll(outline, -1, axis=0)
    along = following - outline
    after = np.roll(along, -1, axis=0)
    turn = along[:, 0] * after[:, 1] - along[:, 1] * after[:, 0]
    if ((turn == 0) & ((along * after).sum(axis=1) <= 0)).any():
        return False  # it goes back the way it came
    one, other = np.triu_indices(count, 2)
    apart = (one > 0) | (other < count - 1)
    one, other = one[apart], other[apart]
    low, high = np.minimum(outline, following), np.maximum(outline, following)
    near = ((low[one] <= high[other]) & (low[other] <= high[one])).all(axis=1)
    one, other = one[near], other[near]

    def sides(of: NDArray[np.int64], points: NDArray[np.float64]) -> NDArray[np.float64]:
        to = points - outline[of]
        result: NDArray[np.float64] = np.sign(along[of, 0] * to[:, 1] - along[of, 1] * to[:, 0])
        return result

    across = sides(one, outline[other]) * sides(one, following[other]) <= 0
    across &= sides(other, outline[one]) * sides(other, following[one]) <= 0
    return not across.any()


def _extruded(outline: NDArray[np.float64], low: float, high: float) -> Mesh:
    """Returns the prism over an outline."""
    from manifold3d import triangulate

    following = np.roll(outline, -1, axis=0)
    if float((outline[:, 0] * following[:, 1] - outline[:, 1] * following[:, 0]).sum()) < 0:
        outline = outline[::-1]
    count = len(outline)
    cap = np.array(triangulate([np.ascontiguousarray(outline)]), dtype=np.int64)
    at = np.arange(count)
    after = (at + 1) % count
    sides = np.concatenate([np.stack([at, after, after + count], axis=1), np.stack([at, after + count, at + count], axis=1)])
    vertices = np.concatenate([np.column_stack([outline, np.full(count, height)]) for height in (low, high)])
    return Mesh(vertices, np.concatenate([cap[:, ::-1], cap + count, sides]))
