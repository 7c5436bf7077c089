#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: ./do bench [--quick | --speed | --check | --record | --micro | --flicker]
#
# Measures time and error of every mode, and writes a report: build/bench/report.html.
#   --quick   small pictures, few of them: a minute or two
#   --speed   only compares the time with shift-and-add of 13 views, at each vector width of the machine: block mode with
#             5 views and one worker, on the scene portrait and the data set leaves
#   --check   only compares instruction counts with examples/lab/bench/baseline.txt
#   --record  writes that file anew
#   --micro   only times kernels, the line scan and small pictures
#   --flicker only measures the flicker of five frames with exact, unstable and repaired maps, and compares the table
#             with examples/lab/bench/flicker.txt; rendering the frames takes nine minutes of processor time
. "$(dirname "$0")/../../../toolchains/steps.sh"

check_counts() {
  install valgrind
  ./do build starfocus_lab starfocus_valgrind starfocus-bench-count starfocus_instruction_bench || exit 1
  examples/lab/bench/count.sh $BUILD "$1"
}

micro() {
  install build libbenchmark-dev
  ./do build starfocus-bench-micro || exit 1
  $BUILD/starfocus-bench-micro || fail "the micro bench failed"
}

# scene NAME ARGUMENT...: renders a scene unless the scene already exists.
scene() {
  local folder=build/bench/$1
  shift
  [ -f "$folder/meta.txt" ] || lab "made the light field $folder" scene "$folder" "$@"
}

# flicker: compares the table of starfocus-lab flicker with the recorded table, whose figures are equal on all machines.
flicker() {
  local clip=build/bench/clip table=build/bench/flicker.txt recorded=examples/lab/bench/flicker.txt
  ./do build starfocus_lab || exit 1
  [ -f $clip/frame_0004/meta.txt ] || lab "made the frames $clip" scene $clip --size 640x480 --views 5 --frames 5 \
    --unstable 1 --truth 4.9,0.4
  $BUILD/starfocus-lab flicker $clip >$table || fail "measuring the flicker failed"
  cat $table
  diff $recorded $table || fail "the flicker changed; if the change is intended, copy $table to $recorded"
}

# speed: compares the engine with shift-and-add. Minima of 20 rounds hardly depend on other processes.
speed() {
  local fields="build/bench/portrait-speed 10 none build/bench/portrait-speed -11 none" leaves=../shared/data/leaves
  ./do build starfocus_lab starfocus-bench-speed || exit 1
  scene portrait-speed --name portrait --transfer none --truth=10,1 --truth=-11,1
  [ ! -f $leaves/disparity.pfm ] || fields="$fields $leaves 9 none"
  $BUILD/starfocus-bench-speed 20 $fields || fail "comparing the speed failed"
}

# measure [--quick]: measures every mode, and writes the report.
measure() {
  local folder fields=build/bench/portrait-small options="--views 5,9 --max-layers 0,1 --rules
    --n-scales 0.5,0.7,1,1.4,2 --targets all --workers 2"
  install build gnuplot-nox python3
  ./do build starfocus_lab starfocus-bench || exit 1
  mkdir -p build/bench
  scene portrait-small --name portrait --size 512x384 --truth=3.5,1
  if [ $# = 1 ]; then
    options="$options --quantiles 0.1,0.5,0.9 --repetitions 3 --patience 0.5 --largest-radius 16 --largest-size 1"
  else
    options="$options --quantiles 0.1,0.3,0.5,0.7,0.9 --apertures 1,0.5,0.25 --superblocks 32,128,256 --largest-radius 64
      --largest-size 16"
    fields="build/bench/portrait build/bench/ramp build/bench/hair-scene"
    scene portrait --name portrait --truth=7.84,1 --truth=-8.6,1
    scene ramp --name ramp --size 512x384
    scene hair-scene --name hair --truth=10,1 --truth=-11.4,1
    for folder in ../shared/data/*/; do
      [ -f "$folder/disparity.pfm" ] && fields="$fields $folder"
    done
  fi
  $BUILD/starfocus-bench $fields $options --sweep build/bench/portrait-small \
    --revision "$(git rev-parse --short HEAD 2>/dev/null)" --csv build/bench/results.csv \
    --json build/bench/results.json || fail "the bench failed"
  python3 examples/lab/bench/report.py build/bench/results.json examples/lab/bench/baseline.txt \
    toolchains/board/instruction_counts.txt >build/bench/report.html || fail "the report failed"
  echo "report: build/bench/report.html; rows: build/bench/results.csv and .json"
}

help_if_asked "$@"
case "$*" in
  '' | --quick) measure "$@" ;;
  --check) check_counts check ;;
  --record) check_counts record ;;
  --micro) micro ;;
  --speed) speed ;;
  --flicker) flicker ;;
  *) fail "./do bench: expected --quick, --speed, --check, --record, --micro, --flicker or nothing, found '$*'" ;;
esac
