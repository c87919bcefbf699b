#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# fuzz.sh [--seconds N] [FORMAT...]: runs the readers' fuzzers (all, or those named), one after the
# other, each N seconds (600). Finds go to build/fuzz/found, what was learned to build/fuzz/corpus.
# Real models of the folder that STRAKE_DATA names are where the fuzzers start from, too.
set -euo pipefail
. scripts/common.sh
need build test
seconds=600
[ "${1:-}" = --seconds ] && { seconds=$2; shift 2; }
formats=${*:-gltf obj stl ply rvm rvm_attributes rules sheets clash_document view_document bcf project project_blob}
# shellcheck disable=SC2086 # a word for each fuzzer
configure_and_build fuzz write_seeds $(printf '%s_fuzzer ' $formats)
build/fuzz/bin/write_seeds build/fuzz/seeds
for format in $formats; do
  say "$format, $seconds s"
  mkdir -p "build/fuzz/corpus/$format" "build/fuzz/found/$format" "build/fuzz/seeds/$format"
  case $format in
    gltf) real=gltf ;;
    obj|stl|ply) real=mesh ;;
    rvm*) real=rvm ;;
    *) real=none ;;
  esac
  folders=("build/fuzz/corpus/$format" "build/fuzz/seeds/$format")
  [ -d "${STRAKE_DATA:-}/$real" ] && folders+=("$STRAKE_DATA/$real")
  # Small inputs: a find in a kilobyte is one in a gigabyte, and there are a hundred times as many.
  # A project is made of pages, and no smaller.
  longest=16384
  [ "$format" = project ] && longest=524288
  "build/fuzz/bin/${format}_fuzzer" -max_total_time="$seconds" -max_len="$longest" -timeout=10 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="build/fuzz/found/$format/" \
    "${folders[@]}" 2>&1 | grep -vE '^#|NEW_FUNC' || { say "found something: build/fuzz/found/$format"; exit 1; }
done
