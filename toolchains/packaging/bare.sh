# SPDX-License-Identifier: Apache-2.0
# Command of ./do that tries the other commands in a bare Debian; sourced by ./do.

# The commands of ./do help that install packages, each in its shortest form, and each form that installs other packages.
BARE_COMMANDS="demo
build
test
check
mutate --sample 1
fuzz 1
consumers package
consumers source
consumers m32
consumers wasm
consumers python
consumers java
consumers swift
consumers java-aarch64
bench --quick
bench --check
bench --micro
cross aarch64 build
cross armv6 bytes
boot
count
size
web build
web test
package
package test
package arm64
release --dry-run
wheel
wheel test
docs
site
golden
format
lint"

# make_bare_root FOLDER: makes the folder FOLDER/root with a bare Debian 12, git and ccache, unless the folder exists.
# ccache does not depend on a compiler, and the commands share its cache FOLDER/ccache.
make_bare_root() {
  [ ! -d "$1/root" ] || return 0
  rm -rf "$1/new"
  mkdir -p "$1/new" "$1/ccache" && toolchains/packaging/debian_root.sh "$1/new" bookworm "$(dpkg --print-architecture)" &&
    DEBIAN_FRONTEND=noninteractive chroot "$1/new" apt-get install -y --no-install-recommends git ccache &&
    mv "$1/new" "$1/root"
}

# try_bare FOLDER COMMAND: runs ./do COMMAND in FOLDER/copy, a copy of FOLDER/root with a clone of HEAD. The command has
# its own mounts and processes, which end with the command. Its root is changed by pivot_root, because programs that chroot
# started cannot create user namespaces. /dev has only the files that debootstrap made.
try_bare() {
  local copy=$1/copy
  rm -rf "$copy"
  cp -a "$1/root" "$copy" && git clone -q . "$copy/srv/starfocus" || return
  unshare --mount --pid --fork --kill-child sh -ec '
    mount --bind "$1/copy" "$1/copy"
    cd "$1/copy"
    mkdir -p var/cache/ccache
    mount --bind "$1/ccache" var/cache/ccache
    mount -t proc proc proc
    pivot_root . mnt
    umount -l mnt
    cd /srv/starfocus
    env -i --default-signal HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin ${http_proxy:+"http_proxy=$http_proxy"} \
      ${https_proxy:+"https_proxy=$https_proxy"} CCACHE_DIR=/var/cache/ccache CMAKE_C_COMPILER_LAUNCHER=ccache \
      CMAKE_CXX_COMPILER_LAUNCHER=ccache ./do $2' sh "$(realpath "$1")" "$2" &
  running=$!
  wait $running
  set -- $?
  running=
  return $1
}

# installed FOLDER: prints the number of packages that are installed in the root FOLDER.
installed() { grep -c '^Status: install ok installed$' "$1/var/lib/dpkg/status"; }

# Ends the processes of try_bare, and removes the copy.
end_bare() {
  [ -z "$running" ] || { kill -KILL "$running" && wait "$running"; } 2>/dev/null
  rm -rf build/bare/copy build/bare/new || { sleep 1 && rm -rf build/bare/copy build/bare/new; }
}

# bare [COMMAND...]: runs each COMMAND of ./do, by default all of BARE_COMMANDS, in a separate copy of a bare Debian 12,
# and prints a table of the results.
bare() {
  local PACKAGES="debootstrap git" folder=build/bare command log start result all failures=0
  running=
  [ "$(id -u)" = 0 ] || fail "bare: expected root, which makes mounts and a Debian in $folder"
  install_missing
  trap end_bare EXIT
  trap 'exit 1' HUP INT TERM
  step bare-root "making $folder/root" make_bare_root $folder
  if [ $# = 0 ]; then
    mapfile -t all <<<"$BARE_COMMANDS"
    set -- "${all[@]}"
  fi
  printf '%-24s %-7s %8s %9s\n' command result seconds packages
  for command; do
    log=$LOGS/bare-${command//[^a-z0-9]/-}.log start=$SECONDS result=passed
    logged "$command" "$log" try_bare $folder "$command" || result=failed failures=$((failures + 1))
    printf '%-24s %-7s %8d %9d\n' "$command" $result $((SECONDS - start)) \
      $(($(installed $folder/copy) - $(installed $folder/root)))
  done
  [ $failures = 0 ] || fail "$failures commands failed; their logs are $LOGS/bare-*.log"
}
