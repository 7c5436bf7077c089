// Every kernel on every SIMD target of this machine against the plain C++ that defines it.
#include "simd/kernels.h"

#include <doctest/doctest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "lib/engine.h"
#include "tests/simd_targets.h"
#include "tests/test_scene.h"

namespace {

using starfocus::simd::CellLimits;
using starfocus::simd::CellMeasure;
using starfocus::simd::Kernels;
using starfocus::simd::kPadding;
using starfocus::simd::kRunLanes;
using starfocus::simd::kTransposePadding;
using starfocus::simd::ReferenceKernels;
using starfocus::simd::RunLimits;
using starfocus::simd::RunMarks;
using starfocus::simd::Span;

// Lengths from one sample past two of the widest vectors, with all tails.
constexpr int kLongest = 2 * 64 + 3;

std::vector<uint8_t> RandomBytes(size_t size, test::Random* random) {
  std::vector<uint8_t> bytes(size);
  const bool extreme = random->Int(0, 1) == 0;
  for (uint8_t& byte : bytes) byte = extreme ? uint8_t(255 * random->Int(0, 1)) : random->Byte();
  return bytes;
}

// Buffers of spans: one source, and spans that lie side by side in the target.
struct Spans {
  static constexpr int kMargin = 8;  // neighbours, and odd places to start

  // With `blend`, weights sum to 256.
  Spans(int samples, int count, bool blend, test::Random* random)
      : bytes(RandomBytes(size_t(kMargin + samples + kMargin) + kPadding, random)) {
    uint32_t target = uint32_t(random->Int(0, 5));
    for (int i = 0; i < count; ++i) {
      Span span;
      span.source = bytes.data() + kMargin + random->Int(-3, 3);
      span.target = target;
      span.samples = uint32_t(samples);
      const int kind = random->Int(0, 3);
      const int one = blend ? 256 : random->Int(0, 1) == 0 ? 32767 : random->Int(0, 32767);
      const int neighbour = kind == 0 ? 0 : kind == 1 ? one : random->Int(0, one);
      span.neighbour_weight = uint16_t(neighbour);
      span.weight = uint16_t(blend ? one - neighbour : kind == 1 ? 32767 : one);
      span.neighbour_offset = random->Int(0, 1) == 0 ? 3 : -3;
      spans.push_back(span);
      target += uint32_t(samples + random->Int(0, 2));
    }
    end = target;
  }

