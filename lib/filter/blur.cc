// SPDX-License-Identifier: Apache-2.0
#include "lib/filter/blur.h"

#include <cmath>
#include <cstring>

namespace starfocus {
namespace {

constexpr int32_t kOne = 1 << kDisparityBits;
constexpr int32_t kFineSteps = 8;     // per pixel
constexpr int32_t kFineEnd = 4;       // pixels
constexpr int32_t kCoarseSteps = 32;  // per octave's start
double Smaller(double a, double b) { return a < b ? a : b; }
double Larger(double a, double b) { return a > b ? a : b; }

// Lines of a pixel, and points of a line, that integrate (4). Kernels of few pixels have more.
constexpr int32_t LinesOf(int32_t radius) { return radius <= kFineEnd * kOne ? 16 : 8; }
constexpr int32_t kPoints = 8;

// Radius of a step in 1 / kOne pixels.
int32_t RadiusOfStep(int32_t step) {
  const int32_t fine = kFineSteps * kFineEnd;
  if (step <= fine) return step * kOne / kFineSteps;
  const int32_t octave = (step - fine) / kCoarseSteps, rest = (step - fine) % kCoarseSteps;
  return ((kFineEnd * kOne) << octave) / kCoarseSteps * (kCoarseSteps + rest);
}

int32_t SizeOfStep(int32_t step) {
  return step == 0 ? 0 : (RadiusOfStep(step) + kOne / 2 + kOne - 1) / kOne;
}

// Returns the integral of (3) over the pixel (n, m), relative, for a radius in 1 / kOne pixels. By
// the midpoint rule along lines that end where the disc does: points of a square grid, each inside
// or outside, are wrong by up to 1.6 gray levels where the aperture ends without having fallen off.
// The arithmetic and the square root are IEEE's, and so the same everywhere.
double PixelIntegral(int32_t n, int32_t m, int32_t radius, double fall_off) {
  const double r = static_cast<double>(radius) / kOne, square = r * r;
  const double low = Larger(m - 0.5, -r), high = Smaller(m + 0.5, r);
  if (low >= high) return 0;
  const int32_t lines = LinesOf(radius);
  double sum = 0;
  for (int32_t line = 0; line < lines; ++line) {
    const double y = low + (line + 0.5) / lines * (high - low), rim = std::sqrt(square - y * y);
    const double from = Larger(n - 0.5, -rim), to = Smaller(n + 0.5, rim);
    if (from >= to) continue;
    double along = 0;
    for (int32_t point = 0; point < kPoints; ++point) {
      const double x = from + (point + 0.5) / kPoints * (to - from);
      const double ratio = fall_off / ((x * x + y * y) / square + fall_off);
      along += ratio * ratio;
    }
    sum += along * (to - from);
  }
  return sum * (high - low) / lines;
}

int32_t OrbitOf(int32_t n, int32_t m) {
  if (n == 0) return 1;
  return m == 0 || m == n ? 4 : 8;
}

// Calls visit(n, m, integral of (4)) for 0 <= m <= n <= size, the centre last.
template <class Visit>
void ForEachOrbit(int32_t step, double fall_off, const Visit& visit) {
  const int32_t radius = RadiusOfStep(step);
  for (int32_t n = SizeOfStep(step); n >= 0; --n) {
    for (int32_t m = n; m >= 0; --m) visit(n, m, PixelIntegral(n, m, radius, fall_off));
  }
}

// Every orbit takes up the rounding of those before it and the centre the rest, as in MakeAperture.
void MakeKernel(int32_t step, double fall_off, uint16_t* weights, BlurKernel* kernel) {
  kernel->size = SizeOfStep(step);
  kernel->weights = weights;
  kernel->sum_bits = 14;
  if (step == 0) {
    weights[0] = 1 << 14;
    return;
  }
  double total = 0, largest = 0;
  ForEachOrbit(step, fall_off, [&](int32_t n, int32_t m, double integral) {
    total += OrbitOf(n, m) * integral;
    largest = integral;  // the centre comes last
  });
  while (kernel->sum_bits < kMaxWeightBits &&
         largest / total * (2 << kernel->sum_bits) < kMaxWeight - 8) {
    ++kernel->sum_bits;
  }
  const int32_t one = 1 << kernel->sum_bits;
  double wanted = 0;
  int32_t given = 0;
  ForEachOrbit(step, fall_off, [&](int32_t n, int32_t m, double integral) {
    const int32_t orbit = OrbitOf(n, m);
    wanted += orbit * integral;
    const auto target = n == 0 ? one : static_cast<int32_t>(wanted / total * one + 0.5);
    const int32_t weight = Max(0, (target - given + orbit / 2) / orbit);
    weights[n * (n + 1) / 2 + m] = static_cast<uint16_t>(Checked(ranges::kBlurWeight, weight));
    given += weight * orbit;
  });
  Checked(ranges::kRemainder, given - one);
}

// Copies the extended rectangle and repeats the picture's edge around it.
void LoadPixels(const BlurJob& job, uint8_t* rgb) {
  const int32_t width = job.rect.width + 2 * job.border;
  const Window& window = *job.window;
  if (window.reads != nullptr) {
    window.reads->centre_pixels +=
        static_cast<uint64_t>(width) * static_cast<uint64_t>(job.rect.height + 2 * job.border);
  }
  for (int32_t row = 0; row < job.rect.height + 2 * job.border; ++row) {
    const uint8_t* from =
        window.centre.Row(Clamp(job.rect.y - job.border + row, 0, window.height - 1));
    uint8_t* to = rgb + 3 * static_cast<size_t>(row) * width;
    for (int32_t column = 0; column < width; ++column) {
      const int32_t x = Clamp(job.rect.x - job.border + column, 0, window.width - 1);
      std::memcpy(to + 3 * column, from + 3 * x, 3);
    }
  }
}

// Adds a kernel over `count` pixels of one radius; two weights side by side go in one span.
void AddRun(const BlurKernel& kernel, const uint8_t* at, size_t stride, int32_t count,
            SpanList* list) {
  const uint32_t samples = 3 * static_cast<uint32_t>(count);
  for (int32_t m = -kernel.size; m <= kernel.size; ++m) {
    const uint8_t* row = at + static_cast<ptrdiff_t>(m) * static_cast<ptrdiff_t>(stride);
    for (int32_t n = -kernel.size; n <= kernel.size; n += 2) {
      const uint32_t weight = kernel.Weight(n, m);
      const uint32_t next = n < kernel.size ? kernel.Weight(n + 1, m) : 0;
      if (weight + next == 0) continue;
      list->Add({row + 3 * static_cast<ptrdiff_t>(n), 0, samples, static_cast<uint16_t>(weight),
                 static_cast<uint16_t>(next), 3});
    }
  }
}

}  // namespace

int32_t BlurStep(int32_t radius) {
  const int32_t fine = kFineSteps * kFineEnd;
  if (radius <= kFineEnd * kOne) return (radius * kFineSteps + kOne / 2) / kOne;
  int32_t octave = 0;
  while (radius >= (2 * kFineEnd * kOne) << octave) ++octave;
  const int32_t unit = ((kFineEnd * kOne) << octave) / kCoarseSteps;
  return fine + octave * kCoarseSteps + (radius + unit / 2) / unit - kCoarseSteps;
}

int32_t BlurStepCount(double max_blur) {
  return BlurStep(static_cast<int32_t>(max_blur * kOne) + 1) + 1;
}

size_t BlurWeightCount(double max_blur) {
  size_t count = 0;
  for (int32_t step = 0; step < BlurStepCount(max_blur); ++step) {
    const auto size = static_cast<size_t>(SizeOfStep(step));
    count += (size + 1) * (size + 2) / 2;
  }
  return count;
}

void MakeBlurKernels(int32_t first, int32_t last, uint32_t fall_off, uint16_t* weights,
                     BlurKernel* kernels) {
  for (int32_t step = 0; step < last; ++step) {
    if (step >= first) MakeKernel(step, fall_off / 65536.0, weights, &kernels[step]);
    const auto size = static_cast<size_t>(kernels[step].size);
    weights += (size + 1) * (size + 2) / 2;
  }
}

void BlurRectangle(const BlurJob& job, const BlurScratch& scratch, uint8_t* out,
                   size_t out_stride) {
  LoadPixels(job, scratch.rgb);
  const Rect& rect = job.rect;
  const size_t stride = 3 * static_cast<size_t>(rect.width + 2 * job.border);
  SpanList list(*job.kernels, scratch.spans, scratch.accumulators);
  for (int32_t y = 0; y < rect.height; ++y, out += out_stride) {
    const int16_t* disparity = job.window->disparity.Row(rect.y + y) + rect.x;
    const uint8_t* row = scratch.rgb + static_cast<size_t>(y + job.border) * stride +
                         3 * static_cast<size_t>(job.border);
    const auto step_at = [&](int32_t x) {
      return BlurStep(job.scale.Radius(Abs(disparity[x] - job.scale.focus)));
    };
    for (int32_t x = 0; x < rect.width;) {
      const int32_t begin = x, step = step_at(x);
      while (++x < rect.width && step_at(x) == step) {
      }
      const BlurKernel& kernel = job.kernels_of_radius[step];
      const size_t samples = 3 * static_cast<size_t>(x - begin);
      std::memset(scratch.accumulators, 0, samples * sizeof(uint32_t));
      AddRun(kernel, row + 3 * begin, stride, x - begin, &list);
      list.Flush();
      CheckSums(scratch.accumulators, samples, kernel.sum_bits);
      job.kernels->Finish(scratch.accumulators, samples, kernel.sum_bits, out + 3 * begin);
    }
  }
}

}  // namespace starfocus
