# SPDX-License-Identifier: Apache-2.0
"""Solids of a product, and the shells of the faces that are in none, each with its colour."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepBuilderAPI import BRepBuilderAPI_Sewing
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.Quantity import Quantity_TypeOfColor
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Compound
from OCP.TopTools import TopTools_IndexedMapOfShape

from strake.importers.shapes import Color
from strake.importers.step.face_sets import face_sets

# Faces whose edges lie no farther apart than this are one surface, mm.
_SEWING = 0.01


@dataclass(frozen=True)
class Piece:
    """A solid, a shell or a set of faces. Only such a set has a name of its own."""

    shape: Any
    is_solid: bool
    color: Color | None
    name: str = ""


def found(shape: Any, kind: TopAbs_ShapeEnum, outside: TopAbs_ShapeEnum | None = None) -> list[Any]:
    """Returns the shapes of a kind within another, each once, and only those outside of another kind."""
    explorer = TopExp_Explorer(shape, kind) if outside is None else TopExp_Explorer(shape, kind, outside)
    visited = TopTools_IndexedMapOfShape()
    shapes: list[Any] = []
    while explorer.More():
        if visited.Add(explorer.Current()) > len(shapes):
            shapes.append(explorer.Current())
        explorer.Next()
    return shapes


def pieces_of(product: Any, styles: Any, name_of_face: Callable[[Any], str]) -> list[Piece]:
    """Returns the pieces of a product; `styles` are the colours of shapes within it."""
    kinds = TopAbs_ShapeEnum
    whole = color_of_shape(product, styles)
    pieces = []
    for solid in found(product, kinds.TopAbs_SOLID):
        own = color_of_shape(solid, styles) or next(
            (color for shell in found(solid, kinds.TopAbs_SHELL) if (color := color_of_shape(shell, styles))), whole
        )
        pieces.append(Piece(solid, True, _largest(found(solid, kinds.TopAbs_FACE), own, styles)))
    loose: list[tuple[Any, Color | None]] = []
    for shell in found(product, kinds.TopAbs_SHELL, kinds.TopAbs_SOLID):
        of_shell = color_of_shape(shell, styles) or whole
        if bare := _without_surface(found(shell, kinds.TopAbs_FACE)):
            pieces.append(_tessellated(bare, of_shell, styles))
        loose += _with_colors(found(shell, kinds.TopAbs_FACE), of_shell, styles)
    alone = found(product, kinds.TopAbs_FACE, kinds.TopAbs_SHELL)
    for one in face_sets(_without_surface(alone), name_of_face):
        pieces.append(_tessellated(one.faces, whole, styles, one.name))
    loose += _with_colors(alone, whole, styles)
    return pieces + (_sewn(loose) if loose else [])


def has_surface(face: Any) -> bool:
    """Whether a face is one of a surface; AP242 files have some that are triangles and nothing else."""
    return BRep_Tool.Surface_s(TopoDS.Face_s(face)) is not None


def _with_colors(faces: list[Any], whole: Color | None, styles: Any) -> list[tuple[Any, Color | None]]:
    """Returns those of the faces that have surfaces, each with its colour."""
    return [(face, color_of_shape(face, styles) or whole) for face in faces if has_surface(face)]


def _without_surface(faces: list[Any]) -> list[Any]:
    return [face for face in faces if not has_surface(face)]


def _tessellated(faces: Sequence[Any], whole: Color | None, styles: Any, name: str = "") -> Piece:
    """Returns faces that are triangles alone as one piece: sewing would drop them."""
    together, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(together)
    for face in faces:
        builder.Add(together, face)
    return Piece(together, False, _largest(faces, whole, styles), name)


def _sewn(faces: list[tuple[Any, Color | None]]) -> list[Piece]:
    """Sews faces where their edges meet, and returns each shell."""
    sewing = BRepBuilderAPI_Sewing(_SEWING)
    for face, _ in faces:
        sewing.Add(face)
    sewing.Perform()
    sewn = sewing.SewedShape()
    if sewn is None or sewn.IsNull():
        return []
    parts = found(sewn, TopAbs_ShapeEnum.TopAbs_SHELL) + found(sewn, TopAbs_ShapeEnum.TopAbs_FACE, TopAbs_ShapeEnum.TopAbs_SHELL)
    of_face, part_of = TopTools_IndexedMapOfShape(), {}
    for number, part in enumerate(parts):
        for face in found(part, TopAbs_ShapeEnum.TopAbs_FACE):
            part_of[of_face.Add(face)] = number
    areas: list[dict[Color, float]] = [{} for _ in parts]
    for face, color in faces:
        number = part_of.get(of_face.FindIndex(sewing.ModifiedSubShape(face)), -1)
        if color is not None and number >= 0:
            areas[number][color] = areas[number].get(color, 0.0) + _area(face)
    return [Piece(part, False, max(own, key=lambda c: own[c]) if own else None) for part, own in zip(parts, areas, strict=True)]


def _largest(faces: Sequence[Any], whole: Color | None, styles: Any) -> Color | None:
    """Returns the colour of most of the area."""
    own = [color_of_shape(face, styles) for face in faces]
    if not any(own):
        return whole
    areas: dict[Color, float] = {}
    for face, color in zip(faces, own, strict=True):
        if counted := color or whole:
            areas[counted] = areas.get(counted, 0.0) + _area(face)
    return max(areas, key=lambda c: areas[c])


def _area(face: Any) -> float:
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(face, properties)
    return abs(float(properties.Mass()))


def color_of_shape(shape: Any, styles: Any) -> Color | None:
    """Returns the colour that is stated of a shape itself."""
    if not styles.Contains(shape):
        return None
    style = styles.FindFromKey(shape)
    return rgba(style.GetColorSurfRGBA()) if style.IsSetColorSurf() else None


def rgba(color: Any) -> Color:
    """Returns a colour as scenes have it."""
    red, green, blue = color.GetRGB().Values(Quantity_TypeOfColor.Quantity_TOC_sRGB)
    return (round(red, 6), round(green, 6), round(blue, 6), round(float(color.Alpha()), 6))
