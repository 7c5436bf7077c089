#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: constants.sh PROGRAM PROGRAM-BEFORE [REFOCUS-OPTION...]
# Measures the effect of a changed constant, as a row of docs/constants.md. The row has the PSNR in dB of the
# pictures of PROGRAM against ray-traced truth (wires, leaves) and against the benchmark mode of PROGRAM-BEFORE
# (stilllife). The row also has the number of samples, in millions, that are rendered at the last focus of each scene.
# Compare the printed row with the row of the program before the change. starfocus-lab must be in the folder of PROGRAM.
set -eu
program=$1 before=$2
shift 2
data=$(cd "$(dirname "$0")/../../.." && pwd)/../shared/data
[ -d "$data/wires" ] || { echo "SKIPPED: the data sets are absent: $data" >&2; exit 0; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

refocus() { # PROGRAM SCENE FOCUS OUT [OPTION...]
  local program=$1 scene=$2 focus=$3 out=$4
  shift 4
  "$program" refocus "$data/$scene" -o "$out" --focus="$focus" --transfer none \
    --report "$work/report.json" "$@"
}
psnr() { "$program-lab" compare "$1" "$2" | sed 's/PSNR \([0-9.inf]*\).*/\1/'; }
samples() {
  sed -n 's/^  "rendered_samples": \([0-9]*\).*/\1/p' "$work/report.json" |
    awk '{ printf "(%.1f)", $1 / 1e6 }'
}

row=
for scene in wires:-1,0,3,7 leaves:0.5,9,-11.4; do
  for focus in $(echo "${scene#*:}" | tr , ' '); do
    refocus "$program" "${scene%:*}" "$focus" "$work/out.png" "$@"
    row="$row $(psnr "$work/out.png" "$data/${scene%:*}/truth_dt${focus}_ut1.png")"
  done
  row="$row $(samples) |"
done
for focus in -8 0 5; do
  refocus "$before" stilllife "$focus" "$work/best.png" --mode benchmark
  refocus "$program" stilllife "$focus" "$work/out.png" "$@"
  row="$row $(psnr "$work/out.png" "$work/best.png")"
done
echo "$row $(samples)"
