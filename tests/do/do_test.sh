#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# do_test.sh SOURCES: checks the messages and exit codes of ./do build on machines without some tools. The test replaces
# tools by fake programs. The programs dpkg and apt-get are absent. The test also checks the commands of ./do bare.
set -eu
sources=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/tree" "$work/bin"
cp -r "$sources/do" "$sources/toolchains" "$work/tree"
for name in cat cut dirname env grep id mkdir nproc rm sed sleep tail tr; do
  ln -s "$(command -v $name)" "$work/bin"
done

# build: runs ./do build. Sets $result to the exit code, and writes the output to the file `said`.
build() {
  result=0
  PATH="$work/bin" CXX= CMAKE_PREFIX_PATH= "$work/tree/do" build >"$work/said" 2>&1 || result=$?
}

fail() {
  echo "do_test: $1; ./do build said:" >&2
  cat "$work/said" >&2
  exit 1
}

build
[ $result != 0 ] || fail "nothing is there and nothing is missed"
for package in g++ cmake ninja-build libhwy-dev libstb-dev doctest-dev libcli11-dev; do
  grep -qwF -e "$package" "$work/said" || fail "$package is not named"
done

for name in cmake ninja pkg-config; do
  printf '#!/bin/sh\n' >"$work/bin/$name"
done
# This fake compiler finds all headers except CLI/CLI.hpp.
printf '#!/bin/sh\n! grep -q CLI/CLI.hpp\n' >"$work/bin/c++"
chmod +x "$work"/bin/*
build
[ $result != 0 ] || fail "a missing header is not missed"
grep -qE 'packages.*: libcli11-dev$' "$work/said" || fail "expected libcli11-dev alone to be named"

printf '#!/bin/sh\n' >"$work/bin/c++"
build
[ $result = 0 ] || fail "everything is there, and it fails"

# Each command of the help installs packages, except `help` and `bare` itself, and is tried in a bare Debian.
"$work/tree/do" help | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p' | grep -vxE 'help|bare' | sort -u >"$work/commands"
bash -c '. "$0" && echo "$BARE_COMMANDS"' "$work/tree/toolchains/packaging/bare.sh" | sed 's/ .*//' | sort -u >"$work/tried"
diff "$work/commands" "$work/tried" >"$work/said" || fail "the help (<) and BARE_COMMANDS (>) have different commands"
