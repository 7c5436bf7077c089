// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/prepared.h"

#include <new>

#include "lib/base/fixed.h"
#include "lib/engine/stripe.h"
#include "lib/io/deep.h"
#include "lib/optics/view_set.h"

namespace starfocus {
namespace {

// Computes the mean light of whole blocks. With a constant size, the compiler unrolls the loops and
// divides by shifts.
template <int kShift>
void MeanOfWhole(const uint32_t* sums, int32_t blocks, int16_t* light) {
  constexpr int kSide = 1 << kShift;
  for (int32_t n = 0; n < blocks; ++n, sums += 3 * kSide, light += 3) {
    uint32_t total[3] = {};
    for (int k = 0; k < kSide; ++k) {
      for (int c = 0; c < 3; ++c) total[c] += sums[3 * k + c];
    }
    for (int c = 0; c < 3; ++c) {
      light[c] = static_cast<int16_t>((total[c] + (1U << (2 * kShift - 1))) >> (2 * kShift));
    }
  }
}

// Computes the mean light of a block of pixels that is partly outside the picture.
void MeanOfPart(const uint32_t* sums, int32_t columns, int32_t rows, int16_t* light) {
  const uint32_t count = static_cast<uint32_t>(columns) * static_cast<uint32_t>(rows);
  for (int c = 0; c < 3; ++c) {
    uint32_t total = 0;
    for (int32_t k = 0; k < columns; ++k) total += sums[3 * k + c];
    light[c] = static_cast<int16_t>((2 * total + count) / (2 * count));
  }
}

// Computes the mean light of blocks of pixels, rounded half up. `sums` contains the sums of `rows`
// rows of light: one RGB sum for each of `columns` columns.
void MeanOfBlocks(const uint32_t* sums, int32_t columns, int32_t rows, int shift, int16_t* light) {
  static_assert(STARFOCUS_MAX_PREVIEW == 3, "MeanOfWhole is instantiated for each shift");
  const int32_t side = 1 << shift;
  int32_t whole = 0;
  if (rows == side) {
    whole = columns / side;
    if (shift == 1) MeanOfWhole<1>(sums, whole, light);
    if (shift == 2) MeanOfWhole<2>(sums, whole, light);
    if (shift == 3) MeanOfWhole<3>(sums, whole, light);
  }
  for (int32_t n = whole; n < ReducedSize(columns, shift); ++n) {
    MeanOfPart(sums + 3 * n * side, Min(side, columns - n * side), rows, light + 3 * n);
  }
}

// Returns the median of `count` values; `count` is at most 4^STARFOCUS_MAX_PREVIEW. For an even
// count, the median is the larger of the two middle values. The median of disparities therefore
// always lies on a surface, not between two surfaces.
int16_t MedianOf(const int16_t* values, int32_t count) {
  int16_t low = values[0], high = values[0];
  for (int32_t n = 1; n < count; ++n) {
    low = values[n] < low ? values[n] : low;
    high = values[n] > high ? values[n] : high;
  }
  // Bisection: the median is the smallest number that is at least as large as more than half of the
  // values. The median always stays in [low, high].
  while (low < high) {
    const auto middle = static_cast<int16_t>((low + high) >> 1);
    int32_t not_above = 0;
    for (int32_t n = 0; n < count; ++n) not_above += values[n] <= middle ? 1 : 0;
    if (not_above > count / 2) {
      high = middle;
    } else {
      low = static_cast<int16_t>(middle + 1);
    }
  }
  return low;
}

void AddLight(const int16_t* light, size_t samples, bool is_first, uint32_t* sums) {
  if (is_first) {
    for (size_t n = 0; n < samples; ++n) sums[n] = static_cast<uint32_t>(light[n]);
  } else {
    for (size_t n = 0; n < samples; ++n) sums[n] += static_cast<uint32_t>(light[n]);
  }
}

// The functions below reduce the pixels of `part`, the rows of a stripe in one column of
// superblocks, and return false after cancellation.

// Stores the means of blocks of a row of a view: of light, of excess in units of deep codes, and of
// alpha. The last two are null if the views are codes.
void StoreMeans(const Prepared& prepared, const EngineState& engine, int view, int shift,
                const Rect& part, int32_t y, const int16_t* const (&means)[kPassCount]) {
  const StoredViews& views = prepared.reduced[shift].views;
  const auto count = static_cast<size_t>(ReducedSize(part.width, shift));
  const ptrdiff_t x = part.x >> shift;
  if (!engine.input.is_deep()) {
    engine.kernels->Encode(means[kLightPass], 3 * count, *engine.input.transfer,
                           views.codes[view].Row(y >> shift) + 3 * x);
    return;
  }
  uint16_t* const rgb = views.deep[view].Row(y >> shift) + 3 * x;
  uint16_t* const alpha = views.deep_alpha[view].Row(y >> shift) + x;
  for (size_t n = 0; n < 3 * count; ++n) {
    const int32_t light = means[kLightPass][n] + (means[kExcessPass][n] << kExcessBits);
    rgb[n] = DeepOfLight(light);
    alpha[n / 3] = static_cast<uint16_t>(means[kAlphaPass][n]);
  }
}

// Reduces a view to all sizes of previews.
bool ReduceView(const Prepared& prepared, const EngineState& engine, int view, const Rect& part,
                Scratch* scratch) {
  const int32_t previews = prepared.config.previews, side = engine.config.superblock;
  const size_t samples = 3 * static_cast<size_t>(part.width);
  const bool deep = engine.input.is_deep();
  const int passes = deep ? kPassCount : 1;
  Input others[kPassCount];
  if (deep) {
    others[kExcessPass] = DeepExcessOf(engine.input, 0);
    others[kAlphaPass] = DeepAlphaOf(engine.input);
  }
  // All share the memory of a superblock. The space between them is larger than a row of light,
  // because Input::Light may write beyond the last sample.
  int16_t* const light = scratch->picture_samples;
  int16_t* means[kPassCount];
  for (int pass = 0; pass < kPassCount; ++pass) means[pass] = light + (pass + 2) * 3 * side;
  for (int32_t y = part.y; y < part.y + part.height; ++y) {
    if (!scratch->cancel.Spend(static_cast<int64_t>(samples) * passes * (1 + previews))) {
      return false;
    }
    for (int pass = 0; pass < passes; ++pass) {
      const Input& in = pass == kLightPass ? engine.input : others[pass];
      in.Light(view, part.x, y, part.width, light);
      for (int shift = 1; shift <= previews; ++shift) {
        // Each size and pass has its own row of sums, because it completes blocks after other rows.
        uint32_t* const sums = scratch->sums + 3 * (shift * kPassCount + pass) * side;
        AddLight(light, samples, (y & ((1 << shift) - 1)) == 0, sums);
      }
    }
    for (int shift = 1; shift <= previews; ++shift) {
      const int32_t row = y & ((1 << shift) - 1);
      if (row + 1 < 1 << shift && y + 1 < engine.config.height) continue;
      for (int pass = 0; pass < passes; ++pass) {
        MeanOfBlocks(scratch->sums + 3 * (shift * kPassCount + pass) * side, part.width, row + 1,
                     shift, means[pass]);
      }
      StoreMeans(prepared, engine, view, shift, part, y, means);
    }
  }
  return true;
}

// Calls reduce(x, y, right, bottom) for each square of 2^shift pixels, or its part inside `part`.
// `cost` is the work for a pixel (CancelToken::Spend). Returns false after cancellation.
template <class Reduce>
bool ForSquares(const Rect& part, int shift, int64_t cost, Scratch* scratch, const Reduce& reduce) {
  const int32_t side = 1 << shift, right = part.x + part.width, bottom = part.y + part.height;
  for (int32_t y = part.y; y < bottom; y += side) {
    if (!scratch->cancel.Spend(cost * side * part.width)) return false;
    for (int32_t x = part.x; x < right; x += side) {
      reduce(x, y, Min(x + side, right), Min(y + side, bottom));
    }
  }
  return true;
}

// Reduces the map to 1/2^shift of its size.
bool ReduceMap(const Prepared& prepared, const EngineState& engine, int shift, const Rect& part,
               Scratch* scratch) {
  const FullConfig reduced = ReducedConfig(engine.config, shift);
  const auto converted = [&](float end) {
    int16_t disparity = 0;
    engine.kernels->ConvertDisparity(&end, 1, end, end, &disparity);
    return disparity;
  };
  // A rounded disparity may exceed the disparity range by one unit of fixed point, so the result is
  // clamped.
  const int16_t low = converted(MinDisparity(reduced)), high = converted(MaxDisparity(reduced));
  const auto reduce = [&](int32_t x, int32_t y, int32_t right, int32_t bottom) {
    int16_t values[1 << (2 * STARFOCUS_MAX_PREVIEW)] = {};
    int32_t count = 0;
    for (int32_t row = y; row < bottom; ++row) {
      const int16_t* from = prepared.disparity.Row(row);
      for (int32_t k = x; k < right; ++k) values[count++] = from[k];
    }
    // Converted to pixels of the reduced picture, rounded half up.
    const int32_t median = (MedianOf(values, count) + (1 << shift >> 1)) >> shift;
    prepared.reduced[shift].disparity.Row(y >> shift)[x >> shift] =
        static_cast<int16_t>(Clamp(median, low, high));
  };
  // The bisection compares each value several times.
  return ForSquares(part, shift, 4, scratch, reduce);
}

// Reduces the coverage to 1/2^shift of its size.
bool ReduceCoverage(const Prepared& prepared, const EngineState& engine, int shift,
                    const Rect& part, Scratch* scratch) {
  const Plane<const uint8_t>& given = engine.input.given_coverage;
  const Plane<uint8_t>& coverage = prepared.reduced[shift].coverage;
  if (given.data == nullptr || coverage.data == nullptr) return true;
  const auto reduce = [&](int32_t x, int32_t y, int32_t right, int32_t bottom) {
    int32_t sum = 0;
    const int32_t count = (right - x) * (bottom - y);
    for (int32_t row = y; row < bottom; ++row) {
      for (int32_t k = x; k < right; ++k) sum += given.Row(row)[k];
    }
    coverage.Row(y >> shift)[x >> shift] = static_cast<uint8_t>((sum + count / 2) / count);
  };
  return ForSquares(part, shift, 1, scratch, reduce);
}

// Reduces the rows of a stripe of the engine's input to all sizes of previews.
starfocus_status ReduceRows(const Prepared& prepared, const Range& rows,
                            const EngineState& engine) {
  const FullConfig& config = engine.config;
  const int32_t previews = prepared.config.previews;
  if (previews == 0) return STARFOCUS_OK;
  return ForEach(Columns(config), engine.jobs, [&](int32_t column, int32_t worker) {
    const int32_t x = column * config.superblock;
    const Rect part = {x, rows.first, Min(config.superblock, config.width - x),
                       rows.last - rows.first};
    Scratch* const scratch = &engine.scratch[worker];
    for (int view = 0; view < config.views; ++view) {
      if (!ReduceView(prepared, engine, view, part, scratch)) return;
    }
    for (int shift = 1; shift <= previews; ++shift) {
      if (!ReduceMap(prepared, engine, shift, part, scratch)) return;
      if (!ReduceCoverage(prepared, engine, shift, part, scratch)) return;
    }
  });
}

}  // namespace

Rect ReducedRect(const Rect& rect, int shift) {
  const int32_t x = rect.x >> shift, y = rect.y >> shift;
  return {x, y, ReducedSize(rect.x + rect.width, shift) - x,
          ReducedSize(rect.y + rect.height, shift) - y};
}

FullConfig ReducedConfig(const FullConfig& config, int shift) {
  FullConfig reduced = config;
  const double side = 1 << shift;
  reduced.width = ReducedSize(config.width, shift);
  reduced.height = ReducedSize(config.height, shift);
  reduced.disparity_min = config.disparity_min / side;
  reduced.disparity_max = config.disparity_max / side;
  reduced.features &= ~STARFOCUS_FEATURE_STREAMING;
  reduced.previews = 0;
  return reduced;
}

namespace {

void TakeReduced(const FullConfig& config, int shift, Arena* arena, ReducedField* field) {
  const auto width = static_cast<size_t>(ReducedSize(config.width, shift));
  const int32_t height = ReducedSize(config.height, shift);
  for (int view = 0; view < config.views; ++view) {
    if (HasDeep(config)) {
      field->views.deep[view] = TakePlane<uint16_t>(3 * width, height, arena);
      field->views.deep_alpha[view] = TakePlane<uint16_t>(width, height, arena);
    } else {
      field->views.codes[view] = TakePlane<uint8_t>(3 * width, height, arena);
    }
  }
  field->disparity = TakePlane<int16_t>(width, height, arena);
  if (!Has(config, STARFOCUS_FEATURE_COVERAGE)) return;
  field->coverage = TakePlane<uint8_t>(width, height, arena);
}

// Number of rows of the picture that the filter of layer 1 reads below a stripe. Images are read in
// pairs of rows.
constexpr int32_t kRowsBelow = kDownBorder - 1;
static_assert(kRowsBelow % 2 == 0);

// Largest number of pixels of the picture by which a layer extends beyond the picture (LayerSize).
// For each 4 pixels of the picture, layers 1 and 2 grow by 2 pixels and 1 pixel.
constexpr int32_t Overhang(int32_t size, int32_t layer) {
  return (LayerSize(size, layer) << layer) - size;
}
constexpr int32_t kMostOverhang = Overhang(3, 2);
static_assert(Overhang(1, 1) <= kMostOverhang && Overhang(2, 1) <= kMostOverhang &&
              Overhang(1, 2) <= kMostOverhang && Overhang(2, 2) <= kMostOverhang &&
              Overhang(4, 2) <= kMostOverhang);

// Computes the rows of layer 1 of a stripe from the picture, and the rows of layer 2 whose source
// rows are complete. `two` are the rows of layer 2 of the previous stripe, and are replaced by the
// rows of this stripe. Computing layer 2 from layer 1 halves the number of codes that are decoded.
starfocus_status MakeLayers(const Prepared& prepared, const Range& rows, Range* two,
                            EngineState* engine) {
  // The last stripe includes the rows beyond the picture. PlaceLayers omits rows outside the
  // layers.
  const FullConfig& config = engine->config;
  const bool is_last = rows.last == config.height;
  StripeLayers* const store = &engine->layers;
  const int32_t most = config.tuning.max_layer;
  ForgetLayers(config, store);
  MarkLayerColumns(config, store);
  PlaceLayers({rows.first, is_last ? config.height + kMostOverhang : rows.last}, Borders(), engine);
  for (int layer = 1; layer <= most; ++layer) {
    store->planes[layer].samples = prepared.layers[layer];
  }
  LayerPlane& second = store->planes[2];
  const LayerPlane& first = store->planes[1];
  const starfocus_status status = FillLayers({1, 2}, nullptr, engine);
  // Row y of layer 2 depends on the rows of layer 1 before 2 * y + 4.
  *two = {two->last, is_last ? second.height : Max(two->last, first.rows.last / 2 - 1)};
  second.rows = *two;
  if (status != STARFOCUS_OK || most < 2) return status;
  return FillLayers({2, 3}, &first, engine);
}

// Converts the map and computes the layers and reduced light fields into the planes of `prepared`.
// `maker` is a copy of the engine, whose layers are those of `prepared`.
starfocus_status MakePlanes(const Prepared& prepared, EngineState maker) {
  const int32_t height = maker.config.height;
  Range two = {0, 0};
  return ForStripes({0, height}, kRowsBelow, height, maker.config,
                    [&](int32_t y, const Range& read) {
                      maker.jobs->call_progress.SetRows(y);
                      const Range rows = {y, Min(y + maker.config.superblock, height)};
                      starfocus_status status = ReadRows(read, &prepared.disparity, &maker);
                      if (status == STARFOCUS_OK) status = MakeLayers(prepared, rows, &two, &maker);
                      return status == STARFOCUS_OK ? ReduceRows(prepared, rows, maker) : status;
                    });
}

}  // namespace

size_t LayOutPrepared(const FullConfig& config, void* base, Prepared** prepared) {
  Arena arena(base);
  *prepared = arena.Take<Prepared>(1);
  Prepared counted;  // used instead of **prepared if `base` is null
  Prepared& p = *prepared == nullptr ? counted : *new (*prepared) Prepared();
  p.config = config;
  p.config.problem = nullptr;
  p.disparity = TakePlane<int16_t>(static_cast<size_t>(config.width), config.height, &arena);
  for (int layer = 1; layer <= config.tuning.max_layer; ++layer) {
    p.layers[layer] = TakePlane<int16_t>(3 * static_cast<size_t>(LayerSize(config.width, layer)),
                                         LayerSize(config.height, layer), &arena);
  }
  for (int shift = 1; shift <= config.previews; ++shift) {
    TakeReduced(config, shift, &arena, &p.reduced[shift]);
  }
  return p.bytes = arena.Bytes();
}

starfocus_status Prepare(void* memory, EngineState* engine, Prepared** prepared) {
  const int32_t height = engine->config.height;
  CallProgress& call_progress = engine->jobs->call_progress;
  engine->stream.active = false;
  call_progress.Begin(0, height);
  starfocus_status status = ReadRows({0, height}, nullptr, engine);
  if (status != STARFOCUS_OK) return status;
  Prepared* made = nullptr;
  LayOutPrepared(engine->config, memory, &made);
  made->covers = engine->input.given_coverage.data != nullptr;
  made->has_alpha = engine->input.has_alpha;
  status = MakePlanes(*made, *engine);
  ForgetLayers(engine->config, &engine->layers);
  if (status != STARFOCUS_OK) return status;
  call_progress.SetRows(height);
  if (!call_progress.Ask()) return STARFOCUS_ERROR_CANCELLED;
  *prepared = made;
  return STARFOCUS_OK;
}

bool Fits(const Prepared& prepared, const FullConfig& config) {
  const FullConfig& made = prepared.config;
  return made.width == config.width && made.height == config.height && SameViews(made, config) &&
         made.disparity_min == config.disparity_min && made.disparity_max == config.disparity_max &&
         made.tuning.max_layer == config.tuning.max_layer && made.transfer == config.transfer &&
         HasDeep(made) == HasDeep(config);
}

Extent PreparedMemory(const Prepared& prepared) {
  return ExtentOf(&prepared, 0, 1, prepared.bytes);
}

void UsePrepared(const Prepared& prepared, Input* in) {
  in->map = {};
  in->disparity = {prepared.disparity.data, prepared.disparity.stride, 0, 0};
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    in->layers[layer] = {prepared.layers[layer].data, prepared.layers[layer].stride, 0, 0};
  }
  in->has_layers = true;
}

}  // namespace starfocus
