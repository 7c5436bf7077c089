# SPDX-License-Identifier: Apache-2.0
# 64-bit RISC-V with scalar kernels, since GCC 12 lacks the vector intrinsics that Highway uses. Debian 12 has a
# compiler for RISC-V but no packages, so the sysroot contains only headers.
set(CMAKE_SYSTEM_PROCESSOR riscv64)
set(STARFOCUS_TRIPLE riscv64-linux-gnu)
set(STARFOCUS_ARCHITECTURE headers)
set(STARFOCUS_QEMU qemu-riscv64)
set(STARFOCUS_DEFAULT_CPU rv64)
include("${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake")
