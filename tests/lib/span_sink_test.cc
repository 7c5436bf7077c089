// SPDX-License-Identifier: Apache-2.0
// Tests the span sink on surfaces, mixed pixels and holes with a rim.
#include "lib/line_scan/span_sink.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "simd/kernels.h"
#include "tests/support/test_scene.h"

namespace span_sink_test {
namespace {

using namespace starfocus::simd;

constexpr int kLength = 12;
constexpr uint32_t kBlendOne = 1 << starfocus::simd::kBlendBits;
constexpr double kRounding = 0.5 / 128;  // largest rounding error of light, in grey levels
constexpr int16_t kUntouched = 0x5A5A;

// Fills a hole with one grey level, and records the surface behind the hole.
struct GrayHoles {
  int level;
  mutable int disparity = 0;
  mutable int red = 0;  // red level of the surface behind the hole, 0 to 255

  void Fill(int32_t begin, int32_t end, int32_t behind, const int16_t* colour, int16_t* out) const {
    std::fill_n(out, 3 * (end - begin), int16_t(level << kLightBits));
    disparity = behind;
    red = colour[0] >> kLightBits;
  }
};

// A line whose pixel x has level 20 x + c in channel c, and disparity 100 + x.
struct Drawing {
  static constexpr int kBegin = 3;  // the first rendered pixel

  explicit Drawing(int level) : holes{level}, rgb(3 * kLength + kPadding) {
    for (int x = 0; x < kLength; ++x) {
      for (int c = 0; c < 3; ++c) rgb[size_t(3 * x + c)] = int16_t((20 * x + c) << kLightBits);
      depths.push_back(int16_t(100 + x));
    }
  }

  // With `weight` kBlendOne, blends colours and disparities. With any other weight, accumulates
  // colours without disparities.
  template <class Draw>
  void Run(uint32_t weight, const Draw& draw) {
    const starfocus::Line line = {rgb.data(), depths.data(), 1, kLength, nullptr, 0};
    std::vector<Span> spans(starfocus::kSpanCapacity);
    std::vector<int16_t> pixels(3 * kLength);
    starfocus::LineScanScratch scratch = {};
    scratch.kernels = &ReferenceLineScanKernels();
    scratch.spans = spans.data();
    scratch.holes = pixels.data();
    scratch.hole_samples = pixels.size();
    const bool blends = weight == kBlendOne;
    starfocus::SpanList list = blends
                                   ? starfocus::SpanList(scratch, line_.data())
                                   : starfocus::SpanList(ReferenceKernels(), scratch, sums.data());
    starfocus::SpanSink<GrayHoles> sink(line, kBegin, 0, weight,
                                        blends ? disparity.data() : nullptr, holes, &list);
    draw(&sink);
    list.Flush();
  }

  double Level(int p) const { return std::ldexp(line_[size_t(3 * (p - kBegin))], -kLightBits); }
  bool Untouched(int p) const { return line_[size_t(3 * (p - kBegin))] == kUntouched; }
  int Disparity(int p) const { return disparity[size_t(p - kBegin)]; }
  double Sum(int p) const { return std::ldexp(sums[size_t(3 * (p - kBegin))], -kLightBits); }

  GrayHoles holes;
  std::vector<int16_t> rgb;
  std::vector<int16_t> depths;
  std::vector<int16_t> line_ = std::vector<int16_t>(3 * kLength + kPadding, kUntouched);
  std::vector<int16_t> disparity = std::vector<int16_t>(kLength, 0x5A5A);
  std::vector<uint32_t> sums = std::vector<uint32_t>(3 * kLength + kPadding);
};

TEST_CASE(
    "span sink: a mixed pixel has parts of two colours and the disparity of the first pixel") {
  for (const int other : {1, 6, 9}) {  // Second pixel of the mixture.
    for (const int weight : {1, 64, 128}) {
      const auto draw = [&](auto* sink) { sink->Mix(5, 4, other, weight); };
      const double exact = 80 + (20.0 * other - 80) * weight / 256;
      Drawing blended(0);
      blended.Run(kBlendOne, draw);
      CAPTURES(other, weight);
      CHECK(std::fabs(blended.Level(5) - exact) <= kRounding);
      CHECK(blended.Disparity(5) == 104);
      CHECK(blended.Disparity(4) == 0x5A5A);
      CHECK(blended.Untouched(4));
      CHECK(blended.Untouched(6));
      Drawing summed(0);
      summed.Run(1024, draw);
      CHECK(summed.Sum(5) == 1024 * exact);
      CHECK(summed.Sum(4) == 0);
    }
  }
}

TEST_CASE("span sink: the rim of a hole is mixed, with the disparity of the larger part") {
  struct Case {
    int pixel, rim, at;  // Pixel and rim of the line, and pixel of the view.
  };
  for (const Case& c : {Case{8, 2, 4}, Case{2, 8, 7}}) {
    for (const int covered : {1, 127, 128, 129, 255}) {
      Drawing drawing(200);
      const auto draw = [&](auto* sink) { sink->Hole(4, 8, c.pixel, c.rim, covered); };
      drawing.Run(kBlendOne, draw);
      CAPTURES(c.rim, covered);
      CHECK(drawing.holes.disparity == 100 + c.pixel);
      CHECK(drawing.holes.red == 20 * c.pixel);
      for (int p = 4; p < 8; ++p) {
        const bool rim = p == c.at;
        const double exact = rim ? 200 + (20.0 * c.rim - 200) * covered / 256 : 200;
        CAPTURE(p);
        CHECK(std::fabs(drawing.Level(p) - exact) <= kRounding);
        CHECK(drawing.Disparity(p) == 100 + (rim && covered > 128 ? c.rim : c.pixel));
      }
      CHECK(drawing.Untouched(8));
      Drawing summed(200);
      summed.Run(1024, draw);
      CHECK(std::fabs(summed.Sum(c.at) / 1024 - drawing.Level(c.at)) < 1e-9);
    }
  }
}

TEST_CASE("span sink: a hole without a rim and a surface with its neighbours are drawn") {
  Drawing drawing(200);
  drawing.Run(kBlendOne, [](auto* sink) {
    sink->Surface(3, 6, 4, -1, int(kBlendOne) / 4);
    sink->Hole(6, 8, 1, -1, 0);
    sink->Surface(8, 10, 9, 1, 0);
  });
  for (int p = 3; p < 6; ++p) {
    CHECK(drawing.Level(p) == 20 * (p + 1) - 5);
    CHECK(drawing.Disparity(p) == 100 + p + 1);
  }
  for (int p = 6; p < 8; ++p) {
    CHECK(drawing.Level(p) == 200);
    CHECK(drawing.Disparity(p) == 101);
  }
  for (int p = 8; p < 10; ++p) {
    CHECK(drawing.Level(p) == 20 * (p + 1));
    CHECK(drawing.Disparity(p) == 100 + p + 1);
  }
}

}  // namespace
}  // namespace span_sink_test
