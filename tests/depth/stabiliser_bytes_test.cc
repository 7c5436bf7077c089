// SPDX-License-Identifier: Apache-2.0
// Stabilised maps and followed subjects of a synthetic video: a textured square in front of a
// textured wall, both of which move by whole pixels, so that the exact maps are known.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "starfocus/video.h"
#include "tests/operations/operations.h"
#include "tests/support/test_scene.h"

namespace stabiliser_test {
namespace {

constexpr float kNear = 9, kFar = -2;

// A frame, and what is true of it.
struct Frame {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;
  std::vector<float> exact, map;
  std::vector<uint8_t> coverage;

  size_t At(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
};

// A world in which the square and the wall move by (dx, dy) pixels a frame.
struct World {
  int width = 150, height = 90, side = 40;
  int square_dx = 4, square_dy = 1, wall_dx = -2, wall_dy = 0;

  // Returns a code of a smooth texture at a place of a surface, computed without rounding.
  static uint8_t Texture(int x, int y, int surface, int channel) {
    const auto wave = [](int phase) { return std::abs((phase & 127) - 64); };
    const int a = wave(5 * x + 2 * y + 40 * channel), b = wave(3 * y - x + 25 * surface);
    return uint8_t(surface == 1 ? 110 + a + b : 30 + (3 * a + b) / 2);
  }
  bool IsNear(int frame, int x, int y) const {
    const int left = 30 + square_dx * frame, top = 25 + square_dy * frame;
    return x >= left && y >= top && x < left + side && y < top + side;
  }
  Frame Make(int frame) const {
    Frame made;
    made.width = width;
    made.height = height;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool near = IsNear(frame, x, y);
        const int u = x - frame * (near ? square_dx : wall_dx);
        const int v = y - frame * (near ? square_dy : wall_dy);
        for (int c = 0; c < 3; ++c) made.rgb.push_back(Texture(u, v, near ? 1 : 0, c));
        made.exact.push_back(near ? kNear : kFar);
      }
    }
    made.map = made.exact;
    return made;
  }
};

// A stabiliser with its memory.
struct Video {
  Video(int width, int height, int workers = 1, int poison = 0xA5) {
    starfocus::Config config;
    config.width = width;
    config.height = height;
    config.disparity_min = -20;
    config.disparity_max = 20;
    config.max_workers = workers;
    size_t bytes = 0;
    REQUIRE(starfocus_stabiliser_size(&config, &bytes, nullptr) == STARFOCUS_OK);
    CHECK(bytes < 40 * size_t(width + 40) * size_t(height + 40) + 20000);
    memory.reset(::operator new (bytes, std::align_val_t{STARFOCUS_ALIGNMENT}));
    std::memset(memory.get(), poison, bytes);
    REQUIRE(starfocus_stabiliser_init(&config, memory.get(), bytes, &stabiliser, nullptr) ==
            STARFOCUS_OK);
  }

  // Returns the stabilised map of a frame.
  std::vector<float> Next(const Frame& frame, const starfocus_callbacks* callbacks = nullptr) {
    std::vector<float> out(frame.map.size());
    confidence.assign(out.size(), 77);
    coverage.assign(frame.coverage.size(), 77);
    starfocus_light_field field = starfocus::NewLightField();
    const size_t width = size_t(frame.width);
    field.views[0] = starfocus_image_rgb(frame.rgb.data(), 3 * width);
    field.depth = starfocus_depth_float(frame.map.data(), 4 * width, frame.width, frame.height);
    starfocus_disparity_output map = {};
    map.disparity = out.data();
    map.disparity_stride = 4 * width;
    map.confidence = confidence.data();
    map.confidence_stride = width;
    if (!frame.coverage.empty()) {
      field.coverage = frame.coverage.data();
      map.coverage = coverage.data();
      field.coverage_stride = map.coverage_stride = width;
    }
    status = starfocus_stabilise_disparity(stabiliser, callbacks, &field, &map, &report);
    CHECK(map.has_coverage == (frame.coverage.empty() || status != STARFOCUS_OK ? 0 : 1));
    return out;
  }