  std::vector<uint8_t> bytes;
  std::vector<Span> spans;
  size_t end = 0;
};

void TestAccumulate(const Kernels& kernels) {
  test::Random random(1);
  for (int samples = 1; samples <= kLongest; ++samples) {
    for (const int count : {1, 2, 5}) {
      const Spans spans(samples, count, false, &random);
      std::vector<uint32_t> expected(spans.end + kPadding);
      for (uint32_t& value : expected) value = random.Next() >> 4;
      std::vector<uint32_t> got = expected;
      ReferenceKernels().accumulate(spans.spans.data(), spans.spans.size(), expected.data());
      kernels.accumulate(spans.spans.data(), spans.spans.size(), got.data());
      CAPTURE(samples);
      CHECK(got == expected);
    }
  }
}

void TestBlend(const Kernels& kernels) {
  test::Random random(2);
  for (int samples = 1; samples <= kLongest; ++samples) {
    for (const int count : {1, 2, 5}) {
      const Spans spans(samples, count, true, &random);
      std::vector<uint8_t> expected(spans.end + kPadding, test::kPoison);
      std::vector<uint8_t> got = expected;
      ReferenceKernels().blend(spans.spans.data(), spans.spans.size(), expected.data());
      kernels.blend(spans.spans.data(), spans.spans.size(), got.data());
      CAPTURE(samples);
      CHECK(got == expected);
    }
  }
}

void TestFinish(const Kernels& kernels) {
  test::Random random(3);
  for (int shift = 1; shift <= 24; ++shift) {
    for (int count = 1; count <= kLongest; ++count) {
      const size_t start = size_t(random.Int(0, 5));
      std::vector<uint32_t> sums(start + size_t(count) + kPadding);
      const uint32_t largest = uint32_t{255} << shift;
      for (uint32_t& sum : sums) {
        const int kind = random.Int(0, 4);
        const uint32_t half = (uint32_t(random.Int(0, 254)) << shift) + (1u << (shift - 1));
        sum = kind == 0   ? largest
              : kind == 1 ? half
              : kind == 2 ? half - 1
                          : random.Next() % largest;
      }
      std::vector<uint8_t> expected(start + size_t(count) + kPadding, test::kPoison);
      std::vector<uint8_t> got = expected;
      ReferenceKernels().finish(sums.data() + start, size_t(count), shift, expected.data() + start);
      kernels.finish(sums.data() + start, size_t(count), shift, got.data() + start);
      CAPTURE(shift);
      CAPTURE(count);
      CHECK(got == expected);
    }
  }
}

std::vector<float> RandomDisparities(int count, float low, float high, test::Random* random) {
  std::vector<float> disparity(static_cast<size_t>(count));
  for (float& d : disparity) {
    const int kind = random->Int(0, 4);
    const double exact = random->Real(low, high);
    const double tie = (std::floor(exact * 64) + 0.5) / 64;
    d = kind == 0 ? low : kind == 1 ? high : kind == 2 ? float(tie) : float(exact);
    d = std::clamp(d, low, high);
  }
  return disparity;
}

void TestConvert(const Kernels& kernels) {
  test::Random random(4);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float limit : {500.0f, 7.3f, 0.0f}) {
    for (int count = 1; count <= kLongest; ++count) {
      std::vector<float> disparity = RandomDisparities(count, -limit, limit, &random);
      std::vector<int16_t> expected(size_t(count) + 8, 0x5A5A), got = expected;
      CAPTURE(limit);
      CAPTURE(count);
      CHECK(ReferenceKernels().convert_disparity(disparity.data(), size_t(count), -limit, limit,
                                                 expected.data()));
      CHECK(kernels.convert_disparity(disparity.data(), size_t(count), -limit, limit, got.data()));
      CHECK(got == expected);
      for (const float bad : {kNan, kInfinity, -kInfinity, std::nextafter(limit, 1000.0f),
                              std::nextafter(-limit, -1000.0f)}) {
        const size_t place = size_t(random.Int(0, count - 1));
        std::vector<float> spoilt = disparity;
        spoilt[place] = bad;
        CHECK_FALSE(
            kernels.convert_disparity(spoilt.data(), size_t(count), -limit, limit, got.data()));
        CHECK(got[size_t(count)] == 0x5A5A);
      }
    }
  }
}

// --- find_runs ---

// Lines side by side, forwards or backwards, with what kernels may read behind them.
struct Lines {
  Lines(int of_length, int of_count, test::Random* random)
      : length(of_length),
        count(of_count),
        backwards(random->Int(0, 1) == 1),
        step(size_t(of_count + random->Int(0, 9))),
        disparity(size_t(of_length) * step + kPadding / sizeof(int16_t)) {
    const int kind = random->Int(0, 3);
    const int most = kind == 0 ? 32000 : kind == 1 ? 300 : 40;
    for (int16_t& d : disparity) d = int16_t(random->Int(-most, most));
    if (kind != 3) return;
    for (int16_t& d : disparity) d = int16_t(d < 0 ? -32000 : 32000);
  }

  int At(int q, int k) const {
    return disparity[size_t(backwards ? length - 1 - q : q) * step + size_t(k)];
  }

  int length, count;
  bool backwards;
  size_t step;
  std::vector<int16_t> disparity;
};

// Marks of lines, poisoned, with a guard behind each array.
struct Marks {
  static constexpr size_t kGuard = 64;

  Marks(const Lines& lines, size_t more_stride)
      : stride((size_t(lines.count) + kRunLanes - 1) / kRunLanes * kRunLanes + more_stride),
        words(size_t(lines.length + 15) / 16 * stride),
        starts(words + kGuard, 0xCDCD),
        edges(words + kGuard, 0xCDCD),
        middles(size_t(lines.length) * stride + kGuard, 0x5A5A) {}

