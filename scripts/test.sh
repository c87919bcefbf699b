#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# test.sh [--all]: build, format, lint, tests; ends with CTest's summary.
set -euo pipefail
. scripts/common.sh
preset=test
case "${1:-}" in
  "") ;;
  --all) preset=nightly ;;
  *) echo "test: unknown option '$1' (there is only --all)" >&2; exit 2 ;;
esac
need build test
scripts/npm.sh
[ "$preset" = nightly ] && { need docs step; scripts/sanitize.sh --all; }
configure_and_build "$preset"
scripts/format.sh --check
if [ "$preset" = nightly ]; then
  scripts/lint.sh --all
else
  scripts/lint.sh
fi
[ "$preset" = nightly ] && { scripts/python.sh; scripts/wheel.sh; }
ctest --test-dir "build/$preset" -j "$jobs" --output-on-failure --no-tests=error
