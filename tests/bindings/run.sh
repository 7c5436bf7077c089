#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: tests/bindings/run.sh [KIND...]
#
# Builds and runs small projects outside the source tree that use starfocus in all supported ways. All projects must print
# the same checksums as a program that is linked directly with the library of build/release. The default is every KIND
# but the last two.
#   package   CMake packages and pkg-config, static and shared library, then uninstallation
#   source    the source tree as a subfolder of another project, and through FetchContent
#   m32       a build for 32 bits with GCC's -m32
#   wasm      a build for WebAssembly SIMD with emscripten, run by node
#   python    the Python package, from a wheel and from the source tree
#   java      the Java API
#   swift     the module map of the C headers
#   java-aarch64  the Java API on aarch64, run by an emulator
#   PRESET    the build of this preset for another machine in build/PRESET, run by its emulator
. "$(dirname "$0")/../../toolchains/steps.sh"
set -e

help_if_asked "$@"
if [ $# = 0 ]; then
  set -- package source wasm python java swift
  [ "$(uname -m)" != x86_64 ] || set -- "$@" m32
fi
packages=build targets='starfocus starfocus_lab starfocus_shared'
for kind; do
  case "$kind" in
    package | source) ;;
    m32) packages+=' libc6-dev-i386 lib32stdc++-12-dev qemu-user' ;;
    wasm) packages+=' emscripten nodejs' ;;
    python)
      packages+=" python3 $(printf 'python3-%s ' numpy pip venv setuptools wheel pil matplotlib distributed mypy)"
      targets+=' starfocus_python'
      ;;
    java | java-aarch64)
      packages+=' openjdk-17-jdk-headless kotlin python3 zip android-platform-frameworks-native-headers'
      targets+=' starfocus_jni starfocus_phone'
      [ "$kind" = java ] || packages+=' g++-aarch64-linux-gnu qemu-user'
      ;;
    swift) packages+=' clang' ;;
    *) [ -f "build/$kind/CMakeCache.txt" ] || wrong "expected a KIND, or a preset that was built, found '$kind'" ;;
  esac
done
install $packages
./do build $targets
sources=$PWD build=$PWD/$BUILD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
cp -r "$sources/tests/bindings/consumers" "$work"
consumers=$work/consumers expected=$work/expected

# quietly COMMAND...: runs a command. Prints the output only if the command fails.
quietly() {
  "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; echo "consumers: failed: $*" >&2; exit 1; }
}

# same KIND: checks that the file `sums` has the same checksums as the first program that was run.
same() {
  [ -f "$expected" ] || cp "$work/sums" "$expected"
  [ "$(wc -l <"$work/sums")" = 2 ] && cmp -s "$work/sums" "$expected" || {
    echo "consumers: $1: expected" $(cat "$expected"), found $(cat "$work/sums") >&2
    exit 1
  }
  printf '%-40s %s\n' "$1" "$(paste -s -d ' ' "$work/sums")"
}

# project KIND WAY LANGUAGE ARGUMENT...: configures, builds and runs the project of tests/bindings/consumers.
project() {
  kind=$1 way=$2 language=$3
  shift 3
  rm -rf "$work/build"
  quietly cmake -S "$consumers" -B "$work/build" -DWAY=$way -DLANGUAGE=$language "$@"
  quietly cmake --build "$work/build" --parallel "$(nproc)"
  cp "$work/build/sums" "$work/sums"
  same "$kind"
}

# program KIND COMPILER-ARGUMENT...: compiles the program without CMake and runs it.
program() {
  kind=$1
  shift
  quietly cc -std=c99 -pedantic -Wall -Wextra -Werror "$consumers/refocus.c" \
    -o "$work/refocus" "$@"
  "$work/refocus" >"$work/sums"
  same "$kind"
}

# library FOLDER ARGUMENT...: builds only the static library with these options, and installs it. Checksums do not
# depend on optimization, and compiling with -O1 takes half of the time of -O3.
library() {
  folder=$1
  shift
  quietly cmake -S "$sources" -B "$work/$folder-build" '-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG' \
    -DSTARFOCUS_STATIC_DISPATCH=ON -DSTARFOCUS_PROGRAMS=OFF -DSTARFOCUS_TESTS=OFF "$@"
  quietly cmake --build "$work/$folder-build" --parallel "$(nproc)"
  quietly cmake --install "$work/$folder-build" --prefix "$work/$folder"
}

