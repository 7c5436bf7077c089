// SPDX-License-Identifier: Apache-2.0
// Reads depth pictures whose values are distances. Tests units, infinite and missing distances,
// DEPTH16, and the note about values that look like distances.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/readers/depth_scene.h"
#include "tests/support/error_line.h"

namespace starfocus::depth_unit_test {
namespace {

using namespace depth_scene;
using namespace photos;

// Disparity of a distance in metres.
double OfMetres(double metres) { return kNearest * 1.5 / metres; }

// Returns a map of distances in which the wall is infinitely far.
FloatMap WithInfiniteWall(const Scene& scene) {
  FloatMap map = MapOf(scene);
  std::replace(map.values.begin(), map.values.end(), static_cast<float>(scene.wall), HUGE_VALF);
  return map;
}

TEST_CASE("depth units: distances in any unit give the disparities of metres, and +inf gives 0") {
  for (const double metres : {1.0, 0.001, 0.0002, 1.0 / 256, 0.3048}) {
    CAPTURE(metres);
    FloatMap map = WithInfiniteWall({3 / metres, 1.5 / metres, 0.9 / metres});
    map.values[Index(20, 16)] = kNan;  // Within the box.
    for (const std::string& file : {NpyOf(map), PfmOf(map), PfmOf(map, ByteOrder::kBig)}) {
      const Opened opened("map", file, UnitIs(DepthUnit::kDistance, metres));
      REQUIRE(opened.error == "");
      for (int x = 0; x < kColumns; ++x) CHECK(opened.At(x, 0) == 0);
      CHECK(opened.At(28, 15) == 0);  // Next to the box.
      CHECK(opened.At(kBox[0], kBox[1]) == doctest::Approx(OfMetres(0.9)));
      CHECK(opened.At(kFloor[0], kFloor[1]) == doctest::Approx(OfMetres(1.5)));
      CHECK(opened.HasNote("1 of 1728 pixels"));
    }
    DepthOptions unknown = UnitIs(DepthUnit::kDistance, metres);
    unknown.has_unknown = true;
    unknown.unknown = {HUGE_VAL};
    CHECK(Opened("map", NpyOf(map), unknown).At(kWall[0], kWall[1]) > 0.1);
  }
}

TEST_CASE("depth units: without a unit, +inf is the farthest distance, or an unknown disparity") {
  FloatMap map = WithInfiniteWall({4, 2, 1});
  for (const DepthOptions& options : {DepthOptions(), NearIs(Near::kBlack)}) {
    const Opened opened("map", NpyOf(map), options);
    REQUIRE(opened.error == "");
    CHECK(opened.At(28, 15) == 0);  // Next to the box.
    CHECK(opened.At(kBox[0], kBox[1]) == doctest::Approx(kNearest));
    CHECK(opened.HasNote("only distances are infinite") == (options.near == Near::kUnknown));
    CHECK(!opened.HasNote("are unknown and were filled"));
  }
  for (const DepthOptions& options : {NearIs(Near::kWhite), UnitIs(DepthUnit::kDisparity)}) {
    const Opened opened("map", NpyOf(map), options);
    REQUIRE(opened.error == "");
    CHECK(opened.HasNote("are unknown and were filled"));
  }
}

TEST_CASE("unknown depth: 0 and negative floats are no distances, and the guess ignores them") {
  for (const float marker : {0.0F, -0.0F, -1.0F, -HUGE_VALF}) {
    CAPTURE(marker);
    FloatMap map = MapOf({3, 1.5, 0.9});
    for (int y = 0; y < kRows; ++y) map.values[Index(28, y)] = map.values[Index(2, y)] = marker;
    // The marker in the upper rows would turn the guess of the near end.
    for (int x = 0; x < kColumns; ++x) map.values[Index(x, 0)] = map.values[Index(x, 1)] = marker;
    for (int x = 0; x < kColumns; ++x) map.values[Index(x, 2)] = map.values[Index(x, 3)] = marker;
    for (const DepthOptions& options : {DepthOptions(), NearIs(Near::kBlack)}) {
      const Opened opened("map", NpyOf(map), options);
      CheckScene(opened);
      CHECK(opened.At(28, 15) == doctest::Approx(0));  // Filled with the wall, not with the box.
      CHECK(opened.HasNote("--unknown none overrides this") == std::isfinite(marker));
    }
    const Opened metres("map", NpyOf(map), UnitIs(DepthUnit::kDistance));
    REQUIRE(metres.error == "");
    CHECK(metres.At(28, 15) == doctest::Approx(OfMetres(3)));
    if (!std::isfinite(marker)) continue;
    DepthOptions none = NearIs(Near::kBlack);
    none.has_unknown = true;
    CHECK(Opened("map", NpyOf(map), none).At(28, 15) == doctest::Approx(kNearest));
    const Opened disparity("map", NpyOf(map), UnitIs(DepthUnit::kDisparity));
    CHECK(disparity.At(28, 15) == double(marker));
    CHECK(disparity.capture.notes.empty());
    // If larger values are nearer, 0 is the inverse distance of infinitely distant points.
    for (const Opened& nearer :
         {Opened("map", NpyOf(map), NearIs(Near::kWhite)), Opened("map", PfmOf(map), {})}) {
      CHECK(nearer.At(28, 15) == doctest::Approx(0));
      CHECK(nearer.At(20, 2) == doctest::Approx(0));
      CHECK(nearer.HasNote("taken as a known depth"));
      CHECK(!nearer.HasNote("were filled"));
    }
  }
  FloatMap relative = MapOf({1, 0.3, 0.01});  // Normalized depth of a network: 0 is the nearest.
  relative.values[Index(20, 15)] = 0;
  const Opened opened("map", NpyOf(relative), NearIs(Near::kBlack));
  CHECK(opened.At(20, 15) == doctest::Approx(kNearest));
  CHECK(opened.capture.notes.empty());
}

TEST_CASE("near end: rows and sky that a sensor did not measure do not decide the guess") {
  const struct {
    Scene scene;
    bool whole;  // the values are millimetres in whole numbers
  } kKinds[] = {{{3, 1.5, 0.9}, false}, {kMillimetres, true}};
  for (const auto& kind : kKinds) {
    // Unmeasured: the first rows, or the wall around the box, so that only the box is known above.
    for (const bool rows : {true, false}) {
      CAPTURE(rows);
      FloatMap map = MapOf(kind.scene);
      for (int y = 0; y < 18; ++y) {
        for (int x = 0; x < kColumns; ++x) {
          if (rows ? y < 14 : map.at(x, y) == float(kind.scene.wall)) map.values[Index(x, y)] = 0;
        }
      }
      std::vector<uint16_t> levels;
      for (const float value : map.values) levels.push_back(static_cast<uint16_t>(value));
      const Opened opened("map", kind.whole ? GreyPng(levels) : NpyOf(map), {});
      REQUIRE(opened.error == "");
      CHECK(opened.HasNote("black is taken as near"));
      CHECK(opened.HasNote("look like distances in"));
      CHECK(opened.At(kBox[0], kBox[1]) > opened.At(kWall[0], kWall[1]) + 1);
      // The unmeasured part above the box is as far as the wall beside it.
      if (!rows) CHECK(opened.At(20, 2) == doctest::Approx(opened.At(2, 2)));
    }
  }
}

TEST_CASE("near end: 0 is the farthest value of a normalized inverse depth") {
  FloatMap map = MapOf({0.2, 0.5, 1});
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      if (map.at(x, y) == 0.2F) map.values[Index(x, y)] = 0;
    }
  }
  const Opened guessed("map", NpyOf(map), {}), white("map", NpyOf(map), NearIs(Near::kWhite));
  REQUIRE(guessed.error == "");
  CHECK(guessed.capture.light_field.disparity.values == white.capture.light_field.disparity.values);
  CHECK(!guessed.HasNote("look like distances"));
  CHECK(!guessed.HasNote("were filled"));
}

