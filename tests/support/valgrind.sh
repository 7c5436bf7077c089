#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs a program of a build folder under valgrind. usage: valgrind.sh BUILD-FOLDER ARGUMENT...
set -eu
preloaded=$1/tests/libstarfocus_valgrind.so
shift
[ -f "$preloaded" ] || { echo "$preloaded: expected to be built, found none" >&2; exit 1; }
LD_PRELOAD=$(realpath "$preloaded") exec valgrind "$@"
