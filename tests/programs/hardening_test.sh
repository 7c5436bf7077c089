#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: hardening_test.sh PROGRAM...
# Checks that each program can be loaded at any address (PIE), that the linker resolves all symbols before the program
# starts and makes their addresses read-only (full RELRO), and that the compiler added checks of the stack and of the
# functions of the C library (_FORTIFY_SOURCE).
set -eu
[ $# -gt 0 ] || { echo "usage: $0 PROGRAM..." >&2; exit 2; }

# need PROGRAM WHAT PATTERN OPTION...: fails if readelf prints no line with the pattern.
need() {
  program=$1 what=$2 pattern=$3
  shift 3
  readelf -W "$@" "$program" | grep -q -- "$pattern" || {
    echo "$program: expected $what, found none" >&2
    exit 1
  }
}

for program; do
  need "$program" "a position-independent program" 'Type: *DYN' --file-header
  need "$program" "read-only relocations" GNU_RELRO --segments
  need "$program" "symbols that are resolved at the start" 'FLAGS.* NOW' --dynamic
  need "$program" "a check of the stack" __stack_chk_fail --symbols
  need "$program" "checks of functions of the C library" '__[a-z]*_chk@' --symbols
done
