// SPDX-License-Identifier: Apache-2.0
// Tables of SIMD kernels. A table holds one pointer per kernel of a list, for one SIMD target.
// `simd/kernels.h` (the engine), `simd/depth_kernels.h` and `simd/image_kernels.h` list the kernels
// of the three tables, so that a program links only the tables that it uses. `simd/table-inl.h`
// compiles a table for every target of `simd/targets.h`.
#ifndef STARFOCUS_SIMD_KERNEL_TABLE_H_
#define STARFOCUS_SIMD_KERNEL_TABLE_H_

#include <cstddef>

// One member of a table, and one entry of its initializer: the kernel of that name in scope.
#define STARFOCUS_MEMBER(Kernel) decltype(&reference::Kernel) Kernel;
#define STARFOCUS_ENTRY(Kernel) Kernel,

// Declares a table of the kernels of LIST, and three functions that return one:
// - Best##Table: the best target of this machine, which Highway chooses once.
// - Reference##Table: the references.
// - Table##OfTarget: target `index` of those compiled in and supported here, the best first; null
//   past the last. For tests and the bench only: it is slow, and changes Highway's choice for other
//   threads while it runs.
#define STARFOCUS_DECLARE_TABLE(Table, LIST) \
  struct Table {                             \
    const char* name; /* of the target */    \
    LIST(STARFOCUS_MEMBER)                   \
  };                                         \
  const Table& Best##Table();                \
  const Table& Reference##Table();           \
  const Table* Table##OfTarget(size_t index);

#endif  // STARFOCUS_SIMD_KERNEL_TABLE_H_
