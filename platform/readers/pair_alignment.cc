// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/pair_alignment.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "platform/readers/brightness.h"

namespace starfocus {
namespace {

constexpr int kSmallSide = 400;      // Longest side of the pictures that are compared.
constexpr int kHalf = 5;             // Patches of 11x11 pixels are compared.
constexpr int kStep = 9;             // Distance between patches in rows and columns.
constexpr int kLeastContrast = 480;  // Least sum of differences of a patch in each direction.

// Grey levels minus the mean of their surroundings, so that exposure does not matter.
struct Detail {
  int width = 0, height = 0;
  std::vector<int> values;

  int At(int x, int y) const { return values[size_t(y) * size_t(width) + size_t(x)]; }
};

// Returns the differences between the brightness of pixels and the mean of the square of pixels
// around them.
Detail DetailOf(const Image& picture, int factor) {
  constexpr int kReach = 2, kSide = 2 * kReach + 1;  // squares of 5x5 pixels
  const FloatMap grey = Brightness(picture, factor);
  const auto level = [&](int x, int y) {
    return static_cast<int>(
        grey.at(std::clamp(x, 0, grey.width - 1), std::clamp(y, 0, grey.height - 1)));
  };
  Detail detail = {grey.width, grey.height, {}};
  detail.values.reserve(grey.values.size());
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      int sum = 0;
      for (int v = -kReach; v <= kReach; ++v) {
        for (int u = -kReach; u <= kReach; ++u) sum += level(x + u, y + v);
      }
      detail.values.push_back(level(x, y) - sum / (kSide * kSide));
    }
  }
  return detail;
}

struct Point {
  int x, y;
};

// Returns true if the levels of the patch around a point change in both directions. Otherwise, the
// position of the patch cannot be measured.
bool IsCorner(const Detail& detail, const Point& at) {
  int across = 0, down = 0;
  for (int y = at.y - kHalf; y < at.y + kHalf; ++y) {
    for (int x = at.x - kHalf; x < at.x + kHalf; ++x) {
      across += std::abs(detail.At(x + 1, y) - detail.At(x, y));
      down += std::abs(detail.At(x, y + 1) - detail.At(x, y));
    }
  }
  return std::min(across, down) >= kLeastContrast;
}

// Returns the sum of differences between two patches, or a value of at least `most`.
int Apart(const Detail& left, const Point& a, const Detail& right, const Point& b, int most) {
  int sum = 0;
  for (int v = -kHalf; v <= kHalf && sum < most; ++v) {
    for (int u = -kHalf; u <= kHalf; ++u) {
      sum += std::abs(left.At(a.x + u, a.y + v) - right.At(b.x + u, b.y + v));
    }
  }
  return sum;
}

struct Match {
  Point at;
  double rise;  // difference of the heights in the right and the left picture
};

// Returns the fraction of a pixel from the middle of three sums to their minimum.
double Fraction(int before, int middle, int after) {
  const int bend = before + after - 2 * middle;
  return bend > 0 ? 0.5 * (before - after) / bend : 0;
}

// Returns the sum of the absolute values of a patch.
int Strength(const Detail& detail, const Point& at) {
  int sum = 0;
  for (int v = -kHalf; v <= kHalf; ++v) {
    for (int u = -kHalf; u <= kHalf; ++u) sum += std::abs(detail.At(at.x + u, at.y + v));
  }
  return sum;
}

// Number of places of the right picture that a patch fits.
enum class Places { kNone, kOne, kSeveral };

// Searches a patch of the left picture in the right picture. Sets `match` if the patch fits one
// place.
Places FindMatch(const Detail& left, const Detail& right, const Point& at, Match* match) {
  constexpr double kClearly = 0.8;  // ratio of the best difference to the best elsewhere
  constexpr int kElsewhere = 3;     // distance of other places from the best place
  // A patch fits several places if its difference from the best of them is at most this fraction of
  // its strength. No patch did so in 6 pairs of photos or rendered pictures of different scenes.
  constexpr double kFits = 0.5;
  const int reach = left.width / 8, rise = std::max(2, left.height / 16);
  const int x_first = std::max(kHalf, at.x - reach);
  const int x_last = std::min(left.width - 1 - kHalf, at.x + reach);
  const int y_first = std::max(kHalf + 1, at.y - rise);
  const int y_last = std::min(left.height - 2 - kHalf, at.y + rise);
  int best = std::numeric_limits<int>::max(), other = best;
  Point found = at;
  for (int y = y_first; y <= y_last; ++y) {
    for (int x = x_first; x <= x_last; ++x) {
      const int apart = Apart(left, at, right, {x, y}, other);
      if (apart >= other) continue;
      const bool near = std::max(std::abs(x - found.x), std::abs(y - found.y)) < kElsewhere;
      if (apart < best) {
        if (!near) other = best;
        best = apart;
        found = {x, y};
      } else if (!near) {
        other = apart;
      }
    }
  }
  if (best >= kClearly * other) {
    return best <= kFits * Strength(left, at) ? Places::kSeveral : Places::kNone;
  }
  if (found.y == y_first || found.y == y_last) return Places::kNone;
  const auto difference = [&](int y) {
    return Apart(left, at, right, {found.x, y}, std::numeric_limits<int>::max());
  };
  *match = {at, found.y - at.y + Fraction(difference(found.y - 1), best, difference(found.y + 1))};
  return Places::kOne;
}

double MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Computes the plane whose normal equations are `rows`, by Gaussian elimination. The plane has the
// height plane[0] + plane[1] * x + plane[2] * y. Returns false if the points do not define a plane.
bool Solve(double (&rows)[3][4], double* plane) {
  constexpr double kLeastPivot = 1e-6;  // The pivots of points on a line are 0 up to rounding.
  for (int k = 0; k < 3; ++k) {
    if (std::fabs(rows[k][k]) < kLeastPivot) return false;
    for (int other = 0; other < 3; ++other) {
      if (other == k) continue;
      const double factor = rows[other][k] / rows[k][k];
      for (int n = k; n < 4; ++n) rows[other][n] -= factor * rows[k][n];
    }
  }
  for (int k = 0; k < 3; ++k) plane[k] = rows[k][3] / rows[k][k];
  return true;
}

// Fits a plane to the rises of the matches that differ from the plane by less than `within`.
void FitPlane(const std::vector<Match>& matches, double within, double* plane) {
  double rows[3][4] = {};
  for (const Match& match : matches) {
    const double point[] = {1, double(match.at.x), double(match.at.y)};
    const double now = plane[0] + plane[1] * point[1] + plane[2] * point[2];
    if (std::fabs(match.rise - now) >= within) continue;
    for (int k = 0; k < 3; ++k) {
      for (int n = 0; n < 3; ++n) rows[k][n] += point[k] * point[n];
      rows[k][3] += point[k] * match.rise;
    }
  }
  double fitted[3];
  if (Solve(rows, fitted)) std::copy_n(fitted, 3, plane);
}

// Writes the pixel at (x, y) of a picture by bilinear interpolation. Beyond the edges, the
// outermost pixels are repeated.
void Interpolate(const Image& picture, double x, double y, uint8_t* pixel) {
  x = std::clamp(x, 0.0, double(picture.width - 1));
  y = std::clamp(y, 0.0, double(picture.height - 1));
  const int left = int(x), right = std::min(left + 1, picture.width - 1), above = int(y);
  const uint8_t* upper = picture.row(above);
  const uint8_t* lower = picture.row(std::min(above + 1, picture.height - 1));
  for (int c = 0; c < 3; ++c) {
    const auto between = [&](const uint8_t* row) {
      return row[3 * left + c] + (x - left) * (row[3 * right + c] - row[3 * left + c]);
    };
    const double level = between(upper) + (y - above) * (between(lower) - between(upper));
    pixel[c] = static_cast<uint8_t>(level + 0.5);
  }
}

}  // namespace

bool PairAlignment::contradicts() const {
  constexpr double kMostSlope = 0.05;  // a rotation of 3 degrees, or a difference of scale of 5 %
  constexpr int kLeastShare = 8;       // At least one point in 8 of one scene has a match.
  const int unrepeated = corners - repeated;
  if (unrepeated < kLeastPoints) return false;
  return kLeastShare * matches < unrepeated || 2 * consistent < matches ||
         std::fabs(across) > kMostSlope || std::fabs(down) > kMostSlope;
}

PairAlignment MeasureAlignment(const Image& left, const Image& right) {
  constexpr double kConsistent = 1;  // largest distance of consistent matches from the plane
  const int factor = (std::max(left.width, left.height) + kSmallSide - 1) / kSmallSide;
  const Detail from = DetailOf(left, factor), to = DetailOf(right, factor);
  PairAlignment alignment;
  std::vector<Match> matches;
  for (int y = kHalf + 1; y < from.height - kHalf - 1; y += kStep) {
    for (int x = kHalf; x < from.width - kHalf; x += kStep) {
      if (!IsCorner(from, {x, y})) continue;
      ++alignment.corners;
      Match match = {};
      const Places places = FindMatch(from, to, {x, y}, &match);
      if (places == Places::kOne) matches.push_back(match);
      if (places == Places::kSeveral) ++alignment.repeated;
    }
  }
  alignment.matches = int(matches.size());
  if (matches.empty()) return alignment;
  std::vector<double> rises;
  for (const Match& match : matches) rises.push_back(match.rise);
  double plane[3] = {MedianOf(rises), 0, 0};
  // The limit decreases, because the first planes are inaccurate.
  for (const double within : {4.0, 3.0, 2.0, 1.5, kConsistent, kConsistent}) {
    FitPlane(matches, within, plane);
  }
  for (const Match& match : matches) {
    const double at = plane[0] + plane[1] * match.at.x + plane[2] * match.at.y;
    alignment.consistent += std::fabs(match.rise - at) <= kConsistent ? 1 : 0;
  }
  alignment.offset = factor * plane[0];
  alignment.across = plane[1];
  alignment.down = plane[2];
  return alignment;
}

double LargestDifference(const PairAlignment& alignment, const Image& picture) {
  double largest = 0;
  for (const int x : {0, picture.width - 1}) {
    for (const int y : {0, picture.height - 1}) {
      largest = std::max(largest, std::fabs(alignment.At(x, y)));
    }
  }
  return largest;
}

Image AlignedPicture(const PairAlignment& alignment, const Image& right) {
  const double middle_x = 0.5 * right.width, middle_y = 0.5 * right.height;
  Image moved(right.width, right.height);
  for (int y = 0; y < right.height; ++y) {
    for (int x = 0; x < right.width; ++x) {
      // The heights define a rotation and a scale, which also move points sideways.
      const double aside = alignment.down * (x - middle_x) - alignment.across * (y - middle_y);
      Interpolate(right, x + aside, y + alignment.At(x, y), moved.row(y) + 3 * size_t(x));
    }
  }
  return moved;
}

}  // namespace starfocus
