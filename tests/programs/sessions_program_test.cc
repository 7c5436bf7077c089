// SPDX-License-Identifier: Apache-2.0
// Runs the sessions that take little time.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/image_io.h"
#include "platform/pfm.h"
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

Image MakeFrame(int frame, int width = kWidth, int height = kHeight) {
  Image image(width, height);
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

// A square that moves to the right by 3 pixels from frame to frame and comes nearer: frame n has it
// at disparity 1 + n / 4. It is hidden in frame 5 of 8. The maps in `s` of odd frames are larger by
// a fifth.
void MakeWalk(const TempFolder& folder) {
  const Image wall = MakeFrame(0, 80, 48), square = MakeFrame(1, 24, 24);
  for (const char* name : {"in", "d", "s"}) fs::create_directory(folder.file(name));
  for (int frame = 0; frame < 8; ++frame) {
    Image image = wall;
    FloatMap map = {80, 48, std::vector<float>(80 * 48, 0.0f)};
    for (int y = 0; y < 24 && frame != 5; ++y) {
      const int left = 8 + 3 * frame;
      std::copy_n(square.row(y), square.stride(), image.row(y + 12) + 3 * left);
      std::fill_n(map.values.begin() + 80 * (y + 12) + left, 24, 1 + static_cast<float>(frame) / 4);
    }
    REQUIRE(WriteImage(folder.file("in/" + std::to_string(frame) + ".png"), image) == "");
    REQUIRE(WritePfm(folder.file("d/" + std::to_string(frame) + ".pfm"), map) == "");
    for (float& disparity : map.values) disparity *= frame % 2 == 0 ? 1.0F : 1.2F;
    REQUIRE(WritePfm(folder.file("s/" + std::to_string(frame) + ".pfm"), map) == "");
  }
}

TEST_CASE("sessions: every session of sessions.txt succeeds") {
  RunSessions("programs/sessions.txt");
}

TEST_CASE("sessions: every session of video_sessions.txt succeeds") {
  RunSessions("programs/video_sessions.txt",
              {{"clip", MakeClip}, {"linear", MakeLinear}, {"walk", MakeWalk}});
}

}  // namespace
}  // namespace starfocus::sessions_program_test
