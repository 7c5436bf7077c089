// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/orientation.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace starfocus {
namespace {

// SwapsSides, FromRight and FromBelow decompose an EXIF orientation. An EXIF orientation states at
// which sides of the scene row 0 and column 0 of the picture are (EXIF 2.32, tag 274).
bool SwapsSides(int orientation) { return orientation >= 5; }
bool FromRight(int orientation) {  // true if the stored columns are in reverse order
  return orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
}
bool FromBelow(int orientation) {
  return orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
}

// Maps pixels of the upright picture, whose size is width x height, to pixels of the stored
// picture.
struct Turn {
  int orientation, width, height;

  std::pair<int, int> Place(int x, int y) const {
    int across = x, down = y, columns = width, rows = height;
    if (SwapsSides(orientation)) {
      across = y;
      down = x;
      columns = height;
      rows = width;
    }
    return {FromRight(orientation) ? columns - 1 - across : across,
            FromBelow(orientation) ? rows - 1 - down : down};
  }
};

// Turns a picture of `channels` samples per pixel.
template <class Sample>
void TurnSamples(int orientation, int channels, int* width, int* height,
                 std::vector<Sample>* samples) {
  const int stored = *width;
  if (SwapsSides(orientation)) std::swap(*width, *height);
  std::vector<Sample> turned;
  turned.reserve(samples->size());
  const Turn turn = {orientation, *width, *height};
  for (int y = 0; y < *height; ++y) {
    for (int x = 0; x < *width; ++x) {
      const auto [from_x, from_y] = turn.Place(x, y);
      const size_t pixel = size_t(from_y) * size_t(stored) + size_t(from_x);
      const auto from = samples->begin() + static_cast<ptrdiff_t>(pixel * size_t(channels));
      turned.insert(turned.end(), from, from + channels);
    }
  }
  *samples = std::move(turned);
}

}  // namespace

void TurnMap(int orientation, FloatMap* map) {
  TurnSamples(orientation, 1, &map->width, &map->height, &map->values);
}

void TurnPoint(int orientation, double* x, double* y) {
  if (FromRight(orientation)) *x = 1 - *x;
  if (FromBelow(orientation)) *y = 1 - *y;
  if (SwapsSides(orientation)) std::swap(*x, *y);
}

void ApplyOrientation(DepthPhoto* photo) {
  const int orientation = photo->orientation;
  if (orientation <= 1 || orientation > 8) return;
  Image& picture = photo->picture;
  TurnSamples(orientation, 3, &picture.width, &picture.height, &picture.pixels);
  if (photo->deep) {
    DeepImage& deep = *photo->deep;
    TurnSamples(orientation, deep.channels, &deep.width, &deep.height, &deep.samples);
  }
  GainMap& gain = photo->gain_map;
  TurnSamples(orientation, gain.channels, &gain.width, &gain.height, &gain.levels);
  TurnMap(orientation, &photo->map);
  TurnMap(orientation, &photo->matte);
  TurnPoint(orientation, &photo->focus_x, &photo->focus_y);
  TurnPoint(orientation, &photo->subject_x, &photo->subject_y);
  photo->facts.emplace_back("orientation",
                            std::to_string(orientation) + " of EXIF, applied to picture and map");
  photo->applied_orientation = orientation;
  photo->orientation = 1;
}

}  // namespace starfocus
