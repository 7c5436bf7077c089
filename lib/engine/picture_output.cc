// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/picture_output.h"

#include <cstring>

#include "lib/base/fixed.h"
#include "lib/engine/jobs.h"
#include "lib/io/rows.h"

namespace starfocus {
namespace {

// Converts pairs of rows of the image. PartOf divides the row pairs into one range for each job,
// and job `index` converts range `index`.
struct PairsJob {
  const PictureOutput* out;
  Plane<uint8_t> from;
  const uint8_t* odd_row;  // Upper row of a pair that an earlier call started.
  Range rows;              // Rows of the image to write.
  int32_t jobs;
};

const uint8_t* RowOf(const PairsJob& job, int32_t y) {
  if (y < job.rows.first) return job.odd_row;
  const Rect& rect = job.out->rect;
  return job.from.Row(rect.y + y) + 3 * static_cast<size_t>(rect.x);
}

void WritePair(const PairsJob& job, int32_t upper) {
  const PictureOutput& out = *job.out;
  const Range rows = {Max(upper, job.rows.first), Min(upper + 2, job.rows.last)};
  for (int32_t y = rows.first; y < rows.last; ++y) {
    WriteCodes(*out.kernels, RowOf(job, y), out.rect.width, y, out.image);
    if (out.image.has_alpha && out.alpha.rows.data != nullptr) {
      CopyAlpha(out.alpha, out.rect.x, out.rect.y + y, out.rect.width, y, out.image);
    }
  }
  const int32_t lower = Min(upper + 1, out.rect.height - 1);
  if (!out.image.is_yuv || lower >= rows.last) return;
  WriteChroma(*out.kernels, RowOf(job, upper), RowOf(job, lower), out.rect.width, upper, out.image);
}

void WritePairs(const PairsJob& job, int32_t index, Scratch* scratch) {
  const Range pairs = PartOf({job.rows.first / 2, (job.rows.last + 1) / 2}, index, job.jobs);
  for (int32_t pair = pairs.first; pair < pairs.last; ++pair) {
    if (!scratch->cancel.Spend(6 * int64_t{job.out->rect.width})) return;
    WritePair(job, 2 * pair);
  }
}

// Copies columns [first, last) of row y to the output image.
void CopyColumns(const PictureOutput& out, const Plane<uint8_t>& from, int32_t y, int32_t first,
                 int32_t last) {
  if (first >= last) return;
  std::memcpy(out.image.Pixel(first - out.rect.x, y - out.rect.y),
              from.Row(y) + 3 * static_cast<size_t>(first), 3 * static_cast<size_t>(last - first));
}

// Copies row y to the output image. If a previous picture exists, copies the row of the previous
// picture and overwrites the changed columns.
void StoreRow(const PictureOutput& out, const Plane<uint8_t>& from, int32_t y,
              const EngineState& engine) {
  const Rect& rect = out.rect;
  if (out.previous == nullptr) {
    CopyColumns(out, from, y, rect.x, rect.x + rect.width);
    return;
  }
  std::memcpy(out.image.Pixel(0, y - rect.y), RowsOf(*out.previous, rect.y).Row(y),
              3 * static_cast<size_t>(rect.width));
  const int32_t side = engine.config.superblock, reach = engine.lens.borders.joined;
  for (int32_t column = 0; column < Columns(engine.config); ++column) {
    const int32_t x = column * side;
    if (!HasChanged(engine.stripe.changes, {x, y - reach, side, 1 + 2 * reach})) continue;
    CopyColumns(out, from, y, Max(x - reach, rect.x), Min(x + side + reach, rect.x + rect.width));
  }
}

starfocus_status Store(const void* self, const Range& rows, const Plane<uint8_t>& from,
                       EngineState* engine) {
  const auto& out = *static_cast<const PictureOutput*>(self);
  if (out.image.IsPacked()) {
    for (int32_t y = rows.first; y < rows.last; ++y) StoreRow(out, from, y, *engine);
    return STARFOCUS_OK;
  }
  const Range inside = {rows.first - out.rect.y, rows.last - out.rect.y};
  const int32_t pairs = (inside.last + 1) / 2 - inside.first / 2;
  const int32_t jobs = Min(MaxJobs(engine->config), pairs);
  const PairsJob job = {&out, from, engine->images.odd_row, inside, jobs};
  const starfocus_status status = RunJobs<PairsJob, WritePairs>(job, jobs, engine);
  if (out.image.is_yuv && inside.last % 2 != 0 && inside.last < out.rect.height) {
    std::memcpy(engine->images.odd_row, RowOf(job, inside.last - 1),
                3 * static_cast<size_t>(out.rect.width));
  }
  return status;
}

}  // namespace

RowSink SinkOf(const PictureOutput& out) { return {Store, &out}; }

}  // namespace starfocus
