// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/pair_alignment.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace starfocus {
namespace {

constexpr int kSmallSide = 400;      // Longest side of the pictures that are compared.
constexpr int kHalf = 5;             // Patches of 11x11 pixels are compared.
constexpr int kStep = 9;             // Distance between patches in rows and columns.
constexpr int kLeastContrast = 480;  // Least sum of differences of a patch in each direction.
constexpr int kLeastCorners = 40;

// Grey levels minus the mean of their surroundings, so that exposure does not matter.
struct Detail {
  int width = 0, height = 0;
  std::vector<int> values;

  int At(int x, int y) const { return values[size_t(y) * size_t(width) + size_t(x)]; }
};

// Returns the sum of R, G and B, averaged over factor * factor pixels.
Detail Reduce(const Image& picture, int factor) {
  Detail grey = {picture.width / factor, picture.height / factor, {}};
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      int sum = 0;
      for (int row = y * factor; row < (y + 1) * factor; ++row) {
        const uint8_t* from = picture.row(row) + 3 * size_t(x) * size_t(factor);
        for (int k = 0; k < 3 * factor; ++k) sum += from[k];
      }
      grey.values.push_back(sum / (factor * factor));
    }
  }
  return grey;
}

// Returns the differences between grey levels and the means of the 5x5 levels around them.
Detail DetailOf(const Detail& grey) {
  Detail detail = {grey.width, grey.height, {}};
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      int sum = 0;
      for (int v = -2; v <= 2; ++v) {
        for (int u = -2; u <= 2; ++u) {
          sum +=
              grey.At(std::clamp(x + u, 0, grey.width - 1), std::clamp(y + v, 0, grey.height - 1));
        }
      }
      detail.values.push_back(grey.At(x, y) - sum / 25);
    }
  }
  return detail;
}

struct Point {
  int x, y;
};

// Returns true if the patch around a point differs from patches beside it and above it.
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

// Searches a patch of the left picture in the right picture. Returns false if no place or several
// places fit.
bool FindMatch(const Detail& left, const Detail& right, const Point& at, Match* match) {
  constexpr double kClearly = 0.8;  // ratio of the best difference to the best elsewhere
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
      const bool near = std::abs(x - found.x) <= 2 && std::abs(y - found.y) <= 2;
      if (apart < best) {
        if (!near) other = best;
        best = apart;
        found = {x, y};
      } else if (!near) {
        other = apart;
      }
    }
  }
  if (best >= kClearly * other || found.y == y_first || found.y == y_last) return false;
  const auto beside = [&](int by) {
    return Apart(left, at, right, {found.x, found.y + by}, std::numeric_limits<int>::max());
  };
  *match = {at, found.y - at.y + Fraction(beside(-1), best, beside(1))};
  return true;
}

double MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Solves the normal equations of a plane z = p[0] + p[1] * x + p[2] * y by elimination. Returns
// false if the points do not define a plane.
bool Solve(double (&rows)[3][4], double* plane) {
  for (int k = 0; k < 3; ++k) {
    if (std::fabs(rows[k][k]) < 1e-6) return false;
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
    pixel[c] = static_cast<uint8_t>(
        std::lround(between(upper) + (y - above) * (between(lower) - between(upper))));
  }
}

}  // namespace

bool PairAlignment::contradicts() const {
  constexpr double kMostSlope = 0.05;  // a rotation of 3 degrees, or a difference of scale of 5 %
  if (corners < kLeastCorners) return false;
  return 8 * matches < corners || 2 * consistent < matches || std::fabs(across) > kMostSlope ||
         std::fabs(down) > kMostSlope;
}

PairAlignment MeasureAlignment(const Image& left, const Image& right) {
  const int factor = (std::max(left.width, left.height) + kSmallSide - 1) / kSmallSide;
  const Detail from = DetailOf(Reduce(left, factor)), to = DetailOf(Reduce(right, factor));
  PairAlignment alignment;
  std::vector<Match> matches;
  for (int y = kHalf + 1; y < from.height - kHalf - 1; y += kStep) {
    for (int x = kHalf; x < from.width - kHalf; x += kStep) {
      if (!IsCorner(from, {x, y})) continue;
      ++alignment.corners;
      Match match = {};
      if (FindMatch(from, to, {x, y}, &match)) matches.push_back(match);
    }
  }
  alignment.matches = int(matches.size());
  if (matches.empty()) return alignment;
  std::vector<double> rises;
  for (const Match& match : matches) rises.push_back(match.rise);
  double plane[3] = {MedianOf(rises), 0, 0};
  for (const double within : {4.0, 3.0, 2.0, 1.5, 1.0, 1.0}) FitPlane(matches, within, plane);
  for (const Match& match : matches) {
    const double at = plane[0] + plane[1] * match.at.x + plane[2] * match.at.y;
    alignment.consistent += std::fabs(match.rise - at) <= 1 ? 1 : 0;
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
