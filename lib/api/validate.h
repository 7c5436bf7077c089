// SPDX-License-Identifier: Apache-2.0
// Checks all arguments of the C API. All checks run before a call writes any output.
#ifndef STARFOCUS_LIB_API_VALIDATE_H_
#define STARFOCUS_LIB_API_VALIDATE_H_

#include <cstddef>
#include <cstdint>

#include "lib/api/sized.h"
#include "lib/base/geometry.h"
#include "lib/base/problem.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Starts an API call that receives a configuration. Copies the configuration to *full, which must
// contain the defaults. Clears the error description (`problem`) of the previous call, and checks
// that no pointer is null.
template <class Config>
starfocus_status EnterConfig(const Config* config, std::initializer_list<Pointer> pointers,
                             Config* full) {
  if (config == nullptr) return STARFOCUS_ERROR_NULL;
  if (!ReadSized(*config, full)) return STARFOCUS_ERROR_STRUCTURE;
  return CheckPointers(pointers, full->problem);
}

starfocus_config DefaultConfig();

starfocus_params DefaultParams();

// Starts an API call that receives an engine: clears the engine's error description (`problem`) and
// checks that no pointer is null.
starfocus_status EnterEngine(starfocus_engine* engine, std::initializer_list<Pointer> pointers);

// Starts an API call that refocuses: performs the checks of EnterEngine and copies `params` to
// *full. `params` must be one of the pointers.
starfocus_status EnterCall(starfocus_engine* engine, std::initializer_list<Pointer> pointers,
                           const starfocus_params* params, starfocus_params* full);

// Fields that starfocus_config and starfocus_depth_config have in common.
struct PictureRange {
  int32_t width, height;
  double disparity_min, disparity_max;
  int32_t max_workers;
};
void CheckPictureRange(const PictureRange& picture, Checker* check);

// Checks the fields of a lens that determine which disparities are in focus.
void CheckFocus(const starfocus_lens& lens, Checker* check);

// CheckConfig and CheckParams report a rejected field to config.problem, which may be null.
starfocus_status CheckConfig(const starfocus_config& config);
starfocus_status CheckParams(const starfocus_config& config, const starfocus_params& params);

// Memory that the caller passes to an API call as the argument `name`.
struct Memory {
  const char* name;
  const void* data;
  size_t bytes;
};

// Checks that memory is aligned to STARFOCUS_ALIGNMENT and has at least `needed` bytes.
starfocus_status CheckMemory(const Memory& memory, size_t needed, starfocus_problem* problem);

struct MapPlane {
  const float* disparity;
  size_t stride;
};

// Checks the pointer, size and stride of a disparity map.
starfocus_status CheckMap(const MapPlane& map, int32_t width, int32_t height,
                          starfocus_problem* problem);

// Returns true if a stride is at least `row_bytes` and all rows are addressable.
bool ValidStride(size_t stride, size_t row_bytes, int32_t rows);

// Checks the stride of the coverage of a light field. A null `coverage` is valid.
starfocus_status CheckCoverage(const starfocus_config& config, const uint8_t* coverage,
                               size_t stride);

// Checks that all fields of a region are 0, or that the region lies inside a picture of
// width x height.
starfocus_status CheckRegion(const starfocus_region& region, int32_t width, int32_t height,
                             starfocus_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_H_
