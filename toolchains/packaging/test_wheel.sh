#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: test_wheel.sh FOLDER BUILD
# Installs the wheel of FOLDER into a bare Debian 12 and a bare Debian 13, whose numpy has version 2, and the source
# archive of FOLDER into a bare Debian 12. pip has no network. The installed packages must refocus with the same bytes
# as the program of the build folder BUILD. Requires root.
set -eu
[ $# = 2 ] || { echo "usage: $0 FOLDER BUILD" >&2; exit 2; }
folder=$(cd "$1" && pwd)
build=$(cd "$2" && pwd)
tools=$(cd "$(dirname "$0")" && pwd)
. "$tools/bare_debian.sh"

# try LABEL PATTERN: installs the files of FOLDER that match the pattern into a new environment, and runs the package.
try() {
  cp "$folder"/$2 "$tools/try_wheel.py" "$root/tmp/"
  "$build/starfocus-lab" scene "$root/tmp/field" --size 160x120 --views 5 >/dev/null
  "$build/starfocus" refocus "$root/tmp/field" -o "$root/tmp/expected.png" --focus 2 --aperture 0.5 >/dev/null
  inside rm -rf /tmp/environment
  inside python3 -m venv --system-site-packages /tmp/environment
  inside unshare --net sh -c "/tmp/environment/bin/pip install --no-index --no-build-isolation /tmp/$2"
  inside /tmp/environment/bin/python /tmp/try_wheel.py /tmp/field /tmp/expected.png
  printf '%-30s %s\n' "$1" "$(tail -n 1 "$root/log")"
}

make_bare_debian trixie
inside apt-get install -y --no-install-recommends python3-numpy python3-pil python3-venv
try 'wheel in Debian 13' 'starfocus-*.whl'
rm -rf "$root"
make_bare_debian bookworm
inside apt-get install -y --no-install-recommends python3-numpy python3-pil python3-venv
try 'wheel in Debian 12' 'starfocus-*.whl'
inside apt-get install -y --no-install-recommends g++ cmake make libhwy-dev libstb-dev libcli11-dev \
  nlohmann-json3-dev libjpeg62-turbo-dev libpng-dev libdeflate-dev libwebp-dev libexpat1-dev libexif-dev \
  python3-setuptools python3-wheel
try 'source archive in Debian 12' 'starfocus-*.tar.gz'
