#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# step.sh: installs Open CASCADE and builds the importer of STEP and IGES beside the program, where it is found.
set -euo pipefail
. scripts/common.sh
need build step
cmake --preset release -D STRAKE_STEP=ON >/dev/null
cmake --build build/release -j "$jobs" --target strake strake-import-step
say "built build/release/bin/strake-import-step"
