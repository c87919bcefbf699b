#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# lint.sh [--all] [BUILD_FOLDER]: house rules, and clang-tidy on the sources that changed: against
# origin/main, or in the last 20 commits where HEAD is origin/main itself. Without a history none is
# known to have changed: --all looks at all. A source that passed is not looked at again until it, a
# header or the rules change. Sources of the Python package are looked at where there is a Python with
# nanobind for them, as ./run python leaves one.
set -euo pipefail
. scripts/common.sh
need build test
python3 scripts/check_house.py
all=
[ "${1:-}" = --all ] && { all=yes; shift; }
build=${1:-build/dev}
# Not of a unity build, which knows no single sources; configuring is enough.
[ -f "$build/compile_commands.json" ] || configure "$(basename "$build")"
stamps=build/tidy
mkdir -p "$stamps"
commands=("$build/compile_commands.json")
python=$PWD/build/python-venv/bin/python
if ! grep -q '/python/bindings/' "${commands[0]}" && "$python" -c 'import nanobind' 2>/dev/null; then
  # In a folder of its own, since the option would have the dev build make the package, too.
  cmake --preset dev -B "$stamps/python" -D STRAKE_TESTS=OFF -D STRAKE_PYTHON=ON -D "Python_EXECUTABLE=$python" >"$stamps/python.log" 2>&1 ||
    { cat "$stamps/python.log" >&2; exit 1; }
  commands+=("$stamps/python/compile_commands.json")
fi
# Of all commands, without the precompiled headers: a source must include what it uses itself.
python3 - "${commands[@]}" >"$stamps/compile_commands.json" <<'END'
import json, re, sys
first, *others = (json.load(open(name)) for name in sys.argv[1:])
all_of = first + [entry for more in others for entry in more if '/python/bindings/' in entry['file']]
for entry in all_of:
    entry['command'] = re.sub(r' -Winvalid-pch| -fpch-preprocess| -include \S*cmake_pch\.hxx', '', entry['command'])
json.dump(all_of, sys.stdout)
END

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

# A source has passed once for a given state of the rules, of all headers and of itself.
rules=$( (cat .clang-tidy; sources '*.hpp' | xargs cat) | sha256sum | cut -c1-16)
todo=()
while read -r file; do
  grep -qF "/$file\"" "$stamps/compile_commands.json" || continue
  stamp=$stamps/$( (echo "$rules"; cat "$file") | sha256sum | cut -c1-32)
  [ -e "$stamp" ] || todo+=("$file" "$stamp")
done < <(changed)
# A change of everything, as a name that all use, is looked at in full by the nightly run.
most=40
if [ -z "$all" ] && [ $((${#todo[@]} / 2)) -gt $most ]; then
  say "lint: of $((${#todo[@]} / 2)) sources the $most that changed most; lint.sh --all looks at all"
  todo=("${todo[@]:0:$((2 * most))}")
fi
say "lint: $((${#todo[@]} / 2)) sources"
[ ${#todo[@]} -eq 0 ] && exit 0
printf '%s\0' "${todo[@]}" | xargs -0 -P "$jobs" -n 2 scripts/tidy_one.sh "$stamps"
say "lint: clean"