  struct Free {
    void operator()(void* of) const {
      ::operator delete (of, std::align_val_t{STARFOCUS_ALIGNMENT});
    }
  };
  std::unique_ptr<void, Free> memory;
  starfocus_stabiliser* stabiliser = nullptr;
  starfocus_status status = STARFOCUS_OK;
  starfocus_stabiliser_report report = {};
  std::vector<uint8_t> confidence, coverage;
};

double MeanError(const Frame& frame, const std::vector<float>& map) {
  double sum = 0;
  for (size_t n = 0; n < map.size(); ++n) sum += std::fabs(double(map[n]) - frame.exact[n]);
  return sum / double(map.size());
}

// Returns the share of pixels whose surface is wrong.
double WrongShare(const Frame& frame, const std::vector<float>& map) {
  int wrong = 0;
  for (size_t n = 0; n < map.size(); ++n) wrong += std::fabs(map[n] - frame.exact[n]) > 4 ? 1 : 0;
  return wrong / double(map.size());
}

TEST_CASE("stabiliser: exact maps of a moving scene stay exact") {
  const World world;
  Video video(world.width, world.height);
  for (int k = 0; k < 6; ++k) {
    const Frame frame = world.Make(k);
    const std::vector<float> map = video.Next(frame);
    CAPTURE(k);
    CHECK(WrongShare(frame, map) < 0.0005);
    CHECK(MeanError(frame, map) < 0.01);
    CHECK(video.report.cut == 0);
    if (k > 0) CHECK(double(video.report.followed) > 0.9 * world.width * world.height);
  }
}

TEST_CASE("stabiliser: errors that differ from frame to frame average out") {
  const World world;
  test::Random random(5);
  Video video(world.width, world.height);
  double before = 0, after = 0, wrong_before = 0, wrong_after = 0;
  for (int k = 0; k < 10; ++k) {
    Frame frame = world.Make(k);
    // An offset of the map, and an outline that grows or shrinks.
    const float offset = float(random.Real(-0.8, 0.8));
    World other = world;
    const int grow = random.Int(-2, 2);
    other.side += 2 * grow;
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        frame.map[frame.At(x, y)] = (other.IsNear(k, x + grow, y + grow) ? kNear : kFar) + offset;
      }
    }
    const std::vector<float> map = video.Next(frame);
    if (k < 5) continue;
    before += MeanError(frame, frame.map);
    after += MeanError(frame, map);
    wrong_before += WrongShare(frame, frame.map);
    wrong_after += WrongShare(frame, map);
  }
  CHECK(after < 0.6 * before);
  CHECK(wrong_after < 0.5 * wrong_before);
}

TEST_CASE("stabiliser: the scale of maps is that of the frames before") {
  const World world;
  Video video(world.width, world.height);
  for (int k = 0; k < 9; ++k) video.Next(world.Make(k));
  Frame frame = world.Make(9);
  for (float& d : frame.map) d = 1.1F * d + 0.5F;
  const std::vector<float> map = video.Next(frame);
  CHECK(MeanError(frame, frame.map) > 0.4);
  CHECK(MeanError(frame, map) < 0.15);
  CHECK(video.report.scale == doctest::Approx(1 / 1.1).epsilon(0.02));
}

// A line through noisy disparities of one surface is flatter than their scale.
TEST_CASE("stabiliser: noise of a flat scene does not change the scale of maps") {
  World world;
  const int side = world.side;
  test::Random random(5);
  Video video(world.width, world.height);
  for (int k = 0; k < 12; ++k) {
    world.side = k < 11 ? 0 : side;
    Frame frame = world.Make(k);
    for (float& d : frame.map) d += float(random.Real(-1, 1));
    const std::vector<float> map = video.Next(frame);
    CAPTURE(k);
    CHECK(video.report.scale == doctest::Approx(1).epsilon(0.03));
    if (k == 11) CHECK(MeanError(frame, map) < 0.4);
  }
}

