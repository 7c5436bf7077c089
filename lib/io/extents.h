// SPDX-License-Identifier: Apache-2.0
// Collects the address ranges that an API call reads or writes, to detect overlaps.
#ifndef STARFOCUS_LIB_IO_EXTENTS_H_
#define STARFOCUS_LIB_IO_EXTENTS_H_

#include "lib/base/geometry.h"
#include "lib/base/problem.h"
#include "lib/optics/view_set.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// List of address ranges. The capacity suffices for all planes of one light field in any format, or
// of two in-place light fields, plus six more ranges.
struct Extents {
  Extent of[3 * kMaxViews + 6];
  int count = 0;

  void Add(const Extent& extent) { of[count++] = extent; }
  void AddRows(const void* data, size_t stride, int32_t rows, size_t row_bytes) {
    Add(ExtentOf(data, stride, rows, row_bytes));
  }
  void AddCoverage(const starfocus_config& config, const uint8_t* coverage, size_t stride) {
    if (coverage == nullptr) return;
    AddRows(coverage, stride, config.height, static_cast<size_t>(config.width));
  }
};

inline bool Overlaps(const Extent& a, const Extents& b) {
  for (int n = 0; n < b.count; ++n) {
    if (Overlaps(a, b.of[n])) return true;
  }
  return false;
}

// Checks that an output does not overlap the address ranges in `read`. `name` is the name of the
// output argument.
inline starfocus_status CheckApart(const Extent& out, const Extents& read, const char* name,
                                   starfocus_problem* problem) {
  if (!Overlaps(out, read)) return STARFOCUS_OK;
  return Refuse(STARFOCUS_ERROR_OVERLAP, {name},
                {"memory that overlaps neither the inputs nor the workspace"}, problem);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_EXTENTS_H_
