#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: compare_abi.sh [REVISION]
# Compares the ABI of the shared library at HEAD with REVISION (default: the newest tag v* before HEAD) by abidiff.
# Fails if the ABI changed, except for new functions and new fields at the end of structures with a field `size`, and
# both libraries have the same SOVERSION.
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
# abidiff does not compare structures that grew, so the fields that both libraries list are compared.
sized='config|params|light_field|previous|report|tuning|study|observer'
cat >"$work/grown" <<TEXT
[suppress_type]
  name_regexp = ^starfocus_($sized)\$
  has_data_member_inserted_at = end
TEXT
changes=0
abidiff --no-added-syms --suppressions "$work/grown" --headers-dir1 "$work/old/tree/lib/include" \
  --headers-dir2 "$work/new/tree/lib/include" "$old" "$new" || changes=$?
[ "$(soname "$old")" != "$(soname "$new")" ] || python3 - "$old" "$new" $(echo "$sized" | tr '|' ' ') <<'TEXT' || exit 1
import ctypes, sys

class Field(ctypes.Structure):
    _fields_ = [("name", ctypes.c_char_p), ("structure", ctypes.c_char_p), ("offset", ctypes.c_uint32),
                ("count", ctypes.c_uint32), ("type", ctypes.c_int32)]

def fields(library, name):
    first, count = ctypes.POINTER(Field)(), ctypes.c_int32()
    library.starfocus_fields(name.encode(), ctypes.byref(first), ctypes.byref(count))
    return [(one.name, one.structure, one.offset, one.count, one.type) for one in first[:count.value]]

old, new = (ctypes.CDLL(path) for path in sys.argv[1:3])
for name in (f"starfocus_{word}" for word in sys.argv[3:]):
    before = fields(old, name)
    if not before or fields(new, name)[:len(before)] != before:
        sys.exit(f"the fields of {name} changed: expected new fields only at the end")
TEXT
[ $((changes & 3)) = 0 ] || { echo "abidiff failed" >&2; exit 1; }
if [ $changes != 0 ] && [ "$(soname "$old")" = "$(soname "$new")" ]; then
  echo "the ABI changed since $previous: expected another SOVERSION than in $(soname "$new")" >&2
  exit 1
fi
case $changes in
  0) echo "the ABI of $previous is unchanged" ;;
  *) echo "the ABI changed since $previous, and $(soname "$old") became $(soname "$new")" ;;
esac
