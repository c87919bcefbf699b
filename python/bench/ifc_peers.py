# SPDX-License-Identifier: Apache-2.0
"""Clashes of IFC files by IfcOpenShell's own functions, by ifcclash and by strake, from the same triangles.

    python ifc_peers.py A.ifc B.ifc [C.ifc ...] [--tolerance 2] [--clearance 25]

IfcOpenShell reads the files and makes their triangles; these are what strake is given, too. Each pair of files is tested. A
table says what each found and in which time, then each pair of objects that they judge differently is listed by why, with how
deep they are and the volume that manifold3d finds in common, which knows nothing of either. Needs `ifcopenshell`, `ifcclash`,
`manifold3d`.
"""

from __future__ import annotations

import argparse
import logging
import multiprocessing
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Pair = tuple[str, str]  # a product of the first file, one of the second: two files may have one with the same id
Triangles = tuple[NDArray[np.float64], NDArray[np.int32]]


# How often what takes milliseconds is timed.
REPEAT = 5
# What the grid may account for, and no more: within it objects touch.
GRID_MM = 0.008


@dataclass
class File:
    """One IFC file as IfcOpenShell has it. Lengths are metres."""

    path: Path
    model: Any
    products: list[Any]
    triangles: dict[str, Triangles] = field(default_factory=dict)

    def label(self, guid: str) -> str:
        """Class and name of a product."""
        product = self.model.by_guid(guid)
        return f"{product.is_a()} '{product.Name or ''}'"


def seconds(call: Callable[[], Any], repeat: int = 1) -> tuple[float, float, Any]:
    """CPU and wall time of a call, with that of its children, and what it returned; of several calls the medians."""
    cpus, walls, result = [], [], None
    for _ in range(repeat):
        before, began = _cpu_s(), time.perf_counter()
        result = call()
        cpus.append(_cpu_s() - before)
        walls.append(time.perf_counter() - began)
    return statistics.median(cpus), statistics.median(walls), result


def _cpu_s() -> float:
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def read(path: Path, tree: Any, threads: int) -> File:
    """Reads a file by the kernel and the settings that IfcOpenShell takes by itself."""
    import ifcopenshell
    import ifcopenshell.geom

    from strake.importers import Report
    from strake.importers.ifc.products import choose_products
    from strake.importers.ifc.source import open_model

    with tempfile.TemporaryDirectory() as folder, Report(Path(folder) / "report") as report:
        model = open_model(path, report, Path(folder))
    solid = [model.file.by_id(product.id()) for product in choose_products(model).solid]
    file = File(path, model.file, solid)
    iterator = ifcopenshell.geom.iterator(ifcopenshell.geom.settings(), file.model, threads, include=file.products)
    going = bool(file.products) and iterator.initialize()
    while going:
        element = iterator.get()
        tree.add_element(element)
        placement = np.array(element.transformation.matrix).reshape(4, 4).T
        vertices: NDArray[np.float64] = np.frombuffer(element.geometry.verts_buffer, "f8").reshape(-1, 3)
        faces: NDArray[np.int32] = np.frombuffer(element.geometry.faces_buffer, "i4").reshape(-1, 3)
        if len(faces):
            file.triangles[element.guid] = (vertices @ placement[:3, :3].T + placement[:3, 3], faces.copy())
        going = bool(iterator.next())
    return file


def welded(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> Triangles:
    """The same triangles with one vertex at each place: IfcOpenShell has one for each face."""
    _, first, number = np.unique(np.round(vertices * 1e6), axis=0, return_index=True, return_inverse=True)
    return vertices[first], number.reshape(-1)[faces].astype(np.int32)


def common_volume(a: Triangles, b: Triangles) -> str:
    """What two meshes have in common, as text. In a process of its own: meshes of some files end manifold3d."""
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=lambda: theirs.send(_volume(a, b)))
    process.start()
    theirs.close()
    try:
        volume: float | None = ours.recv()
    except EOFError:
        return "manifold3d crashes"
    finally:
        process.join()
    return "not closed for manifold3d" if volume is None else f"{volume:.6g} mm3 in common"


