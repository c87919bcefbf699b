# SPDX-License-Identifier: Apache-2.0
"""Compares the kernels of IfcOpenShell over a folder of IFC files: CPU seconds, products without a shape, volumes.

    PYTHONPATH=python python python/bench/ifc_kernels.py FOLDER [--csv products.csv] [--kernels a,b]

Each file and kernel is a process of its own with a limit of CPU time. Volumes are compared with those of opencascade at
a sag of 0.02 mm, so that they differ by what the kernels do and not by chords; `closed` shapes only, whose
edges are all shared by two triangles.
"""

from __future__ import annotations

import argparse
import csv
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

KERNELS = ("opencascade", "cgal-simple", "hybrid-cgal-simple-opencascade", "cgal", "manifold")
SAG_M = 0.00002
AGREE = 1e-3


def measure(path: str, kernel: str, sag_m: float) -> None:
    """Prints a JSON line for each product that gets a shape; last a line with the time."""
    import ifcopenshell.geom
    import numpy as np

    from strake.importers.ifc.conversion import tasks_of
    from strake.importers.ifc.kernels import geometry_settings, items_of
    from strake.importers.ifc.products import choose_products
    from strake.importers.ifc.source import open_model
    from strake.importers.report import Report

    with tempfile.TemporaryDirectory() as folder, Report(Path(folder) / "report") as report:
        model = open_model(Path(path), report, Path(folder))
    products = [model.by_id(number) for task in tasks_of(model, choose_products(model).solid) for number in task]
    for product in products:
        print(json.dumps({"n": product.id(), "class": product.is_a(), "items": sorted(items_of(product))}))
    settings = geometry_settings()
    settings.set("mesher-linear-deflection", sag_m)
    began = time.process_time()
    included = [model.file.by_id(product.id()) for product in products]
    iterator = ifcopenshell.geom.iterator(settings, model.file, 1, include=included, geometry_library=kernel)
    going = bool(products) and iterator.initialize()
    while going:
        shape = iterator.get()
        v = np.frombuffer(shape.geometry.verts_buffer, dtype="f8").reshape(-1, 3)
        t = np.frombuffer(shape.geometry.faces_buffer, dtype="i4").reshape(-1, 3)
        line: dict[str, object] = {"n": shape.id, "triangles": len(t)}
        if len(t):
            a, b, c = (v[t[:, k]] - v.mean(axis=0) for k in range(3))
            cross = np.cross(b - a, c - a)
            line["volume"] = float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)
            line["area"] = float(np.linalg.norm(cross, axis=1).sum() / 2)
            rounded = np.unique(np.round(v * 1e5), axis=0, return_inverse=True)[1].reshape(-1)[t]
            edges = np.concatenate([rounded[:, [0, 1]], rounded[:, [1, 2]], rounded[:, [2, 0]]])
            edges = edges[edges[:, 0] != edges[:, 1]]
            _, counts = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
            line["closed"] = bool((counts % 2 == 0).all())
        print(json.dumps(line))
        going = bool(iterator.next())
    print(json.dumps({"cpu_s": time.process_time() - began, "done": True}), flush=True)


def run_apart(path: Path, kernel: str, sag_m: float, limit_s: int) -> dict[str, object]:
    """Returns what a process of its own said: shapes by product, CPU seconds, how it ended."""
    command = [
        "bash",
        "-c",
        f'ulimit -t {limit_s}; exec "$0" "$@"',
        sys.executable,
        __file__,
        "--one",
        kernel,
        "--sag",
        str(sag_m),
        str(path),
    ]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=10 * limit_s, check=False)
    shapes: dict[int, dict[str, object]] = {}
    item_counts: dict[int, dict[str, object]] = {}
    cpu: object = None
    for text in ended.stdout.splitlines():
        try:
            line = json.loads(text)
        except ValueError:
            continue
        if not isinstance(line, dict):
            continue
        if "done" in line:
            cpu = line["cpu_s"]
        elif "items" in line:
            item_counts[line["n"]] = line
        elif line.get("triangles"):
            shapes[line["n"]] = line
    return {"shapes": shapes, "products": item_counts, "cpu_s": cpu, "status": ended.returncode, "said": ended.stderr[-300:]}


