#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tidy_one.sh BUILD_FOLDER SOURCE STAMP: clang-tidy on one source; leaves the stamp when it passed.
set -euo pipefail
# Clang refuses some templates of CGAL that nobody uses, unless it reads templates when they are used.
extra=()
if grep -q '#include <CGAL/' "$2"; then
  extra=(--extra-arg=-fdelayed-template-parsing --extra-arg=-Wno-delayed-template-parsing-in-cxx20)
fi
if output=$(clang-tidy-19 --quiet -p "$1" ${extra[@]+"${extra[@]}"} "$2" 2>/dev/null); then
  : >"$3"
else
  printf '%s\n' "$output" >&2
  echo "clang-tidy: $2" >&2
  exit 1
fi
