# SPDX-License-Identifier: Apache-2.0
# For scripts that download packages without changing the host. Defines private_apt, an apt with its own lists,
# cache and package database in the new folder $work, which is removed when the script ends. The apt reads copies of the
# host's package sources, keys and proxy settings. $architecture is the architecture of the packages.

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
mkdir -p "$work/parts" "$work/lists/partial" "$work/archives/partial"
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
