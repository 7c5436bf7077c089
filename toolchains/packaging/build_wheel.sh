#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: build_wheel.sh FOLDER
# Builds the source archive (sdist) of the Python package from the commit HEAD, and a self-contained wheel from the
# source archive, in FOLDER. Both have the same bytes in every folder and at every time. The wheel contains static
# libraries, and therefore needs nothing but the C library.
set -eu
[ $# = 1 ] || { echo "usage: $0 FOLDER" >&2; exit 2; }
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/../.."
# Debian packages whose code the wheel contains.
linked="libc6-dev libstdc++-12-dev libhwy-dev libjpeg62-turbo-dev libpng-dev zlib1g-dev libdeflate-dev libwebp-dev
  libexpat1-dev libexif-dev libseccomp-dev libsixel-dev libstb-dev libcli11-dev nlohmann-json3-dev"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct) PYTHONDONTWRITEBYTECODE=1 PIP_DISABLE_PIP_VERSION_CHECK=1
export SOURCE_DATE_EPOCH PYTHONDONTWRITEBYTECODE PIP_DISABLE_PIP_VERSION_CHECK
umask 022
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

[ -d "$folder/highway" ] || toolchains/packaging/static_highway.sh "$folder/highway"
rm -f "$folder"/starfocus-*
mkdir "$work/tree" "$work/wheel"
git archive HEAD | tar -x -C "$work/tree"
(cd "$work/tree/platform/python" && /usr/bin/python3 setup.py -q sdist --dist-dir "$work")
# Packs the archive again, with the time and the owner of its files independent of this build.
archive=$(basename "$work"/starfocus-*.tar.gz)
(cd "$work" && tar -xf "$archive" && tar --sort=name "--mtime=@$SOURCE_DATE_EPOCH" --owner=0 --group=0 \
  --numeric-owner --mode=u=rwX,go=rX -c "${archive%.tar.gz}") | gzip -9n >"$folder/$archive"

CMAKE_ARGS="-GNinja -DSTARFOCUS_STATIC_PROGRAMS=ON -Dhwy_DIR=$folder/highway/lib/cmake/hwy \
  -DCMAKE_EXE_LINKER_FLAGS=-s -DCMAKE_MODULE_LINKER_FLAGS=-s" \
  /usr/bin/python3 -m pip wheel --no-index --no-deps --no-build-isolation --no-cache-dir \
  -w "$work/wheel" "$folder/$archive"
/usr/bin/python3 toolchains/packaging/tag_wheel.py "$work"/wheel/starfocus-*.whl "$folder" $linked