TEST_CASE("stabiliser: a cut starts anew, and so does a restart") {
  const World world;
  Video video(world.width, world.height);
  for (int k = 0; k < 3; ++k) video.Next(world.Make(k));
  Frame cut = world.Make(0);
  test::Random random(2);
  for (uint8_t& code : cut.rgb) code = random.Byte();
  for (float& d : cut.map) d = 5;
  CHECK(video.Next(cut) == cut.map);
  CHECK(video.report.cut == 1);
  CHECK(video.report.followed == 0);
  starfocus_stabiliser_restart(video.stabiliser);
  for (float& d : cut.map) d = 7;
  CHECK(video.Next(cut) == cut.map);
  CHECK(video.report.cut == 0);
}

TEST_CASE("stabiliser: a surface that appears keeps its map, and unknown pixels keep theirs") {
  World world;
  world.square_dx = 6;
  Video video(world.width, world.height);
  for (int k = 0; k < 3; ++k) video.Next(world.Make(k));
  Frame frame = world.Make(3);
  const size_t middle = frame.At(30 + 18 + 20, 50), beside = frame.At(30 + 18 - 3, 50);
  frame.map[middle] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> map = video.Next(frame);
  CHECK(map[middle] == kNear);
  CHECK(map[beside] == kFar);
  CHECK(video.confidence[middle] > 200);
  Video fresh(world.width, world.height);
  CHECK(std::isnan(fresh.Next(frame)[middle]));
}

TEST_CASE("stabiliser: coverage is averaged where a surface continues") {
  const World world;
  Video video(world.width, world.height);
  for (const int value : {0, 90, 255}) {
    Frame frame = world.Make(0);
    frame.coverage.assign(frame.map.size(), uint8_t(value));
    video.Next(frame);
    const int expected = value == 0 ? 0 : value == 90 ? 45 : 115;
    CHECK(video.coverage[frame.At(75, 60)] == expected);
  }
}

TEST_CASE("stabiliser: coverage is not averaged with that of a frame without coverage") {
  const World world;
  Video video(world.width, world.height);
  Frame frame = world.Make(0);
  video.Next(frame);
  frame.coverage.assign(frame.map.size(), 200);
  video.Next(frame);
  CHECK(video.coverage == frame.coverage);
}

TEST_CASE("stabiliser: bytes do not depend on workers, memory or failed calls") {
  const World world;
  test::Random random(8);
  Video one(world.width, world.height), many(world.width, world.height, 5, 0);
  properties::ShuffledRunner runner = {5};
  const starfocus_callbacks callbacks = test::RunBy(properties::ShuffledRunner::Run, &runner);
  const starfocus_callbacks failing = test::RunBy(
      [](void*, starfocus_job job, void* data, int32_t count) {
        for (int32_t k = 0; k < count / 2; ++k) job(data, k, 0);
        return 1;
      },
      nullptr);
  uint64_t checksum = 0;
  for (int k = 0; k < 4; ++k) {
    Frame frame = world.Make(k);
    for (float& d : frame.map) d += float(random.Int(-64, 64)) / 64;
    const std::vector<float> expected = one.Next(frame);
    many.Next(frame, &failing);
    CHECK(many.status == STARFOCUS_ERROR_RUNNER);
    CHECK(many.Next(frame, &callbacks) == expected);
    CHECK(many.confidence == one.confidence);
    for (const float d : expected) checksum = 31 * checksum + uint64_t(int64_t(d * 64) + 4096);
  }
  CHECK(checksum == 16511006968239513453u);  // on every machine
}

