// SPDX-License-Identifier: Apache-2.0
// A scene of three surfaces, and its depth pictures in several formats, which tests open together
// with a grey photo.
#ifndef STARFOCUS_TESTS_PROGRAMS_DEPTH_SCENE_H_
#define STARFOCUS_TESTS_PROGRAMS_DEPTH_SCENE_H_

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/readers/jpeg_parts.h"
#include "tests/support/opened_photo.h"

namespace starfocus::depth_scene {

using namespace photos;

inline constexpr int kColumns = 48, kRows = 36;
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Values of a map: the wall, the bottom of a floor that comes nearer, and a box in front of both.
struct Scene {
  double wall, floor, box;

  double At(int x, int y) const {
    if (x >= 16 && x < 28 && y >= 8 && y < 26) return box;
    return y < 20 ? wall : wall + (floor - wall) * (y - 19) / (kRows - 20);
  }
};

inline FloatMap MapOf(const Scene& scene, int columns = kColumns) {
  FloatMap map = {columns, kRows, {}};
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < columns; ++x) map.values.push_back(static_cast<float>(scene.At(x, y)));
  }
  return map;
}

inline size_t Index(int x, int y) { return size_t(y) * kColumns + size_t(x); }

inline FloatMap WithColumns(FloatMap map, int from, int to, float value) {
  for (int y = 0; y < kRows; ++y) {
    for (int x = from; x < to; ++x) map.values[Index(x, y)] = value;
  }
  return map;
}

// Opens a photo with a depth picture and a matte in separate files, unless their content is empty.
inline Result<Capture> OpenWith(const Image& photo, const std::string& depth,
                                CaptureOptions options = {}, const std::string& matte = "",
                                int orientation = 1) {
  TempFolder folder;
  const std::string path = folder.file("photo.jpg");
  Write(path, Insert(Encode(photo, ".jpg"), ExifSegment(orientation, 0)));
  const auto write = [&](const std::string& name, const std::string& bytes) {
    if (bytes.empty()) return std::string();
    Write(folder.file(name), bytes);
    return folder.file(name);
  };
  options.depth = write("map", depth);
  options.matte = write("matte", matte);
  return OpenCapture(path, options);
}

// Opens a grey photo with a depth picture.
inline Result<Capture> OpenMap(const std::string& depth, const DepthOptions& options) {
  return OpenWith(Plain(kColumns, kRows, 128), depth, {"", options});
}

inline std::string PfmOf(const FloatMap& map, ByteOrder order = ByteOrder::kLittle) {
  TempFolder folder;
  Require(WritePfm(folder.file("map.pfm"), map, order));
  const Bytes bytes = ValueOf(ReadFile(folder.file("map.pfm")));
  return {bytes.begin(), bytes.end()};
}

inline Span SpanOf(const std::string& bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

// Returns the disparity of a pixel.
inline double At(const Capture& capture, int x, int y) {
  return double(capture.light_field.disparity.at(x, y));
}

// Opens a file that stores its depth or matte.
inline Capture OpenPhoto(const std::string& file, const CaptureOptions& options = {}) {
  Capture capture;
  Require(Open(file, &capture, options));
  return capture;
}

inline DepthOptions NearIs(Near near) {
  DepthOptions options;
  options.near = near;
  return options;
}

inline std::string NpyOf(const FloatMap& map) {
  const std::string npy = std::string("\x93NUMPY\1\0\76\0", 10) +
                          "{'descr': '<f4', 'fortran_order': False, 'shape': (36, 48), }\n";
  return npy + std::string(reinterpret_cast<const char*>(map.values.data()),
                           map.values.size() * sizeof(float));
}

// Returns an NPY file of 32-bit integers.
inline std::string IntegerNpyOf(FloatMap map) {
  for (float& value : map.values) {
    const auto integer = static_cast<int32_t>(std::lround(value));
    std::memcpy(&value, &integer, sizeof value);
  }
  const std::string npy = NpyOf(map);
  return std::string(npy).replace(npy.find("<f4"), 3, "<i4");
}

// Returns a PNG file whose alpha channel, or whose grey channel if `channels` is 1, is the matte.
// The colours are random.
inline std::string AlphaPng(const FloatMap& matte, int channels) {
  const int colour = channels == 4 ? 6 : 0;
  const Image noise = Noise(matte.width, matte.height);
  std::string samples;
  for (size_t k = 0; k < matte.values.size(); ++k) {
    if (channels == 4)
      samples.append(noise.pixels.begin() + int(3 * k), noise.pixels.begin() + int(3 * k + 3));
    samples += static_cast<char>(std::lround(255 * double(matte.values[k])));
  }
  return Png(uint32_t(matte.width), uint32_t(matte.height), {8, colour}, samples,
             size_t(matte.width) * size_t(channels));
}

inline DepthOptions UnitIs(DepthUnit unit, double metres = 1) {
  DepthOptions options;
  options.unit = unit;
  options.metres = metres;
  return options;
}

// Elements of the XMP of auxiliary pictures, as Apple's cameras write them.
inline std::string AppleType(const std::string& type) {
  return "<apdi:AuxiliaryImageType>" + type + "</apdi:AuxiliaryImageType>";
}
inline const std::string kAppleRange =
    "<apdi:FloatMinValue>0.5</apdi:FloatMinValue><apdi:FloatMaxValue>2</apdi:FloatMaxValue>";

// Returns the attribute that names the extended XMP.
inline const std::string kGuidName = std::string("xmpNote:HasExtendedXMP=\"") + kGuid + "\" ";

inline constexpr Scene kMillimetres = {3000, 1500, 900};
// The largest disparity of a map without units: a portrait at 1.5 m from a 50 mm lens.
inline const double kNearest = 50.0 * 50 / 1000 / 2 / 43.2666 * std::hypot(kColumns, kRows) / 1.5;

}  // namespace starfocus::depth_scene

#endif  // STARFOCUS_TESTS_PROGRAMS_DEPTH_SCENE_H_