def _volume(a: Triangles, b: Triangles) -> float | None:
    from manifold3d import Error, Manifold, Mesh64

    solids = []
    for mesh in (a, b):
        vertices, faces = welded(*mesh)
        solid = Manifold(Mesh64(vertices * 1000, faces.astype(np.uint64)))
        if solid.status() != Error.NoError or solid.is_empty():
            return None
        solids.append(solid)
    return float((solids[0] ^ solids[1]).volume())


def in_order(named: Iterable[Pair], a: File, b: File) -> set[Pair]:
    """Pairs of objects, that of the first file first: some are named the other way round."""
    return {(x, y) if x in a.triangles and y in b.triangles else (y, x) for x, y in named}


def named(results: Any) -> list[Pair]:
    """The pairs of objects that a function of IfcOpenShell names."""
    return [(one.a.get_argument(0), one.b.get_argument(0)) for one in results]


def peers(tree: Any, a: File, b: File, tolerance_mm: float, clearance_mm: float) -> Iterator[tuple[str, Callable[[], list[Pair]]]]:
    """The functions of IfcOpenShell, by name."""
    first, second = a.products, b.products
    yield (
        f"intersection, tolerance {tolerance_mm:g} mm",
        lambda: named(tree.clash_intersection_many(first, second, tolerance=tolerance_mm / 1000, check_all=True)),
    )
    yield "collision", lambda: named(tree.clash_collision_many(first, second, allow_touching=False))
    yield "collision or touch", lambda: named(tree.clash_collision_many(first, second, allow_touching=True))
    yield (
        f"clearance {clearance_mm:g} mm",
        lambda: named(tree.clash_clearance_many(first, second, clearance=clearance_mm / 1000, check_all=True)),
    )


def by_ifcclash(a: Path, b: Path, tolerance_mm: float) -> list[Pair]:
    """What the package finds: it reads the files itself."""
    from ifcclash import ifcclash

    settings = ifcclash.ClashSettings()
    settings.logger = logging.getLogger("ifcclash")
    clasher = ifcclash.Clasher(settings)
    one: Any = {
        "name": "all",
        "mode": "intersection",
        "a": [{"file": str(a)}],
        "b": [{"file": str(b)}],
        "tolerance": tolerance_mm / 1000,
        "check_all": True,
    }
    clasher.clash_sets = [one]
    clasher.clash()
    return [(clash["a_global_id"], clash["b_global_id"]) for clash in one["clashes"].values()]


def load_times(paths: list[Path]) -> None:
    """Prints how long strake reads the files: for the first time, and from the scenes that are kept."""
    code = "import sys, strake; print(len(strake.load(sys.argv[1:])))"
    with tempfile.TemporaryDirectory() as cache:
        for what in ("strake, first load", "strake, from kept scenes"):
            command = [sys.executable, "-c", code, *map(str, paths)]
            cpu, wall, done = seconds(
                lambda command=command: subprocess.run(  # type: ignore[misc]
                    command, env={**os.environ, "STRAKE_CACHE": cache}, capture_output=True, text=True, check=True
                )
            )
            print(f"| {what} | {done.stdout.strip()} | {cpu:.2f} | {wall:.2f} |")


