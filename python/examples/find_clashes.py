# SPDX-License-Identifier: Apache-2.0
"""From a model to the clashes worth a meeting. The cells run one by one in an editor that knows `# %%`, or all at once."""

# %% A model of yours, or a ship that is made here
import sys
from pathlib import Path
from tempfile import mkdtemp

import strake

folder = Path(mkdtemp())
model = strake.load(sys.argv[1:]) if sys.argv[1:] else strake.generate(objects=2000, seed=1)
print(model)

# %% What collides, touches or comes nearer than 25 mm
clashes = strake.clash(model, clearance=25, profile="ship")
print(clashes)

# %% Who has most of them
for group in clashes.groups[:5]:
    print(f"{group.name}: {len(group.rows)} results, the worst {group.worst.name} {group.separation:.1f} mm")

# %% Numbers: hits deeper than 5 mm, as arrays
rows = clashes.array
deep = rows[(rows["kind"] == strake.Kind.HIT) & (rows["depth"] > 5)]
for row in deep[:5]:
    print(model.names[row["a"]], model.names[row["b"]], row["depth"], row["point"])

# %% Pipes against everything else
pipes = model.select("PIP*")
print(strake.clash(model, a=pipes, b=~pipes))

# %% Files, with the bytes that the program writes
clashes.save(folder / "clashes.json")
clashes.save(folder / "clashes.csv", columns=["discipline"])
print(sorted(file.name for file in folder.iterdir()))
