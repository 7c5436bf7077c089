// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/lens_options.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "examples/cli/input.h"
#include "examples/command_line/options.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

namespace {

// Stores the name and the value of the option that set the radius. --strength is stored only if
// neither --f-stop nor --aperture was given.
void NameOption(const ApertureOptions& options, ApertureChoice* aperture) {
  for (const auto& [name, value] : {std::pair{"--f-stop", options.f_stop},
                                    {"--aperture", options.aperture},
                                    {"--strength", options.strength}}) {
    if (!value) continue;
    aperture->option = name;
    aperture->value = Short(*value);
    return;
  }
}

// Returns the first number of three digits that satisfies `fits`. The search starts at `value` and
// increments or decrements the third digit. The function tests the number as printed, so that the
// number also fits if a user types it.
template <class Fits>
double FirstThatFits(double value, int direction, const Fits& fits) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  for (double count = std::round(value / unit) - direction;; count += direction) {
    const double printed = std::strtod(ThreeDigits(count * unit).c_str(), nullptr);
    if (fits(printed)) return printed;
  }
}

// Returns the widest f-stop of three digits within the blur limit. LargestRadius and
// LargestPercentage return the corresponding limits of --aperture and --strength.
double WidestFStop(double range, const ApertureChoice& aperture) {
  const double factor = aperture.widest * aperture.strength;
  return FirstThatFits(factor * range / STARFOCUS_MAX_BLUR, 1, [&](double f_stop) {
    return aperture.widest / f_stop * aperture.strength * range <= STARFOCUS_MAX_BLUR;
  });
}

double LargestRadius(double range, const ApertureChoice& aperture) {
  return FirstThatFits(STARFOCUS_MAX_BLUR / range / aperture.strength, -1, [&](double radius) {
    return radius * aperture.strength * range <= STARFOCUS_MAX_BLUR;
  });
}

double LargestPercentage(double range, const ApertureChoice& aperture) {
  const double base = aperture.radius / aperture.strength;
  return FirstThatFits(100 * STARFOCUS_MAX_BLUR / range / base, -1, [&](double percentage) {
    return base * (percentage / 100) * range <= STARFOCUS_MAX_BLUR;
  });
}

// Describes the largest aperture within the blur limit, as a value of the option that set the
// aperture.
std::string WhatFits(double range, const ApertureChoice& aperture) {
  if (aperture.option == "--f-stop" || aperture.option == "--aperture-keys") {
    return "f/" + ThreeDigits(WidestFStop(range, aperture)) + " or narrower";
  }
  return aperture.option == "--aperture"
             ? "at most " + ThreeDigits(LargestRadius(range, aperture))
             : "at most " + ThreeDigits(LargestPercentage(range, aperture)) + " percent";
}

}  // namespace

Result<ApertureChoice> PlanAperture(const ApertureOptions& options, const Capture& capture) {
  if (options.aperture && options.f_stop) {
    return Error::Usage("--f-stop", "either --aperture U or --f-stop N", "both");
  }
  if (options.widest && !options.f_stop) {
    return Error::Usage("--widest", "--f-stop N as well", "no --f-stop");
  }
  ApertureChoice aperture;
  if (capture.photo) {
    aperture.remedy =
        std::isfinite(capture.subject)
            ? "a wider aperture by --f-stop or --aperture changes this"
            : "another --depth-unit of a depth picture or a wider aperture changes this";
  }
  if (capture.widest > 0) aperture.widest = capture.widest;
  if (capture.f_stop > 0) aperture.radius = capture.widest / capture.f_stop;
  if (options.aperture) aperture.radius = *options.aperture;
  if (options.widest) aperture.widest = *options.widest;
  if (options.f_stop) aperture.radius = aperture.widest / *options.f_stop;
  if (options.f_stop && *options.f_stop < aperture.widest) {
    return Error::Usage("--f-stop", "an f-stop of at least the widest, " + Short(aperture.widest),
                        Short(*options.f_stop));
  }
  aperture.strength = options.strength.value_or(100) / 100;
  aperture.radius *= aperture.strength;
  NameOption(options, &aperture);
  return aperture;
}

double FarthestFromFocus(const starfocus_disparity_stats& stats, const std::vector<double>& foci,
                         const starfocus::Params& lens) {
  double range = 0;
  for (const double focus : foci) {
    range = std::max(
        {range, focus - lens.focus_farther - stats.min, stats.max - focus - lens.focus_nearer});
  }
  return range;
}

double SharpRadius(int width, int height) {
  return std::max(1.0, std::hypot(width, height) / 3000);
}

Error FitAperture(double range, ApertureChoice* aperture) {
  const double blur = aperture->radius * range;
  aperture->blur = std::min(blur, STARFOCUS_MAX_BLUR);
  if (blur <= STARFOCUS_MAX_BLUR) return {};
  if (aperture->option.empty()) {
    aperture->radius = aperture->widest / WidestFStop(range, *aperture);
    aperture->narrowed = true;
    return {};
  }
  return Error::Usage(
      aperture->option,
      WhatFits(range, *aperture) + " (a blur of at most " + Short(STARFOCUS_MAX_BLUR) + " pixels)",
      aperture->value + ", which blurs by " + Short(std::ceil(10 * blur) / 10) + " pixels");
}

void TellAperture(const std::string& path, const ApertureChoice& aperture) {
  if (!aperture.remedy.empty() && aperture.blur < 1 && aperture.radius > 0) {
    TellNote(path, "the blur is below a pixel everywhere, at most " + ThreeDigits(aperture.blur) +
                       " (" + aperture.remedy + ")");
  }
  if (!aperture.narrowed) return;
  TellNote(path, "aperture set to f/" + ThreeDigits(aperture.widest / aperture.radius) +
                     ", the widest with a blur of at most " + Short(STARFOCUS_MAX_BLUR) +
                     " pixels (--f-stop sets another)");
}

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
