// SPDX-License-Identifier: Apache-2.0
// Reads the light fields of the bench with their ray-traced pictures (truths). Creates larger and
// stretched copies for the sweeps of the size and the blur radius. Used by bench.cc, count.cc and
// measure.cc.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_FIELD_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_FIELD_H_

#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/light_field.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus::bench {

// A ray-traced picture of the light field for one focus and aperture.
struct Truth {
  double focus, aperture;
  Image picture;
};

struct Field {
  std::string name;
  LightField data;
  float low = 0, high = 0;  // smallest and largest disparity of the map
  std::vector<Truth> truths;
  // Transfer function of the ray-traced pictures.
  starfocus_transfer transfer = STARFOCUS_TRANSFER_SRGB;

  int views() const { return int(data.views.size()); }
  double pixels() const { return double(data.width()) * data.height(); }
  // Returns a quantile of the disparity map; `quantile` is in [0, 1].
  double FocusAt(double quantile) const;
  // Returns the largest blur radius in pixels.
  double LargestBlur(double focus, double aperture) const;
  // Returns the ray-traced picture for this focus and aperture, or null if the folder has no such
  // picture.
  const Image* FindTruth(double focus, double aperture) const;
};

// Reads all views of a folder, fills invalid disparities, and reads the ray-traced pictures
// truth_dt<D>_ut<U>.png.
Error LoadField(const std::string& folder, Field* field);

// Tiles `width` x `height` pixels with copies of `field`, and returns the first `views` views.
// Every second copy is mirrored, so that no new depth edges appear.
Field Tile(const Field& field, int width, int height, int views);

// Returns the first `views` views of `field`, with the disparities multiplied by `factor`. The
// result is valid for measuring times only, since its views no longer match its disparities.
Field Stretch(const Field& field, double factor, int views);

// Returns the first `views` views and the disparity map as a starfocus_light_field, which points
// into `data`.
starfocus_light_field Rows(const LightField& data, int views);

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_FIELD_H_