  void Find(const Kernels& kernels, const Lines& lines, const RunLimits& limits) {
    const int16_t* first =
        lines.disparity.data() + (lines.backwards ? size_t(lines.length - 1) * lines.step : 0);
    const ptrdiff_t step = lines.backwards ? -ptrdiff_t(lines.step) : ptrdiff_t(lines.step);
    kernels.find_runs(first, step, size_t(lines.length), size_t(lines.count), limits,
                      {starts.data(), edges.data(), middles.data(), stride});
  }

  bool Start(int q, int k) const { return Bit(starts, q, k); }
  bool Edge(int q, int k) const { return Bit(edges, q, k); }
  int Middle(int q, int k) const { return middles[size_t(q) * stride + size_t(k)]; }
  bool Bit(const std::vector<uint16_t>& words_of, int q, int k) const {
    return (words_of[size_t(q / 16) * stride + size_t(k)] >> (q % 16) & 1) != 0;
  }

  bool GuardsUntouched() const {
    bool same = true;
    for (size_t i = 0; i < kGuard; ++i) {
      same = same && starts[words + i] == 0xCDCD && edges[words + i] == 0xCDCD &&
             middles[middles.size() - kGuard + i] == 0x5A5A;
    }
    return same;
  }

  // Columns of lines that there are; the others are the kernel's to use.
  static bool Same(const Marks& a, const Marks& b, size_t count) {
    for (size_t i = 0; i < a.middles.size() - kGuard; ++i) {
      if (i % a.stride >= count) continue;
      if (a.middles[i] != b.middles[i]) return false;
      if (i < a.words && (a.starts[i] != b.starts[i] || a.edges[i] != b.edges[i])) return false;
    }
    return true;
  }

  size_t stride, words;
  std::vector<uint16_t> starts, edges;
  std::vector<int16_t> middles;
};

// The definition once more: greedily, position by position.
bool MarksAreRight(const Marks& marks, const Lines& lines, const RunLimits& limits) {
  for (int k = 0; k < lines.count; ++k) {
    int begin = 0;
    for (int q = 0; q < lines.length; ++q) {
      const auto range = [&] {
        int low = lines.At(begin, k), high = low;
        for (int at = begin; at <= q; ++at) {
          low = std::min(low, lines.At(at, k));
          high = std::max(high, lines.At(at, k));
        }
        return std::make_pair(low, high);
      };
      bool start = false;
      if (range().second - range().first > limits.spread) start = true, begin = q;
      const double middle = std::floor((range().first + range().second) / 2.0);
      const bool edge = q > 0 && std::abs(lines.At(q, k) - lines.At(q - 1, k)) > limits.edge;
      if (marks.Start(q, k) != start || marks.Edge(q, k) != edge || marks.Middle(q, k) != middle) {
        return false;
      }
    }
    for (int q = lines.length; q % 16 != 0; ++q) {  // bits of positions that are not there
      if (marks.Start(q, k) || marks.Edge(q, k)) return false;
    }
  }
  return true;
}

RunLimits RandomLimits(test::Random* random) {
  const int kind = random->Int(0, 3);
  const int edge = kind == 0 ? 32766 : kind == 1 ? random->Int(0, 32766) : random->Int(0, 96);
  return {int16_t(random->Int(0, 2) == 0 ? edge : random->Int(0, edge)), int16_t(edge)};
}

void TestFindRuns(const Kernels& kernels) {
  test::Random random(5);
  for (int length = 1; length <= 70; ++length) {
    for (int count = 1; count <= 40; ++count) {
      const Lines lines(length, count, &random);
      const RunLimits limits = RandomLimits(&random);
      Marks expected(lines, kRunLanes * size_t(random.Int(0, 1))), got = expected;
      expected.Find(ReferenceKernels(), lines, limits);
      got.Find(kernels, lines, limits);
      CAPTURE(length);
      CAPTURE(count);
      CAPTURE(limits.spread);
      CAPTURE(limits.edge);
      const bool same = Marks::Same(got, expected, size_t(count));
      CHECK(same);
      CHECK(got.GuardsUntouched());
    }
  }
}

