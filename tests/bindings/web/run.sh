#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: run.sh BUILD WEB
# Packs the npm package of the build folder WEB, installs it into an empty project, and tests it in node. Then
# tests the page of WEB in Debian's Chromium, which playwright-core from npm controls. The programs of BUILD
# compute the expected pictures. Finally builds the README's example with vite, and compiles programs that use the
# package's types. package-lock.json has the versions of all tools.
set -eu
[ $# = 2 ] || { echo "usage: $0 BUILD WEB" >&2; exit 2; }
sources=$(cd "$(dirname "$0")/../../.." && pwd)
tests=$sources/tests/bindings/web
build=$(cd "$1" && pwd)
web=$(cd "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
STARFOCUS_PROGRAM=$build/starfocus STARFOCUS_FIELD=$work/field STARFOCUS_SITE=$web/site
STARFOCUS_GOLDEN_FILE=$sources/tests/lib/golden.txt STARFOCUS_SERVER=$sources/examples/web/serve.mjs
STARFOCUS_SCREENSHOTS=$web/screenshots
export STARFOCUS_PROGRAM STARFOCUS_FIELD STARFOCUS_SITE STARFOCUS_GOLDEN_FILE STARFOCUS_SERVER STARFOCUS_SCREENSHOTS

# quietly COMMAND...: runs a command. Only if the command fails, prints each failed test case with the reason, and the end
# of the output.
log=$work/log
quietly() {
  "$@" >"$log" 2>&1 || { grep -A 30 '^ *not ok ' "$log" >&2 || :; tail -n 60 "$log" >&2; echo "web: failed: $*" >&2; exit 1; }
}

# run NAME: runs a test in the project, and prints the number of passed cases and the measured times.
run() {
  start=$(date +%s) log=$work/$1.log
  quietly node --test --test-reporter=tap "$1"
  printf '%-40s %s tests passed (%d s)\n' "$1" "$(sed -n 's/^# pass //p' "$log")" $(($(date +%s) - start))
  sed -n -E 's/^[# \\]*((slow phone|12 megapixels|renderer): .*)/  \1/p' "$log"
  sed -n 's/^ok [0-9]* - \(.*\) # SKIP/  skipped: \1:/p' "$log"
}

quietly "$STARFOCUS_PROGRAM-lab" scene "$work/field" --name portrait --size 320x240 --views 5
(cd "$web/npm" && quietly npm pack --pack-destination "$work")
STARFOCUS_PACKAGE=$(echo "$work"/starfocus-*.tgz)
export STARFOCUS_PACKAGE
size=$(stat -c %s "$STARFOCUS_PACKAGE")
printf '%-40s %d bytes\n' 'the npm package' "$size"
[ "$size" -le 250000 ] || { echo "web: package too large (expected at most 250000 bytes, found $size)" >&2; exit 1; }
mkdir -p "$work/project" "$STARFOCUS_SCREENSHOTS"
cd "$work/project"
cp "$tests"/*.mjs "$tests"/*.ts .
echo '{"private": true, "type": "module"}' >package.json
quietly npm install --offline --no-audit --no-fund "$STARFOCUS_PACKAGE"
run golden_test.mjs
run package_test.mjs
run photo_test.mjs

# The project finds the tools in the parent folder. npm keeps the downloads in its cache. After a change of a version,
# `npm install --package-lock-only --omit-lockfile-registry-resolved` updates the lock file. The lock file must contain no
# addresses: delete its `funding` fields.
! grep -n :// "$tests/package-lock.json" || exit 1
cp "$tests"/package*.json "$work"
(cd "$work" && quietly npm ci --prefer-offline --no-audit --no-fund)

# The page uses one core for most of its time, and vite uses the other core.
run page_test.mjs &
page=$! result=0
run bundler_test.mjs &
wait $page || result=1
wait $! || result=1
exit $result
