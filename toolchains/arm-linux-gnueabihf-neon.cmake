# SPDX-License-Identifier: Apache-2.0
# 32-bit Arm boards with NEON (Raspberry Pi 2, BeagleBone, most ARMv7). NEON is dispatched statically, since the
# detection of Highway 1.0 always chooses scalar code on these boards.
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(STARFOCUS_TRIPLE arm-linux-gnueabihf)
set(STARFOCUS_ARCHITECTURE armhf)
set(STARFOCUS_QEMU qemu-arm)
set(STARFOCUS_DEFAULT_CPU cortex-a7)
# Highway's NEON for ARMv7 uses half floats. -Wno-psabi suppresses GCC's note that an older ABI passed vector arguments
# differently.
set(flags "-march=armv7-a -mfpu=neon-vfpv4 -mfp16-format=ieee -Wno-psabi")
set(CMAKE_C_FLAGS_INIT "${flags}")
set(CMAKE_CXX_FLAGS_INIT "${flags}")
include("${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake")
