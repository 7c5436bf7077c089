# SPDX-License-Identifier: Apache-2.0
# 32-bit boards with NEON (Raspberry Pi 2, BeagleBone, most ARMv7). Highway 1.0's detection always
# chooses scalar here, hence static dispatch.
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(STARFOCUS_TRIPLE arm-linux-gnueabihf)
set(STARFOCUS_ARCHITECTURE armhf)
set(STARFOCUS_QEMU qemu-arm)
set(STARFOCUS_DEFAULT_CPU cortex-a7)
# Highway's NEON for ARMv7 uses half floats; its vectors as arguments make GCC tell of an old ABI.
set(flags "-march=armv7-a -mfpu=neon-vfpv4 -mfp16-format=ieee -Wno-psabi")
set(CMAKE_C_FLAGS_INIT "${flags}")
set(CMAKE_CXX_FLAGS_INIT "${flags}")
include("${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake")