TEST_CASE("kernels: runs by their definition") {
  test::Random random(6);
  for (int round = 0; round < 300; ++round) {
    const Lines lines(random.Int(1, 70), random.Int(1, 40), &random);
    const RunLimits limits = RandomLimits(&random);
    Marks marks(lines, 0);
    marks.Find(ReferenceKernels(), lines, limits);
    const bool right = MarksAreRight(marks, lines, limits);
    CHECK(right);
    CHECK(marks.GuardsUntouched());
  }
}

// --- measure_cell ---

struct CellRows {
  explicit CellRows(test::Random* random) {
    const int kind = random->Int(0, 4);
    const int most = kind == 0 ? 32000 : kind == 1 ? 7000 : kind == 2 ? 200 : 60;
    for (auto& row : values) {
      for (int16_t& d : row) {
        d = int16_t(random->Int(-most, most));
        if (kind == 4) d = int16_t(random->Int(0, 1) == 0 ? -32000 : 32000);
      }
    }
    for (int k = 0; k < 10; ++k) rows[k] = values[k] + 1;
  }
  CellRows(const CellRows&) = delete;

  int At(int x, int y) const { return rows[y + 1][x]; }

  // Columns -1 to 8 of the cell, and what kernels may read behind them.
  int16_t values[10][10 + kPadding / sizeof(int16_t)];
  const int16_t* rows[10];
};

CellLimits RandomCellLimits(test::Random* random) {
  const int kind = random->Int(0, 2);
  CellLimits limits;
  limits.focus = int16_t(kind == 0 ? random->Int(-32768, 32767) : random->Int(-200, 200));
  limits.edge = int16_t(random->Int(0, 3) == 0 ? random->Int(0, 4000) : random->Int(0, 96));
  limits.slope_limit = int16_t(random->Int(0, 3) == 0 ? 32767 : random->Int(1, 96));
  limits.gap_limit = int16_t(random->Int(0, 3) == 0 ? 32767 : random->Int(0, 2000));
  return limits;
}

bool Same(const CellMeasure& a, const CellMeasure& b) {
  return std::equal(a.column_low, a.column_low + 8, b.column_low) &&
         std::equal(a.column_high, a.column_high + 8, b.column_high) &&
         std::equal(a.row_low, a.row_low + 8, b.row_low) &&
         std::equal(a.row_high, a.row_high + 8, b.row_high) && a.nearest == b.nearest &&
         a.edge_low == b.edge_low && a.edge_high == b.edge_high &&
         std::equal(a.slopes, a.slopes + 2, b.slopes) &&
         std::equal(a.edges, a.edges + 2, b.edges) && std::equal(a.gaps, a.gaps + 2, b.gaps);
}

void TestMeasureCell(const Kernels& kernels) {
  test::Random random(7);
  for (int round = 0; round < 5000; ++round) {
    const CellRows rows(&random);
    const CellLimits limits = RandomCellLimits(&random);
    CellMeasure expected, got;
    std::memset(static_cast<void*>(&got), test::kPoison, sizeof(got));
    ReferenceKernels().measure_cell(rows.rows, limits, &expected);
    kernels.measure_cell(rows.rows, limits, &got);
    CAPTURE(round);
    const bool same = Same(got, expected);
    CHECK(same);
  }
}

