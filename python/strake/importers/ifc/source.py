# SPDX-License-Identifier: Apache-2.0
"""Opens the file, whatever wraps it, and refuses what is no IFC."""

from __future__ import annotations

import re
import shutil
import zipfile
from pathlib import Path
from typing import Any

import ifcopenshell
from ifcopenshell import ifcopenshell_wrapper

from strake.importers.ifc.entity import Model
from strake.importers.ifc.pinched import faces_by_text
from strake.importers.report import Report

_EXPORT = "export the model as IFC (STEP) again, in version IFC4 or IFC2x3"
# Text of IFC is packed to a tenth or so; what is packed a thousandfold is no model.
_MAX_RATIO = 200
_MAX_BYTES = 16 << 30
_HEAD_BYTES = 1 << 16
_TAIL_BYTES = 1 << 12


def open_model(path: Path, report: Report, folder: Path) -> Model:
    """Returns the model of a file. What is packed is unpacked into `folder`."""
    with path.open("rb") as file:
        head = file.read(_HEAD_BYTES)
    if not head:
        report.fail("the file is empty", _EXPORT)
    if head.startswith(b"PK\x03\x04"):
        path = _unpacked(path, report, folder)
        with path.open("rb") as file:
            head = file.read(_HEAD_BYTES)
    _check_head(head, report)
    _check_end(path, report)
    return _opened(path, report)


def _unpacked(path: Path, report: Report, folder: Path) -> Path:
    try:
        with zipfile.ZipFile(path) as archive:
            members = [m for m in archive.infolist() if not m.is_dir() and _is_ours(m.filename)]
            names = sorted({Path(m.filename).suffix.lower() for m in archive.infolist() if not m.is_dir()})
            if len(members) != 1:
                report.fail(
                    f"the archive has {len(members)} files that end in .ifc, and must have one (it has {', '.join(names) or 'no file'})",
                    "unpack it, and give the .ifc files one by one",
                )
            member = members[0]
            if member.flag_bits & 1:
                report.fail("the archive is encrypted", "unpack it with its password, and give the .ifc file")
            if member.file_size > min(_MAX_BYTES, _MAX_RATIO * max(member.compress_size, 1 << 16)):
                report.fail(
                    f"the archive would be {member.file_size} bytes of {member.compress_size}: no model is packed so densely",
                    "unpack it, and give the .ifc file, if it is one",
                )
            target = folder / "model.ifc"
            with archive.open(member) as packed, target.open("wb") as out:
                # A directory that lies about the size is caught by the reader, which stops at what it states.
                shutil.copyfileobj(packed, out, 1 << 20)
            return target
    except (zipfile.BadZipFile, EOFError, NotImplementedError, ValueError) as fault:
        report.fail(f"the archive is damaged: {fault}", "copy or download it again")


def _is_ours(name: str) -> bool:
    return Path(name).suffix.lower() == ".ifc" and not Path(name).name.startswith(".") and "__MACOSX" not in name


def _check_head(head: bytes, report: Report) -> None:
    text = head.lstrip(b"\xef\xbb\xbf \t\r\n")
    if text.startswith(b"<") and (b"ifc" in text[:4096].lower()):
        report.fail("the file is ifcXML, which is not read", _EXPORT)
    if not text.startswith(b"ISO-10303-21"):
        report.fail("the file is no IFC: it does not begin with ISO-10303-21", _EXPORT)
    schema = re.search(rb"FILE_SCHEMA\s*\(\s*\(\s*'([^']*)'", text, re.IGNORECASE)
    if schema is None:
        report.fail("the header states no schema", _EXPORT)
    name = schema.group(1).decode("latin-1").upper()
    if not name.startswith("IFC"):
        report.fail(f"the schema is {name}, which is no IFC", "give a file of IFC2x3, IFC4 or IFC4x3")
    if not re.match(r"IFC(2X3|4($|X3|_|X[12]))", name):
        report.fail(f"the version is {name}, which is not read", "export the model as IFC2x3, IFC4 or IFC4x3")


def _check_end(path: Path, report: Report) -> None:
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - _TAIL_BYTES))
        if b"END-ISO-10303-21" not in file.read():
            report.fail("the file ends too soon: END-ISO-10303-21 is missing", "copy or export it again: part of it is lost")


def _opened(path: Path, report: Report) -> Model:
    log: Any = ifcopenshell_wrapper.logger()
    log.output_format(log.FMT_INMEMORY)
    try:
        model = Model(ifcopenshell.open(path, format=".ifc", logger=log))
    except (ifcopenshell.Error, ifcopenshell.SchemaError, OSError, RuntimeError, ValueError) as fault:
        fault_text = _first_fault(log) or str(fault)
        report.fail(f"IfcOpenShell cannot read it: {fault_text}", _EXPORT)
    model.pinched = faces_by_text(model, path)
    if not model.by_type("IfcProject"):
        report.warning("ifc-no-project", "the file has no IfcProject: units are taken to be metres")
    if fault_text := _first_fault(log):
        report.warning("ifc-syntax", f"faults of syntax, the first: {fault_text}")
    return model


def origin_of(model: Model) -> dict[str, str]:
    """Returns what a file says of itself, as attributes: `Project` and `ProjectId`, the GlobalId of its IfcProject, and
    `FileDate`, when it was written."""
    origin = {}
    for project in model.by_type("IfcProject")[:1]:
        origin = {"Project": project.Name or project.is_a(), "ProjectId": project.GlobalId}
    if date := str(model.file.header.file_name.time_stamp or ""):
        origin["FileDate"] = date
    return origin


def _first_fault(log: Any) -> str:
    """Returns the first fault that IfcOpenShell found while it read, where it found any."""
    for message in log.log_messages():
        if message.severity_string == "ERROR":
            return str(message.message).strip()[:300]
    return ""
