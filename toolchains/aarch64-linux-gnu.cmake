# SPDX-License-Identifier: Apache-2.0
# 64-bit boards (Raspberry Pi 3 to 5 and their like). NEON by static dispatch: Highway's detection
# asks for AES as well, which a Raspberry Pi 4 has not, and would fall back to scalar there.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(STARFOCUS_TRIPLE aarch64-linux-gnu)
set(STARFOCUS_ARCHITECTURE arm64)
set(STARFOCUS_QEMU qemu-aarch64)
set(STARFOCUS_DEFAULT_CPU cortex-a53)
include("${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake")
