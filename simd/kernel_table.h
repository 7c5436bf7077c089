// SPDX-License-Identifier: Apache-2.0
// Tables of SIMD kernels. A table holds one pointer per kernel of a list, for one SIMD target. The
// lists of the three tables are in `simd/kernels.h` (the engine), `simd/depth_kernels.h` and
// `simd/image_kernels.h`. A program links only the tables that it uses. `simd/table-inl.h` compiles
// a table for every target of `simd/targets.h`.
#ifndef STARFOCUS_SIMD_KERNEL_TABLE_H_
#define STARFOCUS_SIMD_KERNEL_TABLE_H_

#include <cstddef>

// STARFOCUS_MEMBER declares one member of a table. STARFOCUS_ENTRY is one entry of a table's
// initialiser and refers to the kernel of this name in scope.
#define STARFOCUS_MEMBER(Kernel) decltype(&reference::Kernel) Kernel;
#define STARFOCUS_ENTRY(Kernel) Kernel,

// Declares a table of the kernels of LIST, and three functions that return tables:
// - Best##Table returns the table of the best target of this machine. Highway chooses the target
//   once.
// - Reference##Table returns the table of the references.
// - Table##OfTarget returns the table of target `index`, or null if there are at most `index`
//   targets. `index` counts the targets that are compiled in and supported by this machine, from
//   the best to the worst. The function is slow, and temporarily changes Highway's choice of a
//   target for all threads.
// Reference##Table and Table##OfTarget are only for tests and the bench (targets.cc).
#define STARFOCUS_DECLARE_TABLE(Table, LIST) \
  struct Table {                             \
    const char* name; /* of the target */    \
    LIST(STARFOCUS_MEMBER)                   \
  };                                         \
  const Table& Best##Table();                \
  const Table& Reference##Table();           \
  const Table* Table##OfTarget(size_t index);

#endif  // STARFOCUS_SIMD_KERNEL_TABLE_H_
