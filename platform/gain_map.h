// SPDX-License-Identifier: Apache-2.0
// Gain maps: the light of a photograph beyond white, stored as a small picture. A gain map states
// by which factor the light of each place exceeds that of the 8-bit picture of the file, which is
// the base. Reconstructs the light of a photograph, and computes the gain map of a new picture.
//
// For a level g of the map, 0 to 1, and the light s of the base:
//   light = (s + offset_sdr) * 2^(min + (max - min) * g^(1 / gamma)) - offset_hdr
// This is the equation of Adobe's and Android's gain maps and of ISO 21496-1 on a display that
// shows all of the light. Readers convert Apple's gain maps to this form.
#ifndef STARFOCUS_PLATFORM_GAIN_MAP_H_
#define STARFOCUS_PLATFORM_GAIN_MAP_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

struct GainMap {
  int width = 0, height = 0;
  int channels = 1;              // 1: the same gain for all colours; 3: R, G and B.
  std::vector<uint16_t> levels;  // 65535 is 1; rows without padding; empty: no gain map.
  std::string format;            // Format of the metadata, for users.
  // Parameters of R, G and B. `min` and `max` are in stops, which are factors of 2.
  std::array<double, 3> min = {}, max = {}, gamma = {1, 1, 1};
  std::array<double, 3> offset_sdr = {1.0 / 64, 1.0 / 64, 1.0 / 64}, offset_hdr = offset_sdr;
  // Brightness of displays, in stops above white, up to which a viewer shows the base, and from
  // which on it shows all of the light.
  double capacity_min = 0, capacity_max = 0;

  size_t row_levels() const { return size_t(channels) * size_t(width); }
};

// Returns an error if a parameter is not finite or outside of its range: `min` up to `max`, stops
// from -64 to 64, offsets from -1 to 1, gamma from 1/64 to 64. The error message starts with
// `where`.
Error CheckGainMap(const std::string& where, const GainMap& map);

// Returns the light of a photograph: half floats of three channels, of the size of `base`, in the
// primaries of `base`. White of `base` is 1. The codes of `base` are decoded by the curve of sRGB,
// which Display P3 shares. The map is enlarged bilinearly: the corners of its area are the corners
// of the picture. Light below 0 is set to 0, and light above the largest half float to that.
// `map` must have levels and pass CheckGainMap.
DeepImage ApplyGainMap(const Image& base, const GainMap& map);

// Computes the gain map that converts `base` to `light`, half floats of the same size with at least
// three channels. Both are means of the base and the light of a photograph whose map is `given`. A
// level of the map belongs to `step` x `step` pixels. With one channel, the gain is that of the
// luminance, and with 3, each colour has its own.
//
// The map has the channels, the format and the capacities of `given`, so that displays show the
// same share of the light, and the offset of its first colour for both pictures. Other offsets fit
// worse: the map of a photograph with the offset 0 has 74 dB in PQ with that offset, and 58, 53, 49
// and 45 dB with 1/4096, 1/1024, 1/256 and 1/64 (tests/programs/ultra_hdr_test.cc).
//
// The range of the map is that of the gains that occur, so no light is cut off. If the offsets of
// `given` are one number from 0, the gains of means lie in the range of `given`, and gains beyond,
// which rounding of dark codes causes, are limited to it. Levels are chosen so that the
// enlarged map has the right weighted mean gain, in stops, over the pixels of each level. They are
// multiples of 257, which 8 bits store exactly.
GainMap ComputeGainMap(const Image& base, const DeepImage& light, int step, const GainMap& given);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_GAIN_MAP_H_
