#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# sysroot.sh ARCHITECTURE FOLDER: unpacks the headers starfocus needs, and the target's own
# libraries where Debian has them, for a cross build. ARCHITECTURE is Debian's (arm64, armhf, armel)
# or "headers" for a target Debian has no packages of. Nothing of the host changes: see fetch.sh.
set -eu
[ $# = 2 ] || { echo "usage: $0 arm64|armhf|armel|headers FOLDER" >&2; exit 2; }
fetch="$(dirname "$0")/fetch.sh"
packages="libhwy-dev libstb-dev doctest-dev libcli11-dev nlohmann-json3-dev"
if [ "$1" = headers ]; then
  "$fetch" "$(dpkg --print-architecture)" "$2" '-' $packages
  # Libraries of another machine must not be found.
  rm -rf "$2"/usr/lib/*-linux-*
else
  # A -dev package links its library by a name that a package of another name holds.
  "$fetch" "$1" "$2" 'lib(hwy|stb|gpiod)[0-9][a-z0-9.-]*' $packages libgpiod-dev
fi
