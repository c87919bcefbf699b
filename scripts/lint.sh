#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# lint.sh [--all] [BUILD_FOLDER]: house rules, and clang-tidy on the sources that changed: against
# origin/main, or in the last 20 commits where HEAD is origin/main itself. Without a history none is
# known to have changed: --all looks at all. A source that passed is not looked at again until it, a
# header or the rules change.
set -euo pipefail
. scripts/common.sh
need build test
python3 scripts/check_house.py
all=
[ "${1:-}" = --all ] && { all=yes; shift; }
build=${1:-build/dev}
[ -f "$build/compile_commands.json" ] || configure "$(basename "$build")"

# A source has passed once for a given state of the rules, of all headers and of itself.
base=$(git merge-base HEAD origin/main 2>/dev/null || true)
[ -n "$base" ] && [ "$base" != "$(git rev-parse HEAD)" ] || base=$(git rev-parse -q --verify HEAD~20 2>/dev/null || true)
changed() {
  if [ -n "$all" ]; then
    sources '*.cpp'
  elif [ -n "$base" ]; then
    { git diff --name-only --diff-filter=d "$base" -- '*.cpp'; git ls-files -o --exclude-standard -- '*.cpp'; } | sort -u
  fi
}

stamps=build/tidy
mkdir -p "$stamps"
rules=$( (cat .clang-tidy; sources '*.hpp' | xargs cat) | sha256sum | cut -c1-16)
todo=()
while read -r file; do
  grep -qF "/$file\"" "$build/compile_commands.json" || continue
  stamp=$stamps/$( (echo "$rules"; cat "$file") | sha256sum | cut -c1-32)
  [ -e "$stamp" ] || todo+=("$file" "$stamp")
done < <(changed)
say "lint: $((${#todo[@]} / 2)) sources"
[ ${#todo[@]} -eq 0 ] && exit 0
printf '%s\0' "${todo[@]}" | xargs -0 -P "$jobs" -n 2 scripts/tidy_one.sh "$build"
say "lint: clean"
