# SPDX-License-Identifier: Apache-2.0
# Functions of tests that install packages into a bare Debian; sourced by scripts of this folder. Requires root.

fail() { echo "$(basename "$0" .sh): $*" >&2; exit 1; }

# make_bare_debian SUITE: makes a bare Debian with debootstrap in the new folder $root, which is removed when the script
# ends. The package sources are those of the host (Debian 12, bookworm) for this suite.
make_bare_debian() {
  root=$(mktemp -d)
  trap 'rm -rf "$root"' EXIT
  trap 'exit 1' HUP INT TERM
  debootstrap --variant=minbase "$1" "$root" >"$root/log" 2>&1 || {
    tail -n 30 "$root/log" >&2
    fail "debootstrap failed"
  }
  cp /etc/resolv.conf "$root/etc/"
  rm -f "$root/etc/apt/sources.list"
  cp -r /etc/apt/sources.list* /etc/apt/apt.conf.d "$root/etc/apt/"
  find "$root/etc/apt/" -name '*.list' -o -name '*.sources' | xargs sed -i "s/bookworm/$1/g"
  inside apt-get update
}

# inside COMMAND...: runs a command in the bare Debian. Prints the output only if the command fails.
inside() {
  chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@" >"$root/log" 2>&1 || {
    tail -n 30 "$root/log" >&2
    fail "failed: $*"
  }
}
