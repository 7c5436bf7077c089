#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: debian_root.sh FOLDER SUITE ARCHITECTURE
# Installs a minimal Debian of any architecture into FOLDER, from the mirror and with the proxy settings of the host.
# Requires root.
set -eu
[ $# = 3 ] || { echo "usage: $0 FOLDER SUITE ARCHITECTURE" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
# The mirror of the host's own release; debootstrap has a default if the host's package sources do not name one.
mirror=$(. /etc/os-release && apt-get indextargets --format '$(RELEASE) $(REPO_URI)' 'Created-By: Packages' |
  sed -n "s/^$VERSION_CODENAME //p" | head -n 1)
debootstrap --variant=minbase --foreign --arch="$3" "$2" "$1" ${mirror:+"$mirror"}
# dpkg waits for the disk after each file. A folder that can be made again does not need this.
mkdir -p "$1/etc/dpkg/dpkg.cfg.d"
echo force-unsafe-io >"$1/etc/dpkg/dpkg.cfg.d/unsafe-io"
# The user namespace of emulate.sh cannot create devices. debootstrap supports this restriction for containers of LXC.
"$here/emulate.sh" "$3" chroot "$1" env container=lxc /debootstrap/debootstrap --second-stage
cp /etc/resolv.conf "$1/etc/"
cp -r /etc/apt/apt.conf.d "$1/etc/apt/"
"$here/emulate.sh" "$3" chroot "$1" apt-get update
