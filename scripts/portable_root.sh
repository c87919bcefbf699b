#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# portable_root.sh FOLDER PYTHON: makes of a folder what programs for older systems are compiled with (decision 0108):
# FOLDER/bin/cc and c++, Zig's Clang with headers and symbols of glibc 2.28 and its libc++, FOLDER/usr with the
# libraries of packages.txt, to be linked in, and FOLDER/licences with the terms of all of them. PYTHON has the packages
# ziglang and six.
#
# C++ libraries are compiled from the sources of Debian's packages, since those of Debian go with GCC's standard library.
# C libraries and headers are Debian's: which version of a symbol of the C library they ask for is decided when linked.
set -euo pipefail
. scripts/common.sh
root=$(realpath -m "$1") python=$2
glibc=2.28
mkdir -p "$root/bin" "$root/usr"

zig=$("$python" -c 'import os, ziglang; print(os.path.join(os.path.dirname(ziglang.__file__), "zig"))')
write() {  # write NAME COMMAND...: a program that runs the command with its own arguments behind
  local name=$1
  shift
  printf '#!/bin/sh\nexport ZIG_GLOBAL_CACHE_DIR="%s" ZIG_LOCAL_CACHE_DIR="%s"\nexec %s "$@"\n' \
    "$root/cache" "$root/cache" "$*" >"$root/bin/$name"
  chmod +x "$root/bin/$name"
}
# Zig's Clang writes debug information, and keeps frame pointers, unless told otherwise: a quarter more time, and ten times as much on the disk.
target="-target $(uname -m)-linux-gnu.$glibc -g0 -fomit-frame-pointer"
write cc "'$zig' cc $target -idirafter '$root/usr/include'"
write c++ "'$zig' c++ $target -idirafter '$root/usr/include'"
write ar "'$zig' ar"
write ranlib "'$zig' ranlib"

# Headers, static libraries and descriptions for CMake; no shared library, lest one be linked.
packages=(libcli11-dev nlohmann-json3-dev libtomlplusplus-dev libxxhash-dev zlib1g-dev libzstd-dev libsqlite3-dev libagg-dev)
for package in "${packages[@]}"; do
  dpkg -L "$package" | grep -E '^/usr/(include|lib|share/cmake)/' | grep -vE '\.(so|la)(\.|$)' | while IFS= read -r file; do
    if [ -f "$file" ] && [ ! -e "$root$file" ]; then install -D -m 644 "$file" "$root$file"; fi
  done
done
# Debian's Python looks for one of its headers where those of the compiler are.
config=$("$python" -c 'import sysconfig; print(sysconfig.get_config_h_filename())')
case $config in
  /usr/include/*) install -D -m 644 "$config" "$root$config" ;;
esac

# Debian's sources, by a list of its own: those of the machine may name none.
apt=$root/apt
mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$root/sources"
apt-get indextargets --format '$(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' 'Origin: Debian' |
  sort -u | while read -r uri codename component; do
    printf 'deb-src %s %s %s\n' "$uri" "$codename" "$component"
  done >"$apt/sources.list"
private=(-qq -o "Dir::Etc::SourceList=$apt/sources.list" -o Dir::Etc::SourceParts=- -o "Dir::State::Lists=$apt/lists"
  -o "Dir::Cache=$apt/cache" -o APT::Sandbox::User=root)

# make_tables FOLDER: sources of RE2 that Debian makes anew, of the Unicode that it has.
make_tables() {
  perl "$1/make_perl_groups.pl" >"$1/perl_groups.cc"
  local table
  for table in casefold groups; do "$python" "$1/make_unicode_$table.py" >"$1/unicode_$table.cc"; done
}

unpack() {  # unpack SOURCE: Debian's source package into a folder of its own
  say "compiling $1 for glibc $glibc"
  rm -rf "${root:?}/sources/$1"
  mkdir -p "$root/sources/$1"
  (cd "$root/sources/$1" && apt-get "${private[@]}" source "$1" >/dev/null)
}

compile() {  # compile SOURCE [OPTION of CMake...]: a library of Debian's source package into usr
  local name=$1 at=$root/sources/$1
  shift
  [ -e "$at/installed" ] && return 0
  unpack "$name"
  local made=("$at"/*/)
  [ "$name" != re2 ] || make_tables "${made[0]}re2"
  cmake -S "${made[0]}" -B "$at/build" -G Ninja "${cmake_options[@]}" -D BUILD_SHARED_LIBS=OFF "$@" >"$at/log" 2>&1 &&
    cmake --build "$at/build" -j "$jobs" --target install >>"$at/log" 2>&1 || {
    tail -30 "$at/log" >&2
    return 1
  }
  touch "$at/installed"
}

