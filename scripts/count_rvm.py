#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Counts what a binary RVM file holds, with a parser of its own.

An independent yardstick for the reader's tests: it shares no code with the product and follows the
stated chunk addresses, so it is for healthy files only. Prints one JSON object a file.
"""
import json
import math
import struct
import sys

PARAMETERS = {1: 7, 2: 3, 3: 4, 4: 3, 5: 2, 6: 2, 7: 9, 8: 2, 9: 1, 10: 2}
KINDS = {1: "pyramid", 2: "box", 3: "rectangular_torus", 4: "circular_torus",
         5: "elliptical_dish", 6: "spherical_dish", 7: "snout", 8: "cylinder", 9: "sphere",
         10: "line", 11: "facet_group"}


def text(data, at):
    words, = struct.unpack_from(">I", data, at)
    raw = data[at + 4:at + 4 + 4 * words].split(b"\0")[0]
    return raw.decode("utf-8", "replace"), at + 4 + 4 * words


def facet_counts(data, at):
    """Polygons, contours, vertices and fan triangles (vertices - 2 + 2 a hole) of a facet group."""
    polygons, = struct.unpack_from(">I", data, at)
    at += 4
    all_contours = all_vertices = triangles = 0
    for _ in range(polygons):
        contours, = struct.unpack_from(">I", data, at)
        at += 4
        polygon_vertices = 0
        for _ in range(contours):
            vertices, = struct.unpack_from(">I", data, at)
            at += 4 + 24 * vertices
            polygon_vertices += vertices
        all_contours += contours
        all_vertices += polygon_vertices
        triangles += polygon_vertices - 2 + 2 * (contours - 1)
    return polygons, all_contours, all_vertices, triangles, at


def count(data):
    out = {"head_version": 0, "groups": 0, "objects": 0, "primitives": 0, "obstructions": 0,
           "insulations": 0, "depth": 0, "kinds": {}, "polygons": 0, "contours": 0, "vertices": 0,
           "facet_triangles": 0, "nonfinite_matrices": 0, "largest_origin_m": 0.0}
    at, open_groups, direct = 0, [], set()
    while True:
        name = "".join(chr(c) for c in struct.unpack_from(">4I", data, at))
        following, = struct.unpack_from(">I", data, at + 16)
        body = at + 24
        if name == "END:":
            break
        if name == "HEAD":
            out["head_version"], = struct.unpack_from(">I", data, body)
        elif name == "CNTB":
            out["groups"] += 1
            open_groups.append(at)
            out["depth"] = max(out["depth"], len(open_groups))
        elif name == "CNTE":
            open_groups.pop()
        elif name in ("PRIM", "OBST", "INSU"):
            count_primitive(data, body, name, out)
            direct.add(open_groups[-1] if open_groups else -1)
        at = following
    out["objects"] = len(direct)
    return out


def count_primitive(data, body, name, out):
    out[{"PRIM": "primitives", "OBST": "obstructions", "INSU": "insulations"}[name]] += 1
    kind, = struct.unpack_from(">I", data, body + 4)
    matrix = struct.unpack_from(">12f", data, body + 8)
    if not all(math.isfinite(v) for v in matrix):
        out["nonfinite_matrices"] += 1
    out["largest_origin_m"] = max(out["largest_origin_m"], *(abs(v) for v in matrix[9:]))
    label = KINDS.get(kind, str(kind))
    out["kinds"][label] = out["kinds"].get(label, 0) + 1
    if kind == 11:
        at = body + 8 + 48 + 24 + (0 if name == "PRIM" else 4)
        polygons, contours, vertices, triangles, _ = facet_counts(data, at)
        out["polygons"] += polygons
        out["contours"] += contours
        out["vertices"] += vertices
        out["facet_triangles"] += triangles


def main():
    if len(sys.argv) < 2:
        print("usage: count_rvm.py FILE...", file=sys.stderr)
        return 2
    for path in sys.argv[1:]:
        with open(path, "rb") as file:
            counts = count(file.read())
        print(json.dumps({"file": path, **counts}, sort_keys=True))
    return 0


if __name__ == "__main__":
    sys.exit(main())
