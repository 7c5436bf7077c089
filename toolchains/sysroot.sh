#!/bin/sh
# sysroot.sh ARCHITECTURE FOLDER: unpacks the headers starfocus needs, and the target's own
# libraries where Debian has them, for a cross build. ARCHITECTURE is Debian's (arm64, armhf, armel)
# or "headers" for a target Debian has no packages of.
#
# Nothing of the host changes: a private apt, with its own lists, cache and empty package database,
# reads copies of the host's own sources (and its trust and proxy settings), fetches the packages
# and unpacks them into FOLDER. Needs apt-get and dpkg-deb, and no root.
set -eu

[ $# = 2 ] || { echo "usage: $0 arm64|armhf|armel|headers FOLDER" >&2; exit 2; }
architecture=$1
folder=$2
packages="libhwy-dev libstb-dev doctest-dev libcli11-dev nlohmann-json3-dev"
if [ "$architecture" = headers ]; then
  target=$(dpkg --print-architecture)
else
  target=$architecture
  packages="$packages libgpiod-dev"
fi
stamp="$target: $packages"
[ "$(cat "$folder/.complete" 2>/dev/null)" = "$stamp" ] && exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
mkdir -p "$work/parts" "$work/lists/partial" "$work/archives/partial" "$work/packages"
: >"$work/status"

# The host's sources may be restricted to its own architectures: the copies are not.
eval "$(apt-config shell list Dir::Etc::sourcelist/f parts Dir::Etc::sourceparts/d)"
for source in "$list" "$parts"*.list "$parts"*.sources; do
  [ -f "$source" ] || continue
  sed -e '/^Architectures:/d' -e 's/^\(deb[^[]*\[[^]]*\)\barch=[^] ]*/\1/' -e 's/\[ *\]//' \
    "$source" >"$work/parts/$(basename "$source")"
done

private_apt() {
  tool=$1
  shift
  "$tool" -q -o "APT::Architecture=$target" -o "APT::Architectures=$target" \
    -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$work/parts" \
    -o "Dir::State=$work" -o "Dir::State::lists=$work/lists" -o "Dir::State::status=$work/status" \
    -o "Dir::Cache=$work" -o "Dir::Cache::archives=$work/archives" -o APT::Sandbox::User=root "$@"
}

# A source without this architecture makes the update complain; whether it matters shows below.
private_apt apt-get update || echo "sysroot: continuing with the lists there are" >&2
# A -dev package links its library by a name that a package of another name holds.
runtime=$(private_apt apt-cache depends --no-recommends --no-suggests $packages |
  sed -n 's/^ *Depends: \(lib\(hwy\|stb\|gpiod\)[0-9][a-z0-9.-]*\)$/\1/p')
(cd "$work/packages" && private_apt apt-get download $packages $runtime)

rm -rf "$folder.new"
mkdir -p "$folder.new"
for package in "$work"/packages/*.deb; do
  dpkg-deb -x "$package" "$folder.new"
done
# Libraries of another machine must not be found.
[ "$architecture" != headers ] || rm -rf "$folder.new"/usr/lib/*-linux-*
printf '%s\n' "$stamp" >"$folder.new/.complete"
rm -rf "$folder"
mv "$folder.new" "$folder"
