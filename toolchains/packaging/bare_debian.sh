# SPDX-License-Identifier: Apache-2.0
# Functions of tests that install packages into a bare Debian; sourced by scripts of this folder. Requires root.

fail() { echo "$(basename "$0" .sh): $*" >&2; exit 1; }

# quietly COMMAND...: runs a command, and prints its output only if the command fails.
quietly() {
  "$@" >"$root/log" 2>&1 || {
    tail -n 30 "$root/log" >&2
    fail "failed: $*"
  }
}

# make_bare_debian SUITE [ARCHITECTURE]: makes a bare Debian of ARCHITECTURE, by default that of the host, in the new
# folder $root, which is removed when the script ends.
make_bare_debian() {
  architecture=${2:-$(dpkg --print-architecture)}
  root=$(mktemp -d)
  trap 'rm -rf "$root"' EXIT
  trap 'exit 1' HUP INT TERM
  quietly "$(dirname "$0")/debian_root.sh" "$root" "$1" "$architecture"
}

# inside COMMAND...: runs a command in the bare Debian, which lacks the compiler cache of this machine. Prints the output
# only if the command fails.
inside() {
  quietly "$(dirname "$0")/emulate.sh" "$architecture" chroot "$root" env -u CMAKE_C_COMPILER_LAUNCHER \
    -u CMAKE_CXX_COMPILER_LAUNCHER DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"
}
