// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/map_orientation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "platform/readers/brightness.h"
#include "platform/readers/orientation.h"
#include "platform/readers/photo_scale.h"
#include "platform/readers/robust_range.h"

namespace starfocus {
namespace {

// Limit in pixels on the longer side of pictures whose edges are compared.
constexpr int kSmall = 512;

struct Slope {
  double x, y;
};

Slope SlopeAt(const FloatMap& map, int x, int y) {
  return {double(map.at(x + 1, y)) - double(map.at(x - 1, y)),
          double(map.at(x, y + 1)) - double(map.at(x, y - 1))};
}

// Returns how well the edges of two maps of equal size agree in position and direction, from 0 (not
// at all) to 1.
double Agreement(const FloatMap& picture, const FloatMap& map) {
  double both = 0, first = 0, second = 0;
  for (int y = 1; y + 1 < map.height; ++y) {
    for (int x = 1; x + 1 < map.width; ++x) {
      const Slope a = SlopeAt(picture, x, y), b = SlopeAt(map, x, y);
      if (!std::isfinite(b.x + b.y)) continue;
      both += std::fabs(a.x * b.x + a.y * b.y);
      first += a.x * a.x + a.y * a.y;
      second += b.x * b.x + b.y * b.y;
    }
  }
  return first > 0 && second > 0 ? both / std::sqrt(first * second) : 0;
}

// Result of a comparison between the edges of picture and map. `sure` is true if the edges agree
// clearly better in one of the orientations upright and stored.
struct Uprightness {
  bool upright, sure;
};

// `picture` is upright. `orientation` is the orientation of its file.
Uprightness JudgeByEdges(const Image& picture, int orientation, FloatMap map) {
  constexpr double kSure = 1.05;
  const int longer = std::max(picture.width, picture.height);
  const int factor = (longer + kSmall - 1) / kSmall;
  const FloatMap small = Brightness(picture, factor);
  if (small.values.empty()) return {false, false};
  const RobustRange range = RobustRangeOf(map.values);
  for (float& value : map.values) {
    if (std::isfinite(value)) value = std::clamp(value, range.low, range.high);
  }
  const double upright = Agreement(small, Resize(map, small.width, small.height));
  TurnMap(orientation, &map);
  const double turned = Agreement(small, Resize(map, small.width, small.height));
  const bool sure = std::max(turned, upright) > kSure * std::min(turned, upright);
  return {sure && upright > turned, sure};
}

// Decides by the edges of picture and map whether the map is upright. Used if the proportions of
// the map fit both the upright and the stored orientation. Adds a note.
bool ChooseByEdges(const std::string& kind, const FloatMap& map, DepthPhoto* photo) {
  const auto [upright, sure] = JudgeByEdges(photo->picture, photo->applied_orientation, map);
  photo->notes.push_back("the " + kind + " is taken to be " +
                         (upright ? "upright already" : "rotated like the stored photo") +
                         (sure ? ", because its edges then match the photo better"
                               : ", although its edges do not confirm this") +
                         (upright ? " (--depth-orientation photo overrides this)"
                                  : " (--depth-orientation upright overrides this)"));
  return upright;
}

}  // namespace

bool HasSameProportions(const FloatMap& map, int width, int height) {
  constexpr double kTolerance = 0.03;
  const double a = double(map.width) * height, b = double(map.height) * width;
  // Allow an error of one pixel in the size of the picture or of the map, whichever is smaller,
  // because sizes are rounded to whole pixels.
  return std::fabs(a - b) <= std::max({kTolerance * std::min(a, b), double(width), double(height)});
}

bool IsStretched(const FloatMap& map, int width, int height) {
  return map.width == map.height && !HasSameProportions(map, width, height);
}

void StandWithPhoto(DepthOrientation choice, bool is_matte, DepthPhoto* photo, FloatMap* map) {
  ApplyOrientation(photo);
  const int orientation = photo->applied_orientation;
  if (orientation <= 1) return;
  const Image& picture = photo->picture;
  bool upright = choice == DepthOrientation::kUpright;
  if (choice == DepthOrientation::kUnknown) {
    const bool swaps = orientation >= 5;
    const bool as_turned = HasSameProportions(*map, picture.width, picture.height);
    const bool as_file =
        swaps ? HasSameProportions(*map, picture.height, picture.width) : as_turned;
    const bool stretched = is_matte && IsStretched(*map, picture.width, picture.height);
    const std::string kind = is_matte ? "matte" : "depth picture";
    const bool by_edges = (as_file && as_turned) || stretched;
    upright = by_edges ? ChooseByEdges(kind, *map, photo) : as_turned;
  }
  if (!upright) TurnMap(orientation, map);
}

}  // namespace starfocus
