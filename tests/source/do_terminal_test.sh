#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# do_terminal_test.sh SOURCES: checks that ./do prints the progress of a step in one line of a terminal of any width.
set -eu
export LC_ALL=C.UTF-8
sources=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "do_terminal_test: $1" >&2
  exit 1
}

# columns: prints the largest number of columns of a line of the standard input.
columns() { wc -L; }

long='[1/2] Building CXX object lib/engine.o'
wide='翻訳中: ファイル ‘ü’ 한국어'
(
  . "$sources/toolchains/steps.sh" # defines the functions
  for text in "$long" "$wide" "$(printf 'broken \377 \303')"; do
    for ((width = 0; width < 60; ++width)); do
      shown=$(fit "$text" $width)
      [ "$(columns <<<"$shown")" -le $width ] || fail "'$shown' is wider than $width columns"
      [ "${text:0:${#shown}}" = "$shown" ] || fail "'$shown' is not the start of '$text'"
    done
    [ "$shown" = "$text" ] || fail "'$text' is cut, although it fits"
  done
  [ "$(fit "$long" 20)" = "${long:0:20}" ] || fail "'$long' does not use all of 20 columns"
)

script -qec true /dev/null >"$work/said" 2>&1 </dev/null || {
  echo "SKIPPED: this machine has no pseudoterminals; is /dev/pts mounted?"
  exit
}
mkdir -p "$work/tree" "$work/bin"
cp -r "$sources/do" "$sources/toolchains" "$work/tree"
# The compiler finds all headers. cmake prints a long line, and ends after the terminal showed it, but at most 10 s later.
for name in c++ ninja pkg-config; do printf '#!/bin/sh\n' >"$work/bin/$name"; done
cat >"$work/bin/cmake" <<FAKE
#!/bin/sh
printf '%s\t\033[31m%s\n' "\$1" '$wide $long'
for wait in \$(seq 100); do
  grep -qe ": \$1" '$work/said' && exit
  sleep 0.1
done
FAKE
chmod +x "$work"/bin/*
script -qefc "stty cols 50 && PATH='$work/bin:$PATH' CXX= '$work/tree/do' build" "$work/said" >/dev/null </dev/null ||
  fail "$(cat "$work/said")"
tr '\r' '\n' <"$work/said" | sed '/^Script/d; s/\x1b\[K//g' >"$work/lines"
grep -q '^building everything in build/release: --build ' "$work/lines" || fail "no progress: $(cat "$work/lines")"
[ "$(columns <"$work/lines")" -lt 50 ] || fail "expected at most 49 columns: $(cat "$work/lines")"
