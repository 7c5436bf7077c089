// SPDX-License-Identifier: Apache-2.0
// Runs the sessions that take little time.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/image_io.h"
#include "platform/writers/png.h"
#include "tests/programs/session.h"
#include "tests/support/error_line.h"
#include "tests/support/photo_files.h"

namespace starfocus::sessions_program_test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 32, kHeight = 24, kFirst = 8, kLast = 11;

// Returns the depth of a pixel, 0 (far) to 1: a wall, a floor, a person who walks to the right, and
// from frame 10 on a hand nearer than the person.
double DepthAt(int frame, int x, int y) {
  if (frame >= 10 && x < 6) return 1;
  if (x >= frame && x < frame + 14 && y >= 6) return 0.25;
  return y < 16 ? 0 : 0.1;
}

Image MakeFrame(int frame) {
  Image image(kWidth, kHeight);
  uint32_t state = static_cast<uint32_t>(frame) + 1;
  for (uint8_t& sample : image.pixels) {
    state = state * 1664525 + 1013904223;
    sample = static_cast<uint8_t>(state >> 24);
  }
  return image;
}

void MakeClip(const TempFolder& folder) {
  fs::create_directory(folder.file("clip"));
  for (int frame = kFirst; frame <= kLast; ++frame) {
    const std::string name = folder.file("clip/frame_" + std::to_string(frame));
    REQUIRE(WriteImage(name + ".png", MakeFrame(frame)) == "");
    std::vector<uint16_t> depth;
    for (int k = 0; k < kWidth * kHeight; ++k) {
      depth.push_back(static_cast<uint16_t>(65535 * DepthAt(frame, k % kWidth, k / kWidth)));
    }
    photos::Write(name + "-depth.png", photos::Png16(kWidth, kHeight, depth));
  }
}

// Declares the colours of the frames of the clip as linear light.
void MakeLinear(const TempFolder& folder) {
  for (int frame = kFirst; frame <= kLast; ++frame) {
    const std::string path = folder.file("clip/frame_" + std::to_string(frame) + ".png");
    std::string png = Text(path);
    png.insert(33, photos::Chunk("gAMA", photos::Big(100000, 4)));  // after signature and IHDR
    photos::Write(path, png);
  }
}

TEST_CASE("sessions: every session of sessions.txt succeeds") {
  RunSessions("programs/sessions.txt");
}

TEST_CASE("sessions: every session of video_sessions.txt succeeds") {
  RunSessions("programs/video_sessions.txt", {{"clip", MakeClip}, {"linear", MakeLinear}});
}

}  // namespace
}  // namespace starfocus::sessions_program_test
