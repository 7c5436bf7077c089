// SPDX-License-Identifier: Apache-2.0
#include "lib/io/input.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>

#include "lib/base/config.h"
#include "lib/io/deep.h"
#include "lib/io/depth_map.h"
#include "lib/io/image.h"

namespace starfocus {
namespace {

// Largest number of pixels that are read at once into a buffer on the stack.
constexpr int32_t kMost = 72;

// Prefetches the row after the next one behind `codes`. Side views are read in short pieces, row by
// row. Hardware prefetchers do not predict the addresses of such short pieces. Prefetching saves 2
// to 4 % of the time on scenes with 5 views, also for deep pictures (ReadImageRow).
void Prefetch(const Input& in, int view, const uint8_t* codes) {
  if (view > 0) __builtin_prefetch(codes + 2 * in.images[view].strides[0]);
}

// Reads up to kMost pixels of a row of a view. Pixels outside the picture repeat its edge.
void ReadRow(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  const int32_t right = in.width - 1;
  const int32_t row = Clamp(y, 0, in.height - 1);
  if (x >= 0 && x + count - 1 <= right) {
    in.Light(view, x, row, count, rgb);
    return;
  }
  const int32_t first = Clamp(x, 0, right), last = Clamp(x + count - 1, 0, right);
  const int32_t inside = last - first + 1, before = Clamp(first - x, 0, count - 1);
  in.Light(view, first, row, inside, rgb + 3 * before);
  for (int32_t p = before; p > 0; --p)
    std::memcpy(rgb + 3 * (p - 1), rgb + 3 * p, 3 * sizeof(*rgb));
  for (int32_t p = before + inside; p < count; ++p) {
    std::memcpy(rgb + 3 * p, rgb + 3 * (p - 1), 3 * sizeof(*rgb));
  }
}

// Calls use(value), in which value(k, n) is the light of sample n of row y + k, n < 3 count, for
// k < kRows. Row y + k begins at column x. Pixels outside the picture repeat its edge. Light of
// packed pixels inside the picture is looked up sample by sample, because most calls read few
// pixels.
template <int32_t kRows, class Use>
void WithRows(const Input& in, int view, int32_t x, int32_t y, int32_t count, const Use& use) {
  if (in.read_light == ReadPackedLight && x >= 0 && x + count <= in.width) {
    const uint8_t* codes[kRows];
    for (int32_t k = 0; k < kRows; ++k) {
      codes[k] = ReadPackedCodes(in, view, x, Clamp(y + k, 0, in.height - 1), count, nullptr);
    }
    Prefetch(in, view, codes[kRows - 1]);
    const int16_t* const light = in.transfer->light;
    use([&](int32_t k, int32_t n) { return int32_t{light[codes[k][n]]}; });
    return;
  }
  int16_t rows[kRows][3 * kMost];
  for (int32_t k = 0; k < kRows; ++k) ReadRow(in, view, x, y + k, count, rows[k]);
  use([&](int32_t k, int32_t n) { return int32_t{rows[k][n]}; });
}

// Interpolates the light at `count` < kMost positions along a row. The first position is (x, y),
// kShiftBits.
void InterpolateRow(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  constexpr uint32_t kHalf = 1 << (2 * kShiftBits - 1);
  const int32_t wx = x & (kShiftOne - 1), wy = y & (kShiftOne - 1);
  const int32_t column = x >> kShiftBits, row = y >> kShiftBits;
  const int32_t pixels = count + (wx != 0 ? 1 : 0), next = wx != 0 ? 3 : 0;
  const auto interpolate = [&](const auto& light, int32_t k, int32_t n) {
    return light(k, n) * (kShiftOne - wx) + light(k, n + next) * wx;
  };
  const auto store = [&](int32_t n, int32_t sum) {
    const auto light = static_cast<uint32_t>(Checked(ranges::kHolePixel, sum));
    rgb[n] = static_cast<int16_t>((light + kHalf) >> (2 * kShiftBits));
  };
  if (wy == 0) {
    WithRows<1>(in, view, column, row, pixels, [&](const auto& light) {
      for (int32_t n = 0; n < 3 * count; ++n) store(n, interpolate(light, 0, n) * kShiftOne);
    });
    return;
  }
  WithRows<2>(in, view, column, row, pixels, [&](const auto& light) {
    for (int32_t n = 0; n < 3 * count; ++n) {
      store(n, interpolate(light, 0, n) * (kShiftOne - wy) + interpolate(light, 1, n) * wy);
    }
  });
}

// Returns tap k of a triangular filter. The taps are 1 2 1 for layer 1, and 1 2 3 4 3 2 1 for layer
// 2. The taps of a layer sum to 4^L.
constexpr int32_t Tap(int layer, int32_t k) { return (1 << layer) - Abs(k); }

// Subsamples a captured view at `count` positions along a row, 2^kLayer pixels apart. The first
// position is pixel (x, y) of the picture.
template <int kLayer>
void SubsampleRow(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  constexpr int32_t kReach = (1 << kLayer) - 1, kTaps = 2 * kReach + 1;
  const int32_t pixels = ((count - 1) << kLayer) + kTaps;
  int32_t down[3 * kMost];
  WithRows<kTaps>(in, view, x - kReach, y - kReach, pixels, [&](const auto& light) {
    for (int32_t n = 0; n < 3 * pixels; ++n) {
      int32_t sum = 0;
      for (int32_t k = 0; k < kTaps; ++k) sum += Tap(kLayer, k - kReach) * light(k, n);
      down[n] = sum;
    }
  });
  for (int32_t p = 0; p < count; ++p, rgb += 3) {
    const int32_t* const from = down + ((3 * p) << kLayer);
    int32_t sums[3] = {0, 0, 0};
    for (int32_t k = 0; k < kTaps; ++k) {
      for (int c = 0; c < 3; ++c) sums[c] += Tap(kLayer, k - kReach) * from[3 * k + c];
    }
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<int16_t>(RoundShift(sums[c], 4 * kLayer));
  }
}

// Reads the light at `count` positions along a row of a captured view, with the filters of
// ReadCaptured.
void ReadPlaces(const Input& in, int layer, int view, int32_t x, int32_t y, int32_t count,
                int16_t* rgb) {
  if (layer == 0) {
    InterpolateRow(in, view, x, y, count, rgb);
  } else {
    const int bits = kShiftBits - layer;
    const auto subsample = layer == 1 ? SubsampleRow<1> : SubsampleRow<2>;
    subsample(in, view, static_cast<int32_t>(RoundShift(x, bits)),
              static_cast<int32_t>(RoundShift(y, bits)), count, rgb);
  }
}

const uint8_t* ReadImageCodes(const Input& in, int view, int32_t x, int32_t y, int32_t count,
                              uint8_t* room) {
  if (view == 0) return in.centre.Row(y) + 3 * static_cast<ptrdiff_t>(x);
  ReadCodes(*in.image_kernels, in.images[view], x, y - in.first, count, room);
  return room;
}

void ReadImageLight(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  constexpr int32_t kPiece = 256;
  uint8_t room[3 * kPiece];
  for (int32_t p = 0; p < count; p += kPiece) {
    const int32_t some = Min(kPiece, count - p);
    in.kernels->Decode(ReadImageCodes(in, view, x + p, y, some, room),
                       3 * static_cast<size_t>(some), *in.transfer, rgb + 3 * p);
  }
}

// Reads deep pixels from the image of a view, and prefetches as Prefetch does.
void ReadImageRow(const Input& in, int view, int32_t x, int32_t y, int32_t count, uint16_t* rgb,
                  uint16_t* alpha) {
  const ImageSource& image = in.images[view];
  if (view > 0) image.Prefetch(x, y - in.first + 2, count);
  ReadDeep(*in.deep, image, x, y - in.first, count, rgb, alpha);
}

// Calls use(n, rgb, alpha) for pieces of `count` deep pixels of a row of a view. Piece n begins at
// pixel x + n. `alpha` is null unless kAlpha is true.
template <bool kAlpha, class Use>
void WithDeep(const Input& in, int view, int32_t x, int32_t y, int32_t count, const Use& use) {
  const Plane<const uint16_t>& rows = in.deep_rows[view];
  if (rows.data != nullptr) {
    use(0, count, rows.Row(y) + 3 * static_cast<ptrdiff_t>(x),
        kAlpha ? in.deep_alpha[view].Row(y) + x : nullptr);
    return;
  }
  constexpr int32_t kPiece = 128;
  uint16_t rgb[3 * kPiece], alpha[kPiece];
  for (int32_t n = 0; n < count; n += kPiece) {
    const int32_t some = Min(kPiece, count - n);
    ReadImageRow(in, view, x + n, y, some, rgb, kAlpha ? alpha : nullptr);
    use(n, some, rgb, kAlpha ? alpha : nullptr);
  }
}

// Copies `count` samples of deep codes, clipped at white.
void ClipAtWhite(const uint16_t* codes, int32_t count, int16_t* light) {
  // The compiler uses vectors for arrays of a fixed length.
  constexpr int32_t kGroup = 16;
  uint16_t group[kGroup];
  const auto clipped = [](uint16_t code) { return code < kLightWhite ? code : kLightWhite; };
  int32_t n = 0;
  for (; n + kGroup <= count; n += kGroup) {
    std::memcpy(group, codes + n, sizeof group);
    for (uint16_t& code : group) code = static_cast<uint16_t>(clipped(code));
    std::memcpy(light + n, group, sizeof group);
  }
  for (; n < count; ++n) light[n] = static_cast<int16_t>(clipped(codes[n]));
}

void ReadDeepLight(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  WithDeep<false>(in, view, x, y, count,
                  [&](int32_t at, int32_t some, const uint16_t* codes, const uint16_t*) {
                    ClipAtWhite(codes, 3 * some, rgb + 3 * at);
                  });
}

// ReadDeepLight for pictures that are at most white: their deep codes are the light.
void ReadDeepUpToWhite(const Input& in, int view, int32_t x, int32_t y, int32_t count,
                       int16_t* rgb) {
  const Plane<const uint16_t>& rows = in.deep_rows[view];
  if (rows.data == nullptr) {
    ReadImageRow(in, view, x, y, count, reinterpret_cast<uint16_t*>(rgb), nullptr);
    return;
  }
  std::memcpy(rgb, rows.Row(y) + 3 * static_cast<ptrdiff_t>(x),
              3 * static_cast<size_t>(count) * sizeof *rgb);
}

void ReadDeepExcess(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  const int32_t most = kLightWhite >> in.excess_shift;
  WithDeep<false>(in, view, x, y, count,
                  [&](int32_t at, int32_t some, const uint16_t* codes, const uint16_t*) {
                    for (int32_t n = 0; n < 3 * some; ++n) {
                      const int32_t excess = Clamp(codes[n] - kLightWhite, 0, most);
                      rgb[3 * at + n] = static_cast<int16_t>(excess << in.excess_shift);
                    }
                  });
}

void ReadDeepWhole(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  WithDeep<false>(in, view, x, y, count,
                  [&](int32_t at, int32_t some, const uint16_t* codes, const uint16_t*) {
                    for (int32_t n = 0; n < 3 * some; ++n) {
                      rgb[3 * at + n] = static_cast<int16_t>(LightOfDeep(codes[n]) >> kExcessBits);
                    }
                  });
}

void ReadDeepAlpha(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  WithDeep<true>(in, view, x, y, count,
                 [&](int32_t at, int32_t some, const uint16_t*, const uint16_t* alpha) {
                   for (int32_t n = 0; n < 3 * some; ++n) {
                     rgb[3 * at + n] = static_cast<int16_t>(alpha[n / 3]);
                   }
                 });
}

// Returns the 8-bit codes of a deep view, whose light is clipped at white.
const uint8_t* ReadDeepCodes(const Input& in, int view, int32_t x, int32_t y, int32_t count,
                             uint8_t* room) {
  constexpr int32_t kPiece = 128;
  int16_t light[3 * kPiece];
  for (int32_t n = 0; n < count; n += kPiece) {
    const int32_t some = Min(kPiece, count - n);
    ReadDeepLight(in, view, x + n, y, some, light);
    in.kernels->Encode(light, 3 * static_cast<size_t>(some), *in.transfer, room + 3 * n);
  }
  return room;
}

// Adds `count` pixels from column x on to their tiles.
void AddToTiles(int32_t x, int32_t count, const uint16_t* rgb, const uint16_t* alpha,
                LightTile* tiles) {
  for (int32_t n = 0, end; n < count; n = end) {
    const int32_t tile = (x + n) / LightTile::kTileColumns;
    end = Min(count, (tile + 1) * LightTile::kTileColumns - x);
    uint16_t most = kLightWhite, least = kLightWhite;
    for (int32_t k = 3 * n; k < 3 * end; ++k) most = rgb[k] > most ? rgb[k] : most;
    for (int32_t k = n; k < end; ++k) least = alpha[k] < least ? alpha[k] : least;
    const int32_t excess = most - kLightWhite;
    const int32_t bits = excess == 0 ? 0 : HighestBit(static_cast<uint32_t>(excess)) + 1;
    tiles[tile].Add({static_cast<uint8_t>(bits), static_cast<uint8_t>(least < kLightWhite)});
  }
}

// Returns an input of packed views, without its planes.
Input EmptyInput(const FullConfig& config, const simd::Kernels& kernels) {
  Input in;
  in.kernels = &kernels;
  in.transfer = &TransferOf(config.transfer);
  in.width = config.width;
  in.height = config.height;
  in.views = config.views;
  in.deep_transfer = config.transfer;
  // Creating the engine has already validated the positions of the views.
  ViewSet set;
  FindViews(config.views, config.positions, config.problem, &set);
  in.occlusion_views = ChooseOcclusionViews(set);
  return in;
}

// Returns a plane whose rows cannot be written.
template <class T>
Plane<const T> Constant(const Plane<T>& plane) {
  return {plane.data, plane.stride, plane.rows, plane.first};
}

// Makes `in` read deep pictures.
void ReadFromDeep(const DeepTables* tables, Input* in) {
  in->deep = tables;
  in->reads_codes = false;
  in->read_light = ReadDeepLight;
  in->read_codes = ReadDeepCodes;
}

// Fills the unknown disparities (kNoSurface) of a row. Returns the number of unknown pixels. If
// all pixels are unknown, they get the least disparity of the range.
int32_t FillUnknown(const Input& in, int16_t* row) {
  int32_t unknown = 0;
  for (int32_t x = 0; x < in.width; ++x) unknown += row[x] == simd::kNoSurface ? 1 : 0;
  const auto is_known = [](int16_t value) { return value != simd::kNoSurface; };
  if (unknown == 0 || FillGaps(row, in.width, is_known)) return unknown;
  const float low = in.map.rule.low;
  in.kernels->ConvertDisparity(&low, 1, low, in.map.rule.high, row);
  for (int32_t x = 1; x < in.width; ++x) row[x] = row[0];
  return unknown;
}

}  // namespace

void TakeInput(const FullConfig& config, int32_t rows, int32_t alpha_rows, Arena* arena,
               InputRings* rings) {
  const auto width = static_cast<size_t>(config.width);
  const bool streaming = Has(config, STARFOCUS_FEATURE_STREAMING);
  const bool images = ReadsImages(config);
  const int views = streaming ? config.views : images ? 1 : 0;
  const bool deep = HasDeep(config);
  *rings = {};
  rings->disparity = TakeRing<int16_t>(width, rows, arena);
  if (deep) {
    constexpr size_t kColumns = LightTile::kTileColumns;
    rings->tiles = TakeRing<LightTile>((width + kColumns - 1) / kColumns, rows, arena);
  }
  for (int view = 0; deep && view < views; ++view) {
    rings->deep[view] = TakeRing<uint16_t>(3 * width, rows, arena);
    rings->deep_alpha[view] = TakeRing<uint16_t>(width, rows, arena);
  }
  for (int view = 0; !deep && view < views; ++view) {
    rings->views[view] = arena->Take<uint8_t>(3 * width, static_cast<size_t>(rows));
  }
  if (streaming && Has(config, STARFOCUS_FEATURE_COVERAGE)) {
    rings->coverage = TakeRing<uint8_t>(width, rows, arena);
  }
  if (images) rings->columns = arena->Take<uint32_t>(width);
  if (images && streaming && !deep) rings->alpha = TakeRing<uint8_t>(width, alpha_rows, arena);
}

const uint8_t* ReadPackedCodes(const Input& in, int view, int32_t x, int32_t y, int32_t, uint8_t*) {
  const ImageSource& image = in.images[view];
  const Plane<const uint8_t> rows = {image.planes[0], image.strides[0], in.centre.rows, in.first};
  return rows.Row(y) + 3 * static_cast<ptrdiff_t>(x);
}

void ReadPackedLight(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  const uint8_t* const codes = ReadPackedCodes(in, view, x, y, count, nullptr);
  Prefetch(in, view, codes);
  if (count < 3) {
    for (int32_t n = 0; n < 3 * count; ++n) rgb[n] = in.transfer->light[codes[n]];
    return;
  }
  in.kernels->Decode(codes, 3 * static_cast<size_t>(count), *in.transfer, rgb);
}

Input InputOf(const FullConfig& config, const simd::Kernels& kernels,
              const starfocus_light_field& given, int32_t first, InputRings* rings) {
  Input in = EmptyInput(config, kernels);
  in.image_kernels = &simd::BestImageKernels();
  in.first = first;
  for (int view = 0; view < in.views; ++view) {
    in.images[view] = PlanesOf<const uint8_t>(given.views[view]);
    in.converts_centre = in.converts_centre || !in.images[view].IsPacked();
  }
  in.centre = RowsOf(given.views[0], first);
  if (in.converts_centre && rings->tables == nullptr) {
    in.read_light = ReadImageLight;
    in.read_codes = ReadImageCodes;
    in.centre = Constant(rings->View(0));
  }
  if (kDeep && rings->tables != nullptr) {
    ReadFromDeep(rings->tables, &in);
    in.converts_centre = true;
    bool may_exceed = false;
    for (int view = 0; view < in.views; ++view) {
      in.has_alpha = in.has_alpha || in.images[view].refocuses_alpha;
      may_exceed = may_exceed || MayExceedWhite(*in.deep, in.images[view].format);
    }
    if (!may_exceed) in.read_light = ReadDeepUpToWhite;
    in.deep_rows[0] = Constant(rings->deep[0]);
    in.deep_alpha[0] = Constant(rings->deep_alpha[0]);
  }
  if (rings->columns != nullptr && rings->map_width != given.depth.width) {
    rings->map_width = given.depth.width;
    FillColumns(in.width, rings->map_width, 0, in.width, rings->columns);
  }
  in.map = {given.depth, RuleOf(given.depth, MinDisparity(config), MaxDisparity(config)), in.width,
            in.height, rings->columns};
  // If the map has fewer rows than the picture, the caller always passes all rows of the map, so
  // the first row is 0.
  if (given.depth.height == in.height) in.map.first = first;
  in.fills_unknown = config.unknown == STARFOCUS_UNKNOWN_FILL;
  in.disparity = Constant(rings->disparity);
  in.given_coverage = {given.coverage, given.coverage_stride, 0, first};
  return in;
}

Input InputOf(const FullConfig& config, const simd::Kernels& kernels, const StoredViews& views,
              const Plane<int16_t>& disparity, const Plane<uint8_t>& coverage) {
  Input in = EmptyInput(config, kernels);
  for (int view = 0; view < in.views; ++view) {
    in.images[view].planes[0] = views.codes[view].data;
    in.images[view].strides[0] = views.codes[view].stride;
    in.deep_rows[view] = Constant(views.deep[view]);
    in.deep_alpha[view] = Constant(views.deep_alpha[view]);
  }
  in.centre = Constant(views.codes[0]);
  if (kDeep && views.tables != nullptr) ReadFromDeep(views.tables, &in);
  in.disparity = Constant(disparity);
  in.given_coverage = Constant(coverage);
  return in;
}

void ConvertRow(const Input& in, int32_t y, bool all_views, const InputRings& rings) {
  if (!in.is_deep()) {
    for (int view = 0; view < (all_views ? in.views : 1); ++view) {
      ReadCodes(*in.image_kernels, in.images[view], 0, y - in.first, in.width,
                rings.View(view).Row(y));
    }
    return;
  }
  LightTile* const tiles = rings.tiles.Row(y);
  std::fill_n(tiles, rings.tiles.stride, LightTile{0, 0});
  for (int view = 0; view < in.views; ++view) {
    const ImageSource& image = in.images[view];
    const bool is_stored = !in.converts_centre, is_read = !is_stored && (all_views || view == 0);
    uint16_t *const rgb = rings.deep[view].Row(y), *const alpha = rings.deep_alpha[view].Row(y);
    if (is_read) ReadDeep(*in.deep, image, 0, y - in.first, in.width, rgb, alpha);
    for (int32_t x = 0, some; x < in.width; x += some) {
      some = Min(in.width - x, LightTile::kTileColumns);
      if (!is_stored && IsPlain(*in.deep, image, x, y - in.first, some)) continue;
      if (is_read) {
        AddToTiles(x, some, rgb + 3 * x, alpha + x, tiles);
        continue;
      }
      WithDeep<true>(in, view, x, y, some,
                     [&](int32_t, int32_t all, const uint16_t* codes, const uint16_t* alphas) {
                       AddToTiles(x, all, codes, alphas, tiles);
                     });
    }
  }
}

Input DeepExcessOf(const Input& captured, int32_t shift) {
  Input in = captured;
  in.read_light = ReadDeepExcess;
  in.is_excess = true;
  in.excess_shift = shift;
  return in;
}

Input DeepWholeOf(const Input& captured) {
  Input in = captured;
  in.read_light = ReadDeepWhole;
  return in;
}

Input DeepAlphaOf(const Input& captured) {
  Input in = captured;
  in.read_light = ReadDeepAlpha;
  return in;
}

uint32_t ReadMap(const Input& in, const Range& rows, const Plane<int16_t>* out, uint64_t* unknown) {
  if (out == nullptr) return CheckDepth(*in.image_kernels, in.map, rows);
  const uint32_t flags =
      ReadDepth(*in.image_kernels, in.map, {0, rows.first, in.width, rows.last - rows.first}, *out);
  for (int32_t y = rows.first; y < rows.last; ++y) {
    int16_t* const row = out->Row(y);
    if (in.fills_unknown) *unknown += static_cast<uint64_t>(FillUnknown(in, row));
    if (in.fills_unknown || (flags & simd::kUnknownDepth) == 0) {
      CheckAll(ranges::kDisparity, row, static_cast<size_t>(in.width));
    }
  }
  return flags;
}

void CopyRows(const Input& from, const Range& rows, const InputRings& to) {
  const auto width = static_cast<size_t>(from.width);
  const ImageSource& centre = from.images[0];
  for (int32_t y = rows.first; y < rows.last; ++y) {
    ConvertRow(from, y, true, to);
    if (from.given_coverage.data != nullptr && to.coverage.data != nullptr) {
      std::memcpy(to.coverage.Row(y), from.given_coverage.Row(y), width);
    }
    if (to.alpha.data == nullptr) continue;
    uint8_t* const alpha = to.alpha.Row(y);
    std::memset(alpha, 255, width);
    if (!centre.has_alpha) continue;
    const uint8_t* const given = centre.Pixel(0, y - from.first) + 3;
    for (size_t x = 0; x < width; ++x) alpha[x] = given[x * centre.step];
  }
}

void ReadCaptured(const Input& in, int layer, int view, const CapturedLine& line, int32_t count,
                  int16_t* rgb) {
  for (const int32_t last : {0, count - 1}) {
    Checked(ranges::kHolePosition, line.x + line.dx * last * kShiftOne);
    Checked(ranges::kHolePosition, line.y + line.dy * last * kShiftOne);
  }
  constexpr int32_t kPlaces = 16;
  const bool is_row = line.dx == 1 && line.dy == 0;
  for (int32_t p = 0, some = 0; p < count; p += some) {
    some = is_row ? Min(kPlaces, count - p) : 1;
    ReadPlaces(in, layer, view, line.x + line.dx * p * kShiftOne, line.y + line.dy * p * kShiftOne,
               some, rgb + 3 * p);
  }
}

}  // namespace starfocus
