// SPDX-License-Identifier: Apache-2.0
#include "lib/io/output.h"

#include <cstring>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

const uint8_t* PixelsOf(const Output& out, const Plane<uint8_t>& from, int32_t y) {
  return from.Row(out.rect.y + y) + 3 * static_cast<size_t>(out.rect.x);
}

// Writes row y of the image.
void WriteRow(const Output& out, const uint8_t* rgb, int32_t y) {
  WriteCodes(*out.kernels, rgb, out.rect.width, y, out.image);
  if (!out.image.has_alpha || out.alpha.data == nullptr) return;
  const uint8_t* const alpha =
      out.alpha.Row(out.rect.y + y) + static_cast<size_t>(out.rect.x) * out.alpha_step;
  uint8_t* const to = out.image.Pixel(0, y) + 3;
  for (size_t n = 0; n < static_cast<size_t>(out.rect.width); ++n) {
    to[n * out.image.step] = alpha[n * out.alpha_step];
  }
}

// Writes those rows of the pair of rows `upper` and `upper` + 1 that are in `rows`. The chroma of a
// pair is written together with its lower row.
void WritePair(const Output& out, const Range& rows, const Plane<uint8_t>& from, int32_t upper) {
  for (int32_t y = Max(upper, rows.first); y < Min(upper + 2, rows.last); ++y) {
    WriteRow(out, PixelsOf(out, from, y), y);
  }
  const int32_t lower = Min(upper + 1, out.rect.height - 1);
  if (!out.image.is_yuv || lower >= rows.last) return;
  const uint8_t* const above = upper < rows.first ? out.odd_row : PixelsOf(out, from, upper);
  WriteChroma(*out.kernels, above, PixelsOf(out, from, lower), out.rect.width, upper, out.image);
}

}  // namespace

Output OutputOf(const starfocus_image& image, const Rect& rect, uint8_t* odd_row) {
  return {&simd::BestImageKernels(), PlanesOf<uint8_t>(image), rect, odd_row, {}, 1};
}

void CopyColumns(const Output& out, const Plane<uint8_t>& from, int32_t y, int32_t first,
                 int32_t last) {
  if (first >= last) return;
  std::memcpy(out.image.Pixel(first - out.rect.x, y - out.rect.y),
              from.Row(y) + 3 * static_cast<size_t>(first), 3 * static_cast<size_t>(last - first));
}

starfocus_status StoreRows(const Output& out, const Range& rows, const Plane<uint8_t>& from,
                           int32_t most_jobs, Jobs* jobs) {
  const Rect& rect = out.rect;
  if (out.image.IsPacked()) {
    for (int32_t y = rows.first; y < rows.last; ++y) {
      CopyColumns(out, from, y, rect.x, rect.x + rect.width);
    }
    return STARFOCUS_OK;
  }
  const Range inside = {rows.first - rect.y, rows.last - rect.y};
  const Range pairs = {inside.first / 2, (inside.last + 1) / 2};
  const int32_t count = Min(most_jobs, pairs.last - pairs.first);
  const starfocus_status status = ForEach(count, jobs, [&](int32_t index, int32_t) {
    const Range part = PartOf(pairs, index, count);
    for (int32_t pair = part.first; pair < part.last; ++pair) {
      WritePair(out, inside, from, 2 * pair);
    }
  });
  if (out.image.is_yuv && inside.last % 2 != 0 && inside.last < rect.height) {
    std::memcpy(out.odd_row, PixelsOf(out, from, inside.last - 1),
                3 * static_cast<size_t>(rect.width));
  }
  return status;
}

}  // namespace starfocus
