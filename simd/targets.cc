// SPDX-License-Identifier: Apache-2.0
// Tables of kernels for tests and the bench: the references, and the vector code of each SIMD
// target of the machine. This unit is not part of the engine's library. No engine needs the
// references, and the other functions temporarily change Highway's process-wide choice of a target.
#include <hwy/highway.h>

#include <cstring>

#include "simd/kernels.h"

namespace starfocus::simd {

namespace {

// Returns the table of target `index` of this machine, or null. `best` returns the table of
// Highway's current choice.
template <class Table>
const Table* TableOfTarget(const Table& (*best)(), size_t index) {
#ifdef HWY_COMPILE_ONLY_STATIC
  return index == 0 ? &best() : nullptr;
#else
  const Table* found = nullptr;
  // Highway assigns lower bits to better targets. If a target was not compiled, `best` returns the
  // table of a worse target. The loop skips the table of a worse target, and lists this table later
  // under its own name.
  for (int64_t rest = hwy::SupportedTargets(); rest != 0 && found == nullptr; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    const Table* kernels = &best();
    const bool itself = std::strcmp(kernels->name, hwy::TargetName(rest & -rest)) == 0;
    if (itself && index-- == 0) found = kernels;
  }
  hwy::SetSupportedTargetsForTest(0);
  return found;
#endif
}

}  // namespace

#define STARFOCUS_DEFINE_TABLES(Table, LIST)                               \
  const Table& Reference##Table() {                                        \
    using namespace reference;                                             \
    static constexpr Table kernels = {"reference", LIST(STARFOCUS_ENTRY)}; \
    return kernels;                                                        \
  }                                                                        \
  const Table* Table##OfTarget(size_t index) { return TableOfTarget(Best##Table, index); }

STARFOCUS_DEFINE_TABLES(Kernels, STARFOCUS_KERNELS)
STARFOCUS_DEFINE_TABLES(DepthKernels, STARFOCUS_DEPTH_KERNELS)
STARFOCUS_DEFINE_TABLES(ImageKernels, STARFOCUS_IMAGE_KERNELS)
STARFOCUS_DEFINE_TABLES(LineScanKernels, STARFOCUS_LINE_SCAN_KERNELS)
STARFOCUS_DEFINE_TABLES(WordKernels, STARFOCUS_WORD_KERNELS)
STARFOCUS_DEFINE_TABLES(VideoKernels, STARFOCUS_VIDEO_KERNELS)

const Kernels* FindKernels(const char* name) {
  const Kernels* kernels = nullptr;
  for (size_t i = 0; (kernels = KernelsOfTarget(i)) != nullptr; ++i) {
    if (std::strcmp(kernels->name, name) == 0) break;
  }
  return kernels;
}

}  // namespace starfocus::simd
