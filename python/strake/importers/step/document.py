# SPDX-License-Identifier: Apache-2.0
"""A document of Open CASCADE, and what is asked of its labels."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.IGESCAFControl import IGESCAFControl_Reader
from OCP.Interface import Interface_Static
from OCP.Quantity import Quantity_ColorRGBA
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.StepVisual import StepVisual_TessellatedItem
from OCP.TCollection import TCollection_ExtendedString
from OCP.TColStd import TColStd_HSequenceOfExtendedString, TColStd_SequenceOfAsciiString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_AttributeSequence, TDF_Label, TDF_LabelSequence
from OCP.TDocStd import TDocStd_Document
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import XCAFDoc_ColorTool, XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

from strake.importers.report import Report
from strake.importers.shapes import Color
from strake.importers.step.pieces import rgba

_UNITS = (("milli", "mm"), ("centi", "cm"), ("kilo", "km"), ("micro", "um"), ("metre", "m"), ("meter", "m"), ("inch", "in"))
_IGES_UNITS = ((1, "mm"), (10, "cm"), (1000, "m"), (25.4, "in"), (304.8, "ft"), (1e6, "km"), (1e-3, "um"))
_MADE_UP = re.compile(r"=>\[0:|(COMPOUND|COMPSOLID|SOLID|SHELL|FACE|WIRE|EDGE|VERTEX|SHAPE)$")
# Not of those alone that were requested.
_OF_ALL_ENTITIES = 1
_NUMBERED = re.compile(r"(NAUO)?\d*$")


@dataclass
class Labels:
    """The labels of a document."""

    document: Any
    unit: str
    reader: Any = None  # that of a STEP file, which knows what was made of which entity

    def __post_init__(self) -> None:
        main = self.document.Main()
        self.shapes = XCAFDoc_DocumentTool.ShapeTool_s(main)
        self._layers = XCAFDoc_DocumentTool.LayerTool_s(main)

    def roots(self) -> list[Any]:
        """Returns the labels of what is in no assembly."""
        return _listed(self.shapes.GetFreeShapes)

    def components(self, assembly: Any) -> list[Any]:
        """Returns the labels of the instances in an assembly."""
        return _listed(lambda into: XCAFDoc_ShapeTool.GetComponents_s(assembly, into))

    def is_assembly(self, label: Any) -> bool:
        """Whether a label has parts that are objects of their own: Open CASCADE makes assemblies, too, of products in pieces."""
        if not XCAFDoc_ShapeTool.IsAssembly_s(label):
            return False
        for component in self.components(label):
            piece = referred(component)
            if XCAFDoc_ShapeTool.IsAssembly_s(piece) or name_of(piece) or name_of(component):
                return True
        return False

    def color_of(self, label: Any) -> Color | None:
        """Returns the colour of a label itself; None is no label."""
        if label is None:
            return None
        color = Quantity_ColorRGBA()
        for kind in (XCAFDoc_ColorType.XCAFDoc_ColorSurf, XCAFDoc_ColorType.XCAFDoc_ColorGen):
            if XCAFDoc_ColorTool.GetColor_s(label, kind, color):
                return rgba(color)
        return None

    def color_of_occurrence(self, chain: list[Any]) -> Color | None:
        """Returns the colour of one occurrence alone, which the instances of `chain` lead to, the outermost first."""
        for first in range(len(chain) - 1):
            for usage in usages_of(chain[first]):
                if _leads_along(usage, chain[first + 1 :]) and (color := self.color_of(usage)):
                    return color
        return None

    def layers_of(self, label: Any) -> str:
        """Returns the names of the layers of a label, "; " between several."""
        names = TColStd_HSequenceOfExtendedString()
        if not self._layers.GetLayers(label, names):
            return ""
        return "; ".join(sorted(_text(names.Value(i)) for i in range(1, names.Length() + 1)))

    def name_of_face(self, face: Any) -> str:
        """Returns the name of the set of triangles that a face without a surface was made of; empty where it has none."""
        if self.reader is None:
            return ""
        entity = self.reader.ChangeReader().WS().TransferReader().EntityFromShapeResult(face, _OF_ALL_ENTITIES)
        name = entity.Name() if isinstance(entity, StepVisual_TessellatedItem) else None
        try:
            return "" if name is None else str(name.ToCString()).strip()
        except UnicodeDecodeError:  # a name in a code of its own
            return ""


def _listed(fill: Any) -> list[Any]:
    into = TDF_LabelSequence()
    fill(into)
    return [into.Value(i) for i in range(1, into.Length() + 1)]


def _text(text: Any) -> str:
    return str(text.ToExtString()).strip()


def usages_of(component: Any) -> list[Any]:
    """Returns the labels that say something of occurrences within an instance."""
    nodes = TDF_AttributeSequence()
    XCAFDoc_ShapeTool.GetAllComponentSHUO_s(component, nodes)
    return [nodes.Value(i).Label() for i in range(1, nodes.Length() + 1)]


def _leads_along(usage: Any, chain: list[Any]) -> bool:
    """Whether what is said is of these instances, each within the one before, and of none within the last."""
    following = _listed(lambda into: XCAFDoc_ShapeTool.GetSHUONextUsage_s(usage, into))
    if not chain:
        return not following
    return any(one.Father().IsEqual(chain[0]) and _leads_along(one, chain[1:]) for one in following)


def referred(label: Any) -> Any:
    """Returns the product of an instance."""
    product = TDF_Label()
    return product if XCAFDoc_ShapeTool.GetReferredShape_s(label, product) else label


def name_of(label: Any) -> str:
    """Returns the name of a label; empty where it has none, or one that Open CASCADE made up."""
    name = TDataStd_Name()
    if label is None or not label.FindAttribute(TDataStd_Name.GetID_s(), name):
        return ""
    text = _text(name.Get())
    return "" if _MADE_UP.match(text) else text


def instance_name(instance: Any, product: str) -> str:
    """Returns the name of an instance where it says more than that of its product, or a number."""
    name = name_of(instance)
    return "" if name == product or _NUMBERED.match(name) else name


def read_document(file: Path, is_step: bool, report: Report) -> Labels:
    """Reads a file. Raises ImportFailed where Open CASCADE cannot."""
    # Settings may otherwise come from resource files and the environment.
    reader = STEPCAFControl_Reader() if is_step else IGESCAFControl_Reader()
    Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")
    for name, value in (("read.stepcaf.subshapes.name", 1), ("read.step.ideas", 1), ("read.iges.bspline.continuity", 1)):
        Interface_Static.SetIVal_s(name, value)
    # Triangles that an AP242 file has in place of surfaces; those that it has beside them (1) would be taken for them.
    Interface_Static.SetIVal_s("read.step.tessellated", 2)
    reader.SetColorMode(True)
    reader.SetNameMode(True)
    reader.SetLayerMode(True)
    if is_step:
        reader.SetSHUOMode(True)
        reader.SetGDTMode(False)
    status = reader.ReadFile(str(file))
    if status not in (IFSelect_ReturnStatus.IFSelect_RetDone, IFSelect_ReturnStatus.IFSelect_RetVoid):
        report.fail("Open CASCADE cannot read the file", "it may be damaged: export it again, or as STEP AP214")
    document = TDocStd_Document(TCollection_ExtendedString("MDTV-XCAF"))
    XCAFApp_Application.GetApplication_s().NewDocument(TCollection_ExtendedString("MDTV-XCAF"), document)
    report.progress(0.15)
    if status != IFSelect_ReturnStatus.IFSelect_RetDone or not reader.Transfer(document):
        report.fail("nothing in it becomes an object: no entity is a product with a shape", "export a whole part or assembly")
    if not is_step:
        return Labels(document, _iges_unit(reader))
    return Labels(document, _step_unit(reader), reader)


def _step_unit(reader: Any) -> str:
    lengths, angles, solid_angles = (TColStd_SequenceOfAsciiString() for _ in range(3))
    reader.ChangeReader().FileUnits(lengths, angles, solid_angles)
    if lengths.IsEmpty():
        return ""
    name = lengths.Value(1).ToCString().lower()
    return next((unit for word, unit in _UNITS if word in name), "ft" if "foot" in name or "feet" in name else "")


def _iges_unit(reader: Any) -> str:
    from OCP.IGESData import IGESData_IGESModel

    model = reader.Model()
    if not isinstance(model, IGESData_IGESModel):
        return ""
    mm = model.GlobalSection().UnitValue()
    return next((name for value, name in _IGES_UNITS if abs(mm / value - 1) < 1e-6), "")
