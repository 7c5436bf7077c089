# SPDX-License-Identifier: Apache-2.0
# Android on 64-bit Arm, with the toolchain file of the NDK in ANDROID_NDK_HOME. This file has not been tested with an
# NDK and builds only the library. Highway's headers come from a sysroot: "toolchains/sysroot.sh headers
# build/sysroot/headers".
if(NOT DEFINED ENV{ANDROID_NDK_HOME})
  message(FATAL_ERROR "Set the environment variable ANDROID_NDK_HOME to the folder of the NDK.")
endif()
set(ANDROID_ABI arm64-v8a)
if(NOT DEFINED ANDROID_PLATFORM)
  set(ANDROID_PLATFORM android-24)
endif()
set(ANDROID_STL c++_static)
include("$ENV{ANDROID_NDK_HOME}/build/cmake/android.toolchain.cmake")
list(APPEND CMAKE_FIND_ROOT_PATH "${CMAKE_CURRENT_LIST_DIR}/../build/sysroot/headers")
set(STARFOCUS_STATIC_DISPATCH ON CACHE BOOL "One SIMD target, chosen when compiling")
set(STARFOCUS_PROGRAMS OFF CACHE BOOL "Build platform/ and the programs of examples/")
set(STARFOCUS_TESTS OFF CACHE BOOL "Build the tests")
