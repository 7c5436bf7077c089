// SPDX-License-Identifier: Apache-2.0
// Tests the knob and the buttons with clean and bouncing sequences of edges, and with sequences
// that lack edges.
#include "examples/board/panel.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <vector>

#include "examples/board/framebuffer.h"
#include "tests/support/test_scene.h"

namespace starfocus::controls_test {
namespace {

struct EncoderEdge {
  bool of_a, high;
};

// The edges of one detent clockwise. One detent counter-clockwise has the same edges with swapped
// lines.
constexpr EncoderEdge kStep[] = {{true, false}, {false, false}, {true, true}, {false, true}};

void AddStep(bool clockwise, std::vector<EncoderEdge>* edges) {
  for (const EncoderEdge& edge : kStep) edges->push_back({edge.of_a == clockwise, edge.high});
}

int Decode(const std::vector<EncoderEdge>& edges, QuadratureDecoder* decoder) {
  int steps = 0;
  for (const EncoderEdge& edge : edges) {
    steps += edge.of_a ? decoder->EdgeOfA(edge.high) : decoder->EdgeOfB(edge.high);
  }
  return steps;
}

TEST_CASE("encoder: steps of both directions are counted from any level at rest") {
  for (const bool rest : {true, false}) {
    QuadratureDecoder decoder(rest, rest);
    const auto turn = [&](bool clockwise) {
      std::vector<EncoderEdge> edges;
      AddStep(clockwise, &edges);
      if (!rest) {
        for (EncoderEdge& edge : edges) edge.high = !edge.high;
      }
      return Decode(edges, &decoder);
    };
    for (int i = 0; i < 5; ++i) CHECK(turn(true) == 1);
    for (int i = 0; i < 7; ++i) CHECK(turn(false) == -1);
    CHECK(turn(true) == 1);
  }
}

TEST_CASE("encoder: a step is counted at the last of the four edges of a detent") {
  QuadratureDecoder decoder;
  CHECK(decoder.EdgeOfA(false) == 0);
  CHECK(decoder.EdgeOfB(false) == 0);
  CHECK(decoder.EdgeOfA(true) == 0);
  CHECK(decoder.EdgeOfB(true) == 1);
}

TEST_CASE("encoder: half a step forward and back is not counted") {
  QuadratureDecoder decoder;
  const std::vector<EncoderEdge> edges = {
      {true, false}, {false, false}, {false, true}, {true, true}};
  CHECK(Decode(edges, &decoder) == 0);
  CHECK(Decode({kStep, kStep + 4}, &decoder) == 1);
}

TEST_CASE("encoder: bouncing contacts add no steps") {
  test::Random random(5);
  QuadratureDecoder decoder;
  int wanted = 0, got = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool clockwise = random.Int(0, 2) > 0;
    std::vector<EncoderEdge> clean, bouncing;
    AddStep(clockwise, &clean);
    for (const EncoderEdge& edge : clean) {
      for (int bounce = random.Int(0, 4); bounce > 0; --bounce) {
        bouncing.push_back(edge);
        bouncing.push_back({edge.of_a, !edge.high});
      }
      bouncing.push_back(edge);
    }
    wanted += clockwise ? 1 : -1;
    got += Decode(bouncing, &decoder);
    CHECK(got == wanted);
  }
}

TEST_CASE("encoder: a lost edge loses at most one step and never adds a wrong step") {
  for (const bool clockwise : {true, false}) {
    for (size_t lost = 0; lost < 4; ++lost) {
      CAPTURE(clockwise);
      CAPTURE(lost);
      QuadratureDecoder decoder;
      std::vector<EncoderEdge> edges;
      AddStep(clockwise, &edges);
      edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(lost));
      const int direction = clockwise ? 1 : -1;
      int total = direction * Decode(edges, &decoder);
      CHECK(total >= 0);
      CHECK(total <= 1);
      // After the lost edge, the next detent may also complete the first detent. From the third
      // detent on, the count must be exact.
      std::vector<EncoderEdge> next;
      AddStep(clockwise, &next);
      total += direction * Decode(next, &decoder);
      CHECK(total >= 1);
      CHECK(total <= 2);
      for (int i = 0; i < 5; ++i) CHECK(direction * Decode(next, &decoder) == 1);
    }
  }
}

TEST_CASE("encoder: each lost edge costs at most two steps, and later steps are counted exactly") {
  test::Random random(9);
  QuadratureDecoder decoder;
  int got = 0, lost = 0;
  for (int i = 0; i < 3000; ++i) {
    for (const EncoderEdge& edge : kStep) {
      if (random.Int(0, 99) == 0) {
        ++lost;
      } else {
        got += Decode({edge}, &decoder);
      }
    }
  }
  CHECK(got <= 3000);
  CHECK(got >= 3000 - 2 * lost);
  Decode({kStep, kStep + 4}, &decoder);
  for (int i = 0; i < 10; ++i) CHECK(Decode({kStep, kStep + 4}, &decoder) == 1);
}

constexpr int64_t kMs = 1000000;

// An edge of a button: the time in ms, and the state of the button after the edge. `counts` is true
// if the edge counts as a press.
struct ButtonEdge {
  int ms;
  bool pressed, counts;
};

TEST_CASE("button: only edges that start a press count as presses") {
  const struct {
    const char* what;
    std::vector<ButtonEdge> edges;
  } rows[] = {{"the first edge of a press counts immediately",
               {{0, true, true}, {100, false, false}, {200, true, true}}},
              {"the next press counts even if no level has settled",
               {{0, true, true}, {3, false, false}, {500, true, true}}},
              {"presses count after a lost release and a lost press",
               {{0, true, true},
                {500, true, true},
                {900, false, false},
                {990, false, false},
                {1500, true, true}}}};
  for (const auto& row : rows) {
    CAPTURE(row.what);
    Debouncer button(10 * kMs);
    for (const ButtonEdge& edge : row.edges) {
      CHECK(button.Edge(edge.pressed, edge.ms * kMs) == edge.counts);
    }
  }
}

