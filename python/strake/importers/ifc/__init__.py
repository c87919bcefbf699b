# SPDX-License-Identifier: Apache-2.0
"""Reads IFC2x3, IFC4 and IFC4x3 (.ifc, .ifczip) by IfcOpenShell."""

from __future__ import annotations

from collections.abc import Sequence

from strake.importers.command import Job, run
from strake.importers.ifc.library import load_ifcopenshell
from strake.importers.several import run_several


def import_ifc(job: Job) -> None:
    """Converts an IFC file."""
    try:
        load_ifcopenshell()
    except ImportError as missing:
        job.report.fail(f"IfcOpenShell cannot be loaded: {missing}", _mend_of(missing))
    from strake.importers.ifc.convert import convert

    convert(job)


def _mend_of(missing: ImportError) -> str:
    # What is installed may be built for a newer system than this one.
    if "GLIBC" in str(missing):
        return "it wants a newer system, with the C++ library of GCC 11: import there, and go on with `strake convert FILE.ifc FILE.glb`"
    return "pip install 'strake[ifc]'"


def main(arguments: Sequence[str] | None = None) -> int:
    """The program `strake-import-ifc`."""
    return run(import_ifc, arguments)


def main_of_several() -> int:
    """The program `strake-import-many-ifc`."""
    return run_several(import_ifc, _load)


def _load() -> None:
    load_ifcopenshell()
    from strake.importers.ifc import convert  # noqa: F401
