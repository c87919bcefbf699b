# SPDX-License-Identifier: Apache-2.0
"""STEP and IGES by the Open CASCADE that Python packages bring, on files that it makes itself."""

from __future__ import annotations

import math
import os
import re
from pathlib import Path
from typing import Any

import pytest

from conversions import Outcome, convert

pytest.importorskip("OCP", reason="needs Open CASCADE: pip install 'strake[step]'")

DATA = os.environ.get("STRAKE_DATA", "")
STEP = "strake.importers.step"


class Draft:
    """A document that is being made."""

    def __init__(self) -> None:
        from OCP.TCollection import TCollection_ExtendedString
        from OCP.TDocStd import TDocStd_Document
        from OCP.XCAFApp import XCAFApp_Application
        from OCP.XCAFDoc import XCAFDoc_DocumentTool

        self.document = TDocStd_Document(TCollection_ExtendedString("MDTV-XCAF"))
        XCAFApp_Application.GetApplication_s().NewDocument(TCollection_ExtendedString("MDTV-XCAF"), self.document)
        self.shapes = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main())
        self.colors = XCAFDoc_DocumentTool.ColorTool_s(self.document.Main())

    def named(self, label: Any, name: str) -> Any:
        from OCP.TCollection import TCollection_ExtendedString
        from OCP.TDataStd import TDataStd_Name

        TDataStd_Name.Set_s(label, TCollection_ExtendedString(name))
        return label

    def part(self, shape: Any, name: str) -> Any:
        return self.named(self.shapes.AddShape(shape, False), name)

    def assembly(self, name: str) -> Any:
        return self.named(self.shapes.NewShape(), name)

    def place(self, assembly: Any, part: Any, x: float, name: str) -> Any:
        from OCP.gp import gp_Trsf, gp_Vec
        from OCP.TopLoc import TopLoc_Location

        move = gp_Trsf()
        move.SetTranslation(gp_Vec(x, 0, 0))
        return self.named(self.shapes.AddComponent(assembly, part, TopLoc_Location(move)), name)

    def color(self, label: Any, red: float, green: float, blue: float) -> None:
        from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
        from OCP.XCAFDoc import XCAFDoc_ColorType

        color = Quantity_Color(red, green, blue, Quantity_TypeOfColor.Quantity_TOC_sRGB)
        self.colors.SetColor(label, color, XCAFDoc_ColorType.XCAFDoc_ColorSurf)

    def color_occurrence(self, instances: list[Any], red: float, green: float, blue: float) -> None:
        from OCP.TDF import TDF_LabelSequence
        from OCP.XCAFDoc import XCAFDoc_GraphNode

        from strake.importers.step.document import usages_of

        chain = TDF_LabelSequence()
        for label in instances:
            chain.Append(label)
        assert self.shapes.SetSHUO(chain, XCAFDoc_GraphNode())
        (usage,) = usages_of(instances[0])
        self.color(usage, red, green, blue)

    def write(self, file: Path) -> Path:
        from OCP.IGESCAFControl import IGESCAFControl_Writer
        from OCP.STEPCAFControl import STEPCAFControl_Writer

        self.shapes.UpdateAssemblies()
        writer = STEPCAFControl_Writer() if file.suffix == ".step" else IGESCAFControl_Writer()
        if file.suffix == ".step":
            writer.SetSHUOMode(True)
        writer.Transfer(self.document)
        writer.Write(str(file))
        return file


def solid(kind: str, *sizes: float) -> Any:
    from OCP import BRepPrimAPI

    return getattr(BRepPrimAPI, f"BRepPrimAPI_Make{kind}")(*sizes).Shape()


def rig(file: Path) -> Outcome:
    draft = Draft()
    bolt = draft.part(solid("Cylinder", 4.0, 30.0), "Bolt")
    draft.color(bolt, 0, 0, 1)
    bracket = draft.assembly("Bracket")
    left = draft.place(bracket, bolt, 0, "left")
    draft.place(bracket, bolt, 20, "right")
    whole = draft.assembly("Rig")
    draft.place(whole, bracket, 0, "first")
    second = draft.place(whole, bracket, 100, "second")
    draft.color_occurrence([second, left], 0, 1, 0)
    draft.place(whole, draft.part(solid("Box", 10.0, 20.0, 30.0), "Plate"), 200, "Plate")
    return convert(draft.write(file), module=STEP)


