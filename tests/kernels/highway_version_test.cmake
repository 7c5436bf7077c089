# SPDX-License-Identifier: Apache-2.0
# Usage: cmake -DSOURCE=… -DBUILD=… -DGENERATOR=… -DCXX=… -DCC=… -DMAKE=… -P highway_version_test.cmake
# Checks that the build rejects a Highway older than 1.0.3, by its package and by its headers. The
# documents must state this minimum version of Highway.
cmake_minimum_required(VERSION 3.20)
set(oldest 1.0.3)
set(older 1.0.2)
set(FOLDER "${BUILD}/tests/highway_version")
file(REMOVE_RECURSE "${FOLDER}")

file(READ "${SOURCE}/docs/developing.md" text)
if(NOT text MATCHES "google/highway\\) ${oldest} or newer")
  message(SEND_ERROR "docs/developing.md: wrong version of Highway (expected ${oldest})")
endif()

file(WRITE "${FOLDER}/hwy/hwy-config.cmake" "add_library(hwy::hwy INTERFACE IMPORTED)\n")
include(CMakePackageConfigHelpers)
write_basic_package_version_file("${FOLDER}/hwy/hwy-config-version.cmake" VERSION ${older}
  COMPATIBILITY SameMajorVersion)
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${FOLDER}/build" "-Dhwy_DIR=${FOLDER}/hwy" -DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF
          -DCMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF
          -G "${GENERATOR}" "-DCMAKE_MAKE_PROGRAM=${MAKE}" "-DCMAKE_CXX_COMPILER=${CXX}"
          "-DCMAKE_C_COMPILER=${CC}"
  RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE error)
string(REGEX REPLACE "[ \n]+" " " error "${error}")
if(result EQUAL 0 OR NOT error MATCHES "Highway ${oldest} or newer")
  message(SEND_ERROR "package of Highway ${older}: wrong result (expected an error, found '${error}')")
endif()

# check_headers(VERSION ACCEPTED) compiles simd/targets.h with headers of Highway VERSION.
function(check_headers version accepted)
  string(REPLACE "." ";" numbers ${version})
  list(POP_FRONT numbers major minor patch)
  file(WRITE "${FOLDER}/headers/hwy/foreach_target.h" "")
  file(WRITE "${FOLDER}/headers/hwy/highway.h"
    "#define HWY_MAJOR ${major}\n#define HWY_MINOR ${minor}\n#define HWY_PATCH ${patch}\n")
  file(WRITE "${FOLDER}/unit.cc" "#include \"simd/targets.h\"\n")
  execute_process(COMMAND "${CXX}" -fsyntax-only -I "${FOLDER}/headers" -I "${SOURCE}" unit.cc
    WORKING_DIRECTORY "${FOLDER}" RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE error)
  if(accepted AND NOT result EQUAL 0)
    message(SEND_ERROR "headers of Highway ${version}: rejected with '${error}'")
  elseif(NOT accepted AND result EQUAL 0)
    message(SEND_ERROR "headers of Highway ${version}: accepted (expected ${oldest} or newer)")
  elseif(NOT accepted AND NOT error MATCHES "expected ${oldest} or newer")
    message(SEND_ERROR "headers of Highway ${version}: wrong error '${error}'")
  endif()
endfunction()
foreach(version ${older} 0.17.0)
  check_headers(${version} FALSE)
endforeach()
foreach(version ${oldest} 1.0.4 1.2.0 2.0.0)
  check_headers(${version} TRUE)
endforeach()
