# SPDX-License-Identifier: Apache-2.0
"""What the bytes of a file say of it before Open CASCADE sees any."""

from __future__ import annotations

import re
from pathlib import Path

from strake.importers.report import Report

_HEAD, _END = 1 << 16, 1 << 12
_PROTOCOLS = (
    ("AP242", "STEP AP242"),
    ("AP214", "STEP AP214"),
    ("AP203", "STEP AP203"),
    ("AP209", "STEP AP209"),
    ("AUTOMOTIVE_DESIGN", "STEP AP214"),
    ("CONFIG_CONTROL_DESIGN", "STEP AP203"),
    ("STRUCTURAL_FRAME", "STEP CIS/2"),
)
_IGES_LINE = re.compile(rb"^.{72}[SGDPT][ 0-9]{7}")


def format_of(file: Path, report: Report) -> str:
    """Returns "STEP AP214" or "IGES". Raises ImportFailed for what is neither, or cut off."""
    with file.open("rb") as source:
        head = source.read(_HEAD)
        source.seek(max(0, file.stat().st_size - _END))
        end = source.read().rstrip()
    if not head:
        report.fail("is empty", "export the model again")
    if head.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"ISO-10303-21"):
        return _step_format(head, end, report)
    if _IGES_LINE.match(head) and head[72:73] == b"S":
        last = end[end.rfind(b"\n") + 1 :]
        if not _IGES_LINE.match(last) or last[72:73] != b"T":
            report.fail("the file ends too soon: its last line is not the T line of IGES", "copy or export it again")
        return "IGES"
    if head.startswith(b"PK"):
        report.fail("the file is a zip archive", "unpack it and read what is in it")
    report.fail(
        "the file is neither STEP nor IGES: it does not begin with ISO-10303-21, nor has its first line an S in column 73",
        "export the model as STEP AP214 or AP242",
    )


def _step_format(head: bytes, end: bytes, report: Report) -> str:
    at = head.find(b"FILE_SCHEMA")
    schema = head[at : head.find(b";", at)].decode("latin-1") if at >= 0 else ""
    if "'IFC" in schema:
        report.fail(
            "the file is an IFC model, which this importer does not read",
            "name it .ifc and install its importer: pip install 'strake[ifc]'",
        )
    if b"END-ISO-10303-21" not in end:
        report.fail("the file ends too soon: END-ISO-10303-21 is missing at its end", "copy or export it again")
    return next((name for word, name in _PROTOCOLS if word in schema), "STEP")
