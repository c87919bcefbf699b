# SPDX-License-Identifier: Apache-2.0
"""Views on paper, and their lines as arrays."""

# %% A ship
from pathlib import Path
from tempfile import mkdtemp

import numpy as np

import strake

folder = Path(mkdtemp())
model = strake.generate(objects=1000, seed=2)

# %% In a notebook a drawing shows itself
drawing = strake.draw(model, "iso", hidden="dashed", paper="A2")
drawing.save(folder / "ship.svg")
print(drawing)

# %% A section through a deck
section = strake.draw(model, {"view": "top", "section": "z=4500mm"}, scale=100, paper="A0")
section.save(folder / "deck.svg")

# %% In perspective, pipes only
perspective = strake.draw(model, {"eye": (20_000, -9_000, 6_000), "target": (3_000, 0, 3_000)}, select="PIP*")
perspective.save(folder / "pipes.svg")

# %% Millimetres of ink by kind of line
lines = drawing.lines
lengths = np.linalg.norm(np.diff(lines.points, axis=0), axis=1)
of_chain = np.repeat(np.arange(len(lines.kinds)), np.diff(lines.starts))
within = of_chain[1:] == of_chain[:-1]  # not from the end of one chain to the beginning of the next
ink = np.bincount(lines.kinds[of_chain[1:][within]], lengths[within])
for kind, length in enumerate(ink):
    if length:
        print(f"{strake.LINE_KINDS[kind]}: {length:.0f} mm")