TEST_CASE("stabiliser: small and odd sizes") {
  for (const int width : {1, 7, 16, 33}) {
    for (const int height : {1, 15, 50}) {
      World world;
      world.width = width;
      world.height = height;
      Video video(width, height);
      for (int k = 0; k < 3; ++k) {
        const Frame frame = world.Make(k);
        const std::vector<float> map = video.Next(frame);
        CAPTURES(width, height, k);
        CHECK(WrongShare(frame, map) < 0.2);
      }
    }
  }
}

TEST_CASE("tracking: the focus follows a subject until it leaves, and finds it again") {
  World world;
  world.width = 260;
  Video video(world.width, world.height);
  starfocus_track track = {};
  CHECK(starfocus_track_begin(video.stabiliser, 50, 45, &track) == STARFOCUS_ERROR_STATE);
  video.Next(world.Make(0));
  REQUIRE(starfocus_track_begin(video.stabiliser, 50, 45, &track) == STARFOCUS_OK);
  CHECK(track.focus == kNear);
  // A tap on an unknown pixel focuses on what is known around it.
  Frame unknown = world.Make(0);
  unknown.map[unknown.At(50, 45)] = std::numeric_limits<float>::quiet_NaN();
  Video other(world.width, world.height);
  other.Next(unknown);
  starfocus_track tapped = {};
  REQUIRE(starfocus_track_begin(other.stabiliser, 50, 45, &tapped) == STARFOCUS_OK);
  CHECK(tapped.focus == kNear);
  for (int k = 1; k < 20; ++k) {
    video.Next(world.Make(k));
    REQUIRE(starfocus_track_focus(video.stabiliser, &track) == STARFOCUS_OK);
    CAPTURE(k);
    CHECK(track.lost == 0);
    CHECK(track.focus == kNear);
    CHECK(std::abs(track.x - (50 + 4 * k)) <= 1);
    CHECK(std::abs(track.y - (45 + k)) <= 1);
  }
  // The square is absent for two frames.
  World empty = world;
  empty.side = 0;
  for (int k = 20; k < 22; ++k) {
    video.Next(empty.Make(k));
    REQUIRE(starfocus_track_focus(video.stabiliser, &track) == STARFOCUS_OK);
    CHECK(track.lost == k - 19);
    CHECK(track.focus == kNear);
  }
  world.square_dx = world.square_dy = 0;
  Frame back = world.Make(0);
  World placed = world;
  video.Next(placed.Make(0));
  track.x = 52;
  track.y = 47;
  REQUIRE(starfocus_track_focus(video.stabiliser, &track) == STARFOCUS_OK);
  CHECK(track.lost == 0);
}

TEST_CASE("stabiliser: bad arguments have clear errors") {
  const World world;
  Video video(world.width, world.height);
  Frame frame = world.Make(0);
  frame.map[7] = 21;
  video.Next(frame);
  CHECK(video.status == STARFOCUS_ERROR_DISPARITY);
  const starfocus_problem* problem = starfocus_stabiliser_problem(video.stabiliser);
  CHECK(std::strcmp(problem->field, "disparity") == 0);
  starfocus_light_field field = starfocus::NewLightField();
  starfocus_disparity_output map = {};
  CHECK(starfocus_stabilise_disparity(nullptr, nullptr, &field, &map, nullptr) ==
        STARFOCUS_ERROR_NULL);
  CHECK(starfocus_stabilise_disparity(video.stabiliser, nullptr, nullptr, &map, nullptr) ==
        STARFOCUS_ERROR_NULL);
  CHECK(starfocus_stabilise_disparity(video.stabiliser, nullptr, &field, &map, nullptr) ==
        STARFOCUS_ERROR_NULL);
  starfocus_track track = {};
  video.Next(world.Make(0));
  CHECK(starfocus_track_begin(video.stabiliser, 150, 0, &track) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_track_begin(video.stabiliser, 0, 0, nullptr) == STARFOCUS_ERROR_NULL);
}

}  // namespace
}  // namespace stabiliser_test
