# SPDX-License-Identifier: Apache-2.0
"""Damaged IFC files: each is read, or refused with a reason, and none takes long.

`STRAKE_IFC_MUTATIONS` says how many are made.
"""

from __future__ import annotations

import os
import random
import re
import time
from pathlib import Path

import pytest

pytest.importorskip("ifcopenshell")

from conversions import convert
from ifc_model import IfcModel

COUNT = int(os.environ.get("STRAKE_IFC_MUTATIONS", "12"))
# A product may take a minute in each of three kernels; what has no end takes half as long each time.
MAX_S = 240
NUMBERS = (b"1.E300", b"-1.E30", b"0.", b"1.E-300", b"1.E9", b"-1.", b"$", b"*", b"()")


def house(folder: Path) -> bytes:
    """A file with something of all that the importer looks at."""
    model = IfcModel()
    storey = model.storey("Level 1", 0)
    wall = model.product("IfcWall", "wall", model.body(model.extrusion((4000, 200, 2500))), within=storey)
    model.fill(
        model.void(wall, model.body(model.extrusion((1000, 400, 1000), (0, 0, 900)))),
        model.product("IfcWindow", "window", model.body(model.extrusion((1000, 60, 1000))), (0, 0, 900)),
    )
    pipe = model.cylinder(50, 3000)
    model.color(pipe, 0.2, 0.4, 0.6, 0.5)
    model.product("IfcFlowSegment", "pipe", model.body(pipe), (1000, 0, 0), storey)
    chair = model.mapped(model.body(model.extrusion((400, 400, 900))))
    for i in range(2):
        model.product("IfcFurniture", f"seat {i}", model.body(model.use(chair), kind="MappedRepresentation"), (i * 1000, 900, 0), storey)
    corners = [(x, y, z) for x in (0, 100) for y in (0, 100) for z in (0, 100)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    model.product("IfcFooting", "block", model.body(model.faceted(corners, faces), kind="Brep"), within=storey)
    model.properties(wall, "Pset_WallCommon", {"FireRating": ("IfcLabel", "F60"), "Length": ("IfcLengthMeasure", 4.0)})
    return model.write(folder / "house.ifc").read_bytes()


def mutated(chance: random.Random, data: bytes) -> bytes:
    """The file with a few faults of one kind: in bytes, lines, values, references or classes, or with its end cut off."""
    kind = chance.randrange(6)
    if kind == 0:
        damaged = bytearray(data)
        for _ in range(chance.randint(1, 8)):
            damaged[chance.randrange(len(damaged))] = chance.randrange(256)
        return bytes(damaged)
    if kind == 1:
        lines = data.split(b"\n")
        first = chance.randrange(len(lines))
        return b"\n".join(lines[:first] + lines[first + chance.randint(1, 3) :])
    if kind == 2:
        return data[: chance.randrange(len(data))] + b"\nENDSEC;\nEND-ISO-10303-21;\n"
    pattern = {3: rb"(?<![#\w])-?\d+\.\d*(?:E[+-]?\d+)?", 4: rb"(?<==)IFC\w+|#\d+", 5: rb"#\d+(?!=)"}[kind]
    places = [found.span() for found in re.finditer(pattern, data)]
    for first, last in sorted(chance.sample(places, min(len(places), chance.randint(1, 4))), reverse=True):
        other = chance.choice(places)
        data = data[:first] + (chance.choice(NUMBERS) if kind == 3 else data[other[0] : other[1]]) + data[last:]
    return data


@pytest.mark.parametrize("seed", range(COUNT))
def test_a_damaged_file_is_read_or_refused_with_a_reason(tmp_path: Path, seed: int) -> None:
    data = mutated(random.Random(seed), house(tmp_path))
    path = tmp_path / "damaged.ifc"
    path.write_bytes(data)
    began = time.monotonic()
    outcome = convert(path)
    assert time.monotonic() - began < MAX_S
    if outcome.status == 0:
        assert outcome.glb.ids and outcome.lines[-1]["made_by"]
    else:
        assert outcome.status == 1 and not outcome.output.exists()
        assert outcome.lines[-1]["error"] and outcome.lines[-1]["mend"]
