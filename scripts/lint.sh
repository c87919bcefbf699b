#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# lint.sh [BUILD_FOLDER]: house rules, and clang-tidy on every source that changed since it passed.
set -euo pipefail
. scripts/common.sh
need build test
python3 scripts/check_house.py
build=${1:-build/dev}
[ -f "$build/compile_commands.json" ] || configure_and_build "$(basename "$build")"

# A source has passed once for a given state of the rules, of all headers and of itself.
stamps=build/tidy
mkdir -p "$stamps"
rules=$( (cat .clang-tidy; sources '*.hpp' | xargs cat) | sha256sum | cut -c1-16)
todo=()
while read -r file; do
  grep -qF "/$file\"" "$build/compile_commands.json" || continue
  stamp=$stamps/$( (echo "$rules"; cat "$file") | sha256sum | cut -c1-32)
  [ -e "$stamp" ] || todo+=("$file" "$stamp")
done < <(sources '*.cpp')
say "lint: $((${#todo[@]} / 2)) sources"
[ ${#todo[@]} -eq 0 ] && exit 0
printf '%s\0' "${todo[@]}" | xargs -0 -P "$jobs" -n 2 scripts/tidy_one.sh "$build"
say "lint: clean"
