// SPDX-License-Identifier: Apache-2.0
// Depth-dependent blur of the centre view.
#include <cstring>

#include "lib/gather/gather.h"
#include "lib/io/block_pixels.h"

namespace starfocus {
namespace {

// Copies the light of the extended rectangle, and repeats the edge pixels of the picture outside
// the picture.
void LoadPixels(const BlurJob& job, int16_t* rgb) {
  const int32_t width = job.rect.width + 2 * job.border;
  const Input& input = *job.input;
  for (int32_t row = 0; row < job.rect.height + 2 * job.border; ++row) {
    const int32_t y = Clamp(job.rect.y - job.border + row, 0, input.height - 1);
    int16_t* to = rgb + 3 * static_cast<size_t>(row) * width;
    const int32_t left = job.rect.x - job.border;
    const int32_t first = Clamp(-left, 0, width), last = Clamp(input.width - left, 0, width);
    LoadLight(input, 0, left + first, y, last - first, to + 3 * first);
    for (int32_t k = 0; k < 3 * first; ++k) to[k] = to[3 * first + k % 3];
    for (int32_t k = 3 * last; k < 3 * width; ++k) to[k] = to[k - 3];
  }
}

// Adds `count` pixels of the same radius to the sums, weighted by a PSF that is rotated by half a
// turn if `side` is -1. `at` is the first pixel, in rows `stride` samples apart. Each span uses two
// adjacent weights. kFull is Psf::full. `psf` is a copy, so that the compiler keeps its members in
// registers while the loops write spans.
template <bool kFull>
void AddPsf(const simd::Kernels& kernels, Psf psf, int32_t side, const int16_t* at, size_t stride,
            int32_t count, uint32_t* sums) {
  constexpr size_t kAtOnce = 64;
  const auto weight = [&](int32_t n, int32_t m) {
    return kFull ? psf.Weight(side * n, side * m) : psf.OctantWeight(n, m);
  };
  simd::Span spans[kAtOnce];
  size_t used = 0;
  for (int32_t m = -psf.size; m <= psf.size; ++m) {
    const int16_t* row = at + static_cast<ptrdiff_t>(m) * static_cast<ptrdiff_t>(stride);
    for (int32_t n = -psf.size; n <= psf.size; n += 2) {
      const uint32_t first = weight(n, m);
      const uint32_t next = n < psf.size ? weight(n + 1, m) : 0;
      if (first + next == 0) continue;
      if (used == kAtOnce) {
        kernels.Accumulate(spans, used, sums);
        used = 0;
      }
      simd::Span& span = spans[used++];
      span.source = row + 3 * static_cast<ptrdiff_t>(n);
      span.target = 0;
      span.samples = 3 * static_cast<uint32_t>(count);
      span.weight = static_cast<uint16_t>(first);
      span.neighbour_weight = static_cast<uint16_t>(next);
      span.neighbour_offset = 3;
    }
  }
  kernels.Accumulate(spans, used, sums);
}

}  // namespace

void BlurRectangle(const BlurJob& job, int16_t* rgb, uint32_t* accumulators,
                   const SumsOfRun& runs) {
  LoadPixels(job, rgb);
  const Rect& rect = job.rect;
  const size_t stride = 3 * static_cast<size_t>(rect.width + 2 * job.border);
  const bool turns = job.psfs_of_radius[0].full;
  const auto add_psf = turns ? AddPsf<true> : AddPsf<false>;
  for (int32_t y = 0; y < rect.height; ++y) {
    const int16_t* disparity = job.input->disparity.Row(rect.y + y) + rect.x;
    const int16_t* row =
        rgb + static_cast<size_t>(y + job.border) * stride + 3 * static_cast<size_t>(job.border);
    const auto step_at = [&](int32_t x) {
      return PsfIndex(job.scale.Radius(Abs(job.scale.focus.Distance(disparity[x]))));
    };
    const auto side_of = [&](int32_t x) {
      return turns && disparity[x] < job.scale.focus.far ? -1 : 1;
    };
    for (int32_t x = 0; x < rect.width;) {
      const int32_t begin = x, index = step_at(x), side = side_of(x);
      while (++x < rect.width && step_at(x) == index && side_of(x) == side) {
      }
      const Psf& psf = job.psfs_of_radius[index];
      const size_t samples = 3 * static_cast<size_t>(x - begin);
      const int64_t points = (2 * psf.size + 1) * (2 * psf.size + 1);
      if (!GoesOn(job.cancel, points * static_cast<int64_t>(samples))) return;
      std::memset(accumulators, 0, samples * sizeof(uint32_t));
      add_psf(*job.input->kernels, psf, side, row + 3 * begin, stride, x - begin, accumulators);
      runs.store(runs.data, accumulators, {rect.x + begin, rect.y + y, x - begin, 1},
                 psf.sum_bits + kLightBits);
    }
  }
}

}  // namespace starfocus
