# SPDX-License-Identifier: Apache-2.0
# Command of ./do that builds Debian packages; sourced by ./do.

DEBIAN_PACKAGES="debhelper dh-python dpkg-dev fakeroot help2man lintian pkg-config python3-setuptools python3-wheel"

# make_debian_source FOLDER: writes the files of the commit HEAD, and the folder debian/, to an empty folder.
make_debian_source() {
  rm -rf "$1"
  mkdir -p "$1" && git archive HEAD | tar -x -C "$1" && cp -r "$1/toolchains/packaging/debian" "$1/debian"
}

# build_packages FOLDER: builds the packages next to the folder with the source.
build_packages() {
  (cd "$1" && SOURCE_DATE_EPOCH=$(git log -1 --format=%ct) DEB_BUILD_OPTIONS="parallel=$(nproc)" \
    dpkg-buildpackage --build=binary --unsigned-changes --unsigned-source)
}

# package: builds the Debian packages of HEAD in build/packages, and checks the packages with lintian. With `test`, also
# installs the packages into a bare Debian.
package() {
  local folder=build/packages/source
  PACKAGES="$PACKAGES $DEBIAN_PACKAGES"
  install_missing
  rm -rf build/packages
  step debian-source "copying HEAD to $folder" make_debian_source $folder
  step packages "building packages" build_packages $folder
  step lintian "checking packages" lintian --fail-on error,warning --suppress-tags bad-distribution-in-changes-file \
    build/packages/*.changes
  ls build/packages/*.deb
  [ "${1:-}" != test ] || toolchains/packaging/test_packages.sh build/packages || exit 1
}
