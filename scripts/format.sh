#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# format.sh [--check]: the house format, by clang-format-19.
set -euo pipefail
. scripts/common.sh
need test
if [ "${1:-}" = --check ]; then
  sources '*.cpp' '*.hpp' | xargs -P "$jobs" -n 20 clang-format-19 --dry-run --Werror
  say "format: clean"
else
  # Only what is not in the format yet: a file written anew is built anew.
  sources '*.cpp' '*.hpp' | xargs -P "$jobs" -n 20 sh -c \
    'for f; do clang-format-19 --dry-run --Werror "$f" 2>/dev/null || clang-format-19 -i "$f"; done' sh
fi
