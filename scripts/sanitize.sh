#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The fast tests under ASan+UBSan and the parallel tests under TSan, both built by Clang.
set -euo pipefail
. scripts/common.sh
need build test
scripts/npm.sh
say "address and undefined behaviour"
configure_and_build asan strake_tests_fast
ctest --test-dir build/asan -L fast -j "$jobs" --output-on-failure --no-tests=error
say "threads"
configure_and_build tsan strake_tests_parallel
ctest --test-dir build/tsan -L parallel -j "$jobs" --output-on-failure --no-tests=error