TEST_CASE("depth units: DEPTH16 stores millimetres below a confidence, and 0 is unknown") {
  std::vector<uint16_t> levels = LevelsOf(kMillimetres);
  levels[Index(28, 15)] = 0;  // Next to the box.
  for (size_t k = 0; k < levels.size(); ++k) {
    levels[k] = static_cast<uint16_t>(levels[k] | (k * 5 % 8) << 13);
  }
  const DepthOptions depth16 = UnitIs(DepthUnit::kDepth16);
  const Opened opened("map.png", GreyPng(levels), depth16);
  REQUIRE(opened.error == "");
  CHECK(opened.At(kWall[0], kWall[1]) == doctest::Approx(OfMetres(3)));
  CHECK(opened.At(kBox[0], kBox[1]) == doctest::Approx(OfMetres(0.9)));
  CHECK(opened.At(28, 15) == doctest::Approx(OfMetres(3)));
  CHECK(opened.HasNote("1 of 1728 pixels"));
  CHECK(Contains(Opened("map", NpyOf(MapOf({3, 2, 1})), depth16).error, "found floats"));
  CHECK(
      Contains(Opened("map.png", Encode(Plain(kColumns, kRows, 9), ".png"), depth16).error,
               "expected integers of 16 bits for --depth-unit depth16, found integers of 8 bits"));
}

TEST_CASE("depth units: a note names the unit of values without a unit that look like distances") {
  const auto note = [](const std::string& file, Near near) {
    const Opened opened("map", file, NearIs(near));
    REQUIRE(opened.error == "");
    if (!opened.HasNote("look like distances")) return "";
    return opened.HasNote("(--depth-unit mm reads them") ? "mm" : "m";
  };
  const FloatMap metres = MapOf({6, 2.5, 1.5}), relative = MapOf({1, 0.4, 0.001});
  for (const Near near : {Near::kUnknown, Near::kBlack}) {
    CHECK(note(NpyOf(metres), near) == "m");
    CHECK(note(PfmOf(metres), near) == "m");
    CHECK(note(GreyPng(LevelsOf(kMillimetres)), near) == "mm");
    CHECK(note(NpyOf(relative), near) == "");
    CHECK(note(GreyPng(LevelsOf({65000, 30000, 10})), near) == "");
    CHECK(note(Encode(Ramp(kColumns, kRows), ".png"), near) == "");
  }
  // Larger values are nearer in disparities and inverse distances.
  CHECK(note(NpyOf(metres), Near::kWhite) == "");
  CHECK(note(PfmOf(MapOf({1.5, 2.5, 6})), Near::kUnknown) == "");
}

}  // namespace
}  // namespace starfocus::depth_unit_test
