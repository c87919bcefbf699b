# SPDX-License-Identifier: Apache-2.0
"""Files that are refused, with a reason and what to do."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import pytest

pytest.importorskip("ifcopenshell")

from conversions import Outcome, convert
from ifc_model import IfcModel


def refused(path: Path) -> str:
    """Returns why a file is refused."""
    outcome: Outcome = convert(path)
    assert outcome.status == 1, outcome.lines
    assert not outcome.output.exists()
    assert outcome.lines[-1]["mend"]
    return str(outcome.lines[-1]["error"])


def good_file(folder: Path) -> bytes:
    model = IfcModel()
    model.product("IfcColumn", "c\u00e4", model.body(model.extrusion((1, 1, 1))))
    path: Path = model.write(folder / "good.ifc")
    return path.read_bytes()


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", "empty"),
        (b"\0" * 5000, "no IFC"),
        (b"solid x\nendsolid x\n", "no IFC"),
        (b"<?xml version='1.0'?><ifc:ifcXML/>", "ifcXML"),
        (b"ISO-10303-21;HEADER;ENDSEC;DATA;ENDSEC;END-ISO-10303-21;", "no schema"),
        (b"ISO-10303-21;HEADER;FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));ENDSEC;DATA;ENDSEC;END-ISO-10303-21;", "no IFC"),
        (b"ISO-10303-21;HEADER;FILE_SCHEMA(('IFC1X5'));ENDSEC;DATA;ENDSEC;END-ISO-10303-21;", "not read"),
        (b"PK\x03\x04 and then nothing", "damaged"),
    ],
)
def test_what_is_no_ifc(tmp_path: Path, content: bytes, why: str) -> None:
    path = tmp_path / "a.ifc"
    path.write_bytes(content)
    assert why in refused(path)


def test_a_file_that_ends_too_soon(tmp_path: Path) -> None:
    path = tmp_path / "a.ifc"
    data = good_file(tmp_path)
    path.write_bytes(data[: len(data) * 2 // 3])
    assert "too soon" in refused(path)


def test_numbers_that_are_none(tmp_path: Path) -> None:
    path = tmp_path / "a.ifc"
    path.write_bytes(good_file(tmp_path).replace(b"(0.,0.,1.)", b"(0.,0.,1E400)", 1))
    assert "1E400" in refused(path)


def test_units_that_are_none(tmp_path: Path) -> None:
    path = tmp_path / "a.ifc"
    data, count = re.subn(rb"(IFCPROJECT\(.*),#\d+\);", rb"\1,7);", good_file(tmp_path))
    assert count == 1
    path.write_bytes(data)
    assert "makes no shapes of it" in refused(path)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    assert "no such file" in refused(tmp_path / "a.ifc")


def test_archives(tmp_path: Path) -> None:
    data = good_file(tmp_path)

    def packed(name: str, **members: bytes) -> Path:
        path = tmp_path / name
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            for member, content in members.items():
                archive.writestr(member.replace("_", "."), content)
        return path

    assert len(convert(packed("one.ifczip", model_ifc=data, notes_txt=b"x")).glb.ids) == 1
    assert "2 files" in refused(packed("two.ifczip", a_ifc=data, b_ifc=data))
    assert "0 files" in refused(packed("none.ifczip", a_txt=data))
    assert "so densely" in refused(packed("bomb.ifczip", a_ifc=b"\0" * (64 << 20)))


def test_an_archive_that_lies_about_its_size(tmp_path: Path) -> None:
    path = tmp_path / "liar.ifczip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.ifc", b"\0" * (8 << 20))
    data = bytearray(path.read_bytes())
    size = (8 << 20).to_bytes(4, "little")
    data = bytearray(bytes(data).replace(size, (1000).to_bytes(4, "little")))
    path.write_bytes(data)
    refused(path)


def test_deep_nesting_and_rubbish_end_with_a_reason_or_are_left_out(tmp_path: Path) -> None:
    data = good_file(tmp_path)
    for name, bad in (
        ("deep", b"#900=IFCPROPERTYSINGLEVALUE('x',$," + b"IFCLABEL(" * 200_000 + b"'x'" + b")" * 200_000 + b",$);"),
        ("lists", b"#900=IFCCARTESIANPOINT(" + b"(" * 300_000 + b"1." + b")" * 300_000 + b");"),
        ("latin", b"#900=IFCLABEL('\xff\xfe\xc3');"),
        ("unknown", b"#900=IFCNOSUCHTHING(1,2,3);"),
        ("missing", b"#900=IFCLOCALPLACEMENT(#123456,#99999);"),
    ):
        path = tmp_path / f"{name}.ifc"
        path.write_bytes(data.replace(b"DATA;", b"DATA;\n" + bad, 1))
        outcome = convert(path)
        if outcome.status:
            assert outcome.status == 1 and outcome.lines[-1]["error"] and outcome.lines[-1]["mend"]
        else:
            assert len(outcome.glb.ids) == 1


def test_names_in_no_utf8(tmp_path: Path) -> None:
    path = tmp_path / "a.ifc"
    path.write_bytes(good_file(tmp_path).replace(b"c\\X\\E4", b"c\xe4\xff").replace(b"c\\X2\\00E4\\X0\\", b"c\xe4\xff"))
    outcome = convert(path)
    assert len(outcome.glb.ids) == 1
