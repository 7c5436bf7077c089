#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# fetch.sh ARCHITECTURE FOLDER PATTERN PACKAGE...: unpacks Debian packages of any architecture into FOLDER, together
# with their direct dependencies whose whole names match PATTERN, an extended regular expression. Does nothing if FOLDER
# already contains the packages.
#
# The host does not change. Requires apt-get and dpkg-deb, but not root.
set -eu

[ $# -ge 4 ] || { echo "usage: $0 ARCHITECTURE FOLDER PATTERN PACKAGE..." >&2; exit 2; }
architecture=$1
folder=$2
pattern=$3
shift 3
stamp="$architecture: $*"
[ "$(cat "$folder/.complete" 2>/dev/null)" = "$stamp" ] && exit 0

. "$(dirname "$0")/private_apt.sh"
mkdir "$work/packages"

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
