# SPDX-License-Identifier: Apache-2.0
"""Converts all IFC files of a folder and prints a row of Markdown for each.

    PYTHONPATH=python python python/bench/ifc_files.py FOLDER [--keep SCENES] [--threads N]

Products are counted by IfcOpenShell apart from the importer: those with a representation, those that are left out
included. The importer must account for each of them.
"""

from __future__ import annotations

import argparse
import json
import re
import resource
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Any


def products_in(path: Path) -> str:
    """Returns how many products with a representation a file has."""
    script = (
        "import ifcopenshell, sys; "
        "print(sum(p.Representation is not None for p in ifcopenshell.open(sys.argv[1], format='.ifc').by_type('IfcProduct')))"
    )
    with tempfile.TemporaryDirectory() as folder:
        if zipfile.is_zipfile(path):
            with zipfile.ZipFile(path) as archive:
                path = Path(archive.extract(next(n for n in archive.namelist() if n.lower().endswith(".ifc")), folder))
        ended = subprocess.run([sys.executable, "-c", script, str(path)], capture_output=True, text=True, check=False)
    return ended.stdout.strip() or "-"


def convert(path: Path, scene: Path, threads: int) -> tuple[list[dict[str, Any]], float]:
    """Converts a file; returns the lines of the report and the CPU seconds that it took."""
    report = scene.with_suffix(".jsonl")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    arguments = ["--input", str(path), "--output", str(scene), "--report", str(report), "--threads", str(threads)]
    subprocess.run([sys.executable, "-m", "strake.importers.ifc", *arguments], check=False, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    lines = [json.loads(line) for line in report.read_text("utf-8").splitlines()]
    return lines, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--keep", type=Path, help="a folder for the scenes")
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    print("| file | schema | products | converted | left out | no body | failed | CPU s | result |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(p for p in options.folder.rglob("*") if p.suffix.lower() in (".ifc", ".ifczip")):
            scene = (options.keep or Path(folder)) / f"{path.name}.glb"
            lines, seconds = convert(path, scene, options.threads)
            last = lines[-1] if lines else {}
            failed = sum(line.get("severity") == "skipped" for line in lines)
            warned = sum(line.get("severity") == "warning" for line in lines)
            left_out = bodyless = 0
            for line in lines:
                if line.get("code") == "ifc-left-out":
                    left_out = sum(int(n) for n in re.findall(r"\d+", line["message"]))
                if line.get("code") == "ifc-no-shape-stated":
                    bodyless = int(line["message"].split()[0])
            result = last.get("error") or ("read" if not warned else f"read, {warned} warnings")
            objects = "-"
            if "error" not in last and scene.exists():
                data = scene.read_bytes()
                nodes = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")]).get("nodes", [])
                objects = str(sum("mesh" in node for node in nodes))
            row = [path.name, last.get("format", "-"), products_in(path), objects, left_out, bodyless, failed, f"{seconds:.1f}", result]
            print("| " + " | ".join(str(cell) for cell in row) + " |", flush=True)


if __name__ == "__main__":
    main()
