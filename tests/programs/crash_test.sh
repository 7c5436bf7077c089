#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: crash_test.sh PROGRAM LIBRARY PHOTOS
# Checks that a photo that makes a decoder crash causes one error, that a batch continues, and that no partial file
# remains. Checks that commands that start no programs cannot connect to networks. Checks that --threads limits the
# threads of libraries. LIBRARY makes libjpeg crash on the file whose size is $CRASH_SIZE, and programs that run more
# threads than $MOST_THREADS. PHOTOS is a folder with small depth photos, next to the folder heif.
set -eu
[ $# = 3 ] || { echo "usage: $0 PROGRAM LIBRARY PHOTOS" >&2; exit 2; }
program=$1 library=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$3/gdepth.jpg" "$folder/bad.jpg"
cp "$3/dynamic.jpg" "$folder/good.jpg"
cd "$folder"
export LC_ALL=C CRASH_SIZE="$(wc -c <bad.jpg)"
error='bad.jpg: expected a file that can be decoded, found one that makes the decoder crash (Aborted)'

fail() {
  echo "$*" >&2
  cat log >&2
  exit 1
}

status=0
LD_PRELOAD=$library "$program" refocus bad.jpg -o out.jpg 2>log || status=$?
[ $status = 1 ] || fail "expected exit code 1, found $status"
[ "$(cat log)" = "starfocus: $error" ] || fail "expected the error: $error"
[ ! -e out.jpg ] || fail "expected no output of a photo that cannot be decoded"

status=0
LD_PRELOAD=$library "$program" refocus bad.jpg good.jpg -o out 2>log || status=$?
[ $status = 1 ] || fail "batch: expected exit code 1, found $status"
grep -qxF "starfocus: $error" log || fail "batch: expected the error: $error"
[ "$(ls -A out)" = good.jpg ] || fail "batch: expected good.jpg alone, found $(ls -A out)"

# The program itself decodes the views of light-field folders.
export NO_NETWORK=1
mkdir lf
cp good.jpg lf/view_+0.0_+0.0.png
LD_PRELOAD=$library "$program" info lf >log 2>&1 || fail "expected that a decoder cannot connect to a network"
! (LD_PRELOAD=$library "$program" info lf --depth-command 'cp {input} {output}') >log 2>&1 ||
  fail "expected that --depth-command keeps the network"

# libde265 always starts a thread of its own, for which libheif waits. Decoders for AV1 can use the first thread.
if LD_PRELOAD=$library "$program" info "$3/../heif/depth.heic" --near white >/dev/null 2>log; then
  LD_PRELOAD=$library MOST_THREADS=1 "$program" refocus "$3/../heif/depth.heic" -o out.jpg --near white --threads 1 \
    2>log || fail "expected that a decoder for HEVC starts one thread"
  { printf 'P5 24 16 255\n' && head -c 384 "$program"; } >map.pgm
  LD_PRELOAD=$library MOST_THREADS=0 "$program" refocus "$3/../heif/plain.avif" -o out.jpg --near white \
    --depth map.pgm --threads 1 2>log || fail "expected that a decoder for AV1 starts no thread"
fi
