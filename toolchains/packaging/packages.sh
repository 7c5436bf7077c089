# SPDX-License-Identifier: Apache-2.0
# Command of ./do that builds Debian packages; sourced by ./do.

DEBIAN_PACKAGES="build-essential debhelper dh-python dpkg-dev fakeroot lintian pkg-config python3-setuptools python3-wheel"

# make_debian_source FOLDER: writes the files of the commit HEAD, and the folder debian/, to an empty folder.
make_debian_source() {
  rm -rf "$1"
  mkdir -p "$1" && git archive HEAD | tar -x -C "$1" && cp -r "$1/toolchains/packaging/debian" "$1/debian"
}

# make_cross_root FOLDER ARCHITECTURE: installs into FOLDER a Debian that can build packages for ARCHITECTURE, unless an
# earlier call with the same debian/control did. Requires root.
make_cross_root() {
  local packaging=toolchains/packaging
  cmp -s $packaging/debian/control "$1/control" && return
  mkdir -p "$1" && rm -rf "$1"/* || return # "$1" may be a link
  $packaging/debian_root.sh "$1" bookworm "$(dpkg --print-architecture)" && cp -r $packaging/debian "$1/tmp" &&
    chroot "$1" sh -c "set -e; cd /tmp; export DEBIAN_FRONTEND=noninteractive; dpkg --add-architecture $2
      apt-get update; apt-get install -y --no-install-recommends dpkg-dev fakeroot crossbuild-essential-$2
      apt-get build-dep -y --no-install-recommends --host-architecture $2 --build-profiles cross ." &&
    cp $packaging/debian/control "$1/control"
}

# build_packages FOLDER [ROOT ARCHITECTURE]: builds the packages next to FOLDER, which contains the source. With ROOT,
# FOLDER is relative to the folder ROOT, which make_cross_root made. The packages have the date of the commit. No compiler
# cache is used, because ccache changes paths in debug symbols if CCACHE_BASEDIR is set.
build_packages() {
  ${2:+chroot "$2"} env -u CMAKE_C_COMPILER_LAUNCHER -u CMAKE_CXX_COMPILER_LAUNCHER \
    "SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)" "DEB_BUILD_OPTIONS=parallel=$(nproc)" sh -c "cd $1 &&
    dpkg-buildpackage --build=binary --unsigned-changes --unsigned-source ${3:+--host-arch $3 --build-profiles=cross}"
}

# package [ARCHITECTURE] [test]: builds the Debian packages of HEAD, and checks the packages with lintian. With an
# ARCHITECTURE, builds the packages for another machine. With `test`, also installs the packages into a bare Debian.
package() {
  local folder=build/packages architecture root=
  architecture=$(dpkg --print-architecture)
  PACKAGES="$PACKAGES $DEBIAN_PACKAGES"
  case "${1:-}" in
    arm64 | armhf)
      architecture=$1 folder=build/packages-$1 root=build/cross-$1
      PACKAGES="$PACKAGES debootstrap qemu-user-static"
      shift
      ;;
  esac
  case "${1:-}" in test) PACKAGES="$PACKAGES debootstrap" ;; '') ;; *) fail "usage: ./do package [arm64|armhf] [test]" ;; esac
  install_missing
  rm -rf $folder && mkdir -p $folder
  if [ -n "$root" ]; then
    step cross-root "installing compilers and libraries for $architecture in $root" make_cross_root $root $architecture
    rm -rf $root/packages
    step debian-source "copying HEAD to $root/packages" make_debian_source $root/packages/source
    step packages "building packages" build_packages packages/source $root $architecture
    mv $root/packages/*.* $folder
  else
    step debian-source "copying HEAD to $folder/source" make_debian_source $folder/source
    step packages "building packages" build_packages $folder/source
  fi
  step lintian "checking packages" lintian --fail-on error,warning --suppress-tags bad-distribution-in-changes-file \
    $folder/*.changes
  ls $folder/*.deb
  [ "${1:-}" = test ] || return 0
  build starfocus
  toolchains/packaging/test_packages.sh $folder $architecture $PROGRAM || exit 1
}