def compare(a: File, b: File, tree: Any, tolerance_mm: float, clearance_mm: float) -> None:
    """Prints what each finds between two files, and what they judge differently."""
    import strake

    meshes = [
        strake.Mesh(f"{side}{guid}", vertices * 1000, faces)
        for side, file in (("A", a), ("B", b))
        for guid, (vertices, faces) in ((guid, welded(*mesh)) for guid, mesh in file.triangles.items())
    ]
    model = strake.Model.from_arrays(meshes)
    in_a = np.array([name.startswith("A") for name in model.names])

    def find() -> strake.Clashes:
        return strake.clash(model, a=in_a, b=~in_a, clearance=clearance_mm, touch_overlap=tolerance_mm, thickness_cap=False)

    cpu, wall, found = seconds(find, REPEAT)
    separations = {tuple(name[1:] for name in sorted((one.a_id, one.b_id))): one for one in found}
    print(f"\n### {a.path.name} against {b.path.name}\n\n| what | pairs | CPU s | s |\n|---|---|---|---|")
    of_kind = Counter(one.kind.name for one in found)
    print(f"| strake: {', '.join(f'{of_kind[k]} {k}' for k in sorted(of_kind))} | {len(found)} | {cpu:.4f} | {wall:.4f} |")
    found_by: dict[str, set[Pair]] = {}
    for name, call in peers(tree, a, b, tolerance_mm, clearance_mm):
        cpu, wall, results = seconds(call, REPEAT)
        found_by[name] = in_order(results, a, b)
        print(f"| {name} | {len(found_by[name])} | {cpu:.4f} | {wall:.4f} |")
    if ".ifczip" not in (a.path.suffix.lower(), b.path.suffix.lower()):
        cpu, wall, packaged = seconds(lambda: by_ifcclash(a.path, b.path, tolerance_mm))
        print(f"| ifcclash, intersection, with reading | {len(packaged)} | {cpu:.2f} | {wall:.2f} |")
    of_strake = {
        "intersection": {pair for pair, one in separations.items() if one.kind == strake.Kind.HIT},
        "collision": {pair for pair, one in separations.items() if one.separation < -GRID_MM},
        "collision or touch": {pair for pair, one in separations.items() if one.separation <= GRID_MM},
        "clearance": set(separations),
    }
    for name, theirs in found_by.items():
        ours = of_strake[name.split(",")[0] if "," in name else name.rsplit(" ", 2)[0] if name.startswith("clearance") else name]
        print(f"\n{name}: {len(ours & theirs)} in both, {len(ours - theirs)} of strake alone, {len(theirs - ours)} of IfcOpenShell alone")
        for who, some in (("strake", ours - theirs), ("IfcOpenShell", theirs - ours)):
            reasons = sorted((why(separations.get(pair), tolerance_mm), described(pair, a, b, separations)) for pair in some)
            for reason, count in sorted(Counter(reason for reason, _ in reasons).items()):
                print(f"  {who} alone, {reason}: {count}")
                print("".join(f"    {text}\n" for other, text in reasons if other == reason), end="")


def why(one: Any, tolerance_mm: float) -> str:
    """The class of a disagreement, by what strake measured."""
    if one is None:
        return "farther apart than the clearance"
    if one.flags.name and "OPEN" in one.flags.name:
        return "one of them is open"
    if abs(one.separation) <= GRID_MM:
        return "they touch"
    if -one.separation <= tolerance_mm and one.separation < 0:
        return "less deep than the tolerance"
    return "apart" if one.separation > 0 else "deeper than the tolerance"


def described(pair: Pair, a: File, b: File, separations: dict[Pair, Any]) -> str:
    """One pair that they judge differently, with what decides."""
    one = separations.get(pair)
    volume = common_volume(a.triangles[pair[0]], b.triangles[pair[1]])
    ours = "nothing" if one is None else f"{one.kind.name} {one.relation.name} {one.separation:.6f} mm"
    return f"{a.label(pair[0])} {pair[0]} and {b.label(pair[1])} {pair[1]}: {ours}, {volume}"


def main() -> int:
    """Prints the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", type=Path, nargs="+")
    parser.add_argument("--tolerance", type=float, default=2.0, metavar="MM", help="how deep is no hit")
    parser.add_argument("--clearance", type=float, default=25.0, metavar="MM")
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    import ifcopenshell.geom

    print("| load | objects | CPU s | s |\n|---|---|---|---|")
    load_times(options.files)
    tree = ifcopenshell.geom.tree(backend="opencascade.trianglebvh")
    cpu, wall, files = seconds(lambda: [read(path, tree, options.threads) for path in options.files])
    print(f"| IfcOpenShell, default kernel, with the tree | {sum(len(file.triangles) for file in files)} | {cpu:.2f} | {wall:.2f} |")
    for a, b in combinations(files, 2):
        compare(a, b, tree, options.tolerance, options.clearance)
    return 0


if __name__ == "__main__":
    sys.exit(main())
