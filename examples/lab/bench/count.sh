#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: count.sh BUILD-FOLDER check|record Counts the instructions per pixel of starfocus_refocus with callgrind, and
# compares the counts with baseline.txt or writes baseline.txt. Every run has the same counts, so counts reveal
# slowdowns that are too small for a clock.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
baseline=$here/baseline.txt
build=$1
program=$build/starfocus-bench-count
target=AVX2 # valgrind hides AVX-512
allowed=3   # percent
skip() {
  echo "SKIPPED the comparison of instruction counts: $*"
  exit 0
}

[ "$(uname -m)" = x86_64 ] || skip "this is not x86-64"
command -v valgrind >/dev/null || { echo "install the package valgrind first" >&2; exit 1; }
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
compiler=$("$compiler" --version | sed -n '1s/^[^ ]* //p') # without the program's own name

# count NAME ARGUMENT...: runs starfocus-bench-count with these arguments, and prints
# "NAME instructions-per-pixel".
count() {
  local name=$1 out=$build/callgrind.$1 log=$build/callgrind.$1.log pixels instructions found
  shift
  "$here/../../../tests/support/valgrind.sh" "$build" --tool=callgrind --callgrind-out-file="$out" --toggle-collect=starfocus_refocus \
    "$program" "$@" >"$log" 2>"$log.err" || { cat "$log" "$log.err" >&2; exit 1; }
  read -r pixels found <"$log"
  [ "$found" = $target ] || { echo "target $found"; return; }
  instructions=$(awk '/^(summary|totals):/ { print $2; exit }' "$out")
  awk -v m="$name" -v i="$instructions" -v p="$pixels" 'BEGIN { printf "%s %.1f\n", m, i / p }'
}

# count_case NAME PIXELS KERNELS: runs a case of instruction_bench, and prints
# "NAME KERNELS instructions-per-pixel". `toolchains/board/board count` counts the same cases on AArch64.
count_case() {
  local out=$build/callgrind.$1.$3 instructions
  "$here/../../../tests/support/valgrind.sh" "$build" --tool=callgrind --callgrind-out-file="$out" --toggle-collect=starfocus_refocus \
    "$build/tests/instruction_bench" "$1" "$3" 1 >"$out.log" 2>&1 || { cat "$out.log" >&2; exit 1; }
  instructions=$(awk '/^(summary|totals):/ { print $2; exit }' "$out")
  awk -v n="$1 $3" -v i="$instructions" -v p="$2" 'BEGIN { printf "%s %.1f\n", n, i / p }'
}

# begin COMMAND...: runs a command in the background. The command prints one line of counts. At most one command per
# core runs at a time.
lines=$(mktemp -d)
trap 'rm -rf "$lines"' EXIT
begun=0 running=0
begin() {
  if [ $running -ge "$(nproc)" ]; then
    wait -n
    running=$((running - 1))
  fi
  begun=$((begun + 1)) running=$((running + 1))
  "$@" >"$lines/$(printf %03d $begun)" &
}

for mode in block frame; do begin count $mode $mode; done
# Hair is fine structure in front of a distant wall. The instructions for hair are counted with 5 views and with 1 view.
hair=$build/count-hair
"$build/starfocus-lab" scene "$hair" --name hair --size 512x384 --views 5 >/dev/null
for views in 5 1; do begin count hair-$views block "$hair" $views; done
cases=$("$build/tests/instruction_bench" list)
while read -r name pixels; do
  for kernels in simd reference; do begin count_case "$name" "$pixels" $kernels; done
done <<<"$cases"
while [ $running -gt 0 ]; do
  wait -n
  running=$((running - 1))
done
other=$(sed -n 's/^target //p' "$lines"/* | head -n 1)
[ -z "$other" ] || skip "kernels run on $other, the baseline is of $target"
counts=$(cat "$lines"/*)$'\n'

if [ "$2" = record ]; then
  {
    echo "# Instructions per pixel of starfocus_refocus on $target; ./do bench --record writes this."
    echo "compiler $compiler"
    printf '%s' "$counts"
  } >"$baseline"
  cat "$baseline"
  exit 0
fi

recorded=$(sed -n 's/^compiler //p' "$baseline")
worse=0
# The last word of a line is the count. The words before the count are the name of the case.
while read -r line; do
  mode=${line% *} now=${line##* }
  before=$(sed -n "s/^$mode \([0-9.]*\)\$/\1/p" "$baseline")
  [ -n "$before" ] || { echo "$mode: no baseline, run ./do bench --record" >&2; exit 1; }
  awk -v m="$mode" -v n="$now" -v b="$before" -v a=$allowed 'BEGIN {
    printf "%s: %.1f instructions per pixel, baseline %.1f (%+.1f %%)\n", m, n, b, 100 * (n / b - 1)
    exit n <= 0 || n > b * (1 + a / 100) }' || worse=1
done <<<"${counts%$'\n'}"
if [ "$recorded" != "$compiler" ]; then
  skip "the baseline is of $recorded, this is $compiler"
fi
[ $worse = 0 ] || { echo "instructions grew by more than $allowed %; if that is right: ./do bench --record" >&2; exit 1; }
