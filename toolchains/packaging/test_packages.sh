#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: test_packages.sh FOLDER ARCHITECTURE PROGRAM
# Installs the packages of FOLDER with apt into a bare Debian 12 of ARCHITECTURE, which QEMU emulates if necessary. Runs
# the programs, compiles the C example of docs/library.md against the packages, and removes the packages. After the
# removal, no file of starfocus may remain. The installed program must write the same bytes as PROGRAM, a program
# starfocus of this machine. Requires root.
set -eu
[ $# = 3 ] || { echo "usage: $0 FOLDER ARCHITECTURE PROGRAM" >&2; exit 2; }
packages=$(cd "$1" && pwd)
program=$3
. "$(dirname "$0")/bare_debian.sh"

make_bare_debian bookworm "$2"
find "$packages" -name '*.deb' ! -name '*-dbgsym_*' -exec cp {} "$root/tmp" \;
inside sh -c 'apt-get install -y --no-install-recommends /tmp/*.deb'
inside starfocus --version
inside starfocus-lab scene /tmp/field --size 160x120 --views 5
inside starfocus refocus /tmp/field -o /tmp/program.ppm --focus 2
quietly "$program" refocus "$root/tmp/field" -o "$root/tmp/native.ppm" --focus 2
cmp "$root/tmp/program.ppm" "$root/tmp/native.ppm" || fail "expected the bytes of $program, found others"
inside sh -c 'cd /tmp && python3 -c "
import numpy, starfocus
from PIL import Image
field = starfocus.read_light_field(\"field\")
print(starfocus.__version__, field)"'
inside sh -c 'apt-get install -y --no-install-recommends gstreamer1.0-plugins-base gstreamer1.0-tools'
inside gst-inspect-1.0 starfocus
inside gst-launch-1.0 starfocus name=s ! fakesink videotestsrc num-buffers=2 ! video/x-raw,format=NV12 ! s.video \
  videotestsrc num-buffers=2 ! video/x-raw,format=GRAY8 ! s.depth
inside sh -c 'apt-get install -y --no-install-recommends gcc libc6-dev pkg-config'
cp "$(dirname "$0")/../../examples/minimal/minimal.c" "$root/tmp/example.c"
inside sh -c 'cd /tmp && gcc example.c $(pkg-config --cflags --libs starfocus) -o example && ./example'
inside sh -c 'apt-get purge -y starfocus starfocus-lab python3-starfocus libstarfocus1 libstarfocus-dev \
  gstreamer1.0-starfocus'
find "$root/usr" "$root/etc" "$root/var/lib/dpkg/info" -name '*starfocus*' | grep . && fail "files remain"
echo "installed, ran and removed in a bare Debian for $architecture: $(ls "$root"/tmp/*.deb | wc -l) packages"
