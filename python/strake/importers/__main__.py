# SPDX-License-Identifier: Apache-2.0
"""`strake-import`: calls the importer that a Python package declares for the suffix of a file."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path

from strake.importers.command import Job, run

GROUP = "strake.importers"


def importers() -> dict[str, EntryPoint]:
    """Returns the importers that are installed, by suffix."""
    return {entry.name.lower(): entry for entry in entry_points(group=GROUP)}


def main(arguments: Sequence[str] | None = None) -> int:
    """Lists the importers, or runs the one for `--input`."""
    parser = argparse.ArgumentParser(prog="strake-import", add_help=False)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--input", type=Path)
    options, _ = parser.parse_known_args(arguments)
    known = importers()
    if options.list:
        for suffix in sorted(known):
            print(f"{suffix}\t{known[suffix].value}")
        return 0

    def convert(job: Job) -> None:
        suffix = job.input.suffix.lower().lstrip(".")
        if suffix not in known:
            job.report.fail(
                f"no importer reads files that end in .{suffix}",
                f"install one; there are: {', '.join(sorted(known)) or 'none'}",
            )
        known[suffix].load()(job)

    return run(convert, arguments)


if __name__ == "__main__":
    sys.exit(main())
