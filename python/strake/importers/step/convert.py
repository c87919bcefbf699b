# SPDX-License-Identifier: Apache-2.0
"""A document of Open CASCADE as a scene: assemblies are groups, instances objects, products shapes that they share."""

from __future__ import annotations

import importlib.metadata
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import OCP
from numpy.typing import NDArray
from OCP.BRep import BRep_Builder
from OCP.TCollection import TCollection_AsciiString
from OCP.TDF import TDF_Tool
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Compound
from OCP.XCAFDoc import XCAFDoc_ShapeTool
from OCP.XCAFPrs import XCAFPrs, XCAFPrs_IndexedDataMapOfShapeStyle

from strake.importers.command import Job
from strake.importers.scene_writer import Group, SceneWriter
from strake.importers.shapes import Color, Part
from strake.importers.step.document import Labels, instance_name, name_of, read_document, referred
from strake.importers.step.mesh import Mesh, mesh_of
from strake.importers.step.pieces import found, pieces_of
from strake.importers.step.source import format_of

_GREY: Color = (0.8, 0.8, 0.8, 1.0)


@dataclass(frozen=True)
class _Part:
    """The triangles of a piece; its colour and its name where it has them."""

    mesh: Mesh
    color: Color | None
    name: str


@dataclass
class _Product:
    """A product with its triangles, by piece."""

    name: str
    parts: list[_Part] = field(default_factory=list)
    attributes: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class _Place:
    """Where something is in the tree of assemblies."""

    location: Any
    group: Group | None = None
    path: str = ""
    color: Color | None = None
    instances: tuple[Any, ...] = ()


class _Names:
    """Names within a group: of several that are equal the second is "bolt~2"."""

    def __init__(self) -> None:
        self._counts: dict[str, int] = {}

    def unique(self, name: str) -> str:
        while True:
            count = self._counts[name] = self._counts.get(name, 0) + 1
            if count == 1:
                return name
            name = f"{name}~{count}"


def convert(job: Job) -> None:
    """Converts the file of the job."""
    job.format = format_of(job.input, job.report)
    job.made_by = f"Open CASCADE {importlib.metadata.version(_package())}"
    job.depends_on = [OCP.__file__]
    labels = read_document(job.input, job.format != "IGES", job.report)
    job.unit = labels.unit
    job.report.progress(0.5)
    with job.scene(unit_mm=1.0) as scene:
        builder = _Builder(job, labels, scene)
        builder.add_roots()
        if scene.object_count == 0:
            job.report.fail(
                "nothing in it becomes an object: no product has a face of which triangles can be made",
                "export solids or surfaces, as STEP AP214 or AP242",
            )


def _package() -> str:
    """Returns which of the packages that bring Open CASCADE is installed."""
    for name in ("cadquery-ocp-novtk", "cadquery-ocp"):
        try:
            importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            continue
        return name
    return "cadquery-ocp"


