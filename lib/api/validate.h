// SPDX-License-Identifier: Apache-2.0
// Checks all arguments of the C API. All checks run before a call writes any output. Structures
// whose first field is their size are copied over their defaults before they are read
// (Checker::Read).
#ifndef STARFOCUS_LIB_API_VALIDATE_H_
#define STARFOCUS_LIB_API_VALIDATE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/config.h"
#include "lib/base/geometry.h"
#include "lib/base/problem.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Names of the fields of an image, for error messages.
#define STARFOCUS_IMAGE_FIELDS(prefix)                                                      \
  prefix "format", prefix "matrix", prefix "range", prefix "pixel_stride", prefix "planes", \
      prefix "strides"

// Returns true if two strings are equal. The engine does not use the strings of the C library.
bool AreEqual(const char* a, const char* b);

FullConfig DefaultConfig();

FullParams DefaultParams();

// Start an API call that receives a configuration or an engine, which may be null. Clear the error
// description of the previous call. Fill *full from the configuration and its tuning; full->problem
// is `problem`, which may be null.
Checker Enter(const starfocus_config* config, starfocus_problem* problem, FullConfig* full);
Checker Enter(starfocus_engine* engine);

// All functions below that take a Checker have no effect after an error.

// Fills *full from `params` and its study.
void ReadParams(const starfocus_params* params, FullParams* full, Checker* check);

// Checks that a report, which may be null, was initialised.
void CheckReport(const starfocus_report* report, Checker* check);

// Checks the size of a picture.
void CheckSize(int32_t width, int32_t height, Checker* check);

// Checks the fields of a configuration that engines and estimates of maps have in common.
void CheckPicture(const FullConfig& config, Checker* check);

// Checks the fields of a lens that determine which disparities are in focus.
void CheckFocus(const starfocus_params& lens, Checker* check);

void CheckConfig(const FullConfig& config, Checker* check);
void CheckParams(const FullConfig& config, const FullParams& params, Checker* check);

// Checks that memory, which the caller passes as the argument `name`, is aligned to
// STARFOCUS_ALIGNMENT and has at least `needed` bytes.
void CheckMemory(const char* name, const void* memory, size_t bytes, size_t needed, Checker* check);

// Checks the pointer `name`, the size and the stride `stride_name` of a disparity map.
void CheckMap(const float* disparity, size_t stride, int32_t width, int32_t height,
              const char* name, const char* stride_name, Checker* check);

// Returns true if a stride is at least `row_bytes` and all rows are addressable.
bool ValidStride(size_t stride, size_t row_bytes, int32_t rows);

// Checks the stride of a plane of bytes, whose field is `name`. The plane may be null.
void CheckBytes(const uint8_t* plane, size_t stride, int32_t width, int32_t height,
                const char* name, Checker* check);

// Checks that all fields of a region are 0, or that the region lies inside a picture of
// width x height.
void CheckRegion(const starfocus_region& region, int32_t width, int32_t height, Checker* check);

// Checks `count` views of a picture of width x height, whose formats may be deep if `deep` is true.
void CheckViews(const starfocus_light_field& light_field, int32_t count, int32_t width,
                int32_t height, bool deep, Checker* check);

// Checks the depth map of a picture of width x height.
void CheckDepthMap(const starfocus_depth_map& map, int32_t width, int32_t height, Checker* check);

// Checks a depth map and the size of its picture, which no configuration has checked.
void CheckLoneMap(const starfocus_depth_map& map, int32_t width, int32_t height, Checker* check);

// Checks that the views of a light field and, if `has_map` is true, its map have formats that are
// read in place.
void CheckInPlace(const FullConfig& config, const starfocus_light_field& light_field, bool has_map,
                  Checker* check);

// Checks a light field for an engine of `config`.
void CheckLightField(const FullConfig& config, const starfocus_light_field& light_field,
                     Checker* check);

// Adds the address range of a depth map to *extents.
void AddDepthMap(const starfocus_depth_map& map, Extents* extents);

// Adds the address ranges of all planes of a light field to *extents.
void AddLightField(const FullConfig& config, const starfocus_light_field& light_field,
                   Extents* extents);

// Adds the address ranges of the planes of a picture of width x height to *extents.
void AddImage(const starfocus_image& image, int32_t width, int32_t height, Extents* extents);

// Checks an output picture of width x height, except for overlaps with other memory.
void CheckOutput(const FullConfig& config, const starfocus_image& image, int32_t width,
                 int32_t height, Checker* check);

// Checks that an output picture does not overlap the inputs.
void CheckOutputApart(const starfocus_image& image, int32_t width, int32_t height,
                      const Extents& read, Checker* check);

// If `status` is the error of a wrong disparity, adds the place of the first disparity of `map`
// that is not finite or outside the range of *problem. `first` is the row of the whole map at which
// `map` begins. `problem` may be null. Returns `status`.
starfocus_status TellPlace(starfocus_status status, const starfocus_depth_map& map, int32_t first,
                           starfocus_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_VALIDATE_H_
