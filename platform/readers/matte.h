// SPDX-License-Identifier: Apache-2.0
// Mattes, which state for each pixel of a photo how much of it the subject covers. A matte replaces
// the depth map of a photo, or adds coverage to the outlines of a depth map (starfocus/matte.h).
#ifndef STARFOCUS_PLATFORM_READERS_MATTE_H_
#define STARFOCUS_PLATFORM_READERS_MATTE_H_

#include <cstdint>
#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/light_field.h"
#include "platform/pfm.h"
#include "platform/result.h"
#include "platform/runner.h"

namespace starfocus {

// A matte with 8 bits per sample: 0 is the background, and 255 is the subject.
struct Matte {
  Matte() = default;
  // Converts alpha from 0 to 1. Unknown values (NaN) are background.
  explicit Matte(const FloatMap& map);

  int width = 0, height = 0;
  std::vector<uint8_t> alpha;  // in rows without padding; empty: no matte
};

// Returns the size of a matte and the part of the picture that its subject covers, for users.
std::string Description(const Matte& matte);

// The surfaces that have samples in a matte: the subject with alpha of 0.5 or more, the background.
enum class MatteContent { kBoth, kEmpty, kFull };

MatteContent ContentOf(const FloatMap& matte);

// Returns an error unless `matte`, alpha from 0 to 1, has a subject and a background and can belong
// to `picture` by its proportions. If `is_frame` is true, the matte may be empty or full. A square
// matte can belong to any picture, because many networks stretch pictures to squares. Picture and
// matte must be upright.
Error CheckMatte(const std::string& where, const FloatMap& matte, const Image& picture,
                 bool is_frame);

// Fills map and coverage of a light field from a matte (starfocus_matte_field). The subject has the
// disparity `subject`, and the background has the disparity 0. If `floor` is true, the background
// comes nearer below the horizon that starfocus_measure_matte proposes, up to the disparity of the
// subject. The light field must have one view.
Error FillTwoSurfaces(const std::string& where, const Matte& matte, double subject, bool floor,
                      LightField* light_field);

// Adds the coverage of a matte to a light field with a map (starfocus_matte_coverage). The light
// field must have one view of the size of the map. Runs jobs on `runner`.
Error CoverByMatte(const std::string& where, const Matte& matte, ThreadRunner* runner,
                   LightField* light_field);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MATTE_H_
