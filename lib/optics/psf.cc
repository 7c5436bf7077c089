// SPDX-License-Identifier: Apache-2.0
#include "lib/optics/psf.h"

#include <cmath>

namespace starfocus {
namespace {

constexpr int32_t kOne = 1 << kDisparityBits;
constexpr int32_t kFineSteps = 8;     // Number of PSF radii per pixel, up to kFineEnd.
constexpr int32_t kFineEnd = 4;       // End of the fine steps, in pixels.
constexpr int32_t kCoarseSteps = 32;  // Number of PSF radii per octave beyond kFineEnd.
double Smaller(double a, double b) { return a < b ? a : b; }
double Larger(double a, double b) { return a > b ? a : b; }

// Number of lines per pixel, and of points per line, for the integral of (4). Small PSFs use more
// lines.
constexpr int32_t LinesOf(double r) { return r <= kFineEnd ? 16 : 8; }
constexpr int32_t kPoints = 8;
// Cost of the integral over one pixel, in samples of CancelToken::Spend.
constexpr int32_t kIntegralSamples = 256;

// The pixels of a picture are integrals over pixels. Integrals of (4) over pixels would blur them a
// second time, by a variance of 1/12 along each axis, and would not blur at all below a radius of
// 1/2. The variance of a PSF therefore exceeds the variance of (4) by the share kMore of the
// latter, and by at most kMostMore. An exact variance would sharpen fine detail too much
// (docs/constants.md).
constexpr double kMore = 1.0 / 4, kMostMore = 1.0 / 24;
// Below this variance of (4), a share of the light remains in its pixel (MakePsf). From this
// variance on, the integrals have a variance of almost exactly 1/12 too much, so the PSF is made
// from a smaller disc.
constexpr double kSmallVariance = 1.0 / 2;
// Radius of the smallest disc. The integrals of smaller discs have hardly any light outside the
// middle pixel.
constexpr double kSmallestDisc = 0.8;

// Returns the distance, in pixels along an axis, of the last pixel that a disc covers at least in
// part.
int32_t SizeOf(double r) {
  const auto pixels = static_cast<int32_t>(r + 0.5);
  return pixels > 0 && pixels - 0.5 >= r ? pixels - 1 : pixels;
}

// Returns the radius of the disc from which the PSF of radius r is made. `variance` is the variance
// of (4) along an axis at this radius.
double DiscOf(double r, double variance) {
  if (variance < kSmallVariance) return Larger(r, kSmallestDisc);
  return r * std::sqrt(1 - kMostMore / variance);
}

// Returns the largest size of a PSF of a radius (kDisparityBits).
int32_t LargestSizeOf(int32_t radius) {
  return radius == 0 ? 0 : SizeOf(Larger(static_cast<double>(radius) / kOne, kSmallestDisc));
}

size_t WeightsOf(bool full, int32_t size) {
  const auto n = static_cast<size_t>(size);
  return full ? (2 * n + 1) * (2 * n + 1) : (n + 1) * (n + 2) / 2;
}

// Reduces the interval [*from, *to] of x, on the line at y, to the part where light passes through
// a polygon of radius r. A curved edge limits the interval to the range between the zeros of a
// quadratic function. A straight edge limits one end of the interval.
void KeepPolygon(const ApertureShape& opening, double y, double r, double* from, double* to) {
  constexpr double kUnit = 1.0 / kOpeningOne;
  const double square = opening.bulge * kUnit;
  for (int32_t edge = 0; edge < opening.blades; ++edge) {
    const double across = opening.normals[edge][0] * kUnit, up = opening.normals[edge][1] * kUnit;
    const double slope = opening.slope * kUnit * r;
    const double rest = square * y * y + slope * up * y - opening.limit * kUnit * r * r;
    const double half = 0.5 * slope * across;  // square x^2 + 2 half x + rest <= 0
    if (opening.bulge == 0) {
      if (opening.normals[edge][0] > 0) *to = Smaller(*to, -rest / (2 * half));
      if (opening.normals[edge][0] < 0) *from = Larger(*from, -rest / (2 * half));
      if (opening.normals[edge][0] == 0 && rest > 0) *to = *from;
      continue;
    }
    const double discriminant = half * half - square * rest;
    if (discriminant <= 0) {
      *to = *from;
      return;
    }
    const double root = std::sqrt(discriminant);
    // Avoids cancellation: both zeros are computed without a difference of two similar numbers.
    const double sum = half > 0 ? -half - root : -half + root;
    const double other = sum == 0 ? 0 : rest / sum, zero = sum / square;
    *from = Larger(*from, Smaller(zero, other));
    *to = Smaller(*to, Larger(zero, other));
  }
}

// Returns the relative integral over pixel (n, m) of (3), or of an evenly bright opening. r is the
// radius of the disc in pixels. The midpoint rule is applied along `lines` lines that end at the
// edge of the opening. An integral by counting the points of a square grid would cause errors of up
// to 1.6 grey levels at sharp edges. Arithmetic and square root follow IEEE, so all machines
// compute the same result.
template <starfocus_shape kShape>
double DiscIntegral(int32_t n, int32_t m, double r, int32_t lines, const ApertureShape& opening) {
  const double square = r * r, fall_off = opening.fall_off / 65536.0;
  const double low = Larger(m - 0.5, -r), high = Smaller(m + 0.5, r);
  if (low >= high) return 0;
  double sum = 0;
  for (int32_t line = 0; line < lines; ++line) {
    const double y = low + (line + 0.5) / lines * (high - low), rim = std::sqrt(square - y * y);
    double from = Larger(n - 0.5, -rim), to = Smaller(n + 0.5, rim);
    if (kShape == STARFOCUS_SHAPE_POLYGON) KeepPolygon(opening, y, r, &from, &to);
    if (from >= to) continue;
    double along = kShape == STARFOCUS_SHAPE_FALL_OFF ? 0 : kPoints;
    for (int32_t point = 0; kShape == STARFOCUS_SHAPE_FALL_OFF && point < kPoints; ++point) {
      const double at = from + (point + 0.5) / kPoints * (to - from);
      const double ratio = fall_off / ((at * at + y * y) / square + fall_off);
      along += ratio * ratio;
    }
    sum += along * (to - from);
  }
  return sum * (high - low) / lines;
}

// Returns DiscIntegral for the shape of the opening. The edges of a polygon may be parallel to the
// lines and lie between two lines, so polygons use four times as many lines.
double PixelIntegral(int32_t n, int32_t m, double r, const ApertureShape& opening) {
  const int32_t lines = LinesOf(r);
  if (opening.shape == STARFOCUS_SHAPE_FALL_OFF) {
    return DiscIntegral<STARFOCUS_SHAPE_FALL_OFF>(n, m, r, lines, opening);
  }
  if (opening.shape == STARFOCUS_SHAPE_POLYGON) {
    return DiscIntegral<STARFOCUS_SHAPE_POLYGON>(n, m, r, 4 * lines, opening);
  }
  const double whole = DiscIntegral<STARFOCUS_SHAPE_DISC>(n, m, r, lines, opening);
  if (!opening.IsRing() || opening.inner == 0) return whole;
  const double hole = r * opening.inner / kOpeningOne;
  return Larger(0, whole - DiscIntegral<STARFOCUS_SHAPE_DISC>(n, m, hole, lines, opening));
}

// Calls visit(n, m, points, integral) for the stored weights of a disc of radius r. `points` is the
// number of pixels that share the weight, and `integral` is the integral of (4) over one pixel.
// Returns false after cancellation.
template <class Visit>
bool ForEachWeight(double r, const ApertureShape& opening, CancelToken* cancel,
                   const Visit& visit) {
  const int32_t size = SizeOf(r);
  if (opening.IsSymmetric()) {
    ForEachOfOctant(size, opening.IsRing(), [&](int32_t n, int32_t m) {
      visit(n, m, PointsOfOctant(n, m), PixelIntegral(n, m, r, opening));
    });
    return GoesOn(cancel, int64_t{kIntegralSamples} * size * size / 2);
  }
  for (int32_t m = -size; m <= size; ++m) {
    if (!GoesOn(cancel, int64_t{kIntegralSamples} * (2 * size + 1))) return false;
    for (int32_t n = -size; n <= size; ++n) visit(n, m, 1, PixelIntegral(n, m, r, opening));
  }
  return true;
}

// Computes the PSF of a radius (kDisparityBits). `mean_square` is the MeanSquare of the opening.
// Returns false after cancellation. Pixels that share a weight form an orbit. Each orbit absorbs
// the rounding error of all earlier orbits, and the last orbit absorbs the remainder, as in
// MakeViewWeights.
bool MakePsf(int32_t radius, double mean_square, const ApertureShape& opening, CancelToken* cancel,
             uint16_t* weights, Psf* psf) {
  psf->size = 0;
  psf->weights = weights;
  psf->sum_bits = 14;
  psf->full = !opening.IsSymmetric();
  if (radius == 0) {
    weights[0] = 1 << 14;
    return true;
  }
  const double blur = static_cast<double>(radius) / kOne, variance = blur * blur * mean_square;
  const double r = DiscOf(blur, variance);
  const int32_t size = psf->size = SizeOf(r);
  // `largest` is the largest integral over a set of pixels that simd::Disc multiplies by one
  // weight.
  double total = 0, squares = 0, largest = 0, middle = 0;
  const auto add = [&](int32_t n, int32_t m, int32_t points, double integral) {
    total += points * integral;
    squares += points * integral * (n * n + m * m) / 2;
    const int32_t together = psf->full ? 1 : (n > 0 ? 2 : 1) * (m > 0 ? 2 : 1);
    largest = Larger(largest, together * integral);
    if (n == 0 && m == 0) middle = integral;
  };
  if (!ForEachWeight(r, opening, cancel, add)) return false;
  // Light that remains in its pixel, relative to the integrals. It reduces the variance
  // squares / total to the wanted variance.
  const double wanted = variance + Smaller(variance * kMore, kMostMore);
  const double stays = variance < kSmallVariance ? Larger(squares / wanted - total, 0) : 0;
  total += stays;
  largest = Larger(largest, middle + stays);
  while (psf->sum_bits < kMaxLightBits && largest / total * (2 << psf->sum_bits) < kMaxWeight - 8) {
    ++psf->sum_bits;
  }
  const int32_t one = 1 << psf->sum_bits;
  double sum = 0;
  int32_t given = 0;
  const auto give = [&](int32_t n, int32_t m, int32_t points, double integral) {
    sum += points * integral + (n == 0 && m == 0 ? stays : 0);
    // The last value of `sum` differs from `total` only by rounding errors, so the last target is
    // `one`.
    const auto target = static_cast<int32_t>(sum / total * one + 0.5);
    const auto weight =
        static_cast<int32_t>(PortionOfPoints(target - given, points, opening.IsRing()));
    weights[psf->full ? (m + size) * (2 * size + 1) + n + size : n * (n + 1) / 2 + m] =
        static_cast<uint16_t>(Checked(ranges::kBlurWeight, weight));
    given += weight * points;
  };
  if (!ForEachWeight(r, opening, cancel, give)) return false;
  Checked(ranges::kRemainder, given - one);
  return true;
}

}  // namespace

int32_t PsfIndex(int32_t radius) {
  const int32_t fine = kFineSteps * kFineEnd;
  if (radius <= kFineEnd * kOne) return (radius * kFineSteps + kOne / 2) / kOne;
  int32_t octave = 0;
  while (radius >= (2 * kFineEnd * kOne) << octave) ++octave;
  const int32_t unit = ((kFineEnd * kOne) << octave) / kCoarseSteps;
  return fine + octave * kCoarseSteps + (radius + unit / 2) / unit - kCoarseSteps;
}

int32_t RadiusOfPsf(int32_t index) {
  const int32_t fine = kFineSteps * kFineEnd;
  if (index <= fine) return index * kOne / kFineSteps;
  const int32_t octave = (index - fine) / kCoarseSteps, rest = (index - fine) % kCoarseSteps;
  return ((kFineEnd * kOne) << octave) / kCoarseSteps * (kCoarseSteps + rest);
}

int32_t PsfBelow(int32_t radius) {
  const int32_t index = PsfIndex(radius);
  return RadiusOfPsf(index) > radius ? index - 1 : index;
}

int32_t PsfAbove(int32_t radius) {
  const int32_t index = PsfIndex(radius);
  return RadiusOfPsf(index) < radius ? index + 1 : index;
}

int32_t PsfCount(double max_blur) {
  return PsfIndex(static_cast<int32_t>(max_blur * kOne) + 1) + 1;
}

size_t BlurWeightCount(bool full, double max_blur) {
  size_t count = 0;
  for (int32_t index = 0; index < PsfCount(max_blur); ++index) {
    count += WeightsOf(full, LargestSizeOf(RadiusOfPsf(index)));
  }
  return count;
}

int32_t MakePsfs(int32_t first, int32_t last, const ApertureShape& opening, CancelToken* cancel,
                 uint16_t* weights, Psf* psfs) {
  const double mean_square = static_cast<double>(MeanSquare(opening)) / kOpeningOne;
  for (int32_t index = 0; index < last; ++index) {
    if (index >= first &&
        !MakePsf(RadiusOfPsf(index), mean_square, opening, cancel, weights, &psfs[index])) {
      return index;
    }
    weights += WeightsOf(psfs[index].full, psfs[index].size);
  }
  return last;
}

}  // namespace starfocus
