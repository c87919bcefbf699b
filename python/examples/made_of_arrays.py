# SPDX-License-Identifier: Apache-2.0
"""A model that is made of arrays: a parametric layout is tested while it is computed."""

# %% A plate of 10 mm, and a pipe as a prism of twelve sides
import numpy as np

import strake

plate_corners = np.array([(x, y, z) for z in (0, 10) for x, y in ((0, 0), (2000, 0), (2000, 1000), (0, 1000))], dtype=float)
sides = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
plate_triangles = [three for a, b, c, d in sides for three in ((a, b, c), (a, c, d))]

angles = np.linspace(0, 2 * np.pi, 12, endpoint=False)
circle = np.column_stack([50 * np.cos(angles), 50 * np.sin(angles)])
pipe_corners = np.vstack([np.column_stack([circle, np.full(12, z)]) for z in (-300.0, 300.0)])
pipe_triangles = [(0, i + 1, i) for i in range(1, 11)] + [(12, 12 + i, 13 + i) for i in range(1, 11)]
for i in range(12):
    j = (i + 1) % 12
    pipe_triangles += [(i, j, 12 + j), (i, 12 + j, 12 + i)]


# %% Pipes at some places: they share one shape
def layout(places: list[tuple[float, float, float]]) -> strake.Model:
    meshes = [strake.Mesh("plate", plate_corners, plate_triangles, path="STEEL")]
    for i, at in enumerate(places):
        placement = np.column_stack([np.eye(3), at])
        meshes.append(strake.Mesh(f"pipe {i}", pipe_corners, pipe_triangles, {"DN": "100"}, placement, "PIPING"))
    return strake.Model.from_arrays(meshes)


# %% Move the pipes up, a millimetre more than is lacking, until none is nearer than 25 mm to the plate
height = 300.0
for _ in range(10):
    model = layout([(x, 500.0, height) for x in (300.0, 900.0, 1500.0)])
    clashes = strake.clash(model, a="PIPING/*", b="plate", clearance=25)
    if len(clashes) == 0:
        break
    nearest = clashes.array["separation"].min()
    print(f"{height:.1f} mm: {clashes!r}, nearest {nearest:.1f} mm")
    height += 26 - nearest
print(f"{height:.1f} mm: clear")
