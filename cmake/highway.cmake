# SPDX-License-Identifier: Apache-2.0
# Defines the target starfocus_highway: Highway, with the compile definitions that all sources with Highway code share.
# The oldest supported version is the version in Debian 12; simd/targets.h checks the version of the headers.
add_library(starfocus_highway INTERFACE)
set(STARFOCUS_HIGHWAY_OLDEST 1.0.3)

if(NOT STARFOCUS_STATIC_DISPATCH)
  find_package(hwy ${STARFOCUS_HIGHWAY_OLDEST} CONFIG QUIET)
  starfocus_require(hwy_FOUND libhwy-dev
    "the library of Highway ${STARFOCUS_HIGHWAY_OLDEST} or newer for this machine (its headers suffice with STARFOCUS_STATIC_DISPATCH=ON)")
  target_link_libraries(starfocus_highway INTERFACE hwy::hwy)
  target_compile_definitions(starfocus_highway INTERFACE HWY_COMPILE_ALL_ATTAINABLE)
  return()
endif()

# With a single SIMD target, only the headers of Highway are required, and these are identical on all machines. If the
# folders of the target system do not contain Highway, the headers of the host are used.
find_path(STARFOCUS_HIGHWAY_INCLUDE_DIR hwy/highway.h)
find_path(STARFOCUS_HIGHWAY_INCLUDE_DIR hwy/highway.h PATHS /usr/local/include /usr/include
  NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
mark_as_advanced(STARFOCUS_HIGHWAY_INCLUDE_DIR)
starfocus_require(STARFOCUS_HIGHWAY_INCLUDE_DIR libhwy-dev "Highway")
# Includes a folder that contains only Highway, since other headers of the host would hide headers of the target system.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/highway")
file(CREATE_LINK "${STARFOCUS_HIGHWAY_INCLUDE_DIR}/hwy" "${PROJECT_BINARY_DIR}/highway/hwy" SYMBOLIC)
target_include_directories(starfocus_highway SYSTEM INTERFACE "${PROJECT_BINARY_DIR}/highway")
target_compile_definitions(starfocus_highway INTERFACE HWY_COMPILE_ONLY_STATIC)
