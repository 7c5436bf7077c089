// SPDX-License-Identifier: Apache-2.0
// Checks all arguments of the C API. All checks run before a call writes any output. Structures
// whose first field is their size are copied first, because the caller's header may be older than
// the library.
#ifndef STARFOCUS_LIB_API_VALIDATE_H_
#define STARFOCUS_LIB_API_VALIDATE_H_

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "lib/base/geometry.h"
#include "lib/base/problem.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Writes the defaults to the part of the caller's structure that the library knows, writes zeros to
// the rest, and sets the field `size`.
template <class Structure>
void InitSized(Structure defaults, uint32_t size, Structure* given) {
  if (given == nullptr || size < sizeof size) return;
  defaults.size = size;
  if (size > sizeof defaults) std::memset(static_cast<void*>(given), 0, size);
  std::memcpy(static_cast<void*>(given), &defaults,
              size < sizeof defaults ? size : sizeof defaults);
}

// Copies the caller's structure to *full. The caller's structure may lack newer fields, so *full
// must contain the defaults. Returns false if the structure was not initialised, or was initialised
// by a newer header.
template <class Structure>
bool ReadSized(const Structure& given, Structure* full) {
  const uint32_t size = given.size;
  if (size <= sizeof size || size > sizeof(Structure)) return false;
  std::memcpy(static_cast<void*>(full), &given, size);
  return true;
}

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

struct PictureSize {
  int32_t width, height;
};

// Checks `count` views.
starfocus_status CheckViews(const starfocus_light_field& light_field, int32_t count,
                            const PictureSize& size, starfocus_problem* problem);

// Checks the depth map of a picture of the given size.
starfocus_status CheckDepthMap(const starfocus_depth_map& map, const PictureSize& size,
                               starfocus_problem* problem);

// Checks a depth map and the size of its picture, which no configuration has checked.
starfocus_status CheckLoneMap(const starfocus_depth_map& map, const PictureSize& size);

// Checks that `count` views have formats that are read in place.
starfocus_status CheckInPlace(const starfocus_light_field& light_field, int32_t count,
                              starfocus_problem* problem);

// Checks that a depth map has a format that is read in place.
starfocus_status CheckInPlace(const starfocus_depth_map& map, const PictureSize& size,
                              starfocus_problem* problem);

// Checks a light field for an engine of `config`.
starfocus_status CheckLightField(const starfocus_config& config,
                                 const starfocus_light_field& light_field);

// Adds the address range of a depth map to *extents.
void AddDepthMap(const starfocus_depth_map& map, Extents* extents);

// Adds the address ranges of all planes of a light field to *extents.
void AddLightField(const starfocus_config& config, const starfocus_light_field& light_field,
                   Extents* extents);

// Adds the address ranges of the planes of a picture of the given size to *extents.
void AddImage(const starfocus_image& image, const PictureSize& size, Extents* extents);

// Checks an output picture of the given size, except for overlaps with other memory.
starfocus_status CheckOutput(const starfocus_config& config, const starfocus_image& image,
                             const PictureSize& size);

// Checks that an output picture does not overlap the inputs.
starfocus_status CheckOutputApart(const starfocus_image& image, const PictureSize& size,
                                  const Extents& read, starfocus_problem* problem);

// If `status` is the error of a wrong disparity, adds the place of the first disparity of `map`
// that is not finite or outside the range of *problem. `first` is the row of the whole map at which
// `map` begins. `problem` may be null. Returns `status`.
starfocus_status TellPlace(starfocus_status status, const starfocus_depth_map& map, int32_t first,
                           starfocus_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_H_