TEST_CASE("button: bouncing of press and release makes one press") {
  Debouncer button(10 * kMs);
  int presses = 0;
  for (int64_t at : {int64_t{1000}, int64_t{2000}}) {
    const int64_t start = at * kMs;
    for (int i = 0; i < 7; ++i) presses += button.Edge(i % 2 == 0, start + i * kMs);
    for (int i = 0; i < 7; ++i) presses += button.Edge(i % 2 != 0, start + (50 + i) * kMs);
    CHECK(presses == static_cast<int>(at / 1000));
  }
  CHECK_FALSE(button.unsettled());
}

TEST_CASE("button: a tap shorter than the bouncing time is recognised as released") {
  Debouncer button(10 * kMs);
  CHECK(button.Edge(true, 0));
  CHECK_FALSE(button.Edge(false, 3 * kMs));
  CHECK(button.unsettled());
  CHECK(button.Due() == 10 * kMs);
  CHECK_FALSE(button.Settle(9 * kMs));
  CHECK(button.unsettled());
  CHECK_FALSE(button.Settle(10 * kMs));
  CHECK_FALSE(button.unsettled());
  CHECK(button.Edge(true, 11 * kMs));
}

TEST_CASE("button: a press while the release bounces is counted when the button settles") {
  Debouncer button(10 * kMs);
  CHECK(button.Edge(true, 0));
  CHECK_FALSE(button.Edge(false, 100 * kMs));
  CHECK_FALSE(button.Edge(true, 105 * kMs));
  CHECK(button.Settle(110 * kMs));
  CHECK_FALSE(button.Edge(false, 300 * kMs));
}

TEST_CASE("panel: edges are passed to their controls, and buttons may connect to ground") {
  PanelLines lines;
  lines.encoder_a = 4;
  lines.encoder_b = 5;
  lines.aperture = 6;
  lines.shutter = 7;
  CHECK(lines.All() == std::vector<int>{4, 5, 6, 7});
  Panel panel(lines, true, 10 * kMs, true, true);
  CHECK(panel.Wait(0) == -1);
  int steps = 0;
  for (const EncoderEdge& edge : kStep) {
    steps += panel.Edge(edge.of_a ? 4 : 5, edge.high, kMs).focus_steps;
  }
  CHECK(steps == 1);
  CHECK(panel.Edge(7, false, 20 * kMs).shutters == 1);
  CHECK_FALSE(panel.Edge(7, true, 22 * kMs).any());
  CHECK(panel.Wait(25 * kMs) == 5 * kMs);
  CHECK(panel.Wait(40 * kMs) == 0);
  CHECK_FALSE(panel.Settle(40 * kMs).any());
  CHECK(panel.Wait(40 * kMs) == -1);
  CHECK(panel.Edge(6, false, 60 * kMs).apertures == 1);
  CHECK_FALSE(panel.Edge(99, false, 60 * kMs).any());
}

TEST_CASE("panel: buttons may connect to the supply, and controls may be absent") {
  PanelLines lines;
  lines.shutter = 3;
  CHECK(lines.All() == std::vector<int>{3});
  Panel panel(lines, false, 10 * kMs, true, true);
  CHECK(panel.Edge(3, true, 20 * kMs).shutters == 1);
  CHECK_FALSE(panel.Edge(3, false, 120 * kMs).any());
}

TEST_CASE(
    "framebuffer: the picture is centred, cropped, and converted to the pixels of the screen") {
  Image picture(2, 1);
  picture.pixels = {255, 128, 8, 1, 2, 3};
  std::vector<uint8_t> memory(3 * 20, 0xCD);
  Screen screen;
  screen.memory = memory.data();
  screen.width = 4;
  screen.height = 3;
  screen.stride = 20;
  screen.bytes_per_pixel = 4;
  screen.red = {16, 8};
  screen.green = {8, 8};
  screen.blue = {0, 8};
  Draw(picture, screen);
  const uint8_t row[20] = {0, 0, 0, 0, 8, 128, 255,  0,    3,    2,
                           1, 0, 0, 0, 0, 0,   0xCD, 0xCD, 0xCD, 0xCD};
  CHECK(std::vector<uint8_t>(memory.begin() + 20, memory.begin() + 40) ==
        std::vector<uint8_t>(row, row + 20));
  CHECK(memory[0] == 0);
  CHECK(memory[40] == 0);

  screen.width = 1;
  screen.height = 1;
  screen.bytes_per_pixel = 2;
  screen.red = {11, 5};
  screen.green = {5, 6};
  screen.blue = {0, 5};
  // The screen shows one pixel of a picture of two pixels. Cropping half a pixel on the left rounds
  // to 0, so the left pixel is visible.
  Draw(picture, screen);
  const uint32_t pixel = (255u >> 3 << 11) | (128u >> 2 << 5) | (8u >> 3);
  CHECK(memory[0] == (pixel & 255));
  CHECK(memory[1] == pixel >> 8);
  CHECK(memory[2] == 0);
}

TEST_CASE("framebuffer: files that are not framebuffers are rejected") {
  CHECK(ShowOnFramebuffer("/nowhere/fb0", Image(1, 1))
            .line()
            .rfind("cannot open framebuffer /nowhere/fb0: ", 0) == 0);
  CHECK(ShowOnFramebuffer("/dev/null", Image(1, 1)).line().rfind("/dev/null: expected", 0) == 0);
}

}  // namespace
}  // namespace starfocus::controls_test
