#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# npm.sh: the packages of npm that tests of the program need (tests/npm/package.json), in build/npm/node_modules.
set -euo pipefail
. scripts/common.sh
# Whoever has Node of another source keeps it.
command -v npm >/dev/null || need npm
folder=build/npm
mkdir -p "$folder"
cmp -s tests/npm/package-lock.json "$folder/package-lock.json" && [ -d "$folder/node_modules" ] && exit 0
say "installing the packages of tests/npm"
cp tests/npm/package.json tests/npm/package-lock.json "$folder"
npm ci --prefix "$folder" --no-audit --no-fund --silent
