#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: valgrind.sh BUILD-FOLDER ARGUMENT...
# Runs a program of a build folder under valgrind.
set -eu
preloaded=$1/tests/libstarfocus_valgrind.so
shift
[ -f "$preloaded" ] || { echo "$preloaded: expected the library that tests/CMakeLists.txt builds, found none" >&2; exit 1; }
LD_PRELOAD=$(realpath "$preloaded") exec valgrind "$@"