// The definition once more: over all pairs of pixels that are neighbours.
CellMeasure Measured(const CellRows& rows, const CellLimits& limits) {
  CellMeasure measure = {};
  int nearest = 65535, edge_low = INT16_MAX, edge_high = INT16_MIN;
  for (int k = 0; k < 8; ++k) {
    int low[2] = {32767, 32767}, high[2] = {-32768, -32768};
    for (int other = 0; other < 8; ++other) {
      const int values[2] = {rows.At(k, other), rows.At(other, k)};
      for (int way = 0; way < 2; ++way) {
        low[way] = std::min(low[way], values[way]);
        high[way] = std::max(high[way], values[way]);
      }
      nearest = std::min(nearest, std::abs(values[0] - limits.focus));
    }
    measure.column_low[k] = int16_t(low[0]), measure.column_high[k] = int16_t(high[0]);
    measure.row_low[k] = int16_t(low[1]), measure.row_high[k] = int16_t(high[1]);
  }
  const auto inside = [](int x, int y) { return x >= 0 && x < 8 && y >= 0 && y < 8; };
  for (int y = -1; y <= 8; ++y) {
    for (int x = -1; x <= 8; ++x) {
      for (const bool right : {true, false}) {
        const int to_x = x + right, to_y = y + !right;
        const bool both = inside(x, y) && inside(to_x, to_y);
        if (!inside(x, y) && !inside(to_x, to_y)) continue;
        const int step = std::abs(rows.At(x, y) - rows.At(to_x, to_y));
        const int nearer = std::max(rows.At(x, y), rows.At(to_x, to_y));
        if (step <= limits.edge) {
          measure.slopes[right ? 0 : 1] +=
              both ? uint32_t(std::min<int>(step, limits.slope_limit)) : 0;
          continue;
        }
        edge_low = std::min(edge_low, nearer);
        edge_high = std::max(edge_high, nearer);
        measure.edges[right ? 0 : 1] += both;
        measure.gaps[right ? 0 : 1] += both ? uint32_t(std::min<int>(step, limits.gap_limit)) : 0;
      }
    }
  }
  measure.nearest = uint16_t(nearest);
  measure.edge_low = int16_t(edge_low);
  measure.edge_high = int16_t(edge_high);
  return measure;
}

TEST_CASE("kernels: cells by their definition") {
  test::Random random(8);
  for (int round = 0; round < 3000; ++round) {
    const CellRows rows(&random);
    const CellLimits limits = RandomCellLimits(&random);
    CellMeasure got;
    ReferenceKernels().measure_cell(rows.rows, limits, &got);
    const bool same = Same(got, Measured(rows, limits));
    CHECK(same);
  }
}

// --- transpose ---

struct Pixels {
  Pixels(int of_rows, int of_columns, test::Random* random)
      : rows(size_t(of_rows)),
        columns(size_t(of_columns)),
        in_stride(3 * columns + size_t(random->Int(0, 5))),
        out_stride(3 * rows + kTransposePadding + size_t(random->Int(0, 5))),
        in(RandomBytes(rows * in_stride + kPadding, random)) {}

  // Nothing behind the last row's padding.
  std::vector<uint8_t> Out() const {
    return std::vector<uint8_t>((columns - 1) * out_stride + 3 * rows + kTransposePadding,
                                test::kPoison);
  }

  // In strips of `strip` rows.
  std::vector<uint8_t> Transposed(const Kernels& kernels, size_t strip) const {
    std::vector<uint8_t> out = Out();
    for (size_t row = 0; row < rows; row += strip) {
      kernels.transpose(in.data() + row * in_stride, in_stride, std::min(strip, rows - row),
                        columns, out.data() + 3 * row, out_stride);
    }
    return out;
  }

  // Every pixel at its place, and nothing written that is not allowed.
  bool IsTransposed(const std::vector<uint8_t>& out) const {
    for (size_t i = 0; i < out.size(); ++i) {
      const size_t column = i / out_stride, at = i % out_stride;
      if (at < 3 * rows) {
        if (out[i] != in[at / 3 * in_stride + 3 * column + at % 3]) return false;
      } else if (at >= 3 * rows + kTransposePadding && out[i] != test::kPoison) {
        return false;
      }
    }
    return true;
  }

  size_t rows, columns, in_stride, out_stride;
  std::vector<uint8_t> in;
};

void TestTranspose(const Kernels& kernels) {
  test::Random random(9);
  for (int rows = 1; rows <= 70; ++rows) {
    for (int columns = 1; columns <= 40; ++columns) {
      const Pixels pixels(rows, columns, &random);
      CAPTURE(rows);
      CAPTURE(columns);
      const bool whole = pixels.IsTransposed(pixels.Transposed(kernels, pixels.rows));
      CHECK(whole);
      const size_t strip = 4 * size_t(random.Int(1, 5));
      const bool in_strips = pixels.IsTransposed(pixels.Transposed(kernels, strip));
      CHECK(in_strips);
    }
  }
}

