#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: debian_root.sh FOLDER SUITE ARCHITECTURE
# Installs a minimal Debian of any architecture into FOLDER, with the proxy settings of the host. Requires root.
set -eu
[ $# = 3 ] || { echo "usage: $0 FOLDER SUITE ARCHITECTURE" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
debootstrap --variant=minbase --foreign --arch="$3" "$2" "$1"
# The user namespace of emulate.sh cannot create devices. debootstrap supports this restriction for containers of LXC.
"$here/emulate.sh" "$3" chroot "$1" env container=lxc /debootstrap/debootstrap --second-stage
cp /etc/resolv.conf "$1/etc/"
cp -r /etc/apt/apt.conf.d "$1/etc/apt/"
echo "deb http://deb.debian.org/debian $2 main" >"$1/etc/apt/sources.list"
"$here/emulate.sh" "$3" chroot "$1" apt-get update