def disagrees(mine: dict[str, object], exact: dict[str, object], items: list[str]) -> bool:
    """Whether two closed shapes have different volumes; of surfaces, which enclose none, the areas are compared."""
    if any("SurfaceModel" in item for item in items):
        return abs(float(str(mine["area"])) - float(str(exact["area"]))) > AGREE * float(str(exact["area"]))
    volume, other = abs(float(str(mine["volume"]))), abs(float(str(exact["volume"])))
    chords = float(str(exact["area"])) * 2 * SAG_M
    return abs(volume - other) > AGREE * other + chords


def main() -> int:
    """Prints a table, and writes a row for each product that is missing or differs."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--one", metavar="KERNEL", help="measure a file in this process")
    parser.add_argument("--sag", type=float, default=SAG_M, metavar="METRES")
    parser.add_argument("--kernels", default=",".join(KERNELS))
    parser.add_argument("--limit", type=int, default=120, metavar="SECONDS")
    parser.add_argument("--csv", type=Path)
    options = parser.parse_args()
    if options.one:
        measure(str(options.folder), options.one, options.sag)
        return 0
    files = sorted(p for p in options.folder.rglob("*") if p.suffix.lower() in (".ifc", ".ifczip"))
    rows: list[list[object]] = []
    kernels = options.kernels.split(",")
    sums: dict[str, list[float]] = {kernel: [0.0] * 6 for kernel in kernels}
    for file in files:
        results = {kernel: run_apart(file, kernel, options.sag, options.limit) for kernel in kernels}
        exact = results[kernels[0]]
        products = exact["products"]
        assert isinstance(products, dict)
        for kernel in kernels:
            result, total = results[kernel], sums[kernel]
            shapes, others = result["shapes"], exact["shapes"]
            assert isinstance(shapes, dict) and isinstance(others, dict)
            total[0] += float(str(options.limit if result["cpu_s"] is None else result["cpu_s"]))
            total[1] += result["cpu_s"] is None
            for number, product in products.items():
                shape, other = shapes.get(number), others.get(number)
                fault = ""
                if shape is None:
                    total[2] += 1
                    fault = "missing" if other else "missing in both"
                elif not shape["closed"] and (other is None or other["closed"]):
                    total[3] += 1
                    fault = "open"
                elif other is not None and shape["closed"] and other["closed"]:
                    total[4] += 1
                    if disagrees(shape, other, product["items"]):
                        total[5] += 1
                        fault = f"volume {shape['volume']:.6g}, exact {other['volume']:.6g}"
                if (fault and kernel != kernels[0]) or fault.startswith("missing"):
                    rows.append([file.name, kernel, number, product["class"], "+".join(product["items"]), fault])
        print(file.name, {k: (r["cpu_s"] and round(float(str(r["cpu_s"])), 2), len(r["shapes"])) for k, r in results.items()}, flush=True)  # type: ignore[arg-type]
    print("| kernel | CPU s | files not finished | products missing | open | volumes compared | volumes that differ |")
    print("|---|---|---|---|---|---|---|")
    for kernel, (cpu, unfinished, missing, opened, compared, different) in sums.items():
        print(f"| {kernel} | {cpu:.1f} | {unfinished:.0f} | {missing:.0f} | {opened:.0f} | {compared:.0f} | {different:.0f} |")
    if options.csv:
        with options.csv.open("w", newline="") as out:
            csv.writer(out).writerows([["file", "kernel", "product", "class", "items", "fault"], *rows])
    return 0


if __name__ == "__main__":
    sys.exit(main())
