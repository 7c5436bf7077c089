// SPDX-License-Identifier: Apache-2.0
// Compares the reference kernels with values computed by hand. kernels_bytes_test.cc compares all
// SIMD targets with the references.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lib/io/layers.h"
#include "simd/kernels.h"
#include "tests/kernels/check_kernels.h"
#include "tests/support/test_scene.h"

namespace kernel_definitions_test {
namespace {

using namespace starfocus::simd;
using test::CheckValues;

TEST_CASE(
    "kernel definitions: kernels for spans, composites, discs and disparities return values "
    "computed by hand") {
  const int16_t source[] = {10, 20, 30, 40, 50, 60, 70, 80, 32640};
  const Span blend = {source + 3, 1, 3, 12288, 4096, 3};
  int16_t line[5] = {1, 1, 1, 1, 1};
  ReferenceLineScanKernels().Blend(&blend, 1, line);
  // The first blended sample is (3 * 40 + 70) / 4 = 47.5, rounded half up.
  CheckValues("blend", line, {1, 48, 58, 8205, 1});
  const Span span = {source + 3, 1, 3, 192, 64, 3};
  uint32_t sums[5] = {5, 5, 5, 5, 5};
  ReferenceKernels().Accumulate(&span, 1, sums);
  CheckValues("accumulate", sums,
              {5, 5 + 192 * 40 + 64 * 70, 5 + 192 * 50 + 64 * 80, 5 + 192 * 60 + 64 * 32640, 5});
  const uint32_t wide[3] = {uint32_t{255} << 24, (7u << 24) + (1u << 23),
                            (7u << 24) + (1u << 23) - 1};
  uint8_t out[3];
  ReferenceKernels().Finish(wide, 3, 24, {nullptr, nullptr}, out);
  CheckValues("finish", out, {255, 8, 7});
  // Red light of two pixels, in planes of 16 pixels.
  const uint32_t stack[4 * 16] = {3 << 16, 3 << 16};
  std::vector<uint32_t> covered(stack, stack + 4 * 16);
  covered[3 * 16] = 12 << 16;
  covered[3 * 16 + 1] = 99;
  const int16_t centre[6] = {9 << 7, 9 << 7, 9 << 7, 5 << 7, 6 << 7, 7 << 7};
  uint32_t accumulators[6];
  ReferenceKernels().FinishComposite(covered.data(), 16, centre, 100, 16, 2, accumulators);
  CHECK(accumulators[0] == 64 << 16);
  CHECK(accumulators[1] == 0);
  CHECK(accumulators[3] == 5 << 16);
  CHECK(accumulators[5] == 7 << 16);
  const int16_t rows[3][9] = {{128, 0, 0, 256, 0, 0, 384, 0, 0},
                              {512, 0, 0, 6400, 0, 0, 768, 0, 0},
                              {896, 0, 0, 1024, 0, 0, 1152, 0, 0}};
  const uint16_t ring[3] = {4, 2, 1};  // weights of centre, sides and corners; sum 16
  uint8_t disc[2] = {0, 77};
  ReferenceKernels().FilterDisc({&rows[1][3], 9, 1, 1}, {1, 4, ring}, {nullptr, nullptr}, disc, 9);
  CheckValues("disc", disc, {(4 * 50 + 2 * (2 + 4 + 6 + 8) + 1 + 3 + 7 + 9 + 8) / 16, 77});
  int16_t sample[2] = {0, 77};
  ReferenceKernels().FilterDiscLayer({&rows[1][3], 9, 1, 1}, {1, 4, ring}, sample, 9);
  CheckValues("disc of a layer", sample,
              {(64 * (4 * 50 + 2 * (2 + 4 + 6 + 8) + 1 + 3 + 7 + 9) + 8) / 16, 77});
  const float disparity[4] = {0.0078125f, -0.0078125f, -500, 500};
  int16_t converted[4];
  CHECK(ReferenceKernels().ConvertDisparity(disparity, 4, -500, 500, converted));
  CheckValues("disparities", converted, {1, 0, -32000, 32000});
}

TEST_CASE(
    "kernel definitions: Decode, Encode and Finish convert light and codes as computed by hand") {
  int16_t table[256] = {};
  for (int code = 0; code < 256; ++code) table[code] = int16_t(code * code / 2);
  std::vector<uint16_t> entries(kEncodeEntries, 3 << 4);
  entries[0] = (2 << 4) + 16 - 5;  // light below 5 has code 2, and light from 5 has code 3
  const Encoding encoding = {table, entries.data()};
  const uint8_t codes[3] = {0, 10, 255};
  int16_t light[3];
  ReferenceKernels().Decode(codes, 3, encoding, light);
  CheckValues("decode", light, {0, 50, 32512});
  const int16_t levels[4] = {4, 5, 7, 32640};
  uint8_t out[4];
  ReferenceKernels().Encode(levels, 4, encoding, out);
  CheckValues("encode", out, {2, 3, 3, 3});
  const uint32_t sums[2] = {(4 << 3) + 3, (4 << 3) + 4};  // light just below 4.5, and light 4.5
  ReferenceKernels().Finish(sums, 2, 10, encoding, out);
  CheckValues("finish", out, {2, 3});
  const int16_t halves[2] = {(7 << 7) + 63, (7 << 7) + 64};
  ReferenceKernels().Encode(halves, 2, {nullptr, nullptr}, out);
  CheckValues("halves", out, {7, 8});
}

TEST_CASE("kernel definitions: FindRanges returns values computed by hand") {
  int16_t in[2 * 20] = {};
  for (int16_t& d : in) d = INT16_MIN;
  DisparityRange ranges[2];
  ReferenceKernels().FindRanges(in, 20, 2, 17, ranges);
  CHECK(ranges[0].low > ranges[0].high);
  in[3] = 8, in[20 + 15] = -32767, in[16] = 32767, in[17] = 0;
  ReferenceKernels().FindRanges(in, 20, 2, 17, ranges);
  CHECK(ranges[0].low == -32767);
  CHECK(ranges[0].high == 8);
  CHECK(ranges[1].low == 32767);
  CHECK(ranges[1].high == 32767);
}

TEST_CASE("kernel definitions: FindRuns and MeasureCell return values computed by hand") {
  // The kernel reads two lines of five pixels backwards. A difference of 10 is within the limits,
  // and a difference of 11 is not.
  const int16_t lines[5][2] = {{40, -32000}, {11, 32000}, {0, 31995}, {5, 31990}, {-5, 31989}};
  uint16_t starts[2 * kRunLanes], edges[2 * kRunLanes];
  int16_t middles[17 * kRunLanes];
  ReferenceLineScanKernels().FindRuns(lines[4], -2, 5, 2, 10, 10,
                                      RunMarks{starts, edges, middles, kRunLanes});
  CheckValues("starts", starts, {0b11000, 0b11000});
  CheckValues("edges", edges, {0b11000, 0b10000});
  const int expected[5][2] = {{-5, 31989}, {0, 31989}, {0, 31992}, {11, 32000}, {40, -32000}};
  for (size_t q = 0; q < 5; ++q) {
    CheckValues("middles", middles + q * kRunLanes, {expected[q][0], expected[q][1]});
  }

  int16_t line[17] = {};
  line[15] = 20, line[16] = 40;
  ReferenceLineScanKernels().FindRuns(line, 1, 17, 1, 10, 10,
                                      RunMarks{starts, edges, middles, kRunLanes});
  for (const uint16_t* words : {starts, edges}) {
    CHECK(words[0] == 1 << 15);
    CHECK(words[kRunLanes] == 1);
  }

  // The disparities are flat, except for one pixel inside the cell, one pixel in a corner, and one
  // pixel beyond the left side.
  int16_t values[10][10] = {};
  const int16_t* rows[10];
  for (int k = 0; k < 10; ++k) rows[k] = values[k] + 1;
  values[1 + 3][1 + 4] = 97;
  values[1 + 0][1 + 7] = -20;
  values[1 + 5][0] = 500;
  CellMeasure measure;
  ReferenceKernels().MeasureCell(rows, {100, 96, 15, 90}, &measure);
  CheckValues("columns, low", measure.column_low, {0, 0, 0, 0, 0, 0, 0, -20});
  CheckValues("columns, high", measure.column_high, {0, 0, 0, 0, 97, 0, 0, 0});
  CheckValues("rows, low", measure.row_low, {-20, 0, 0, 0, 0, 0, 0, 0});
  CheckValues("rows, high", measure.row_high, {0, 0, 0, 97, 0, 0, 0, 0});
  CHECK(measure.nearest == 3);
  CHECK(measure.edge_low == 97);
  CHECK(measure.edge_high == 500);
  CheckValues("edges", measure.edges, {2, 2});
  CheckValues("gaps", measure.gaps, {2 * 90, 2 * 90});
  CheckValues("slopes", measure.slopes, {15, 15});
  values[1 + 5][0] = 0;
  values[1 + 3][1 + 4] = 96;
  values[1 + 6][1 + 0] = 4;
  values[1 + 7][1 + 3] = 5;
  ReferenceKernels().MeasureCell(rows, {100, 96, 15, 90}, &measure);
  CheckValues("rows, high", measure.row_high, {0, 0, 0, 96, 0, 0, 4, 5});
  CHECK(measure.edge_low == INT16_MAX);
  CHECK(measure.edge_high == INT16_MIN);
  CheckValues("edges", measure.edges, {0, 0});
  CheckValues("slopes", measure.slopes, {3 * 15 + 4 + 2 * 5, 3 * 15 + 2 * 4 + 5});

  // Edges beyond the right and the lower side do not belong to the cell.
  values[1 + 2][1 + 8] = 300;
  values[1 + 8][1 + 0] = 200;
  ReferenceKernels().MeasureCell(rows, {100, 96, 15, 90}, &measure);
  CHECK(measure.edge_low == 200);
  CHECK(measure.edge_high == 300);
  CheckValues("edges", measure.edges, {0, 0});
}

// Halve must return every second pixel of the line that FilterHalfBand returns.
TEST_CASE("kernel definitions: Halve applies the half-band filter at every even pixel") {
  test::Random random(7);
  const Kernels& kernels = ReferenceKernels();
  constexpr size_t kPairs = 20, kKept = kPairs - 3;
  std::vector<int16_t> line(6 * kPairs);
  for (int16_t& sample : line) sample = int16_t(random.Int(0, kLayerWhite));
  std::vector<int16_t> even(3 * kPairs), odd = even, halved(3 * kKept), whole(6 * kPairs);
  kernels.DeinterleavePhases(line.data(), kPairs, even.data(), odd.data());
  kernels.Halve(even.data() + 6, odd.data() + 6, starfocus::kDownFilter, 3 * kKept, halved.data());
  kernels.FilterHalfBand(line.data() + 12, 3, starfocus::kDownFilter, 6 * kKept - 3, INT16_MIN,
                         INT16_MAX, whole.data());
  for (size_t n = 0; n < 3 * kKept; ++n) CHECK(halved[n] == whole[n / 3 * 6 + n % 3]);
}

TEST_CASE("kernel definitions: WidenPhases and Halve return values computed by hand") {
  const uint8_t bytes[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 255};
  int16_t even[6], odd[6];
  ReferenceKernels().WidenPhases(bytes, 2, {nullptr, nullptr}, even, odd);
  CheckValues("even", even, {64, 128, 192, 448, 512, 576});
  CheckValues("odd", odd, {256, 320, 384, 640, 704, kLayerWhite});
  const int16_t beside[10] = {8, 0, 0, 10, 0, 0, 30, 0, 0, 16};
  const int16_t centre = 101;
  int16_t out = 0;
  ReferenceKernels().Halve(&centre, beside + 6, {8192, 4096, 2048}, 1, &out);
  CHECK(out == 64);  // 63.5 rounded half up: 101 / 2 + (10 + 30) / 4 + (8 + 16) / 8
}

}  // namespace
}  // namespace kernel_definitions_test