TEST_CASE("kernels: several SIMD targets run here") {
  const std::vector<const Kernels*> all = test::SimdTargets();
  std::printf("SIMD targets:");
  for (const Kernels* kernels : all) std::printf(" %s", kernels->name);
  std::printf("\n");
#if HWY_ARCH_X86 && !defined(HWY_COMPILE_ONLY_STATIC)
  CHECK(all.size() > 1);
#endif
  CHECK(std::string(sf_simd_target()) == starfocus::simd::BestKernels().name);
}

TEST_CASE("kernels: a test that would run on no SIMD target fails") {
  CHECK_THROWS(test::ListTargets([](size_t) -> const Kernels* { return nullptr; }));
}

TEST_CASE("kernels: the same results on every target") {
  for (const Kernels* kernels : test::SimdTargets()) {
    CAPTURE(kernels->name);
    TestAccumulate(*kernels);
    TestBlend(*kernels);
    TestFinish(*kernels);
    TestConvert(*kernels);
    TestFindRuns(*kernels);
    TestMeasureCell(*kernels);
    TestTranspose(*kernels);
  }
}

TEST_CASE("kernels: the definitions, by hand") {
  const uint8_t source[] = {10, 20, 30, 40, 50, 60, 70, 80, 90};
  const Span span = {source + 3, 1, 3, 192, 64, 3};
  uint8_t line[5] = {1, 1, 1, 1, 1};
  ReferenceKernels().blend(&span, 1, line);
  // (192 * 40 + 64 * 70) / 256 = 47.5, rounded half up
  const uint8_t blended[5] = {1, 48, 58, 68, 1};
  CHECK(std::memcmp(line, blended, sizeof(line)) == 0);
  uint32_t sums[5] = {5, 5, 5, 5, 5};
  ReferenceKernels().accumulate(&span, 1, sums);
  CHECK(sums[0] == 5);
  CHECK(sums[1] == 5 + 192 * 40 + 64 * 70);
  CHECK(sums[3] == 5 + 192 * 60 + 64 * 90);
  CHECK(sums[4] == 5);
  const uint32_t wide[3] = {uint32_t{255} << 24, (7u << 24) + (1u << 23),
                            (7u << 24) + (1u << 23) - 1};
  uint8_t out[3];
  ReferenceKernels().finish(wide, 3, 24, out);
  CHECK(int(out[0]) == 255);
  CHECK(int(out[1]) == 8);
  CHECK(int(out[2]) == 7);
  const float disparity[4] = {0.0078125f, -0.0078125f, -500, 500};
  int16_t converted[4];
  CHECK(ReferenceKernels().convert_disparity(disparity, 4, -500, 500, converted));
  CHECK(converted[0] == 1);
  CHECK(converted[1] == 0);
  CHECK(converted[2] == -32000);
  CHECK(converted[3] == 32000);
}

TEST_CASE("kernels: transposing by its definition") { TestTranspose(ReferenceKernels()); }