def color_of(outcome: Outcome, object_id: str) -> list[float]:
    glb = outcome.glb
    (primitive,) = glb.json["meshes"][glb.node(object_id)["mesh"]]["primitives"]
    factor: list[float] = glb.json["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorFactor"]
    return [round(share, 3) for share in factor[:3]]


def test_assemblies_instances_and_colours_of_occurrences(tmp_path: Path) -> None:
    outcome = rig(tmp_path / "rig.step")
    glb = outcome.glb
    assert outcome.reported("skipped") == outcome.reported("warning") == []
    assert sorted(glb.ids) == ["Rig/Plate", "Rig/first/left", "Rig/first/right", "Rig/second/left", "Rig/second/right"]
    assert glb.path("Rig/second/left") == ["Rig", "second"]
    assert glb.attributes("Rig/second/left") == {"Product": "Bolt", "Instance": "left"}
    assert [color_of(outcome, f"Rig/{name}") for name in ("first/left", "second/left", "second/right")] == [[0, 0, 1], [0, 1, 0], [0, 0, 1]]
    assert glb.volume("Rig/Plate") == pytest.approx(6000)
    assert glb.volume("Rig/first/left") == pytest.approx(math.pi * 16 * 30, rel=0.01)
    assert glb.node("Rig/first/left")["mesh"] == glb.node("Rig/second/right")["mesh"]
    assert [one["extras"]["sag_mm"] for one in glb.json["meshes"] if one["extras"]["sag_mm"] == 0] == [0]
    assert glb.box("Rig/second/left")[0] == pytest.approx([96, -4, 0], abs=0.02)


@pytest.mark.parametrize(("kind", "sizes", "volume"), [
    ("Sphere", (20.0,), 4 / 3 * math.pi * 8000),
    ("Torus", (30.0, 8.0), 2 * math.pi**2 * 30 * 64),
    ("Cone", (20.0, 0.0, 40.0), math.pi * 400 * 40 / 3),
])  # fmt: skip
def test_curved_solids_are_closed(tmp_path: Path, kind: str, sizes: tuple[float, ...], volume: float) -> None:
    draft = Draft()
    draft.part(solid(kind, *sizes), kind)
    outcome = convert(draft.write(tmp_path / "a.step"), module=STEP)
    assert outcome.reported("warning") == []
    assert outcome.glb.volume(kind) == pytest.approx(volume, rel=0.01)


def test_surfaces_of_iges_are_sewn(tmp_path: Path) -> None:
    draft = Draft()
    draft.part(solid("Box", 30.0, 20.0, 10.0), "Box")
    draft.part(solid("Cylinder", 5.0, 25.0).Moved(moved(100)), "Pin")
    outcome = convert(draft.write(tmp_path / "two.iges"), module=STEP)
    volumes = sorted(outcome.glb.volume(one) for one in outcome.glb.ids)
    assert volumes == [pytest.approx(math.pi * 25 * 25, rel=0.01), pytest.approx(6000, rel=1e-6)]
    assert outcome.lines[-1]["format"] == "IGES"


def moved(x: float) -> Any:
    from OCP.gp import gp_Trsf, gp_Vec
    from OCP.TopLoc import TopLoc_Location

    move = gp_Trsf()
    move.SetTranslation(gp_Vec(x, 0, 0))
    return TopLoc_Location(move)


