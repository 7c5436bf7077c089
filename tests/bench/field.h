// SPDX-License-Identifier: Apache-2.0
// The light fields of the bench: folders with what is known of their truth, and in-memory changes
// of them for the sweeps.
#ifndef STARFOCUS_TESTS_BENCH_FIELD_H_
#define STARFOCUS_TESTS_BENCH_FIELD_H_

#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/light_field.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"

namespace starfocus::bench {

struct Truth {
  double focus, aperture;
  Image picture;
};

struct Field {
  std::string name;
  LightField data;
  float low = 0, high = 0;  // of the disparity map
  std::vector<Truth> truths;
  starfocus_transfer transfer = STARFOCUS_TRANSFER_SRGB;  // that the truths were traced by

  int views() const { return int(data.views.size()); }
  double pixels() const { return double(data.width()) * data.height(); }
  double FocusAt(double quantile) const;
  double LargestBlur(double focus, double aperture) const;
  const Image* FindTruth(double focus, double aperture) const;  // null: there is none
};

// Loads all views, fills invalid disparities, and reads truth_dt<D>_ut<U>.png.
Error LoadField(const std::string& folder, Field* field);

// The light field repeated to width x height with `views` views, as far as needed mirrored so that
// no new depth edges appear.
Field Tile(const Field& field, int width, int height, int views);

// The same pictures with the disparities multiplied: right for times, wrong for holes.
Field Stretch(const Field& field, double factor, int views);

// The first `views` views as the engine takes them.
starfocus_light_field Rows(const LightField& data, int views);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_FIELD_H_
