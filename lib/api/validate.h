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
sf_status EnterConfig(const Config* config, std::initializer_list<Pointer> pointers, Config* full) {
  if (config == nullptr) return SF_ERROR_NULL;
  if (!ReadSized(*config, full)) return SF_ERROR_STRUCTURE;
  return CheckPointers(pointers, full->problem);
}

sf_config DefaultConfig();

sf_params DefaultParams();

// Begins a call with an engine.
sf_status EnterEngine(sf_engine* engine, std::initializer_list<Pointer> pointers);

// Begins a call that refocuses: reads the params, one of the pointers, into *full.
sf_status EnterCall(sf_engine* engine, std::initializer_list<Pointer> pointers,
                    const sf_params* params, sf_params* full);

// What configurations of engines and of maps have in common.
struct PictureRange {
  int32_t width, height;
  double disparity_min, disparity_max;
  int32_t max_workers;
};
void CheckPictureRange(const PictureRange& picture, Checker* check);

// The checks below tell config.problem what they refuse, or `problem` (null: nobody).
sf_status CheckConfig(const sf_config& config);
sf_status CheckParams(const sf_config& config, const sf_params& params);

// Memory of a caller's; the name is that of the argument.
struct Memory {
  const char* name;
  const void* data;
  size_t bytes;
};

// Checks memory to lay something of `needed` bytes out in.
sf_status CheckMemory(const Memory& memory, size_t needed, sf_problem* problem);

struct MapPlane {
  const float* disparity;
  size_t stride;
};

// Checks a disparity map by itself.
sf_status CheckMap(const MapPlane& map, int32_t width, int32_t height, sf_problem* problem);

// Tells whether rows are as wide as `row_bytes`, and all of them addressable.
bool ValidStride(size_t stride, size_t row_bytes, int32_t rows);

// Whether a light field may have that coverage, or none: null.
sf_status CheckCoverage(const sf_config& config, const uint8_t* coverage, size_t stride);

// Checks that a region is all 0, or inside the picture.
sf_status CheckRegion(const sf_config& config, const sf_region& region);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_H_