package() {
  prefix=$work/prefix
  quietly cmake --install "$build" --prefix "$prefix"
  for form in shared static; do
    for pool in OFF ON; do
      project "CMake package, C, $form, pool $pool" package C -DKIND=$form -DWITH_POOL=$pool \
        -DCMAKE_PREFIX_PATH="$prefix"
    done
  done
  project 'CMake package, C++' package CXX -DCMAKE_PREFIX_PATH="$prefix"

  # Checks that the installation prefix can be moved, and that the command of docs/library.md links the static library
  # although the shared library exists: the linked programs would not find the shared library.
  mv "$prefix" "$work/moved"
  PKG_CONFIG_PATH=$(dirname "$(find "$work/moved" -name starfocus.pc)")
  export PKG_CONFIG_PATH
  folder=$(pkg-config --variable=libdir starfocus)
  program 'pkg-config, C99, shared' $(pkg-config --cflags --libs starfocus) "-Wl,-rpath,$folder"
  program 'pkg-config, C99, static' \
    $(pkg-config --static --cflags --libs starfocus | sed 's/-lstarfocus\>/-l:libstarfocus.a/')
  program 'pkg-config, C99, static, pool' -DWITH_POOL \
    $(pkg-config --static --cflags --libs starfocus-pool | sed 's/-lstarfocus\>/-l:libstarfocus.a/')

  mv "$work/moved" "$prefix"
  quietly cmake --build "$build" --target uninstall
  left=$(find "$prefix" ! -type d -o -path '*/starfocus*')
  [ -z "$left" ] || { echo "consumers: uninstall left" $left >&2; exit 1; }
}

# Builds projects without optimization, since such builds are faster, and checksums must not depend on optimization.
source_tree() {
  project 'add_subdirectory, C' subfolder C "-DSTARFOCUS_DIR=$sources" \
    -DSTARFOCUS_STATIC_DISPATCH=ON
  quietly cmake -S "$consumers" -B "$work/everything" -DWAY=subfolder -DLANGUAGE=C \
    "-DSTARFOCUS_DIR=$sources" -DSTARFOCUS_PROGRAMS=ON -DSTARFOCUS_TESTS=ON
  project 'FetchContent, C++, shared, -ffast-math' fetch CXX "-DSTARFOCUS_DIR=$sources" \
    -DSTARFOCUS_STATIC_DISPATCH=ON
}

# Linux can be built without support for 32-bit programs. If Linux lacks this support, QEMU runs the programs.
m32() {
  library m32 -DCMAKE_C_FLAGS=-m32 -DCMAKE_CXX_FLAGS=-m32
  emulator=
  echo 'int main(void) { return 0; }' >"$work/nothing.c"
  quietly cc -m32 -o "$work/nothing" "$work/nothing.c"
  "$work/nothing" 2>/dev/null || emulator='-DCMAKE_SYSTEM_NAME=Linux -DCMAKE_CROSSCOMPILING_EMULATOR=qemu-i386'
  project '-m32, C' package C -DCMAKE_C_FLAGS=-m32 \
    -DCMAKE_PREFIX_PATH="$work/m32" $emulator
}

wasm() {
  NODE_PATH=/usr/share/nodejs
  EMSDK_PYTHON=/usr/bin/python3
  export NODE_PATH EMSDK_PYTHON
  library wasm "-DCMAKE_TOOLCHAIN_FILE=$sources/toolchains/wasm-emscripten.cmake"
  project 'WebAssembly SIMD, C' package C -DKIND=static \
    "-DCMAKE_TOOLCHAIN_FILE=$sources/toolchains/wasm-emscripten.cmake" \
    -DCMAKE_EXE_LINKER_FLAGS='-sSINGLE_FILE=1 -sALLOW_MEMORY_GROWTH=1' \
    "-Dstarfocus_DIR=$(dirname "$(find "$work/wasm" -name starfocus-config.cmake)")"
}

