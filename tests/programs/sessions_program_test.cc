// SPDX-License-Identifier: Apache-2.0
// Runs the sessions that take little time. Tests the pairing of frames with a folder of depth
// pictures, and the colours of frames.
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

std::string Name(const std::string& pattern, int number) {
  char name[64];
  std::snprintf(name, sizeof(name), pattern.c_str(), number);
  return name;
}

// Writes frames and depth pictures to folders of their own. A pattern contains the number as %d.
void MakeFolders(const TempFolder& folder, const std::string& frames,
                 const std::vector<std::string>& depths) {
  for (const char* name : {"rgb", "depth", "out"}) {
    fs::remove_all(folder.file(name));
    if (name[0] != 'o') fs::create_directory(folder.file(name));
  }
  for (int frame = kFirst; frame <= kLast; ++frame) {
    const std::string number = std::to_string(frame), from = "clip/frame_" + number;
    fs::copy(folder.file(from + ".png"), folder.file("rgb/" + Name(frames, frame)));
    for (const std::string& depth : depths) {
      fs::copy(folder.file(from + "-depth.png"), folder.file("depth/" + Name(depth, frame)));
    }
  }
}

TEST_CASE("video: a folder of depth pictures is paired with the frames by name, then by number") {
  TempFolder folder;
  MakeClip(folder);
  Succeed(folder, "video clip -o true --no-repair --near white --focus-at 16,20");
  // Names of frames, and names of depth pictures. Depth pictures are recognized by their content.
  const std::vector<std::vector<std::string>> rows = {
      {"%05d.png", "%05d.png"},
      {"%05d.png", "%05d.pgm"},
      {"frame_%d.png", "depth_%04d.png"},
      {"frame_%04d.png", "depth_%d.png"},
      {"frame_%d.png", "frame_%02d.png"},
      {"IMG_%03d.PNG", "img_%03d.png"},
      {"%d.png", "%d_depth.png"},
      {"%d.png", "Depth%06d.tif"},
      {"shot_2_%d.png", "shot_02_%d-depth.png"},
      {"shot_2_%d.png", "disp_%04d.png"},
      {"%d.png", "depth_v2_%d.png"},
      {"%d.png", "depth_%d_640x480.png"},
      {"take2_%d.png", "v3_%04d_16bit.png"},
      // By name, although the numbers of other pictures fit, too.
      {"frame_%d.png", "frame_%d.png", "view_%d.png"},
  };
  for (const std::vector<std::string>& row : rows) {
    CAPTURE(row[0]);
    CAPTURE(row[1]);
    MakeFolders(folder, row[0], {row.begin() + 1, row.end()});
    const Outcome outcome =
        Call(folder, "video rgb -o out --depth depth --no-repair --near white --focus-at 16,20");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(Contains(outcome.err, "belong to no frame") == (row.size() > 2));
    for (int frame = kFirst; frame <= kLast && outcome.code == 0; ++frame) {
      const std::string stem = fs::path(Name(row[0], frame)).stem().string();
      CHECK(Text(folder.file("out/" + stem + ".png")) ==
            Text(folder.file("true/frame_" + std::to_string(frame) + ".png")));
    }
  }
}

TEST_CASE("video: frames that a folder of depth pictures does not pair are an error before work") {
  TempFolder folder;
  MakeClip(folder);
  const std::string call = "video rgb -o out --depth depth --near white --focus 1";
  const std::string expected =
      "expected one depth picture with the name or number of the frame in ";
  MakeFolders(folder, "shot_%d.png", {"shot_%d.png"});
  fs::rename(folder.file("depth/shot_10.png"), folder.file("depth/thumb_10.png"));
  CheckRefused(folder, call, "rgb/shot_10.png: " + expected + "depth, found none (3 of 4 frames");
  MakeFolders(folder, "%d.png", {"depth_%d.png"});
  fs::copy(folder.file("depth/depth_8.png"), folder.file("depth/depth_08.png"));
  CheckRefused(folder, call,
               "rgb/8.png: " + expected + "depth, found depth_08.png and depth_8.png");
  MakeFolders(folder, "%d.png", {"%d.png", "%d.npy"});
  CheckRefused(folder, call, "rgb/8.png: " + expected + "depth, found 8.npy and 8.png");
  MakeFolders(folder, "%d.png", {"depth_%d.png", "vis_%d.png"});
  CheckRefused(folder, call, "rgb/8.png: " + expected + "depth, found depth_8.png and vis_8.png");
  MakeFolders(folder, "%d.png", {});
  CheckRefused(folder, call, "depth: expected a folder with depth pictures, found none");
  Succeed(folder, "scene lf --size 40x30 --views 1");
  CheckRefused(folder, "video lf -o out --depth depth --focus 1", "depth");
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
