// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/reduced.h"

#include "lib/base/features.h"
#include "lib/base/fixed.h"
#include "lib/engine/jobs.h"
#include "lib/matting/passes.h"

namespace starfocus {
namespace {

// Arguments of jobs that reduce rows. Each job reduces the rows of one column of superblocks.
struct ReduceJob {
  const EngineState* engine;
  Plane<int16_t> disparity;
  Range rows;
  int32_t previews;
  const ReducedField* fields;
};

// Range of columns of the picture.
struct ColumnPart {
  int32_t x, width;
};

void AddLight(const int16_t* light, size_t samples, bool is_first, uint32_t* sums) {
  if (is_first) {
    for (size_t n = 0; n < samples; ++n) sums[n] = static_cast<uint32_t>(light[n]);
  } else {
    for (size_t n = 0; n < samples; ++n) sums[n] += static_cast<uint32_t>(light[n]);
  }
}

// Reduces the columns `part` of a view to all sizes of previews. Returns false after cancellation.
bool ReduceView(const ReduceJob& job, int view, const ColumnPart& part, Scratch* scratch) {
  const EngineState& engine = *job.engine;
  const simd::Encoding& encoding = engine.input.transfer->encoding;
  const size_t samples = 3 * static_cast<size_t>(part.width);
  int16_t* const light = scratch->picture_samples;
  int16_t* const mean = light + 6 * engine.config.superblock;
  for (int32_t y = job.rows.first; y < job.rows.last; ++y) {
    if (!scratch->cancel.Spend(static_cast<int64_t>(samples) * (1 + job.previews))) return false;
    engine.input.Light(view, part.x, y, part.width, light);
    for (int shift = 1; shift <= job.previews; ++shift) {
      uint32_t* const sums = scratch->sums + 3 * shift * engine.config.superblock;
      const int32_t row = y & ((1 << shift) - 1);
      AddLight(light, samples, row == 0, sums);
      if (row + 1 < 1 << shift && y + 1 < engine.config.height) continue;
      MeanOfBlocks(sums, part.width, row + 1, shift, mean);
      engine.kernels->Encode(mean, 3 * static_cast<size_t>(ReducedSize(part.width, shift)),
                             encoding,
                             job.fields[shift].views[view].Row(y >> shift) + 3 * (part.x >> shift));
    }
  }
  return true;
}

// Converts an end of the disparity range to fixed point (kDisparityBits).
int16_t ConvertedEnd(const EngineState& engine, float end) {
  int16_t converted = 0;
  engine.kernels->ConvertDisparity(&end, 1, end, end, &converted);
  return converted;
}

// Reduces the columns `part` of the map to 1/2^shift of its size. Returns false after cancellation.
bool ReduceMap(const ReduceJob& job, int shift, const ColumnPart& part, Scratch* scratch) {
  const starfocus_config reduced = ReducedConfig(job.engine->config, shift);
  // A rounded disparity may exceed the disparity range by one unit of fixed point, so the result is
  // clamped.
  const int16_t low = ConvertedEnd(*job.engine, MinDisparity(reduced));
  const int16_t high = ConvertedEnd(*job.engine, MaxDisparity(reduced));
  const int32_t side = 1 << shift;
  for (int32_t y = job.rows.first; y < job.rows.last; y += side) {
    if (!scratch->cancel.Spend(int64_t{4} * side * part.width)) return false;
    int16_t* const out = job.fields[shift].disparity.Row(y >> shift);
    for (int32_t x = part.x; x < part.x + part.width; x += side) {
      int16_t values[1 << (2 * kMaxReduction)];
      int32_t count = 0;
      for (int32_t row = y; row < Min(y + side, job.rows.last); ++row) {
        const int16_t* from = job.disparity.Row(row);
        for (int32_t k = x; k < Min(x + side, part.x + part.width); ++k) values[count++] = from[k];
      }
      const int16_t median = ReducedDisparity(MedianOf(values, count), shift);
      out[x >> shift] = median < low ? low : median > high ? high : median;
    }
  }
  return true;
}

// Reduces the columns `part` of the coverage to 1/2^shift of its size. Returns false after
// cancellation.
bool ReduceCoverage(const ReduceJob& job, int shift, const ColumnPart& part, Scratch* scratch) {
  const Plane<const uint8_t>& given = job.engine->input.given_coverage;
  const Plane<uint8_t>& coverage = job.fields[shift].coverage;
  if (given.data == nullptr || coverage.data == nullptr) return true;
  const int32_t side = 1 << shift;
  for (int32_t y = job.rows.first; y < job.rows.last; y += side) {
    if (!scratch->cancel.Spend(int64_t{side} * part.width)) return false;
    for (int32_t x = part.x; x < part.x + part.width; x += side) {
      int32_t sum = 0, count = 0;
      for (int32_t row = y; row < Min(y + side, job.rows.last); ++row) {
        for (int32_t k = x; k < Min(x + side, part.x + part.width); ++k, ++count) {
          sum += given.Row(row)[k];
        }
      }
      coverage.Row(y >> shift)[x >> shift] = static_cast<uint8_t>((sum + count / 2) / count);
    }
  }
  return true;
}

void ReduceColumn(const ReduceJob& job, int32_t index, Scratch* scratch) {
  const starfocus_config& config = job.engine->config;
  const int32_t x = index * config.superblock;
  const ColumnPart part = {x, Min(config.superblock, config.width - x)};
  for (int view = 0; view < config.views; ++view) {
    if (!ReduceView(job, view, part, scratch)) return;
  }
  for (int shift = 1; shift <= job.previews; ++shift) {
    if (!ReduceMap(job, shift, part, scratch)) return;
    if (!ReduceCoverage(job, shift, part, scratch)) return;
  }
}

}  // namespace

starfocus_config ReducedConfig(const starfocus_config& config, int shift) {
  starfocus_config reduced = config;
  const double side = 1 << shift;
  reduced.width = ReducedSize(config.width, shift);
  reduced.height = ReducedSize(config.height, shift);
  reduced.disparity_min = config.disparity_min / side;
  reduced.disparity_max = config.disparity_max / side;
  reduced.features &= ~STARFOCUS_FEATURE_STREAMING;
  reduced.previews = 0;
  return reduced;
}

void TakeReduced(const starfocus_config& config, int shift, Arena* arena, ReducedField* field) {
  const auto width = static_cast<size_t>(ReducedSize(config.width, shift));
  const auto height = static_cast<size_t>(ReducedSize(config.height, shift));
  for (int view = 0; view < config.views; ++view) {
    field->views[view].stride = 3 * width;
    field->views[view].data = arena->Take<uint8_t>(3 * width, height);
  }
  field->disparity.stride = width;
  field->disparity.data = arena->Take<int16_t>(width, height);
  if (!Has(config, STARFOCUS_FEATURE_COVERAGE)) return;
  field->coverage.stride = width;
  field->coverage.data = arena->Take<uint8_t>(width, height);
}

starfocus_status ReduceRows(const Plane<int16_t>& disparity, const Range& rows, int32_t previews,
                            const ReducedField* fields, EngineState* engine) {
  if (previews == 0) return STARFOCUS_OK;
  const ReduceJob job = {engine, disparity, rows, previews, fields};
  return RunJobs<ReduceJob, ReduceColumn>(job, Columns(engine->config), engine);
}

}  // namespace starfocus