# preset NAME: tests the build of a preset. With a toolchain file, CMake searches only the folders of the
# toolchain, so the folder of the package is passed explicitly.
preset() {
  other=$(dirname "$build")/$1
  toolchain=$(sed -n 's/^CMAKE_TOOLCHAIN_FILE:[A-Z]*=//p' "$other/CMakeCache.txt")
  quietly cmake --install "$other" --prefix "$work/$1"
  project "CMake package, C, $1" package C -DKIND=static \
    "-DCMAKE_TOOLCHAIN_FILE=$toolchain" \
    "-Dstarfocus_DIR=$(dirname "$(find "$work/$1" -name starfocus-config.cmake)")"
}

# Builds the library for the emulated board, and downloads a Java run time.
java_aarch64() {
  step sysroot-aarch64 "fetching headers and libraries for aarch64" toolchains/sysroot.sh arm64 build/sysroot/arm64
  step java-aarch64 "fetching Java for aarch64" \
    toolchains/fetch.sh arm64 build/sysroot/java-arm64 zlib1g openjdk-17-jre-headless
  step configure-aarch64 "configuring build/aarch64" cmake --preset aarch64
  step build-aarch64 "building starfocus_jni in build/aarch64" \
    cmake --build --preset aarch64 --parallel "$(nproc)" --target starfocus_jni
  tests/bindings/java/run.sh "$build" aarch64 build/sysroot/java-arm64
}

# Compiles the module map of the Swift package with clang. No other part of the package is tested.
swift() {
  cat >"$work/module.m" <<'TEXT'
@import CStarfocus;
int main(void) {
  starfocus_config config;
  starfocus_image image = {0};
  starfocus_light_field frame;
  starfocus_disparity_stats range;
  starfocus_params params;
  starfocus_engine* engine;
  starfocus_prepared* prepared;
  starfocus_config_init(&config);
  starfocus_light_field_init(&frame);
  starfocus_params_init(&params);
  // The calls of examples/phone/TapToFocus.swift.
  starfocus_measure_disparity(&frame.depth, &range, NULL);
  starfocus_create(&config, 0, &engine, NULL);
  starfocus_prepare(engine, &frame, 0, 0, &prepared);
  starfocus_focus_at(&frame.depth, 640, 480, 1, 2, &params.focus, NULL);
  starfocus_largest_aperture(engine, &params, &params.aperture);
  starfocus_refocus_prepared(engine, &params, prepared, &image, 0);
  starfocus_destroy_prepared(prepared);
  starfocus_destroy(engine);
  return image.format + (starfocus_version(NULL) == NULL);
}
TEXT
  quietly clang -fsyntax-only -Wall -Werror -fmodules "-fmodules-cache-path=$work/modules" \
    "-fmodule-map-file=$sources/platform/swift/Sources/CStarfocus/module.modulemap" \
    "-I$sources/lib/include" "$work/module.m"
  printf '%-40s %s\n' 'Swift, module map by clang' 'compiles'
}

program 'by hand, C99, static' "-I$sources/lib/include" "$build/lib/libstarfocus.a" \
  $(sed -n 's/^Libs.private: //p' "$build/package/starfocus.pc")

# run KIND: builds and runs the projects of one kind in a separate folder.
run() {
  work=$work/$1
  mkdir "$work"
  case "$1" in
    package) package ;;
    source) source_tree ;;
    m32) m32 ;;
    wasm) wasm ;;
    python) "$sources/tests/bindings/python/run.sh" "$build" ;;
    java) "$sources/tests/bindings/java/run.sh" "$build" ;;
    java-aarch64) java_aarch64 ;;
    swift) swift ;;
    *) preset "$1" ;;
  esac
}

# Runs two kinds at a time, since many of their steps use one core. Only one kind at a time may run ninja in the release
# build, which `package` and `python` do.
kinds=()
for kind; do
  if [ "$kind" = package ]; then (run package); else kinds+=("$kind"); fi
done
side_by_side run "${kinds[@]}"
