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
# Not of a unity build, which knows no single sources; configuring is enough.
[ -f "$build/compile_commands.json" ] || configure "$(basename "$build")"

# The sources that changed, those that changed most first.
base=$(git merge-base HEAD origin/main 2>/dev/null || true)
[ -n "$base" ] && [ "$base" != "$(git rev-parse HEAD)" ] || base=$(git rev-parse -q --verify HEAD~20 2>/dev/null || true)
changed() {
  if [ -n "$all" ]; then
    sources '*.cpp'
  elif [ -n "$base" ]; then
    { git diff -M --numstat -z --diff-filter=d "$base" -- '*.cpp' | python3 -c '
import sys
fields = iter(sys.stdin.read().split("\0"))
for field in fields:
    if field:
        added, deleted, path = field.split("\t")
        print(int(added) + int(deleted), path or (next(fields), next(fields))[1])' | sort -k1,1nr -k2
      git ls-files -o --exclude-standard -- '*.cpp' | sed 's/^/0 /'
    } | cut -d' ' -f2- | awk '!seen[$0]++'
  fi
}

stamps=build/tidy
mkdir -p "$stamps"
# A source has passed once for a given state of the rules, of all headers and of itself.
rules=$( (cat .clang-tidy; sources '*.hpp' | xargs cat) | sha256sum | cut -c1-16)
todo=()
while read -r file; do
  grep -qF "/$file\"" "$build/compile_commands.json" || continue
  stamp=$stamps/$( (echo "$rules"; cat "$file") | sha256sum | cut -c1-32)
  [ -e "$stamp" ] || todo+=("$file" "$stamp")
done < <(changed)
# A change of everything, as a name that all use, is looked at in full by the nightly run.
most=60
if [ -z "$all" ] && [ $((${#todo[@]} / 2)) -gt $most ]; then
  say "lint: of $((${#todo[@]} / 2)) sources the $most that changed most; lint.sh --all looks at all"
  todo=("${todo[@]:0:$((2 * most))}")
fi
say "lint: $((${#todo[@]} / 2)) sources"
[ ${#todo[@]} -eq 0 ] && exit 0
# Without the precompiled headers: a source must include what it uses itself.
sed -E 's/ -Winvalid-pch| -fpch-preprocess| -include [^ ]*cmake_pch\.hxx//g' "$build/compile_commands.json" \
  >"$stamps/compile_commands.json"
build=$stamps
printf '%s\0' "${todo[@]}" | xargs -0 -P "$jobs" -n 2 scripts/tidy_one.sh "$build"
say "lint: clean"
