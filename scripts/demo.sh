#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A small ship section: made, clashed, drawn, and a page of it. The files are left in build/demo.
set -euo pipefail
. scripts/common.sh
need build demo
# The first answer is what counts here: compiled so, the program is there in two thirds of the time.
configure_and_build quick strake
strake=build/quick/bin/strake
out=build/demo
mkdir -p "$out"
say "a ship section of 1,200 objects"
"$strake" generate ship --objects 1200 --seed 1 -o "$out/ship.glb" --truth "$out/ship.truth.json"
say "its clashes"
"$strake" clash "$out/ship.glb" --clearance 25mm -o "$out/clashes.json" -o "$out/report.html"
say "its drawing, hidden lines removed"
"$strake" draw "$out/ship.glb" --view iso -o "$out/ship.svg"
rsvg-convert --width 2400 --background-color white -o "$out/ship.png" "$out/ship.svg"
say "done; look at:"
printf '   %s\n' "$out/ship.svg" "$out/ship.png" "$out/clashes.json" "$out/ship.truth.json" "$out/ship.glb"
say "open this page in a browser: the clashes, and the model round them"
printf '   %s\n' "$out/report.html"
