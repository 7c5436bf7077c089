// SPDX-License-Identifier: Apache-2.0
// Checks of everything that comes from outside, before anything is written.
#ifndef STARFOCUS_LIB_API_VALIDATE_H_
#define STARFOCUS_LIB_API_VALIDATE_H_

#include <cstddef>
#include <cstdint>

#include "lib/api/sized.h"
#include "lib/base/geometry.h"
#include "lib/base/problem.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Begins a call with a configuration: reads it into *full, which holds defaults, forgets the
// problem of the call before, and checks that no pointer is null.
template <class Config>
starfocus_status EnterConfig(const Config* config, std::initializer_list<Pointer> pointers,
                             Config* full) {
  if (config == nullptr) return STARFOCUS_ERROR_NULL;
  if (!ReadSized(*config, full)) return STARFOCUS_ERROR_STRUCTURE;
  return CheckPointers(pointers, full->problem);
}

starfocus_config DefaultConfig();

starfocus_params DefaultParams();

// Begins a call with an engine.
starfocus_status EnterEngine(starfocus_engine* engine, std::initializer_list<Pointer> pointers);

// Begins a call that refocuses: reads the params, one of the pointers, into *full.
starfocus_status EnterCall(starfocus_engine* engine, std::initializer_list<Pointer> pointers,
                           const starfocus_params* params, starfocus_params* full);

// What configurations of engines and of maps have in common.
struct PictureRange {
  int32_t width, height;
  double disparity_min, disparity_max;
  int32_t max_workers;
};
void CheckPictureRange(const PictureRange& picture, Checker* check);

// The checks below tell config.problem what they refuse, or `problem` (null: nobody).
starfocus_status CheckConfig(const starfocus_config& config);
starfocus_status CheckParams(const starfocus_config& config, const starfocus_params& params);

// Memory of a caller's; the name is that of the argument.
struct Memory {
  const char* name;
  const void* data;
  size_t bytes;
};

// Checks memory to lay something of `needed` bytes out in.
starfocus_status CheckMemory(const Memory& memory, size_t needed, starfocus_problem* problem);

struct MapPlane {
  const float* disparity;
  size_t stride;
};

// Checks a disparity map by itself.
starfocus_status CheckMap(const MapPlane& map, int32_t width, int32_t height,
                          starfocus_problem* problem);

// Tells whether rows are as wide as `row_bytes`, and all of them addressable.
bool ValidStride(size_t stride, size_t row_bytes, int32_t rows);

// Whether a light field may have that coverage, or none: null.
starfocus_status CheckCoverage(const starfocus_config& config, const uint8_t* coverage,
                               size_t stride);

// Checks that a region is all 0, or inside the picture.
starfocus_status CheckRegion(const starfocus_config& config, const starfocus_region& region);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_H_
