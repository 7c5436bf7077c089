// SPDX-License-Identifier: Apache-2.0
// For tests of photo readers: changes copies of the seeds of the fuzz targets, makes a small depth
// photo, opens photos and checks their contents.
#ifndef STARFOCUS_TESTS_SUPPORT_OPENED_PHOTO_H_
#define STARFOCUS_TESTS_SUPPORT_OPENED_PHOTO_H_

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "platform/file.h"
#include "platform/readers/capture.h"
#include "platform/result.h"
#include "tests/support/error_line.h"
#include "tests/support/photo_files.h"

namespace starfocus {

inline std::string Seed(const std::string& name) {
  const Bytes bytes = ValueOf(ReadFile(STARFOCUS_SOURCE_DIR "/tests/fuzz/corpus/" + name));
  return {bytes.begin(), bytes.end()};
}

// Returns `file` with `bytes` written `behind` bytes after the end of the first `text`.
inline std::string Changed(std::string file, const std::string& text, size_t behind,
                           const std::string& bytes) {
  const size_t at = file.find(text);
  REQUIRE(at != std::string::npos);
  return file.replace(at + text.size() + behind, bytes.size(), bytes);
}

}  // namespace starfocus

namespace starfocus::photos {

constexpr int kWidth = 40, kHeight = 24;

inline std::string Photo() { return Encode(Plain(kWidth, kHeight, 128), ".jpg"); }
inline std::string RampPng() { return Encode(Ramp(kWidth, kHeight), ".png"); }

inline std::string Data(const std::string& map) { return "GDepth:Data=\"" + Base64(map) + "\""; }

inline Error Open(const std::string& bytes, Capture* capture, const CaptureOptions& options = {}) {
  TempFolder folder;
  Write(folder.file("photo.jpg"), bytes);
  Result<Capture> opened = OpenCapture(folder.file("photo.jpg"), options);
  if (opened) *capture = std::move(*opened);
  return opened.error();
}

// Returns the blur scale per dioptre (docs/formats.md) for an f/1 lens on a full-frame camera.
// `focal` is the focal length in mm.
inline double PerDiopter(double focal) {
  return focal * focal / 1000 / 2 / 43.2666 * std::hypot(kWidth, kHeight);
}

// Nearest disparity of a depth map without units, which is assumed to show a distance of 1.5 m and
// a 50 mm lens.
inline const double kPortrait = PerDiopter(50) / 1.5;

// Checks that the disparities of a photo are a ramp from `at_black` on the left to `at_white` on
// the right.
inline void CheckRamp(const Capture& capture, double at_black, double at_white) {
  const FloatMap& map = capture.light_field.disparity;
  REQUIRE(map.width == kWidth);
  REQUIRE(map.height == kHeight);
  CHECK(double(map.at(0, 3)) == doctest::Approx(at_black).epsilon(1e-4));
  CHECK(double(map.at(kWidth - 1, 3)) == doctest::Approx(at_white).epsilon(1e-4));
}

inline std::string FactOf(const Capture& capture, const std::string& name) {
  for (const auto& fact : capture.facts) {
    if (fact.first == name) return fact.second;
  }
  return "";
}

inline const std::string kInverse =
    "GDepth:Format=\"RangeInverse\" GDepth:Near=\"0.5\" GDepth:Far=\"4\" ";

inline bool HasNote(const Capture& capture, const std::string& part) {
  for (const std::string& note : capture.notes) {
    if (note.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace starfocus::photos

#endif  // STARFOCUS_TESTS_SUPPORT_OPENED_PHOTO_H_
