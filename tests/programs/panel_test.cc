// SPDX-License-Identifier: Apache-2.0
// Tests the knob and the buttons with clean and bouncing sequences of edges, and with sequences
// that lack edges.
#include "examples/board/panel.h"

#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "examples/board/framebuffer.h"
#include "tests/support/error_line.h"
#include "tests/support/test_scene.h"

namespace starfocus::panel_test {
namespace {

struct EncoderEdge {
  bool of_a, high;
};

// The edges of one detent clockwise. One detent counter-clockwise has the same edges with swapped
// lines.
constexpr EncoderEdge kStep[] = {{true, false}, {false, false}, {true, true}, {false, true}};

std::vector<EncoderEdge> Step(bool clockwise) {
  std::vector<EncoderEdge> edges;
  for (const EncoderEdge& edge : kStep) edges.push_back({edge.of_a == clockwise, edge.high});
  return edges;
}

int Decode(const std::vector<EncoderEdge>& edges, QuadratureDecoder* decoder) {
  int steps = 0;
  for (const EncoderEdge& edge : edges) {
    steps += edge.of_a ? decoder->EdgeOfA(edge.high) : decoder->EdgeOfB(edge.high);
  }
  return steps;
}

TEST_CASE("encoder: a step is counted at the last of the four edges of a detent, from any rest") {
  for (const bool rest : {true, false}) {
    QuadratureDecoder decoder(rest, rest);
    for (int i = 0; i < 12; ++i) {
      const bool clockwise = i < 5;
      for (const EncoderEdge& edge : kStep) {
        const int found = Decode({{edge.of_a == clockwise, edge.high == rest}}, &decoder);
        CHECK(found == (&edge == &kStep[3] ? (clockwise ? 1 : -1) : 0));
      }
    }
  }
}

TEST_CASE("encoder: bouncing contacts, and half a step forward and back, add no steps") {
  test::Random random(5);
  QuadratureDecoder decoder;
  int wanted = 0, got = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool clockwise = random.Int(0, 2) > 0;
    std::vector<EncoderEdge> bouncing;
    for (const EncoderEdge& edge : Step(clockwise)) {
      for (int bounce = random.Int(0, 4); bounce > 0; --bounce) {
        bouncing.push_back(edge);
        bouncing.push_back({edge.of_a, !edge.high});
      }
      bouncing.push_back(edge);
    }
    wanted += clockwise ? 1 : -1;
    got += Decode(bouncing, &decoder);
    CHECK(got == wanted);
    CHECK(Decode({{true, false}, {false, false}, {false, true}, {true, true}}, &decoder) == 0);
  }
}

TEST_CASE("encoder: a lost edge loses at most one step and never adds a wrong step") {
  for (const bool clockwise : {true, false}) {
    for (size_t lost = 0; lost < 4; ++lost) {
      CAPTURE(clockwise);
      CAPTURE(lost);
      QuadratureDecoder decoder;
      const std::vector<EncoderEdge> whole = Step(clockwise);
      std::vector<EncoderEdge> edges = whole;
      edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(lost));
      const int direction = clockwise ? 1 : -1;
      int total = direction * Decode(edges, &decoder);
      CHECK((total == 0 || total == 1));
      // After the lost edge, the next detent may also complete the first detent. From the third
      // detent on, the count must be exact.
      total += direction * Decode(whole, &decoder);
      CHECK((total == 1 || total == 2));
      for (int i = 0; i < 5; ++i) CHECK(direction * Decode(whole, &decoder) == 1);
    }
  }
}

constexpr int64_t kMs = 1000000;

TEST_CASE("button: only edges that start a press count as presses, however contacts bounce") {
  // Each event has a time in ms, "+" for an edge to pressed, "-" for an edge to released or "." for
  // a call of Settle, "!" if a press counts, and "?" if the button is unsettled afterwards.
  const std::pair<const char*, const char*> rows[] = {
      {"the first edge of a press counts immediately", "0+! 100- 200+!"},
      {"the next press counts even if no level has settled", "0+! 3-? 500+!"},
      {"presses count after a lost release and a lost press", "0+! 500+! 900- 990- 1500+!"},
      {"bouncing of press and release makes one press", "0+! 1-? 2+ 50- 51+? 52- 1000+!"},
      {"a tap shorter than the bouncing time is recognised as released", "0+! 3-? 9.? 10. 11+!"},
      {"a press while the release bounces counts as the button settles",
       "0+! 100- 105+? 110.! 300-"}};
  for (const auto& row : rows) {
    const std::string what = row.first;
    CAPTURE(what);
    Debouncer button(10 * kMs);
    std::istringstream events(row.second);
    for (std::string event; events >> event;) {
      CAPTURE(event);
      const size_t at = event.find_first_of("+-.");
      const int64_t time = std::stoi(event) * kMs;
      const bool counts =
          event[at] == '.' ? button.Settle(time) : button.Edge(event[at] == '+', time);
      CHECK(counts == Contains(event, "!"));
      CHECK(button.unsettled() == Contains(event, "?"));
    }
  }
}

TEST_CASE(
    "panel: edges are passed to their controls, and buttons connect to ground or to the supply") {
  const PanelLines lines = {4, 5, 6, 7}, alone = {-1, -1, -1, 3};
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
  CHECK(alone.All() == std::vector<int>{3});
  Panel supply(alone, false, 10 * kMs, true, true);
  CHECK(supply.Edge(3, true, 20 * kMs).shutters == 1);
  CHECK_FALSE(supply.Edge(3, false, 120 * kMs).any());
}

TEST_CASE(
    "framebuffer: the picture is centred, cropped, and converted to the pixels of the screen") {
  Image picture(2, 1);
  picture.pixels = {255, 128, 8, 1, 2, 3};
  std::vector<uint8_t> memory(3 * 20, 0xCD);
  Draw(picture, {memory.data(), 4, 3, 20, 4, {16, 8}, {8, 8}, {0, 8}});
  const std::vector<uint8_t> row = {0, 0, 0, 0, 8, 128, 255,  0,    3,    2,
                                    1, 0, 0, 0, 0, 0,   0xCD, 0xCD, 0xCD, 0xCD};
  CHECK(std::vector<uint8_t>(memory.begin() + 20, memory.begin() + 40) == row);
  CHECK(memory[0] == 0);
  CHECK(memory[40] == 0);
  // The screen shows one pixel of a picture of two pixels. Cropping half a pixel on the left rounds
  // to 0, so the left pixel is visible.
  Draw(picture, {memory.data(), 1, 1, 20, 2, {11, 5}, {5, 6}, {0, 5}});
  const uint32_t pixel = (255u >> 3 << 11) | (128u >> 2 << 5) | (8u >> 3);
  CHECK(memory[0] == (pixel & 255));
  CHECK(memory[1] == pixel >> 8);
  CHECK(memory[2] == 0);
}

TEST_CASE("framebuffer: files that are not framebuffers are rejected") {
  for (const auto& [path, error] :
       {std::pair{"/nowhere/fb0", "cannot open framebuffer /nowhere/fb0: "},
        {"/dev/null", "/dev/null: expected"}}) {
    CHECK(ShowOnFramebuffer(path, Image(1, 1)).line().rfind(error, 0) == 0);
  }
}

}  // namespace
}  // namespace starfocus::panel_test
