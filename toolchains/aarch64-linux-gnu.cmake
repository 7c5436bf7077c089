# SPDX-License-Identifier: Apache-2.0
# 64-bit Arm boards, for example Raspberry Pi 3 to 5. NEON is dispatched statically: Highway's detection at run time
# requires AES and would choose scalar code on a Raspberry Pi 4, which lacks AES.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(STARFOCUS_TRIPLE aarch64-linux-gnu)
set(STARFOCUS_ARCHITECTURE arm64)
set(STARFOCUS_QEMU qemu-aarch64)
set(STARFOCUS_DEFAULT_CPU cortex-a53)
include("${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake")
