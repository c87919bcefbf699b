# SPDX-License-Identifier: Apache-2.0
# Sourced by the other scripts: packages, presets, the list of sources.

jobs=$(nproc)
# One cache for every checkout of the sources, wherever it lies, precompiled headers included.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime

say() { printf '== %s\n' "$*" >&2; }

# packages_of SECTION...: the package names of those sections of packages.txt.
packages_of() {
  local section
  for section in "$@"; do
    awk -v want="[$section]" '
      /^\[/ { on = ($1 == want); next }
      on && NF && $1 !~ /^#/ { print $1 }' packages.txt
  done
}

# need SECTION...: installs what is missing of those sections; asks for root only then.
need() {
  local missing=() package
  for package in $(packages_of "$@"); do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  command -v apt-get >/dev/null || {
    echo "missing packages: ${missing[*]} (no apt-get here: install their counterparts by hand)" >&2
    return 3
  }
  local as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  say "installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# configure PRESET: silent unless it fails.
configure() {
  local log
  log=$(mktemp)
  cmake --preset "$1" >"$log" 2>&1 || {
    cat "$log" >&2
    rm -f "$log"
    return 1
  }
  rm -f "$log"
}

# configure_and_build PRESET [TARGET...]
configure_and_build() {
  local preset=$1
  shift
  configure "$preset" || return
  cmake --build "build/$preset" -j "$jobs" ${1:+--target "$@"}
}

# sources PATTERN...: those of git's files, and files not yet added, that match and were not removed;
# in a release, which is no checkout, and without git, all that do outside build.
sources() {
  if [ -e .git ] && command -v git >/dev/null; then
    git ls-files --cached --others --exclude-standard -- "$@" | while IFS= read -r file; do
      if [ -e "$file" ]; then printf '%s\n' "$file"; fi
    done
    return
  fi
  local pattern
  for pattern in "$@"; do
    find . -path ./build -prune -o -type f -name "$pattern" -printf '%P\n'
  done
}
