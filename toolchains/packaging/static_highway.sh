#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: static_highway.sh FOLDER
# Downloads Debian's source package of Highway, and installs its static library and CMake package to the new folder
# FOLDER, because Debian's package of Highway has only a shared library. Requires dpkg-dev, but not root.
set -eu
[ $# = 1 ] || { echo "usage: $0 FOLDER" >&2; exit 2; }
architecture=$(dpkg --print-architecture)
. "$(dirname "$0")/../private_apt.sh"
sed -i -e 's/^Types:.*/Types: deb-src/' -e 's/^deb /deb-src /' "$work"/parts/*
private_apt apt-get update
(cd "$work" && private_apt apt-get source highway)
cmake -G Ninja -S "$work"/highway-* -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
  -DHWY_ENABLE_CONTRIB=OFF -DHWY_ENABLE_EXAMPLES=OFF -DHWY_ENABLE_TESTS=OFF -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
  "-DCMAKE_CXX_FLAGS=-ffile-prefix-map=$work=."
cmake --build "$work/build"
cmake --install "$work/build" --prefix "$1"
