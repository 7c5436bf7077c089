# SPDX-License-Identifier: Apache-2.0
# Builds the libraries of starfocus for vcpkg. STARFOCUS_SOURCE is a checkout or an unpacked source archive; without it,
# the archive of the release is fetched from STARFOCUS_URL and compared with STARFOCUS_SHA512.
if(DEFINED ENV{STARFOCUS_SOURCE})
  set(SOURCE_PATH "$ENV{STARFOCUS_SOURCE}")
else()
  vcpkg_download_distfile(archive URLS "$ENV{STARFOCUS_URL}" FILENAME "starfocus-${VERSION}.tar.gz"
    SHA512 "$ENV{STARFOCUS_SHA512}")
  vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${archive}")
endif()
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS
  -DSTARFOCUS_PROGRAMS=OFF -DSTARFOCUS_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/starfocus)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
