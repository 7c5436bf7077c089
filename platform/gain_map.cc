// SPDX-License-Identifier: Apache-2.0
#include "platform/gain_map.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "platform/deep_image.h"
#include "platform/text.h"

namespace starfocus {
namespace {

// Returns the light of a half float, from 0 to the largest finite half.
float LightOf(uint16_t half) {
  const float light = FloatOfHalf(half);
  return light > 0 ? std::min(light, kLargestHalf) : 0;
}

uint16_t StoredLight(float light) {
  return light > 0 ? HalfOfFloat(std::min(light, kLargestHalf)) : uint16_t{0};
}

constexpr int kColours = 3;
constexpr size_t kLevels = 65536;

// Returns the light of the 256 codes of sRGB (IEC 61966-2-1). White is 1.
std::array<float, 256> SrgbLight() {
  std::array<float, 256> light = {};
  for (size_t code = 0; code < light.size(); ++code) {
    const double value = static_cast<double>(code) / 255;
    light[code] = static_cast<float>(value <= 0.04045 ? value / 12.92
                                                      : std::pow((value + 0.055) / 1.055, 2.4));
  }
  return light;
}

// Position of a pixel among the levels of a row or column of a map: between the levels `low` and
// `high`, of which `high` has the weight `share` / kOne.
struct Place {
  static constexpr int kBits = 12;
  static constexpr uint32_t kOne = 1u << kBits;
  size_t low, high;
  uint32_t share;
};

// Returns the places of `pixels` pixels, which cover the same length as `levels` levels. Pixels
// outside of the centres of the outermost levels have the outermost level.
std::vector<Place> PlacesOf(int pixels, int levels) {
  std::vector<Place> places;
  places.reserve(static_cast<size_t>(pixels));
  for (int k = 0; k < pixels; ++k) {
    // The centre of the pixel, in units of levels / (2 * kOne), relative to the first level.
    const int64_t centre = (int64_t{2} * k + 1) * levels * Place::kOne / pixels - Place::kOne;
    const int64_t last = int64_t{2} * Place::kOne * (levels - 1);
    const auto at = static_cast<uint64_t>(std::clamp(centre, int64_t{0}, last) / 2);
    const auto low = static_cast<size_t>(at >> Place::kBits);
    places.push_back({low, std::min(low + 1, static_cast<size_t>(levels - 1)),
                      static_cast<uint32_t>(at & (Place::kOne - 1))});
  }
  return places;
}

// Interpolates the rows of a map at the place of a row of pixels. The results have Place::kBits
// fractional bits.
void MixRows(const GainMap& map, const Place& place, std::vector<uint32_t>* mixed) {
  const uint16_t* low = map.levels.data() + place.low * map.row_levels();
  const uint16_t* high = map.levels.data() + place.high * map.row_levels();
  for (size_t k = 0; k < mixed->size(); ++k) {
    (*mixed)[k] = low[k] * (Place::kOne - place.share) + high[k] * place.share;
  }
}

// Returns the level at a place of a row that MixRows computed.
size_t LevelAt(const std::vector<uint32_t>& mixed, const Place& place, size_t channels,
               size_t channel) {
  constexpr int kShift = 2 * Place::kBits;
  const uint64_t level =
      uint64_t{mixed[place.low * channels + channel]} * (Place::kOne - place.share) +
      uint64_t{mixed[place.high * channels + channel]} * place.share;
  return static_cast<size_t>((level + (uint64_t{1} << (kShift - 1))) >> kShift);
}

// Returns the factor of each level for one colour. A step of one level changes the factor by at
// most 0.07 % for 64 stops, and usually by less than the rounding of half floats.
std::vector<float> FactorsOf(const GainMap& map, size_t colour) {
  std::vector<float> factors(kLevels);
  const double exponent = 1 / map.gamma[colour];
  for (size_t level = 0; level < kLevels; ++level) {
    const double share = static_cast<double>(level) / (kLevels - 1);
    const double weight = exponent == 1 ? share : std::pow(share, exponent);
    factors[level] = static_cast<float>(
        std::exp2(map.min[colour] + (map.max[colour] - map.min[colour]) * weight));
  }
  return factors;
}

bool HasSameGain(const GainMap& map, size_t a, size_t b) {
  return map.min[a] == map.min[b] && map.max[a] == map.max[b] && map.gamma[a] == map.gamma[b];
}

// Gains, in stops, of the pixels of each level of a map, for one channel.
struct Gains {
  std::vector<double> mean;      // Weighted mean; the weighted sum while pixels are added.
  std::vector<double> weight;    // Sum of the weights.
  std::vector<float> low, high;  // The smallest and the largest gain.
};

// Returns the index of the level to which each of `pixels` pixels belongs.
std::vector<size_t> OwnersOf(int pixels, int levels) {
  std::vector<size_t> owners;
  for (int k = 0; k < pixels; ++k) {
    owners.push_back(static_cast<size_t>((int64_t{2} * k + 1) * levels / (int64_t{2} * pixels)));
  }
  return owners;
}

// Returns the light whose gain a map of one channel stores: the luminance by ITU-R BT.709.
float Luminance(const std::array<float, kColours>& light) {
  return 0.2126F * light[0] + 0.7152F * light[1] + 0.0722F * light[2];
}

// Adds the gains of a row of pixels to the levels from index `first` on. The weight of a pixel is
// the effect of the gain on its code in PQ, which is approximately the logarithm of the light
// + kDark: dark pixels whose light the gain hardly changes do not determine it. kSmallestOffset
// keeps the gains of black pixels finite if `offset` is 0.
void AddRow(const uint8_t* base, const uint16_t* light, size_t light_channels, float offset,
            const std::vector<size_t>& columns, size_t first, std::vector<Gains>* gains) {
  static const std::array<float, 256> kSrgb = SrgbLight();
  constexpr float kDark = 1.0F / 128, kSmallestOffset = 1.0F / (1 << 16);
  const float added = std::max(offset, kSmallestOffset);
  for (size_t x = 0; x < columns.size(); ++x) {
    std::array<float, kColours> from = {}, to = {};
    for (size_t c = 0; c < kColours; ++c) {
      from[c] = kSrgb[base[kColours * x + c]];
      to[c] = LightOf(light[light_channels * x + c]);
    }
    if (gains->size() == 1) {
      from[0] = Luminance(from);
      to[0] = Luminance(to);
    }
    for (size_t c = 0; c < gains->size(); ++c) {
      const float gain = std::log2((to[c] + added) / (from[c] + added));
      const double weight = double{(to[c] + added) / (to[c] + added + kDark)};
      Gains& its = (*gains)[c];
      const size_t level = first + columns[x];
      its.mean[level] += weight * double{gain};
      its.weight[level] += weight;
      its.low[level] = std::min(its.low[level], gain);
      its.high[level] = std::max(its.high[level], gain);
    }
  }
}

// Convolves a row or column of levels, which are `step` apart, with 1/8, 3/4, 1/8: the mean of a
// bilinearly enlarged map over the pixels of a level.
void MeanOfEnlarged(double* levels, size_t count, size_t step) {
  double before = levels[0];
  for (size_t k = 0; k < count; ++k) {
    const double here = levels[k * step], after = levels[std::min(k + 1, count - 1) * step];
    levels[k * step] = here + (before - 2 * here + after) / 8;
    before = here;
  }
}

// Returns levels whose bilinear enlargement has the means of `gains`, by repeated correction with
// the error of the means. Levels stay within the gains that occur at their own pixels, so that
// bright places get no dark rims. After 8 corrections, a checkerboard of single levels, which is
// the worst case, has the right contrast up to 10 %.
std::vector<double> FitLevels(const Gains& gains, size_t width, size_t height) {
  constexpr int kCorrections = 8;
  std::vector<double> fitted = gains.mean, means;
  for (int n = 0; n < kCorrections; ++n) {
    means = fitted;
    for (size_t y = 0; y < height; ++y) MeanOfEnlarged(&means[y * width], width, 1);
    for (size_t x = 0; x < width; ++x) MeanOfEnlarged(&means[x], height, width);
    for (size_t k = 0; k < fitted.size(); ++k) {
      fitted[k] = std::clamp(fitted[k] + gains.mean[k] - means[k], double{gains.low[k]},
                             double{gains.high[k]});
    }
  }
  return fitted;
}

// Limits the stops of a channel to the range of a map with one offset, from 0, for both pictures
// and all colours. Light + offset is a multiple of base + offset there, and so are their means.
void LimitStops(const GainMap& given, size_t channel, std::vector<double>* stops) {
  const std::array<double, kColours>& offsets = given.offset_sdr;
  if (offsets != given.offset_hdr || offsets[0] != offsets[1] || offsets[0] != offsets[2]) return;
  if (offsets[0] < 0) return;
  double low = given.min[channel], high = given.max[channel];
  if (given.channels == 1) {
    low = *std::min_element(given.min.begin(), given.min.end());
    high = *std::max_element(given.max.begin(), given.max.end());
  }
  for (double& stop : *stops) stop = std::clamp(stop, low, high);
}

// Sets the levels of one channel, and the range of the colours that it serves. The limits of the
// range are multiples of 2^-20 stops, which XMP and ISO 21496-1 can both store.
void StoreLevels(const std::vector<double>& stops, size_t channel, GainMap* map) {
  constexpr double kUnit = 1.0 / (1 << 20), kSmallestRange = 1.0 / 64;
  const auto [least, most] = std::minmax_element(stops.begin(), stops.end());
  const double min = std::floor(*least / kUnit) * kUnit;
  const double max = std::max(std::ceil(*most / kUnit) * kUnit, min + kSmallestRange);
  for (size_t c = 0; c < kColours; ++c) {
    if (map->channels == kColours && c != channel) continue;
    map->min[c] = min;
    map->max[c] = max;
  }
  for (size_t k = 0; k < stops.size(); ++k) {
    const double share = (stops[k] - min) / (max - min);
    map->levels[k * size_t(map->channels) + channel] =
        static_cast<uint16_t>(257 * std::lround(255 * share));
  }
}

}  // namespace

Error CheckGainMap(const std::string& where, const GainMap& map) {
  constexpr double kMostStops = 64, kMostGamma = 64;
  const auto check = [&](const char* name, const std::array<double, 3>& values, double low,
                         double high) -> Error {
    for (const double value : values) {
      if (value >= low && value <= high) continue;  // false for NaN
      return Expected(where,
                      std::string(name) + " from " + NumberText(low) + " to " + NumberText(high),
                      NumberText(value));
    }
    return {};
  };
  if (Error error = check("GainMapMin", map.min, -kMostStops, kMostStops)) return error;
  if (Error error = check("GainMapMax", map.max, -kMostStops, kMostStops)) return error;
  if (Error error = check("Gamma", map.gamma, 1 / kMostGamma, kMostGamma)) return error;
  if (Error error = check("OffsetSDR", map.offset_sdr, -1, 1)) return error;
  if (Error error = check("OffsetHDR", map.offset_hdr, -1, 1)) return error;
  const std::array<double, 3> capacities = {map.capacity_min, map.capacity_max, map.capacity_max};
  if (Error error = check("HDRCapacity", capacities, -kMostStops, kMostStops)) return error;
  for (size_t c = 0; c < kColours; ++c) {
    if (map.min[c] <= map.max[c]) continue;
    return Expected(where, "GainMapMin up to GainMapMax",
                    NumberText(map.min[c]) + " and " + NumberText(map.max[c]));
  }
  return {};
}

DeepImage ApplyGainMap(const Image& base, const GainMap& map) {
  DeepImage light(base.width, base.height, kColours);
  light.is_half = true;
  const std::array<float, 256> srgb = SrgbLight();
  std::array<std::shared_ptr<const std::vector<float>>, kColours> factors;
  std::array<float, kColours> before = {}, after = {};
  for (size_t c = 0; c < kColours; ++c) {
    factors[c] = c > 0 && HasSameGain(map, c, 0)
                     ? factors[0]
                     : std::make_shared<const std::vector<float>>(FactorsOf(map, c));
    before[c] = static_cast<float>(map.offset_sdr[c]);
    after[c] = static_cast<float>(map.offset_hdr[c]);
  }
  const std::vector<Place> columns = PlacesOf(base.width, map.width);
  const std::vector<Place> rows = PlacesOf(base.height, map.height);
  const auto channels = static_cast<size_t>(map.channels);
  std::vector<uint32_t> mixed(map.row_levels());
  for (int y = 0; y < base.height; ++y) {
    MixRows(map, rows[static_cast<size_t>(y)], &mixed);
    const uint8_t* from = base.row(y);
    uint16_t* to = light.row(y);
    for (const Place& place : columns) {
      size_t level = 0;
      for (size_t c = 0; c < kColours; ++c) {
        if (c < channels) level = LevelAt(mixed, place, channels, c);
        *to++ = StoredLight((srgb[*from++] + before[c]) * (*factors[c])[level] - after[c]);
      }
    }
  }
  return light;
}

GainMap ComputeGainMap(const Image& base, const DeepImage& light, int step, const GainMap& given) {
  GainMap map;
  map.width = (base.width + step - 1) / step;
  map.height = (base.height + step - 1) / step;
  map.channels = given.channels;
  map.format = given.format;
  map.offset_sdr.fill(given.offset_sdr[0]);
  map.offset_hdr = map.offset_sdr;
  map.capacity_min = given.capacity_min;
  map.capacity_max = std::max(given.capacity_max, given.capacity_min + 1.0 / 64);
  const size_t width = static_cast<size_t>(map.width), height = static_cast<size_t>(map.height);
  const size_t levels = width * height;
  map.levels.resize(levels * static_cast<size_t>(map.channels));
  const Gains none = {std::vector<double>(levels), std::vector<double>(levels),
                      std::vector<float>(levels, HUGE_VALF),
                      std::vector<float>(levels, -HUGE_VALF)};
  std::vector<Gains> gains(static_cast<size_t>(map.channels), none);
  const std::vector<size_t> columns = OwnersOf(base.width, map.width);
  const std::vector<size_t> rows = OwnersOf(base.height, map.height);
  for (int y = 0; y < base.height; ++y) {
    AddRow(base.row(y), light.row(y), static_cast<size_t>(light.channels),
           static_cast<float>(map.offset_sdr[0]), columns, rows[static_cast<size_t>(y)] * width,
           &gains);
  }
  for (size_t c = 0; c < gains.size(); ++c) {
    for (size_t k = 0; k < levels; ++k) gains[c].mean[k] /= gains[c].weight[k];
    std::vector<double> stops = FitLevels(gains[c], width, height);
    LimitStops(given, c, &stops);
    StoreLevels(stops, c, &map);
  }
  return map;
}

}  // namespace starfocus
