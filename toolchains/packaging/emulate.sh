#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: emulate.sh ARCHITECTURE COMMAND...
# Runs a command, during which the kernel starts programs of ARCHITECTURE with QEMU. The registration of QEMU exists
# only in a user namespace of the command, so the host does not change. Requires root, qemu-user-static, and Linux 6.7.
# If the host can run programs of ARCHITECTURE itself, runs only the command.
set -eu
[ $# -ge 2 ] || { echo "usage: $0 ARCHITECTURE COMMAND..." >&2; exit 2; }
case "$1" in
  "$(dpkg --print-architecture)") shift && exec "$@" ;;
  arm64) name=qemu-aarch64 ;;
  armhf) name=qemu-arm ;;
  *) echo "$0: expected arm64 or armhf, found '$1'" >&2 && exit 2 ;;
esac
shift
[ ! -e "/proc/sys/fs/binfmt_misc/$name" ] || exec "$@"

# The inner shell is user 65534 until this shell maps all users to themselves.
unshare --user --mount --pid --fork --kill-child sh -ec '
  until [ "$(id -u)" = 0 ]; do sleep 0.1; done
  mount -t binfmt_misc none /proc/sys/fs/binfmt_misc
  cat "$0" >/proc/sys/fs/binfmt_misc/register
  exec "$@"' "/usr/lib/binfmt.d/$name.conf" "$@" &
until echo "0 0 65536" 2>/dev/null >/proc/$!/uid_map; do
  kill -0 $!
  sleep 0.1
done
echo "0 0 65536" >/proc/$!/gid_map
wait $!
