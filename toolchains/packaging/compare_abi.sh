#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: compare_abi.sh [REVISION]
# Compares the ABI of the shared library at HEAD with REVISION (default: the newest tag v* before HEAD) by abidiff. Fails
# if the ABI changed, except for new functions, and both libraries have the same SOVERSION.
set -eu
cd "$(dirname "$0")/../.."
previous=${1:-$(git describe --tags --abbrev=0 --match 'v*' HEAD~ 2>/dev/null)} || previous=
[ -n "$previous" ] || { echo "no earlier release: there is no ABI to compare"; exit; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

# library REVISION FOLDER: builds and installs the shared library with debug information.
library() {
  mkdir -p "$work/$2/tree"
  git archive "$1" | tar -x -C "$work/$2/tree"
  cmake -S "$work/$2/tree" -B "$work/$2/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-g -DSTARFOCUS_SHARED=ON \
    -DSTARFOCUS_STATIC_DISPATCH=ON -DSTARFOCUS_PROGRAMS=OFF -DSTARFOCUS_TESTS=OFF
  cmake --build "$work/$2/build" --parallel "$(nproc)" --target starfocus_shared
}

soname() { readelf -d "$1" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p'; }

library "$previous" old
library HEAD new
old=$work/old/build/lib/libstarfocus.so new=$work/new/build/lib/libstarfocus.so
changes=0
abidiff --no-added-syms --headers-dir1 "$work/old/tree/lib/include" --headers-dir2 "$work/new/tree/lib/include" "$old" "$new" ||
  changes=$?
[ $((changes & 3)) = 0 ] || { echo "abidiff failed" >&2; exit 1; }
if [ $changes != 0 ] && [ "$(soname "$old")" = "$(soname "$new")" ]; then
  echo "the ABI changed since $previous: expected another SOVERSION than in $(soname "$new")" >&2
  exit 1
fi
case $changes in
  0) echo "the ABI of $previous is unchanged" ;;
  *) echo "the ABI changed since $previous, and $(soname "$old") became $(soname "$new")" ;;
esac
