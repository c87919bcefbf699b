#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bench.sh [--build] [NAME...]: builds and runs the benchmarks (all, or those named); each checks its results. --build runs none,
# and installs what those named need.
set -euo pipefail
. scripts/common.sh
run_them=yes
if [ "${1:-}" = --build ]; then
  run_them=
  shift
fi
need build test bench
# Some have packages of their own, which are not asked of those who run all.
for name in "$@"; do need "bench-$name"; done
configure_and_build bench
[ -n "$run_them" ] || exit 0
ran=
for program in build/bench/bin/bench_*; do
  name=${program##*/bench_}
  if [ $# -gt 0 ]; then
    case " $* " in *" $name "*) ;; *) continue ;; esac
  fi
  say "$name"
  "$program"
  ran=yes
done
[ -n "$ran" ] || {
  names=$(printf '%s\n' build/bench/bin/bench_* | sed 's/.*bench_//' | tr '\n' ' ')
  echo "bench: none is called '$*'; there are: $names" >&2
  exit 2
}
