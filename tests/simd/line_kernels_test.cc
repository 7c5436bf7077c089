// The kernels of disparities and whole lines, find_runs, measure_cell and transpose, on every SIMD
// target of this machine against the plain C++ that defines them, and against their definitions.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "simd/kernels.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

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
    kernels.FindRuns(first, step, size_t(lines.length), size_t(lines.count), limits,
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

TEST_CASE("line kernels: runs by their definition") {
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
    ReferenceKernels().MeasureCell(rows.rows, limits, &expected);
    kernels.MeasureCell(rows.rows, limits, &got);
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

TEST_CASE("line kernels: cells by their definition") {
  test::Random random(8);
  for (int round = 0; round < 3000; ++round) {
    const CellRows rows(&random);
    const CellLimits limits = RandomCellLimits(&random);
    CellMeasure got;
    ReferenceKernels().MeasureCell(rows.rows, limits, &got);
    const bool same = Same(got, Measured(rows, limits));
    CHECK(same);
  }
}

// --- find_ranges, find_within ---

void TestFindRanges(const Kernels& kernels) {
  test::Random random(9);
  for (size_t count = 1; count <= 70; ++count) {
    const size_t rows = size_t(random.Int(1, 9)), stride = count + size_t(random.Int(0, 5));
    const int most = random.Int(0, 2) == 0 ? 32767 : 90, absent = random.Int(0, 3);
    std::vector<int16_t> in(rows * stride + starfocus::simd::kSliceLanes);
    for (int16_t& d : in)
      d = int16_t(random.Int(0, 3) < absent ? INT16_MIN : random.Int(-most, most));
    std::vector<starfocus::simd::DisparityRange> expected(6, {5, 5}), got = expected;
    ReferenceKernels().FindRanges(in.data(), stride, rows, count, expected.data());
    kernels.FindRanges(in.data(), stride, rows, count, got.data());
    CAPTURE(count);
    for (size_t k = 0; k < got.size(); ++k) {
      CHECK(got[k].low == expected[k].low);
      CHECK(got[k].high == expected[k].high);
    }
  }
}

void TestFindWithin(const Kernels& kernels) {
  constexpr size_t kMost = 9;
  test::Random random(10);
  for (int round = 0; round < 200; ++round) {
    const size_t rows = size_t(random.Int(1, kMost)), stride = size_t(random.Int(16, 40));
    std::vector<int16_t> in(rows * stride);
    for (int16_t& d : in) d = int16_t(random.Int(-40, 40) * (random.Int(0, 3) == 0 ? 819 : 1));
    const auto low = int16_t(random.Int(-45, 35));
    const auto high = int16_t(random.Int(0, 3) == 0 ? INT16_MAX : random.Int(low, 45));
    const starfocus::simd::DisparityRange range = {low, high};
    std::vector<uint16_t> expected(kMost, 7), got = expected;
    ReferenceKernels().FindWithin(in.data(), stride, rows, range, expected.data());
    kernels.FindWithin(in.data(), stride, rows, range, got.data());
    CHECK(got == expected);
    for (int k = 0; k < 16; ++k) {
      const bool inside = in[size_t(k)] >= range.low && in[size_t(k)] <= range.high;
      CHECK((expected[0] >> k & 1) == int(inside));
    }
  }
}

TEST_CASE("line kernels: ranges, by hand") {
  int16_t in[2 * 20] = {};
  for (int16_t& d : in) d = INT16_MIN;
  starfocus::simd::DisparityRange ranges[2];
  ReferenceKernels().FindRanges(in, 20, 2, 17, ranges);
  CHECK(ranges[0].low > ranges[0].high);
  in[3] = 8, in[20 + 15] = -32767, in[16] = 32767, in[17] = 0;
  ReferenceKernels().FindRanges(in, 20, 2, 17, ranges);
  CHECK(ranges[0].low == -32767);
  CHECK(ranges[0].high == 8);
  CHECK(ranges[1].low == 32767);
  CHECK(ranges[1].high == 32767);
}

// --- transpose ---

struct Pixels {
  Pixels(int of_rows, int of_columns, test::Random* random)
      : rows(size_t(of_rows)),
        columns(size_t(of_columns)),
        in_stride(3 * columns + size_t(random->Int(0, 5))),
        out_stride(3 * rows + kTransposePadding + size_t(random->Int(0, 5))),
        in(test::RandomBytes(rows * in_stride + kPadding, random)) {}

  // Nothing behind the last row's padding.
  std::vector<uint8_t> Out() const {
    return std::vector<uint8_t>((columns - 1) * out_stride + 3 * rows + kTransposePadding,
                                test::kPoison);
  }

  // In strips of `strip` rows.
  std::vector<uint8_t> Transposed(const Kernels& kernels, size_t strip) const {
    std::vector<uint8_t> out = Out();
    for (size_t row = 0; row < rows; row += strip) {
      kernels.Transpose(in.data() + row * in_stride, in_stride, std::min(strip, rows - row),
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

TEST_CASE("line kernels: the same results on every target") {
  for (const Kernels* kernels : test::SimdTargets()) {
    CAPTURE(kernels->name);
    TestFindRuns(*kernels);
    TestMeasureCell(*kernels);
    TestFindRanges(*kernels);
    TestFindWithin(*kernels);
    TestTranspose(*kernels);
  }
}

TEST_CASE("line kernels: transposing by its definition") { TestTranspose(ReferenceKernels()); }

TEST_CASE("line kernels: the definitions of runs, cells and transposing, by hand") {
  // Two lines of five, read backwards, with limits that 10 reaches and 11 exceeds.
  const int16_t lines[5][2] = {{40, -32000}, {11, 32000}, {0, 31995}, {5, 31990}, {-5, 31989}};
  uint16_t starts[kRunLanes], edges[kRunLanes];
  int16_t middles[5 * kRunLanes];
  ReferenceKernels().FindRuns(lines[4], -2, 5, 2, {10, 10},
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
  ReferenceKernels().MeasureCell(rows, {100, 96, 15, 90}, &measure);
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
  ReferenceKernels().MeasureCell(rows, {100, 96, 15, 90}, &measure);
  CHECK(measure.edge_low > measure.edge_high);
  for (int along = 0; along < 2; ++along) {
    CHECK(measure.edges[along] == 0);
    CHECK(measure.slopes[along] == 3 * 15);
  }

  const uint8_t in[2][7] = {{1, 2, 3, 4, 5, 6, 99}, {7, 8, 9, 10, 11, 12, 99}};
  uint8_t out[2][6 + kTransposePadding] = {};
  ReferenceKernels().Transpose(in[0], sizeof(in[0]), 2, 2, out[0], sizeof(out[0]));
  const uint8_t transposed[2][6] = {{1, 2, 3, 7, 8, 9}, {4, 5, 6, 10, 11, 12}};
  for (int k = 0; k < 2; ++k) CHECK(std::equal(transposed[k], transposed[k] + 6, out[k]));
}

}  // namespace
