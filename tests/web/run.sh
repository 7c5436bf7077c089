#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: run.sh BUILD WEB
# Packs the npm package of the build folder WEB, installs it into an empty project, and tests it in node. Then
# tests the page of WEB in Debian's Chromium, which playwright-core from npm controls. The programs of BUILD
# compute the expected pictures.
set -eu
[ $# = 2 ] || { echo "usage: $0 BUILD WEB" >&2; exit 2; }
sources=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
web=$(cd "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
STARFOCUS_PROGRAM=$build/starfocus STARFOCUS_FIELD=$work/field STARFOCUS_SITE=$web/site
STARFOCUS_GOLDEN_FILE=$sources/tests/engine/golden.txt STARFOCUS_SERVER=$sources/examples/web/serve.mjs
STARFOCUS_SCREENSHOTS=$web/screenshots
export STARFOCUS_PROGRAM STARFOCUS_FIELD STARFOCUS_SITE STARFOCUS_GOLDEN_FILE STARFOCUS_SERVER STARFOCUS_SCREENSHOTS

# This version of playwright-core works with Debian's Chromium.
PLAYWRIGHT=1.49.1

# quietly COMMAND...: runs a command. Prints the end of the output only if the command fails.
quietly() {
  "$@" >"$work/log" 2>&1 || { tail -n 60 "$work/log" >&2; echo "web: failed: $*" >&2; exit 1; }
}

# run NAME: runs a test in the project, and prints the number of passed cases.
run() {
  start=$(date +%s)
  quietly node --test --test-reporter=tap "$1"
  printf '%-40s %s tests passed (%d s)\n' "$1" "$(sed -n 's/^# pass //p' "$work/log")" $(($(date +%s) - start))
}

quietly "$STARFOCUS_PROGRAM-lab" scene "$work/field" --name portrait --size 320x240 --views 5
(cd "$web/npm" && quietly npm pack --pack-destination "$work")
size=$(stat -c %s "$work"/starfocus-*.tgz)
printf '%-40s %d bytes\n' 'the npm package' "$size"
[ "$size" -le 225000 ] || { echo "web: package too large (expected at most 225000 bytes, found $size)" >&2; exit 1; }
mkdir -p "$work/project" "$STARFOCUS_SCREENSHOTS"
cd "$work/project"
cp "$sources"/tests/web/*.mjs .
echo '{"private": true, "type": "module"}' >package.json
quietly npm install --offline --no-audit --no-fund "$work"/starfocus-*.tgz
run golden_test.mjs
run package_test.mjs
run photo_test.mjs
quietly npm install --no-audit --no-fund "playwright-core@$PLAYWRIGHT"
run page_test.mjs
