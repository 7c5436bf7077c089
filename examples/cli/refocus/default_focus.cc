// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus/default_focus.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "examples/cli/input/notes.h"

namespace starfocus {
namespace {

// Number of samples along each axis, over the middle half of the picture.
constexpr int kSamples = 64;
// kShare is a fraction of the samples, and kAlike is a fraction of the disparity range.
constexpr double kShare = 0.1, kAlike = 0.06;
// In pixels of disparity. starfocus_focus_at treats disparities with a smaller difference as one
// surface.
constexpr double kLeastAlike = 0.75;

struct Sample {
  int x, y;
  float disparity;
};

// A regular grid of samples over the middle half of a map's width and height.
struct Grid {
  const FloatMap& map;

  static int Place(int k, int pixels) {
    return std::min(pixels - 1, pixels / 4 + (2 * k + 1) * pixels / (4 * kSamples));
  }
  Sample At(int column, int row) const {
    const int x = Place(column, map.width), y = Place(row, map.height);
    return {x, y, map.at(x, y)};
  }
};

// A surface, which consists of all samples with disparities from `low` to `high`.
struct Surface {
  float low, high;

  bool Has(float disparity) const { return disparity >= low && disparity <= high; }
};

// Returns the nearest surface that contains `count` of the samples, which are sorted from near to
// far. Returns a surface around the median if no surface contains `count` samples, as on a slope.
Surface FindNearest(const std::vector<float>& sorted, size_t count) {
  const float alike = std::max(static_cast<float>(kLeastAlike),
                               static_cast<float>(kAlike) * (sorted.front() - sorted.back()));
  for (size_t first = 0; first + count <= sorted.size(); ++first) {
    const float low = sorted[first + count - 1];
    if (sorted[first] - low <= alike) return {low, sorted[first]};
  }
  const float median = sorted[sorted.size() / 2];
  return {median - alike / 2, median + alike / 2};
}

// Returns the number of samples on the surface, among a sample and its neighbours in the grid.
int CountAround(const Grid& grid, const Surface& surface, int column, int row) {
  int count = 0;
  for (int r = std::max(0, row - 1); r <= std::min(kSamples - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(kSamples - 1, column + 1); ++c) {
      count += surface.Has(grid.At(c, r).disparity) ? 1 : 0;
    }
  }
  return count;
}

// Returns the sample with the most neighbours on the surface. Among samples with equal numbers of
// neighbours, returns the sample nearest to the centre.
Sample ChooseSample(const Grid& grid, const Surface& surface) {
  Sample best = {grid.map.width / 2, grid.map.height / 2, 0};
  int most = 0, least_distance = 0;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      const Sample sample = grid.At(column, row);
      if (!surface.Has(sample.disparity)) continue;
      const int count = CountAround(grid, surface, column, row);
      const int across = 2 * column + 1 - kSamples, down = 2 * row + 1 - kSamples;
      const int distance = across * across + down * down;
      if (count < most || (count == most && distance >= least_distance)) continue;
      most = count;
      least_distance = distance;
      best = sample;
    }
  }
  return best;
}

DefaultFocus AtPixel(int x, int y, const std::string& source) { return {true, x, y, 0, source}; }

// Converts a pixel coordinate from a picture of size `from` to a picture of size `to`. The result
// contains the centre of the original pixel.
int Scaled(int at, int from, int to) {
  return static_cast<int>((2 * int64_t{at} + 1) * to / (2 * int64_t{from}));
}

// Returns the median disparity of the places of a regular grid at which the matte has at least
// `least_alpha`, or NaN if there are no such places.
double MedianDisparity(const Matte& matte, const FloatMap& map, int columns, int rows,
                       int least_alpha) {
  std::vector<float> disparities;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto place = [&](int width, int height) {
        return size_t(Scaled(row, rows, height)) * size_t(width) +
               size_t(Scaled(column, columns, width));
      };
      const float disparity = map.values[place(map.width, map.height)];
      const bool is_subject = matte.alpha[place(matte.width, matte.height)] >= least_alpha;
      if (is_subject && std::isfinite(disparity)) disparities.push_back(disparity);
    }
  }
  if (disparities.empty()) return NAN;
  const auto middle = disparities.begin() + static_cast<ptrdiff_t>(disparities.size() / 2);
  std::nth_element(disparities.begin(), middle, disparities.end());
  return double(*middle);
}

// Returns the disparity of the subject of a photo with a matte and a map: the median of the pixels
// that certainly belong to the subject, or of all its pixels if the subject is small or uncertain.
// Returns NaN without a matte, or if the map is unknown there.
double SubjectDisparity(const Capture& capture) {
  constexpr int kGrid = 256, kCertain = 192, kLeastAlpha = 128;
  const FloatMap& map = capture.light_field.disparity;
  const Matte& matte = capture.matte;
  if (matte.alpha.empty()) return NAN;
  const double certain = MedianDisparity(matte, map, kGrid, kGrid, kCertain);
  if (std::isfinite(certain)) return certain;
  return MedianDisparity(matte, map, matte.width, matte.height, kLeastAlpha);
}

}  // namespace

DefaultFocus FindDefaultFocus(const Capture& capture) {
  const FloatMap& map = capture.light_field.disparity;
  const auto at_subject = [](double disparity) -> DefaultFocus {
    return {false, 0, 0, disparity, "the subject of the matte"};
  };
  if (std::isfinite(capture.subject)) return at_subject(capture.subject);
  if (capture.has_subject) {
    return AtPixel(capture.subject_x, capture.subject_y, "the subject in the photo's EXIF");
  }
  if (capture.has_focus) {
    return AtPixel(capture.focus_x, capture.focus_y, "the focus stored in the file");
  }
  if (std::isfinite(capture.focus)) {
    return {false, 0, 0, capture.focus, "the focus distance stored in the file"};
  }
  const double subject = SubjectDisparity(capture);
  if (std::isfinite(subject)) return at_subject(subject);
  const Image& picture = capture.light_field.views[0];
  DefaultFocus focus = FindSurface(map);
  focus.x = Scaled(focus.x, map.width, picture.width);
  focus.y = Scaled(focus.y, map.height, picture.height);
  return focus;
}

DefaultFocus FindSurface(const FloatMap& map) {
  const Grid grid = {map};
  std::vector<float> known;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      const float disparity = grid.At(column, row).disparity;
      if (std::isfinite(disparity)) known.push_back(disparity);
    }
  }
  if (known.empty()) return AtPixel(map.width / 2, map.height / 2, "the centre");
  std::sort(known.begin(), known.end(), [](float a, float b) { return a > b; });
  const auto count = static_cast<size_t>(std::ceil(kShare * static_cast<double>(known.size())));
  const Sample sample = ChooseSample(grid, FindNearest(known, count));
  return AtPixel(sample.x, sample.y, "the nearest large surface near the centre");
}

void TellFocus(const std::string& path, const DefaultFocus& focus) {
  TellNote(path, "focused at " + focus.source + " (--focus-at or --focus sets another)");
}

}  // namespace starfocus
