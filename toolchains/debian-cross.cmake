# SPDX-License-Identifier: Apache-2.0
# Common part of the toolchain files for Debian's cross compilers. Set these variables before you include this file:
#   STARFOCUS_TRIPLE       prefix of the compiler's programs
#   STARFOCUS_ARCHITECTURE the ARCHITECTURE argument of sysroot.sh
#   STARFOCUS_QEMU         the user emulator that runs the tests
#   STARFOCUS_DEFAULT_CPU  CPU model of the emulator; -DSTARFOCUS_CPU=... selects another model
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${STARFOCUS_TRIPLE}-gcc)
set(CMAKE_CXX_COMPILER ${STARFOCUS_TRIPLE}-g++)

set(STARFOCUS_SYSROOT "${CMAKE_CURRENT_LIST_DIR}/../build/sysroot/${STARFOCUS_ARCHITECTURE}"
    CACHE PATH "Folder that toolchains/sysroot.sh filled")
set(STARFOCUS_CPU "${STARFOCUS_DEFAULT_CPU}" CACHE STRING "CPU model of the emulator")
get_filename_component(STARFOCUS_SYSROOT "${STARFOCUS_SYSROOT}" ABSOLUTE)
if(NOT EXISTS "${STARFOCUS_SYSROOT}/.complete")
  message(FATAL_ERROR "There is no sysroot in ${STARFOCUS_SYSROOT}: make it with "
                      "toolchains/sysroot.sh ${STARFOCUS_ARCHITECTURE} ${STARFOCUS_SYSROOT}")
endif()
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES STARFOCUS_SYSROOT STARFOCUS_CPU)

# Searches only the sysroot, never the host's /usr.
set(CMAKE_FIND_ROOT_PATH "${STARFOCUS_SYSROOT}" "/usr/${STARFOCUS_TRIPLE}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_LIBRARY_ARCHITECTURE ${STARFOCUS_TRIPLE})
set(ENV{PKG_CONFIG_SYSROOT_DIR} "${STARFOCUS_SYSROOT}")
set(ENV{PKG_CONFIG_LIBDIR} "${STARFOCUS_SYSROOT}/usr/lib/${STARFOCUS_TRIPLE}/pkgconfig:\
${STARFOCUS_SYSROOT}/usr/share/pkgconfig")
# Lets the linker find the libraries that the sysroot's libraries depend on.
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "-Wl,-rpath-link,${STARFOCUS_SYSROOT}/usr/lib/${STARFOCUS_TRIPLE}")

set(CMAKE_CROSSCOMPILING_EMULATOR "${STARFOCUS_QEMU};-cpu;${STARFOCUS_CPU};\
-L;/usr/${STARFOCUS_TRIPLE};-E;LD_LIBRARY_PATH=${STARFOCUS_SYSROOT}/usr/lib/${STARFOCUS_TRIPLE}")

# Builds one static binary per board, without detection of the SIMD target at run time.
set(STARFOCUS_STATIC_DISPATCH ON CACHE BOOL "One SIMD target, chosen when compiling")
set(STARFOCUS_STATIC_PROGRAMS ON CACHE BOOL "Link the programs statically")
