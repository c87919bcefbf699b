# SPDX-License-Identifier: Apache-2.0
"""Reads IFC2x3, IFC4 and IFC4x3 (.ifc, .ifczip) by IfcOpenShell."""

from __future__ import annotations

from collections.abc import Sequence

from strake.importers.command import Job, run
from strake.importers.ifc.library import load_ifcopenshell


def import_ifc(job: Job) -> None:
    """Converts an IFC file."""
    try:
        load_ifcopenshell()
    except ImportError as missing:
        job.report.fail(f"IfcOpenShell cannot be loaded: {missing}", "pip install 'strake[ifc]'")
    from strake.importers.ifc.convert import convert

    convert(job)


def main(arguments: Sequence[str] | None = None) -> int:
    """The program `strake-import-ifc`."""
    return run(import_ifc, arguments)