TEST_CASE("kernels: the definitions of runs, cells and transposing, by hand") {
  // Two lines of five, read backwards, with limits that 10 reaches and 11 exceeds.
  const int16_t lines[5][2] = {{40, -32000}, {11, 32000}, {0, 31995}, {5, 31990}, {-5, 31989}};
  uint16_t starts[kRunLanes], edges[kRunLanes];
  int16_t middles[5 * kRunLanes];
  ReferenceKernels().find_runs(lines[4], -2, 5, 2, {10, 10},
                               RunMarks{starts, edges, middles, kRunLanes});
  CHECK(starts[0] == 0b11000);
  CHECK(edges[0] == 0b11000);
  CHECK(starts[1] == 0b11000);
  CHECK(edges[1] == 0b10000);
  const int expected[5][2] = {{-5, 31989}, {0, 31989}, {0, 31992}, {11, 32000}, {40, -32000}};
  for (size_t q = 0; q < 5; ++q) {
    for (size_t k = 0; k < 2; ++k) CHECK(middles[q * kRunLanes + k] == expected[q][k]);
  }

  // A flat cell but for one pixel inside, one in the corner, and another beyond the left side.
  int16_t values[10][10] = {};
  const int16_t* rows[10];
  for (int k = 0; k < 10; ++k) rows[k] = values[k] + 1;
  values[1 + 3][1 + 4] = 97;
  values[1 + 0][1 + 7] = -20;
  values[1 + 5][0] = 500;
  CellMeasure measure;
  ReferenceKernels().measure_cell(rows, {100, 96, 15, 90}, &measure);
  for (int k = 0; k < 8; ++k) {
    CHECK(measure.column_low[k] == (k == 7 ? -20 : 0));
    CHECK(measure.column_high[k] == (k == 4 ? 97 : 0));
    CHECK(measure.row_low[k] == (k == 0 ? -20 : 0));
    CHECK(measure.row_high[k] == (k == 3 ? 97 : 0));
  }
  CHECK(measure.nearest == 3);
  CHECK(measure.edge_low == 97);
  CHECK(measure.edge_high == 500);
  for (int along = 0; along < 2; ++along) {
    CHECK(measure.edges[along] == 2);
    CHECK(measure.gaps[along] == 2 * 90);
    CHECK(measure.slopes[along] == 15);
  }
  values[1 + 5][0] = 0;
  values[1 + 3][1 + 4] = 96;
  ReferenceKernels().measure_cell(rows, {100, 96, 15, 90}, &measure);
  CHECK(measure.edge_low > measure.edge_high);
  for (int along = 0; along < 2; ++along) {
    CHECK(measure.edges[along] == 0);
    CHECK(measure.slopes[along] == 3 * 15);
  }

  const uint8_t in[2][7] = {{1, 2, 3, 4, 5, 6, 99}, {7, 8, 9, 10, 11, 12, 99}};
  uint8_t out[2][6 + kTransposePadding] = {};
  ReferenceKernels().transpose(in[0], sizeof(in[0]), 2, 2, out[0], sizeof(out[0]));
  const uint8_t transposed[2][6] = {{1, 2, 3, 7, 8, 9}, {4, 5, 6, 10, 11, 12}};
  for (int k = 0; k < 2; ++k) CHECK(std::equal(transposed[k], transposed[k] + 6, out[k]));
}

std::vector<uint8_t> Refocused(const test::Scene& scene, const sf_params& params,
                               const Kernels& kernels) {
  sf_config config = test::ConfigFor(scene);
  config.largest_block = 32;
  test::Engine engine(config);
  REQUIRE(engine.status() == SF_OK);
  reinterpret_cast<starfocus::EngineState*>(engine.get())->kernels = &kernels;
  test::Output out(scene.width, scene.height, 5);
  REQUIRE(test::Refocus(&engine, params, scene, &out) == SF_OK);
  CHECK(out.PaddingUntouched());
  return out.bytes;
}

TEST_CASE("kernels: the engine gives the same bytes on every target") {
  constexpr int kSizes[][2] = {{1, 1}, {5, 3}, {33, 40}, {77, 50}};
  for (const auto& size : kSizes) {
    for (const int views : {1, 5, 9, 17}) {
      const test::Scene scene =
          test::RandomScene(size[0], size[1], views, -3, 4, 50 + uint64_t(views));
      for (const sf_mode mode : {SF_MODE_FRAME, SF_MODE_BENCHMARK}) {
        const sf_params params = test::Params(1.3, 0.9, mode);
        const std::vector<uint8_t> expected = Refocused(scene, params, ReferenceKernels());
        for (const Kernels* kernels : test::SimdTargets()) {
          CAPTURE(kernels->name);
          CAPTURE(size[0]);
          CAPTURE(views);
          CAPTURE(mode);
          const bool same = Refocused(scene, params, *kernels) == expected;
          CHECK(same);
        }
      }
    }
  }
}

}  // namespace
