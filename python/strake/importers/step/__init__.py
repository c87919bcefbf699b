# SPDX-License-Identifier: Apache-2.0
"""The importer of STEP and IGES by Open CASCADE, where the program strake-import-step is not there (docs/formats/step.md)."""

from __future__ import annotations

from strake.importers.command import Job


def import_step(job: Job) -> None:
    """Makes a neutral scene of a STEP or IGES file. The error says what to install where Open CASCADE lacks."""
    try:
        import OCP.STEPCAFControl  # noqa: F401
    except ImportError:
        job.report.fail(
            "STEP and IGES files are read by Open CASCADE, which is not installed",
            "run: pip install 'strake[step]', or ./run step in the sources of Strake",
        )
    from strake.importers.step.convert import convert

    convert(job)


__all__ = ["import_step"]
