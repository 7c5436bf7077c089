// SPDX-License-Identifier: Apache-2.0
#include "lib/io/output.h"

#include <cstring>

#include "lib/base/fixed.h"
#include "lib/io/deep.h"
#include "simd/words.h"

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
  if (!HasRowPairs(out.image.format) || lower >= rows.last) return;
  const uint8_t* const above = upper < rows.first ? out.odd_row : PixelsOf(out, from, upper);
  WriteChroma(*out.kernels, above, PixelsOf(out, from, lower), out.rect.width, upper, out.image);
}

}  // namespace

void CopyColumns(const Output& out, const Plane<uint8_t>& from, int32_t y, int32_t first,
                 int32_t last) {
  if (first >= last) return;
  std::memcpy(out.image.Pixel(first - out.rect.x, y - out.rect.y),
              from.Row(y) + 3 * static_cast<size_t>(first), 3 * static_cast<size_t>(last - first));
}

namespace {

starfocus_status StoreCodes(const Output& out, const Range& rows, const Plane<uint8_t>& from,
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

// Stores rows `part` of those rows of the picture that are in `inside`, in an image of a deep
// format. The chroma of a pair of rows is written together with its lower row.
void StoreDeepRows(const Output& out, const PictureRows& from, const Range& inside,
                   const Range& part) {
  const Rect& rect = out.rect;
  const auto row = [&](int32_t at) {
    return from.deep.Row(rect.y + at) + 3 * static_cast<ptrdiff_t>(rect.x);
  };
  const bool pairs = HasRowPairs(out.image.format);
  for (int32_t y = part.first, last; y < part.last; y = last) {
    last = y + 1;
    if (!out.image.is_yuv) {
      const DeepRow here = {row(y), from.alpha.Row(rect.y + y) + rect.x};
      WriteDeep(*out.tables, here, rect.width, y, out.image);
      continue;
    }
    const int32_t upper = pairs ? y - y % 2 : y;
    if (pairs && y == upper && last < part.last) ++last;
    const bool is_alone = !pairs || upper + 1 == rect.height;
    const uint16_t* rows[2] = {
        upper < inside.first ? reinterpret_cast<const uint16_t*>(out.odd_row) : row(upper),
        is_alone           ? row(upper)
        : last > upper + 1 ? row(upper + 1)
                           : nullptr};
    WriteDeepYuv(*out.tables, rows, {y, last}, rect.width, upper, out.image);
  }
}

// Converts deep rows to codes, with their alpha if the output has alpha.
void Dither(const Output& out, const Range& rows, const PictureRows& from) {
  constexpr auto kColumns = static_cast<int32_t>(simd::kDitherColumns);
  const Rect& rect = out.rect;
  // Groups of columns are converted as a whole, so that regions get the codes of the whole picture.
  const int32_t first = rect.x / kColumns * kColumns;
  const int32_t width = static_cast<int32_t>(out.dithered.stride) / 3;
  const int32_t last = Min(width, (rect.x + rect.width + kColumns - 1) / kColumns * kColumns);
  for (int32_t y = rows.first; y < rows.last; ++y) {
    const uint16_t* const alpha = from.alpha.Row(y);
    DitherRow(*out.tables, {from.deep.Row(y) + 3 * static_cast<ptrdiff_t>(first), alpha + first}, y,
              last - first, out.image.has_alpha,
              out.dithered.Row(y) + 3 * static_cast<ptrdiff_t>(first));
    uint8_t* const to = out.dithered_alpha.Row(y);
    for (int32_t x = rect.x; out.image.has_alpha && x < rect.x + rect.width; ++x) {
      to[x] = static_cast<uint8_t>((alpha[x] + (1 << kLightBits >> 1)) >> kLightBits);
    }
  }
}

}  // namespace

starfocus_status StoreRows(const Output& given, const Range& rows, const PictureRows& from,
                           int32_t most_jobs, Jobs* jobs) {
  if (!from.is_deep()) return StoreCodes(given, rows, from.codes, most_jobs, jobs);
  Output out = given;
  out.dithered.first = out.dithered_alpha.first = rows.first;
  out.alpha = {out.dithered_alpha.data, out.dithered_alpha.stride, 0, rows.first};
  out.alpha_step = 1;
  const int32_t count = Min(most_jobs, rows.count());
  const Range inside = {rows.first - out.rect.y, rows.last - out.rect.y};
  const bool is_deep = IsDeep(out.image.format);
  const starfocus_status status = ForEach(count, jobs, [&](int32_t index, int32_t) {
    const Range part = PartOf(is_deep ? inside : rows, index, count);
    if (!is_deep) return Dither(out, part, from);
    StoreDeepRows(out, from, inside, part);
  });
  if (!is_deep && status == STARFOCUS_OK) {
    return StoreCodes(out, rows, out.dithered, most_jobs, jobs);
  }
  if (is_deep && HasRowPairs(out.image.format) && inside.last % 2 != 0 &&
      inside.last < out.rect.height) {
    std::memcpy(out.odd_row, from.deep.Row(rows.last - 1) + 3 * static_cast<ptrdiff_t>(out.rect.x),
                6 * static_cast<size_t>(out.rect.width));
  }
  return status;
}

}  // namespace starfocus
