#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# do_test.sh SOURCES: checks the messages and exit codes of ./do build on machines without some tools. The test replaces
# tools by fake programs. The programs dpkg and apt-get are absent. The test also checks the helps of ./do and of the other
# scripts for developers, and the commands of toolchains/packaging/bare.
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

# commands SCRIPT: prints the commands that the help of a script lists.
commands() { "$1" --help | sed -n "s|^  \([a-z][a-z0-9-]*\) .*|$1 \1|p"; }

# Each command of the project installs packages, except `help` and `bare`, and is tried in a bare Debian.
cd "$sources"
{
  commands ./do
  commands toolchains/board/board
  commands toolchains/site/web
  commands tests/bindings/run.sh
  printf 'toolchains/%s\n' packaging/package packaging/release packaging/wheel site/site
} | grep -vx './do help' | sort -u >"$work/commands"
toolchains/packaging/bare --list | awk '{ print (/packaging|site\/site/ ? $1 : $1 " " $2) }' | sort -u >"$work/tried"
diff "$work/commands" "$work/tried" >"$work/said" || fail "the helps (<) and toolchains/packaging/bare (>) differ"

# Each of these scripts explains itself, and rejects a wrong argument in one line that names it.
for script in ./do $(find toolchains tests/bindings -type f -perm -u+x -exec grep -l help_if_asked {} +); do
  "$script" --help | grep -q "^usage: $script" || fail "$script --help does not begin with its usage"
  case $script in *install.sh | *bare) continue ;; esac
  ! "$script" --nonsense >"$work/said" 2>&1 || fail "$script accepts --nonsense"
  [ "$(wc -l <"$work/said")" = 1 ] && grep -q -e "'--nonsense'" "$work/said" || fail "$script --nonsense: expected one line"
done
