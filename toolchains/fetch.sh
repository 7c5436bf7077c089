#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# fetch.sh ARCHITECTURE FOLDER PATTERN PACKAGE...: unpacks Debian packages of any architecture into FOLDER, together
# with their direct dependencies whose whole names match PATTERN, an extended regular expression. Does nothing if FOLDER
# already contains the packages.
#
# The host does not change: a private apt with its own lists, cache and package database reads copies of the host's
# sources, keys and proxy settings. Requires apt-get and dpkg-deb, but not root.
set -eu

[ $# -ge 4 ] || { echo "usage: $0 ARCHITECTURE FOLDER PATTERN PACKAGE..." >&2; exit 2; }
architecture=$1
folder=$2
pattern=$3
shift 3
stamp="$architecture: $*"
[ "$(cat "$folder/.complete" 2>/dev/null)" = "$stamp" ] && exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
mkdir -p "$work/parts" "$work/lists/partial" "$work/archives/partial" "$work/packages"
: >"$work/status"

# Copies the host's package sources without their restrictions to the host's architectures.
eval "$(apt-config shell list Dir::Etc::sourcelist/f parts Dir::Etc::sourceparts/d)"
for source in "$list" "$parts"*.list "$parts"*.sources; do
  [ -f "$source" ] || continue
  sed -e '/^Architectures:/d' -e 's/^\(deb[^[]*\[[^]]*\)\barch=[^] ]*/\1/' -e 's/\[ *\]//' \
    "$source" >"$work/parts/$(basename "$source")"
done

private_apt() {
  tool=$1
  shift
  "$tool" -q -o "APT::Architecture=$architecture" -o "APT::Architectures=$architecture" \
    -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$work/parts" \
    -o "Dir::State=$work" -o "Dir::State::lists=$work/lists" -o "Dir::State::status=$work/status" \
    -o "Dir::Cache=$work" -o "Dir::Cache::archives=$work/archives" -o APT::Sandbox::User=root "$@"
}

# Ignores errors of package sources that do not provide this architecture. Missing packages are reported below.
private_apt apt-get update || echo "fetch: continuing with the lists there are" >&2
more=$(private_apt apt-cache depends --no-recommends --no-suggests "$@" |
  sed -n 's/^ *Depends: //p' | grep -Ex "$pattern" | sort -u) || more=
(cd "$work/packages" && private_apt apt-get download "$@" $more)

rm -rf "$folder.new"
mkdir -p "$folder.new"
for package in "$work"/packages/*.deb; do
  dpkg-deb -x "$package" "$folder.new"
done
printf '%s\n' "$stamp" >"$folder.new/.complete"
rm -rf "$folder"
mv "$folder.new" "$folder"
