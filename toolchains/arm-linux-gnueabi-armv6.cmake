# SPDX-License-Identifier: Apache-2.0
# ARMv6 without NEON (Raspberry Pi Zero and 1), with scalar kernels. The C library is Debian's library for the
# soft-float ABI, which is rarely installed on such boards. Link programs statically.
set(CMAKE_SYSTEM_PROCESSOR armv6l)
set(STARFOCUS_TRIPLE arm-linux-gnueabi)
set(STARFOCUS_ARCHITECTURE armel)
set(STARFOCUS_QEMU qemu-arm)
set(STARFOCUS_DEFAULT_CPU arm1176)
set(flags "-march=armv6k -mfpu=vfp -mfloat-abi=softfp -Wno-psabi")
set(CMAKE_C_FLAGS_INIT "${flags}")
set(CMAKE_CXX_FLAGS_INIT "${flags}")
include("${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake")