CORNERS = [(x, y, z) for x in (0.0, 10.0) for y in (0.0, 20.0) for z in (0.0, 30.0)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def bare_face(sides: list[tuple[int, ...]], x: float = 0) -> Any:
    """A face of triangles without a surface, at a place along x."""
    from OCP.BRep import BRep_Builder
    from OCP.gp import gp_Pnt
    from OCP.Poly import Poly_Triangle, Poly_Triangulation
    from OCP.TopoDS import TopoDS_Face

    used = sorted({corner for side in sides for corner in side})
    triangles = [corners for a, b, c, d in sides for corners in ((a, b, c), (a, c, d))]
    made = Poly_Triangulation(len(used), len(triangles), False)
    for i, corner in enumerate(used, 1):
        made.SetNode(i, gp_Pnt(CORNERS[corner][0] + x, *CORNERS[corner][1:]))
    for i, corners in enumerate(triangles, 1):
        made.SetTriangle(i, Poly_Triangle(*(used.index(corner) + 1 for corner in corners)))
    face = TopoDS_Face()
    BRep_Builder().MakeFace(face, made)
    return face


def tessellated_box(kind: str) -> Any:
    """A box of triangles: a solid of one face or of six, a shell, or faces one beside the other."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound, TopoDS_Shell, TopoDS_Solid

    faces = [bare_face(SIDES)] if kind == "solid of one face" else [bare_face([side]) for side in SIDES]
    builder, shell, box, loose = BRep_Builder(), TopoDS_Shell(), TopoDS_Solid(), TopoDS_Compound()
    builder.MakeShell(shell)
    builder.MakeSolid(box)
    builder.MakeCompound(loose)
    for face in faces:
        builder.Add(loose if kind == "faces" else shell, face)
    if kind != "faces":
        shell.Closed(True)
        builder.Add(box, shell)
    return {"faces": loose, "shell": shell}.get(kind, box)


def write_with_triangles(draft: Draft, file: Path) -> Path:
    from OCP.Interface import Interface_Static
    from OCP.STEPCAFControl import STEPCAFControl_Writer

    STEPCAFControl_Writer()  # it has the settings made
    Interface_Static.SetIVal_s("write.step.schema", 5)
    Interface_Static.SetIVal_s("write.step.tessellated", 1)
    try:
        return draft.write(file)
    finally:
        Interface_Static.SetIVal_s("write.step.schema", 4)
        Interface_Static.SetIVal_s("write.step.tessellated", 2)


@pytest.mark.parametrize("kind", ["solid of one face", "solid of six faces", "shell", "faces"])
def test_triangles_of_ap242_are_read(tmp_path: Path, kind: str) -> None:
    draft = Draft()
    box = draft.part(tessellated_box(kind), "Box")
    whole = draft.assembly("Rig")
    draft.place(whole, box, 0, "left")
    draft.place(whole, box, 100, "right")
    draft.place(whole, draft.part(solid("Box", 5.0, 5.0, 5.0), "Plate"), 50, "Plate")
    file = write_with_triangles(draft, tmp_path / "rig.step")
    assert "TRIANGULATED_" in file.read_text()
    outcome = convert(file, module=STEP)
    assert outcome.reported("warning") == outcome.reported("skipped") == []
    assert outcome.lines[-1]["format"] == "STEP AP242"
    assert sorted(outcome.glb.ids) == ["Rig/Plate", "Rig/left", "Rig/right"]
    assert outcome.glb.volume("Rig/left") == pytest.approx(6000, rel=1e-6)
    assert outcome.glb.box("Rig/right")[1] == pytest.approx([110, 20, 30])
    # What the triangles stand for is not in the file.
    stated = {name: outcome.glb.json["meshes"][outcome.glb.node(name)["mesh"]].get("extras") for name in ("Rig/left", "Rig/Plate")}
    assert stated == {"Rig/left": None, "Rig/Plate": {"sag_mm": 0}}


def box_of_loose_faces(x: float) -> Any:
    """The six sides of a box, at a place along x, as faces of triangles that nothing holds together."""
    return [bare_face([side], x) for side in SIDES]


def loose_faces(folder: Path, names: list[str]) -> Outcome:
    """Converts one product of two boxes of faces that are in no shell; the file calls them by names, in its order."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound

    draft, loose, builder = Draft(), TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(loose)
    for face in (*box_of_loose_faces(0), *box_of_loose_faces(100)):
        builder.Add(loose, face)
    draft.part(loose, "Hull")
    file = write_with_triangles(draft, folder / "hull.step")
    called = iter(names)
    text, count = re.subn(r"(TRIANGULATED_SURFACE_SET\()'[^']*'", lambda found: f"{found[1]}'{next(called)}'", file.read_text())
    assert count == len(names) == 12
    file.write_text(text)
    return convert(file, module=STEP)


def test_loose_triangles_are_an_object_for_each_thing_that_hangs_together(tmp_path: Path) -> None:
    outcome = loose_faces(tmp_path, [""] * 12)
    assert outcome.reported("warning") == outcome.reported("skipped") == []
    assert sorted(outcome.glb.ids) == ["Hull/1", "Hull/2"]
    assert [outcome.glb.volume(name) for name in ("Hull/1", "Hull/2")] == [pytest.approx(6000, rel=1e-6)] * 2
    assert outcome.glb.box("Hull/2")[0] == pytest.approx([100, 0, 0])
    assert outcome.glb.attributes("Hull/1") == {"Product": "Hull"}


def test_loose_triangles_have_the_names_of_their_face_sets(tmp_path: Path) -> None:
    # Of the first box one side has a name of its own: it is a thing of its own.
    outcome = loose_faces(tmp_path, ["deck"] * 5 + ["hatch"] + [""] * 6)
    assert sorted(outcome.glb.ids) == ["Hull/3", "Hull/deck", "Hull/hatch"]
    assert outcome.glb.box("Hull/hatch")[0][2] == outcome.glb.box("Hull/hatch")[1][2] == pytest.approx(30)
    assert outcome.glb.volume("Hull/3") == pytest.approx(6000, rel=1e-6)


def test_triangles_beside_surfaces_are_not_taken_for_them(tmp_path: Path) -> None:
    from OCP.BRepMesh import BRepMesh_IncrementalMesh

    draft, ball = Draft(), solid("Sphere", 20.0)
    BRepMesh_IncrementalMesh(ball, 3.0)
    draft.part(ball, "Ball")
    file = write_with_triangles(draft, tmp_path / "ball.step")
    assert "TESSELLATED_SOLID" in file.read_text() and "MANIFOLD_SOLID_BREP" in file.read_text()
    outcome = convert(file, module=STEP)
    assert outcome.reported("warning") == [] and outcome.glb.ids == ["Ball"]
    assert outcome.glb.volume("Ball") == pytest.approx(4 / 3 * math.pi * 8000, rel=0.01)


def test_bytes_are_the_same_each_time(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    first = rig(tmp_path / "rig.step").output.read_bytes()
    assert convert(tmp_path / "rig.step", threads=1, module=STEP).output.read_bytes() == first


@pytest.mark.parametrize(("name", "text", "why"), [
    ("a.step", "", "is empty"),
    ("a.step", "Dear reader\n", "neither STEP nor IGES"),
    ("a.step", "ISO-10303-21;\nHEADER;\n", "ends too soon"),
    ("a.step", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nEND-ISO-10303-21;", "is an IFC model"),
    ("a.step", "PK\x03\x04", "zip archive"),
    ("a.igs", f"{'':72}S      1\n{'':72}G      1\n", "ends too soon"),
    ("a.step", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AP214'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n", ""),
])  # fmt: skip
def test_what_is_none_is_refused(tmp_path: Path, name: str, text: str, why: str) -> None:
    (tmp_path / name).write_text(text)
    outcome = convert(tmp_path / name, module=STEP)
    assert outcome.status != 0 and not outcome.output.exists()
    assert why in outcome.lines[-1]["error"] and outcome.lines[-1]["mend"]


@pytest.mark.skipif(not DATA, reason="STRAKE_DATA names no models")
def test_a_real_assembly() -> None:
    (file,) = Path(DATA).rglob("as1_pe_203.stp")
    outcome = convert_in_place(file)
    glb = outcome.glb
    assert len(glb.ids) == 18 and len(glb.json["meshes"]) == 5
    assert outcome.reported("skipped") == outcome.reported("warning") == []


def convert_in_place(file: Path) -> Outcome:
    """Converts a file of a folder that may not be written to."""
    import tempfile

    folder = Path(tempfile.mkdtemp())
    copy = folder / file.name
    copy.symlink_to(file)
    return convert(copy, module=STEP)
