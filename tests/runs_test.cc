// Runs of one disparity along hand-made and random lines.
#include "lib/runs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/test_scene.h"

namespace {

using starfocus::Direction;
using starfocus::Run;

struct Found {
  int begin, disparity;
  bool operator==(const Found& other) const {
    return begin == other.begin && disparity == other.disparity;
  }
};

std::vector<Found> Find(const std::vector<int16_t>& line, Direction direction, int spread) {
  std::vector<Run> runs(line.size() + 1, Run{0xCDCD, 0x5A5A});
  const int32_t count =
      starfocus::FindRuns(line.data(), int32_t(line.size()), direction, spread, runs.data());
  REQUIRE(count >= 1);
  REQUIRE(count <= int32_t(line.size()));
  CHECK(runs[size_t(count)].begin == 0xCDCD);
  std::vector<Found> found;
  for (int32_t i = 0; i < count; ++i) found.push_back({runs[i].begin, runs[i].disparity});
  return found;
}

using Runs = std::vector<Found>;

TEST_CASE("runs: one pixel, one surface, two surfaces") {
  CHECK(Find({7}, Direction::kRightToLeft, 16) == Runs{{0, 7}});
  CHECK(Find({7}, Direction::kLeftToRight, 16) == Runs{{0, 7}});
  CHECK(Find({5, 5, 5, 5}, Direction::kRightToLeft, 0) == Runs{{0, 5}});
  CHECK(Find({1, 1, 1, 90, 90}, Direction::kRightToLeft, 16) == Runs{{3, 90}, {0, 1}});
  CHECK(Find({1, 1, 1, 90, 90}, Direction::kLeftToRight, 16) == Runs{{2, 1}, {0, 90}});
}

TEST_CASE("runs: the spread may be reached, not exceeded; the middle is rounded down") {
  CHECK(Find({16, 0}, Direction::kRightToLeft, 16) == Runs{{0, 8}});
  CHECK(Find({17, 0}, Direction::kRightToLeft, 16) == Runs{{1, 0}, {0, 17}});
  CHECK(Find({0, 3}, Direction::kRightToLeft, 16) == Runs{{0, 1}});
  CHECK(Find({0, -3}, Direction::kRightToLeft, 16) == Runs{{0, -2}});
}

TEST_CASE("runs: greedy from the end where the scan starts") {
  const std::vector<int16_t> ramp = {0, 2, 4, 6, 8, 10, 12};
  CHECK(Find(ramp, Direction::kRightToLeft, 4) == Runs{{4, 10}, {1, 4}, {0, 0}});
  CHECK(Find(ramp, Direction::kLeftToRight, 4) == Runs{{4, 2}, {1, 8}, {0, 12}});
}

TEST_CASE("runs: alternating extremes") {
  std::vector<int16_t> line;
  for (int x = 0; x < 100; ++x) line.push_back(x % 2 == 0 ? 32000 : -32000);
  CHECK(Find(line, Direction::kRightToLeft, 96).size() == 100);
  CHECK(Find(line, Direction::kRightToLeft, 64000) == Runs{{0, 0}});
}

void CheckLine(const std::vector<int16_t>& line, int spread) {
  const Runs runs = Find(line, Direction::kRightToLeft, spread);
  std::vector<int16_t> mirrored(line.rbegin(), line.rend());
  CHECK(Find(mirrored, Direction::kLeftToRight, spread) == runs);
  int end = int(line.size());
  for (const Found& run : runs) {
    REQUIRE(run.begin < end);
    const auto range = std::minmax_element(line.begin() + run.begin, line.begin() + end);
    const int low = *range.first, high = *range.second;
    CHECK(high - low <= spread);
    CHECK(run.disparity >= low);
    CHECK(run.disparity <= high);
    CHECK(std::max(high - run.disparity, run.disparity - low) <= (high - low + 1) / 2);
    if (run.begin > 0) {  // one pixel more would be too many
      const int next = line[size_t(run.begin - 1)];
      CHECK(std::max(high, next) - std::min(low, next) > spread);
    }
    end = run.begin;
  }
  CHECK(end == 0);
}

TEST_CASE("runs: random lines are covered by the longest runs the spread allows") {
  test::Random random(3);
  for (int round = 0; round < 2000; ++round) {
    std::vector<int16_t> line(size_t(random.Int(1, 70)));
    const int amplitude = random.Int(0, 3) == 0 ? 32000 : random.Int(0, 60);
    int level = random.Int(-amplitude, amplitude);
    for (int16_t& d : line) {
      if (random.Int(0, 3) == 0) level = random.Int(-amplitude, amplitude);
      d = int16_t(level);
    }
    CheckLine(line, random.Int(0, 96));
  }
}

}  // namespace
