# SPDX-License-Identifier: Apache-2.0
# 64-bit RISC-V: scalar kernels, as GCC 12 does not know the vector intrinsics Highway uses.
# Debian 12 has a compiler for it but no packages, so the sysroot holds headers only.
set(CMAKE_SYSTEM_PROCESSOR riscv64)
set(STARFOCUS_TRIPLE riscv64-linux-gnu)
set(STARFOCUS_ARCHITECTURE headers)
set(STARFOCUS_QEMU qemu-riscv64)
set(STARFOCUS_DEFAULT_CPU rv64)
include("${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake")
