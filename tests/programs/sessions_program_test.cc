// SPDX-License-Identifier: Apache-2.0
// Runs the sessions that take little time, and tests the colours of the frames of videos.
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

void WriteDepth(const std::string& path, int frame) {
  GreyImage depth = {kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      depth.levels.push_back(static_cast<uint16_t>(65535 * DepthAt(frame, x, y)));
    }
  }
  REQUIRE(WriteFile(path, EncodeGreyPng(path, depth)) == "");
}

void MakeClip(const TempFolder& folder) {
  fs::create_directory(folder.file("clip"));
  for (int frame = kFirst; frame <= kLast; ++frame) {
    const std::string name = folder.file("clip/frame_" + std::to_string(frame));
    REQUIRE(WriteImage(name + ".png", MakeFrame(frame)) == "");
    WriteDepth(name + "-depth.png", frame);
  }
}

TEST_CASE("sessions: every session of sessions.txt succeeds") {
  RunSessions("programs/sessions.txt");
}

TEST_CASE("sessions: every session of video_sessions.txt succeeds") {
  RunSessions("programs/video_sessions.txt", {{"clip", MakeClip}});
}

TEST_CASE("video: frames keep their colours, and light is averaged as the colours say") {
  TempFolder folder;
  MakeClip(folder);
  const std::string how = " --near white --focus 9";  // blurs by several pixels
  CHECK(Call(folder, "video clip -o srgb" + how).code == 0);
  for (int frame = kFirst; frame <= kLast; ++frame) {
    const std::string path = folder.file("clip/frame_" + std::to_string(frame) + ".png");
    const Bytes png = ValueOf(ReadFile(path));
    std::string text(png.begin(), png.end());
    text.insert(33, photos::Chunk("gAMA", photos::Big(100000, 4)));  // after signature and IHDR
    REQUIRE(WriteFile(path, Bytes(text.begin(), text.end())) == "");
  }
  CHECK(Call(folder, "video clip -o linear" + how).code == 0);
  const auto read = [&](const std::string& path) {
    return ValueOf(DecodeImage(path, ValueOf(ReadFile(folder.file(path)))));
  };
  for (int frame = kFirst; frame <= kLast; ++frame) {
    const std::string name = "/frame_" + std::to_string(frame) + ".png";
    const DecodedPicture linear = read("linear" + name), srgb = read("srgb" + name);
    CHECK(srgb.metadata.icc.empty());
    CHECK(!linear.metadata.icc.empty());
    CHECK(linear.image.pixels != srgb.image.pixels);
  }
  CHECK(Contains(Call(folder, "import clip/frame_8.png lf --near white").err, "colour profile"));
  REQUIRE(WriteImage(folder.file("clip/frame_9.png"), MakeFrame(9)) == "");
  const Outcome mixed = Call(folder, "video clip -o mixed" + how);
  CHECK(mixed.code == 1);
  CHECK(Contains(mixed.err, "frame_9.png: expected light coded as in the first frame"));
  CHECK(!fs::exists(folder.file("mixed")));
  CHECK(!Contains(Call(folder, "import clip/frame_9.png lf2 --near white").err, "profile"));
}

}  // namespace
}  // namespace starfocus::sessions_program_test
