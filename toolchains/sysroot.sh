#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# sysroot.sh ARCHITECTURE FOLDER: unpacks the headers and libraries that a cross build of starfocus requires.
# ARCHITECTURE is an architecture of Debian (arm64, armhf, armel), or "headers" for a target without Debian packages.
# The script does not change the host: see fetch.sh.
set -eu
[ $# = 2 ] || { echo "usage: $0 arm64|armhf|armel|headers FOLDER" >&2; exit 2; }
fetch="$(dirname "$0")/fetch.sh"
packages="libhwy-dev libstb-dev doctest-dev libcli11-dev nlohmann-json3-dev"
if [ "$1" = headers ]; then
  "$fetch" "$(dpkg --print-architecture)" "$2" '-' $packages
  # Prevents CMake from finding libraries of another machine.
  rm -rf "$2"/usr/lib/*-linux-*
else
  # For each -dev package, the library is in a package with another name.
  "$fetch" "$1" "$2" 'lib(hwy|stb|gpiod)[0-9][a-z0-9.-]*' $packages libgpiod-dev
fi
