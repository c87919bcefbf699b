#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# sanitize.sh [--all]: the fast tests under ASan+UBSan and the parallel tests under TSan, both built by
# Clang; --all with those, too, that start the program hundreds of times.
set -euo pipefail
. scripts/common.sh
short=(-LE long)
case "${1:-}" in
  "") ;;
  --all) short=() ;;
  *) echo "sanitize: unknown option '$1' (there is only --all)" >&2; exit 2 ;;
esac
need build test
scripts/npm.sh
say "address and undefined behaviour"
configure_and_build asan strake_tests_fast
ctest --test-dir build/asan -L fast ${short[@]+"${short[@]}"} -j "$jobs" --output-on-failure --no-tests=error
say "threads"
configure_and_build tsan strake_tests_parallel
ctest --test-dir build/tsan -L parallel -j "$jobs" --output-on-failure --no-tests=error