configure_and_make() {  # configure_and_make SOURCE [OPTION of configure...]: the same of one that has no CMake
  local name=$1 at=$root/sources/$1
  shift
  [ -e "$at/installed" ] && return 0
  unpack "$name"
  local made=("$at"/*/)
  (cd "${made[0]}" &&
    ./configure --prefix="$root/usr" --libdir="$root/usr/lib" --disable-shared --enable-static --with-pic \
      CC="$root/bin/cc" AR="$root/bin/ar" RANLIB="$root/bin/ranlib" CFLAGS="-O2" "$@" &&
    make -j "$jobs" && make install) >"$at/log" 2>&1 || {
    tail -30 "$at/log" >&2
    return 1
  }
  touch "$at/installed"
}
cmake_options=(-D CMAKE_BUILD_TYPE=Release -D "CMAKE_C_COMPILER=$root/bin/cc" -D "CMAKE_CXX_COMPILER=$root/bin/c++"
  -D "CMAKE_AR=$root/bin/ar" -D "CMAKE_RANLIB=$root/bin/ranlib" -D "CMAKE_PREFIX_PATH=$root/usr"
  -D CMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF -D "CMAKE_LIBRARY_ARCHITECTURE=$(uname -m)-linux-gnu" -D CMAKE_POSITION_INDEPENDENT_CODE=ON
  -D "CMAKE_INSTALL_PREFIX=$root/usr" -D CMAKE_INSTALL_LIBDIR=lib)
[ -e "$root/sources/libmicrohttpd/installed" ] || apt-get "${private[@]}" update
compile fmtlib -D FMT_DOC=OFF -D FMT_TEST=OFF
compile re2 -D RE2_BUILD_TESTING=OFF
compile meshoptimizer
compile libzip -D ENABLE_COMMONCRYPTO=OFF -D ENABLE_GNUTLS=OFF -D ENABLE_MBEDTLS=OFF -D ENABLE_OPENSSL=OFF \
  -D ENABLE_BZIP2=OFF -D ENABLE_LZMA=OFF -D ENABLE_ZSTD=OFF \
  -D BUILD_TOOLS=OFF -D BUILD_REGRESS=OFF -D BUILD_EXAMPLES=OFF -D BUILD_DOC=OFF
compile pugixml -D PUGIXML_BUILD_TESTS=OFF
# Debian's own asks for GnuTLS, which `strake view` has no use for.
configure_and_make libmicrohttpd --disable-https --without-gnutls --disable-doc --disable-examples --disable-tools --disable-curl

# What lies in usr is linked in, and so are Zig's own libraries: each has its terms in the wheel (decision 0115).
licences=$root/licences
rm -rf "$licences"
mkdir -p "$licences"
for package in "${packages[@]}"; do cp "/usr/share/doc/$package/copyright" "$licences/$package.txt"; done
for source in "$root"/sources/*/; do
  name=$(basename "$source")
  cp "$source"*/debian/copyright "$licences/$name.txt"
done
cp "$root"/sources/libmicrohttpd/*/COPYING "$licences/libmicrohttpd-LGPL-2.1.txt"
for name in libcxx libcxxabi libunwind; do cp "$(dirname "$zig")/lib/$name/LICENSE.TXT" "$licences/$name.txt"; done
cp "$(dirname "$zig")/LICENSE" "$licences/zig.txt"