class _Builder:
    def __init__(self, job: Job, labels: Labels, scene: SceneWriter) -> None:
        self._report, self._sag, self._file = job.report, job.sag_mm, job.input.stem
        self._is_iges = job.format == "IGES"
        self._labels, self._scene = labels, scene
        self._products: dict[str, _Product] = {}

    def add_roots(self) -> None:
        names = _Names()
        surfaces = []
        for root in self._labels.roots():
            solids = found(XCAFDoc_ShapeTool.GetShape_s(root), TopAbs_ShapeEnum.TopAbs_SOLID)
            if self._is_iges and not solids and not self._labels.is_assembly(root):
                surfaces.append(root)
            else:
                self._add(root, None, _Place(TopLoc_Location()), names)
        if surfaces:
            self._add_loose(surfaces, names)

    def _add_loose(self, roots: list[Any], names: _Names) -> None:
        """Adds what IGES says as surfaces one beside the other: together they are the shells of parts."""
        compound, styles = TopoDS_Compound(), XCAFPrs_IndexedDataMapOfShapeStyle()
        builder = BRep_Builder()
        builder.MakeCompound(compound)
        for root in roots:
            builder.Add(compound, XCAFDoc_ShapeTool.GetShape_s(root))
            XCAFPrs.CollectStyleSettings_s(root, TopLoc_Location(), styles)
        self._add_separately(self._made(self._file, compound, styles, lambda _: ""), _Place(TopLoc_Location()), names)

    def _add(self, label: Any, instance: Any, place: _Place, names: _Names) -> None:
        if not self._labels.is_assembly(label):
            product = self._product_of(label)
            if instance is None:
                self._add_separately(product, place, names)
            else:
                self._add_instance(product, instance, place, names)
            return
        product_name = name_of(label)
        name = names.unique(instance_name(instance, product_name) or product_name or self._file)
        color = self._color_of_instance(instance, place) or self._labels.color_of(label)
        within = replace(
            place,
            group=self._scene.group(name, place.group, {"Assembly": name}),
            path=f"{place.path}{name}/",
            color=color or place.color,
        )
        inner = _Names()
        for component in self._labels.components(label):
            location = place.location.Multiplied(XCAFDoc_ShapeTool.GetLocation_s(component))
            of_component = replace(within, location=location, instances=(*within.instances, component))
            self._add(referred(component), component, of_component, inner)

    def _add_separately(self, product: _Product, place: _Place, names: _Names) -> None:
        """Adds an object for each piece of what is all that the file has: nothing of it could clash otherwise."""
        if len(product.parts) < 2:
            self._add_instance(product, None, place, names)
            return
        name = names.unique(product.name or self._file)
        within = replace(place, group=self._scene.group(name, place.group, {"Assembly": name}), path=f"{place.path}{name}/")
        inner = _Names()
        for number, part in enumerate(product.parts, 1):
            self._add_instance(_Product(part.name or str(number), [part], product.attributes), None, within, inner)

    def _add_instance(self, product: _Product, instance: Any, place: _Place, names: _Names) -> None:
        if not product.parts:
            return
        own = "" if instance is None else instance_name(instance, product.name)
        lone = product.parts[0].name if instance is None and len(product.parts) == 1 else ""
        name = own or lone or product.name or self._file
        color = self._color_of_instance(instance, place)
        parts, known = [], []
        for part in product.parts:
            parts.append(Part(part.mesh.points, part.mesh.triangles, color or part.color or place.color or _GREY))
            if part.mesh.sag_mm is not None:
                known.append(part.mesh.sag_mm)
        sag = max(known) if len(known) == len(parts) else None
        attributes = {**product.attributes, **({"Instance": own} if own else {})}
        if instance is not None and (layers := self._labels.layers_of(instance)):
            attributes["Layer"] = layers
        shape = self._scene.shape(parts, sag)
        self._scene.object(place.path + names.unique(name), name, shape, _matrix(place.location), place.group, attributes)

    def _color_of_instance(self, instance: Any, place: _Place) -> Color | None:
        return self._labels.color_of_occurrence(list(place.instances)) or self._labels.color_of(instance)

    def _product_of(self, label: Any) -> _Product:
        entry = TCollection_AsciiString()
        TDF_Tool.Entry_s(label, entry)
        key = entry.ToCString()
        if key not in self._products:
            styles = XCAFPrs_IndexedDataMapOfShapeStyle()
            XCAFPrs.CollectStyleSettings_s(label, TopLoc_Location(), styles)
            product = self._made(name_of(label), XCAFDoc_ShapeTool.GetShape_s(label), styles, self._labels.name_of_face)
            if product.name:
                product.attributes["Product"] = product.name
            if layers := self._labels.layers_of(label):
                product.attributes["Layer"] = layers
            self._products[key] = product
        return self._products[key]

    def _made(self, name: str, shape: Any, styles: Any, name_of_face: Callable[[Any], str]) -> _Product:
        """Returns a product with triangles; what has none is told of."""
        product, shown = _Product(name), name or self._file
        for piece in pieces_of(shape, styles, name_of_face):
            self._report.alive()
            mesh = mesh_of(piece.shape, self._sag)
            if mesh.faces_without:
                self._report.skipped("step-face-without-triangles", f"{mesh.faces_without} faces have no triangles", shown)
            if not len(mesh.triangles):
                what = "a solid" if piece.is_solid else "a surface"
                self._report.skipped("step-no-triangles", f"{what} of the product is not in the scene", shown)
                continue
            if piece.is_solid and not mesh.is_closed:
                self._report.warning("step-open-solid", "its faces do not meet everywhere, so that it counts as a surface", shown)
            product.parts.append(_Part(mesh, piece.color, piece.name))
        return product


def _matrix(location: Any) -> NDArray[np.float64]:
    place = location.Transformation()
    matrix = np.eye(4)
    for row in range(3):
        for column in range(4):
            matrix[row, column] = place.Value(row + 1, column + 1)
    return matrix
