// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/orientation.h"

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

// Turns a picture with `samples` samples for each pixel.
template <class Picture>
void TurnPicture(int orientation, size_t samples, Picture result, Picture* image) {
  const Turn turn = {orientation, result.width, result.height};
  for (int y = 0; y < result.height; ++y) {
    auto* to = result.row(y);
    for (int x = 0; x < result.width; ++x) {
      const auto [from_x, from_y] = turn.Place(x, y);
      const auto* from = image->row(from_y) + samples * size_t(from_x);
      for (size_t c = 0; c < samples; ++c) *to++ = from[c];
    }
  }
  *image = std::move(result);
}

void TurnDeep(int orientation, DeepImage* deep) {
  const bool swaps = SwapsSides(orientation);
  DeepImage result(swaps ? deep->height : deep->width, swaps ? deep->width : deep->height,
                   deep->channels);
  result.is_half = deep->is_half;
  result.transfer = deep->transfer;
  TurnPicture(orientation, size_t(deep->channels), std::move(result), deep);
}

}  // namespace

void TurnMap(int orientation, FloatMap* map) {
  const bool swaps = SwapsSides(orientation);
  FloatMap result;
  result.width = swaps ? map->height : map->width;
  result.height = swaps ? map->width : map->height;
  result.values.reserve(map->values.size());
  const Turn turn = {orientation, result.width, result.height};
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      const auto [from_x, from_y] = turn.Place(x, y);
      result.values.push_back(map->at(from_x, from_y));
    }
  }
  *map = std::move(result);
}

void TurnPoint(int orientation, double* x, double* y) {
  if (FromRight(orientation)) *x = 1 - *x;
  if (FromBelow(orientation)) *y = 1 - *y;
  if (SwapsSides(orientation)) std::swap(*x, *y);
}

void ApplyOrientation(DepthPhoto* photo) {
  const int orientation = photo->orientation;
  if (orientation <= 1 || orientation > 8) return;
  const bool swaps = SwapsSides(orientation);
  const Image& picture = photo->picture;
  Image turned(swaps ? picture.height : picture.width, swaps ? picture.width : picture.height);
  TurnPicture(orientation, 3, std::move(turned), &photo->picture);
  if (photo->deep) TurnDeep(orientation, &*photo->deep);
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
