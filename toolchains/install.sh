#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: toolchains/install.sh GROUP|PACKAGE...
#
# Installs Debian packages with apt-get, as root or with sudo. The groups are build, test and fuzz. A package is
# installed only if starfocus does not find its files, whether or not a package installed these files.
. "$(dirname "$0")/steps.sh"

# Each line has a package, its group, and the programs and headers that show that the package is not missing. Packages
# that are not in the table have one program, with the name of the package.
TABLE='
g++                      build  c++
cmake                    build  cmake
ninja-build              build  ninja
pkg-config               build  pkg-config
libhwy-dev               build  hwy/highway.h
libstb-dev               build  stb/stb_image.h
doctest-dev              build  doctest/doctest.h
libcli11-dev             build  CLI/CLI.hpp
nlohmann-json3-dev       build  nlohmann/json.hpp
libjpeg62-turbo-dev      build  jpeglib.h
libpng-dev               build  png.h
libdeflate-dev           build  libdeflate.h
libtiff-dev              build  tiffio.h
libopenexr-dev           build  OpenEXR/openexr.h
libwebp-dev              build  webp/mux.h
libexpat1-dev            build  expat.h
libexif-dev              build  libexif/exif-data.h
libheif-dev              build  libheif/heif.h
libsixel-dev             build  sixel/sixel.h
libseccomp-dev           build  seccomp.h
libimage-exiftool-perl   test   exiftool
webp                     test   webpinfo
libsixel-bin             test   sixel2png
openexr                  test   exrinfo
python3-numpy            test   -
python3-pil              test   -
libgstreamer-plugins-base1.0-dev test -
gstreamer1.0-plugins-base test  -
gstreamer1.0-tools       test   gst-inspect-1.0
clang                    fuzz   clang
libclang-rt-14-dev       fuzz   -
libbenchmark-dev         -      benchmark/benchmark.h
llvm                     -      llvm-mca
universal-ctags          -      ctags
gnuplot-nox              -      gnuplot
qemu-user                -      qemu-aarch64
qemu-system-arm          -      qemu-system-aarch64
emscripten               -      emcc
nodejs                   -      node
kotlin                   -      kotlinc
openjdk-17-jdk-headless  -      javac jar
g++-aarch64-linux-gnu    -      aarch64-linux-gnu-g++
g++-arm-linux-gnueabihf  -      arm-linux-gnueabihf-g++
g++-arm-linux-gnueabi    -      arm-linux-gnueabi-g++
g++-riscv64-linux-gnu    -      riscv64-linux-gnu-g++
'

declare -A groups files
while read -r package group found; do
  [ -n "$package" ] || continue
  groups[$group]+=" $package"
  files[$package]=$found
done <<<"$TABLE"

# has_header NAME: true if the compiler finds the header, including in the folders that CMake searches first.
has_header() {
  local IFS=: prefix folders=()
  for prefix in ${CMAKE_PREFIX_PATH:-}; do folders+=("-I$prefix/include"); done
  printf '#if !__has_include(<%s>)\n#error\n#endif\n' "$1" | "${CXX:-c++}" "${folders[@]}" -E -x c++ - >/dev/null 2>&1
}

# has PACKAGE: true if the package is installed, or if its files exist.
has() {
  local file result=0
  for file in ${files[$1]:-$1}; do
    case "$file" in
      *.h | *.hpp) has_header "$file" ;;
      c++) command -v "${CXX:-c++}" ;;
      ctags) ctags --version 2>/dev/null | grep Universal ;;
      *) command -v "$file" ;;
    esac >/dev/null || result=1
  done
  [ $result = 0 ] || dpkg-query -W -f '${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed
}

apt() {
  if [ "$(id -u)" = 0 ]; then
    DEBIAN_FRONTEND=noninteractive apt-get -y -q "$@"
  else
    sudo -n env DEBIAN_FRONTEND=noninteractive apt-get -y -q "$@"
  fi
}

# Updates the package lists only if the installation fails with the current lists.
install_packages() {
  apt install --no-install-recommends "$@" && return
  apt update && apt install --no-install-recommends "$@"
}

help_if_asked "$@"
[ $# -gt 0 ] || wrong "expected groups or packages"
missing=()
for word; do
  for package in ${groups[$word]:-$word}; do
    has "$package" || missing+=("$package")
  done
done
[ ${#missing[@]} -gt 0 ] || exit 0
command -v apt-get >/dev/null ||
  fail "starfocus needs these Debian packages, and there is no apt-get to install them: ${missing[*]}"
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null ||
    fail "starfocus needs these packages; install them as root: apt-get install ${missing[*]}"
  sudo -v || fail "starfocus needs root's leave to install: ${missing[*]}"
fi
step install "installing ${#missing[@]} packages" install_packages "${missing[@]}"
