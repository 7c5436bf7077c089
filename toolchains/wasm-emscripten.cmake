# SPDX-License-Identifier: Apache-2.0
# WebAssembly with SIMD, with the toolchain file of the emscripten in PATH. Builds only the library. To link a program
# with Debian's emscripten, set NODE_PATH=/usr/share/nodejs.
find_program(STARFOCUS_EMCC emcc)
if(NOT STARFOCUS_EMCC)
  message(FATAL_ERROR "starfocus for WebAssembly needs emcc: install the package emscripten.")
endif()
get_filename_component(emscripten "${STARFOCUS_EMCC}" REALPATH)
get_filename_component(emscripten "${emscripten}" DIRECTORY)
set(CMAKE_C_FLAGS_INIT "-msimd128")
set(CMAKE_CXX_FLAGS_INIT "-msimd128")
include("${emscripten}/cmake/Modules/Platform/Emscripten.cmake")
set(STARFOCUS_PROGRAMS OFF CACHE BOOL "Build platform/ and the programs of examples/")
set(STARFOCUS_TESTS OFF CACHE BOOL "Build the tests")
