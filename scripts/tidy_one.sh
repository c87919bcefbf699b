#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tidy_one.sh BUILD_FOLDER SOURCE STAMP: clang-tidy on one source; leaves the stamp when it passed.
set -euo pipefail
if output=$(clang-tidy-19 --quiet -p "$1" "$2" 2>/dev/null); then
  : >"$3"
else
  printf '%s\n' "$output" >&2
  echo "clang-tidy: $2" >&2
  exit 1
fi
