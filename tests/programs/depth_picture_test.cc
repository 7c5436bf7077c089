// SPDX-License-Identifier: Apache-2.0
// Tables of depth pictures in separate files: each row has a file, the options, the disparities of
// some pixels, and the notes. The rows test unknown values, units, infinite distances and near
// ends. photo_refusals_test.cc has the depth pictures that are rejected, and depth_file_test.cc
// has the formats of arrays. Further cases test the filling and the orientation.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "platform/levels.h"
#include "platform/readers/capture.h"
#include "platform/readers/orientation.h"
#include "platform/readers/unknown_depth.h"
#include "tests/programs/depth_scene.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"

namespace starfocus::depth_picture_test {
namespace {

using namespace depth_scene;

// Expected disparity of a pixel.
struct Point {
  int x, y;
  double disparity;
  double tolerance = 1e-5;  // relative, and absolute below 1; 0 means equality
};
using Points = std::vector<Point>;

struct Row {
  std::string name, file;
  DepthOptions options;
  Points points;
  // Parts of notes. "!TEXT" means that no note has the text; "!" alone, that there is no note.
  std::vector<std::string> notes = {};
};

void CheckRows(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    INFO("row ", &row - rows.data(), ": ", row.name);
    const Capture capture = ValueOf(OpenMap(row.file, row.options));
    for (const Point& point : row.points) {
      const double found = At(capture, point.x, point.y), expected = point.disparity;
      INFO("pixel ", point.x, ", ", point.y, ": ", found, " instead of ", expected);
      CHECK(std::fabs(found - expected) <= point.tolerance * std::max(1.0, std::fabs(expected)));
    }
    for (const std::string& note : row.notes) {
      CAPTURE(note);
      const bool absent = note[0] == '!';
      CHECK(HasNote(capture, note.substr(absent ? 1 : 0)) == !absent);
    }
  }
}

Points operator+(Points points, const Points& more) {
  points.insert(points.end(), more.begin(), more.end());
  return points;
}

// Disparity of a distance in metres.
double OfMetres(double metres) { return kNearest * 1.5 / metres; }

// Wall, floor and box of a map that defines only an order, and of a map of 3, 1.5 and 0.9 metres.
const Points kOrder = {{40, 4, 0}, {40, 35, kNearest * 1500 / 2100, 1e-3}, {20, 15, kNearest}};
const Points kMetres = {{40, 4, OfMetres(3)}, {40, 35, OfMetres(1.5)}, {20, 15, OfMetres(0.9)}};
constexpr Scene kScene = {3, 1.5, 0.9};

const DepthOptions kBlack = NearIs(Near::kBlack), kWhite = NearIs(Near::kWhite);

// Returns the options by which all finite values are depths.
DepthOptions AllKnown(DepthOptions options) {
  options.has_unknown = true;
  options.alpha = Alpha::kIgnored;
  return options;
}

DepthOptions Unknown(DepthOptions options, double value) {
  options.has_unknown = true;
  options.unknown = {value};
  return options;
}

FloatMap WithRows(FloatMap map, int from, int to, float value) {
  std::fill(map.values.begin() + from * kColumns, map.values.begin() + to * kColumns, value);
  return map;
}

// Returns the map with another value instead of `value` in all rows above `below`.
FloatMap Replaced(FloatMap map, float value, float other, int below = kRows) {
  std::replace(map.values.begin(), map.values.begin() + below * kColumns, value, other);
  return map;
}

std::string GreyOfMap(const FloatMap& map) {
  return Png16(kColumns, kRows, {map.values.begin(), map.values.end()});
}

TEST_CASE(
    "unknown depth: 0 and 65535 in 16 bits are unknown, unless the map uses the whole range") {
  std::vector<Row> rows;
  for (const uint16_t unknown : {uint16_t{0}, uint16_t{65535}}) {
    // The left border, and a gap next to the box, which is filled with the wall.
    const std::string file =
        GreyOfMap(WithColumns(WithColumns(MapOf(kMillimetres), 0, 5, unknown), 28, 31, unknown));
    const Points filled = {{0, 4, 0}, {28, 15, 0}, {0, 35, kNearest * 1500 / 2100, 1e-3}};
    const std::string note = "288 of 1728 pixels of the depth map are unknown";
    rows.push_back({"unknown", file, kBlack, kOrder + filled, {note, "--unknown none"}});
    rows.push_back({"known", file, AllKnown(kBlack), {{0, 4, unknown == 0 ? kNearest : 0}}, {"!"}});
  }
  const std::vector<std::string> known = {"as a known depth", "--unknown"};
  rows.push_back({"white", GreyOfMap(MapOf({0, 46811, 65535})), kWhite, kOrder, known});
  rows.push_back({"black", GreyOfMap(MapOf({65535, 18725, 0})), kBlack, kOrder, known});
  FloatMap both = MapOf(kMillimetres);
  both.values[Index(40, 2)] = 65535;
  both.values[Index(41, 2)] = 0;
  rows.push_back({"sensor", GreyOfMap(both), kBlack, kOrder, {"0 and 65535 are taken as unknown"}});
  CheckRows(rows);
}

TEST_CASE("unknown depth: in 8 bits, only values of an option and transparent pixels are unknown") {
  Image map = Plain(kColumns, kRows, 100);
  std::fill_n(map.row(0), map.stride(), uint8_t{0});
  std::fill_n(map.row(35), map.stride(), uint8_t{200});
  std::vector<Row> rows = {
      {"grey", Encode(map, ".png"), kWhite, {{3, 5, kNearest / 2}}, {"!"}},
      {"option", Encode(map, ".png"), Unknown(kWhite, 0), {{3, 0, 0}, {3, 5, 0}}}};
  const Scene scene = {50, 160, 204};
  const auto make = [&](int depth, int colour) {
    std::string samples;
    const int bytes = depth / 8;
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        const bool unknown = x < 6;
        const auto level = static_cast<uint32_t>(unknown ? 7 : std::lround(scene.At(x, y)));
        const int channels = colour == 6 ? 3 : 1;
        for (int c = 0; c < channels; ++c) samples += Big(level * (bytes == 2 ? 257 : 1), bytes);
        if (colour == 4 || colour == 6) samples += Big(unknown ? 0 : 0xffffffff, bytes);
      }
    }
    return samples;
  };
  std::string palette, opacities(8, '\xff');
  for (int level = 0; level < 256; ++level) palette += std::string(3, static_cast<char>(level));
  opacities[7] = 0;
  const std::string files[] = {
      Png(kColumns, kRows, {8, 4}, make(8, 4), 2 * kColumns),
      Png(kColumns, kRows, {16, 4}, make(16, 4), 4 * kColumns),
      Png(kColumns, kRows, {8, 6}, make(8, 6), 4 * kColumns),
      Png(kColumns, kRows, {16, 6}, make(16, 6), 8 * kColumns),
      Png(kColumns, kRows, {8, 0, Chunk("tRNS", Big(7, 2))}, make(8, 0), kColumns),
      Png(kColumns, kRows, {16, 0, Chunk("tRNS", Big(7 * 257, 2))}, make(16, 0), 2 * kColumns),
      Png(kColumns, kRows, {8, 3, Chunk("PLTE", palette) + Chunk("tRNS", opacities)}, make(8, 3),
          kColumns)};
  for (const std::string& file : files) {
    const Points known = {
        {40, 4, 0}, {0, 4, 0}, {20, 15, kNearest}, {40, 35, kNearest * 110 / 154}};
    rows.push_back({"transparent", file, kWhite, known, {"216 of 1728 pixels"}});
    rows.push_back({"opaque", file, AllKnown(kWhite), {{40, 4, kNearest * 43 / 197}}});
  }
  CheckRows(rows);
}

TEST_CASE("unknown depth: NaN, outliers, 0 and negative floats are unknown in maps of distances") {
  std::vector<Row> rows;
  for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    FloatMap map = MapOf({5, 5 + 25.0F * 1500 / 2100, 30});
    map = WithColumns(WithColumns(map, 0, 1, HUGE_VALF), 1, 2, -HUGE_VALF);
    map = WithColumns(map, 47, 48, kNan);
    map.values[Index(30, 1)] = 1e6F;  // an outlier: one pixel of 1728
    const Points points = kOrder + Points{{0, 4, 0}, {30, 1, kNearest}};
    rows.push_back({"not finite", PfmOf(map, order), {}, points, {"108 of 1728 pixels"}});
  }
  for (const float marker : {0.0F, -0.0F, -1.0F, -HUGE_VALF}) {
    const std::string name = std::to_string(marker);
    FloatMap map = WithColumns(WithColumns(MapOf(kScene), 2, 3, marker), 28, 29, marker);
    // The marker in the upper rows would turn the guess of the near end.
    map = WithRows(map, 0, 4, marker);
    const std::string npy = NpyOf(map), note = "--unknown none overrides this";
    const bool finite = std::isfinite(marker);
    for (const DepthOptions& options : {DepthOptions(), kBlack}) {
      // The gap is filled with the wall, not with the box.
      rows.push_back(
          {name, npy, options, kOrder + Points{{28, 15, 0}}, {finite ? note : "!" + note}});
    }
    rows.push_back({name, npy, UnitIs(DepthUnit::kDistance), {{28, 15, OfMetres(3)}}});
    if (!finite) continue;
    rows.push_back({name, npy, AllKnown(kBlack), {{28, 15, kNearest}}});
    rows.push_back(
        {name, npy, UnitIs(DepthUnit::kDisparity), {{28, 15, double(marker), 0}}, {"!"}});
    // If larger values are nearer, 0 is the inverse distance of infinitely distant points.
    const std::vector<std::string> notes = {"taken as a known depth", "!were filled"};
    rows.push_back({name, npy, kWhite, {{28, 15, 0}, {20, 2, 0}}, notes});
    rows.push_back({name, PfmOf(map), {}, {{28, 15, 0}, {20, 2, 0}}, notes});
  }
  FloatMap relative = MapOf({1, 0.3, 0.01});  // Normalized depth of a network: 0 is the nearest.
  relative.values[Index(20, 15)] = 0;
  rows.push_back({"relative", NpyOf(relative), kBlack, {{20, 15, kNearest}}, {"!"}});
  CheckRows(rows);
}

TEST_CASE("depth units: distances in any unit give the disparities of metres, and +inf gives 0") {
  std::vector<Row> rows;
  const Points points = {{0, 0, 0, 0},   {20, 0, 0, 0}, {47, 0, 0, 0},
                         {28, 15, 0, 0}, kMetres[1],    kMetres[2]};
  for (const double metres : {1.0, 0.001, 0.0002, 1.0 / 256, 0.3048}) {
    const DepthOptions unit = UnitIs(DepthUnit::kDistance, metres);
    const auto wall = static_cast<float>(3 / metres);
    FloatMap map = Replaced(MapOf({wall, 1.5 / metres, 0.9 / metres}), wall, HUGE_VALF);
    map.values[Index(20, 16)] = kNan;  // Within the box.
    for (const std::string& file : {NpyOf(map), PfmOf(map), PfmOf(map, ByteOrder::kBig)}) {
      rows.push_back({"unit " + std::to_string(metres), file, unit, points, {"1 of 1728 pixels"}});
    }
    CHECK(At(ValueOf(OpenMap(NpyOf(map), Unknown(unit, HUGE_VAL))), 40, 4) > 0.1);
  }
  // Without a unit, +inf is the farthest distance, or an unknown disparity.
  const std::string npy = NpyOf(Replaced(MapOf({4, 2, 1}), 4, HUGE_VALF));
  const Points ends = {{28, 15, 0, 0}, {20, 15, kNearest}};
  const std::string distances = "only distances are infinite",
                    unknown = "are unknown and were filled";
  rows.push_back({"guess", npy, {}, ends, {distances, "!" + unknown}});
  rows.push_back({"black", npy, kBlack, ends, {"!" + distances, "!" + unknown}});
  rows.push_back({"white", npy, kWhite, {}, {unknown}});
  rows.push_back({"disparity", npy, UnitIs(DepthUnit::kDisparity), {}, {unknown}});
  CheckRows(rows);
}

TEST_CASE("depth units: the values of each format are distances, disparities or an order") {
  FloatMap unknown = MapOf(kMillimetres);
  unknown.values[0] = 0;
  std::vector<uint16_t> depth16;
  std::string pgm = "P5\n48 36\n4095\n";
  for (const float value : MapOf(kMillimetres).values) {
    const auto confidence = uint32_t(depth16.size() * 5 % 8), level = uint32_t(value + 0.5F);
    depth16.push_back(static_cast<uint16_t>(level | confidence << 13));
    pgm += Big(level, 2);
  }
  depth16[Index(28, 15)] &= 0xe000;  // unknown, next to the box
  const std::string pfm = PfmOf(MapOf(kScene)), npy = NpyOf(MapOf(kScene));
  const DepthOptions disparity = UnitIs(DepthUnit::kDisparity);
  std::vector<Row> rows = {
      {"PFM", pfm, kBlack, kOrder},
      {"PFM, m", pfm, UnitIs(DepthUnit::kDistance), kMetres},
      {"PNG, mm", GreyOfMap(unknown), UnitIs(DepthUnit::kDistance, 0.001),
       kMetres + Points{{0, 0, OfMetres(3)}}},
      {"PFM, pixels", PfmOf(MapOf({-2, 3, 17.5})), disparity, {{40, 4, -2, 0}, {20, 15, 17.5, 0}}},
      {"NPY", npy, {}, kOrder, {"black is taken as near"}},
      {"NPY, black", npy, kBlack, kOrder},
      {"NPY, pixels", npy, disparity, {{20, 15, 0.9}}},
      {"PGM", pgm, kBlack, kOrder},
      {"DEPTH16",
       Png16(kColumns, kRows, depth16),
       UnitIs(DepthUnit::kDepth16),
       kMetres + Points{{28, 15, OfMetres(3)}},
       {"1 of 1728 pixels"}},
      // Grey pictures stay grey after JPEG compression.
      {"JPEG", Encode(Ramp(kColumns, kRows), ".jpg"), {}, {}}};
  // Proportions may differ from the photo by rounding.
  for (const auto& [width, height] : {std::pair<int, int>{24, 18}, {16, 12}, {11, 8}, {518, 392}}) {
    rows.push_back({"size", Encode(Ramp(width, height), ".png"), kWhite, {}});
  }
  CheckRows(rows);
}

TEST_CASE("near end: a note names values that look like distances, and the guess uses known rows") {
  std::vector<Row> rows;
  const FloatMap metres = MapOf({6, 2.5, 1.5}), relative = MapOf({1, 0.4, 0.001});
  const std::string none = "!look like distances", as_mm = "(--depth-unit mm reads them";
  for (const DepthOptions& options : {DepthOptions(), kBlack}) {
    rows.push_back({"NPY", NpyOf(metres), options, {}, {"look like distances", "!" + as_mm}});
    rows.push_back({"PNG", GreyOfMap(MapOf(kMillimetres)), options, {}, {as_mm}});
    rows.push_back({"relative", NpyOf(relative), options, {}, {none}});
    rows.push_back({"levels", GreyOfMap(MapOf({65000, 30000, 10})), options, {}, {none}});
    rows.push_back({"8 bits", Encode(Ramp(kColumns, kRows), ".png"), options, {}, {none}});
    rows.push_back({"PFM", PfmOf(metres), options, {}, {"look like distances", "!" + as_mm}});
  }
  // Larger values are nearer in disparities and inverse distances.
  rows.push_back({"white", NpyOf(metres), kWhite, {}, {none}});
  rows.push_back({"PFM", PfmOf(MapOf({1.5, 2.5, 6})), {}, {}, {none}});
  // Unmeasured: the first rows, or the wall around the box, so that only the box is known above.
  for (const Scene& scene : {kScene, kMillimetres}) {
    const bool whole = scene.wall > 100;  // the values are millimetres in whole numbers
    const Points points = {{20, 15, kNearest}, {40, 4, 0}, {20, 2, 0}};
    const std::vector<std::string> notes = {"black is taken as near", "look like distances in"};
    for (const FloatMap& map : {WithRows(MapOf(scene), 0, 14, 0),
                                Replaced(MapOf(scene), static_cast<float>(scene.wall), 0, 18)}) {
      rows.push_back({"unmeasured", whole ? GreyOfMap(map) : NpyOf(map), {}, points, notes});
    }
  }
  // 0 is the farthest value of a normalized inverse depth.
  const std::string inverse = NpyOf(Replaced(MapOf({0.2, 0.5, 1}), 0.2F, 0, 12));
  const Points points = {
      {40, 4, 0}, {40, 15, kNearest / 5}, {40, 35, kNearest / 2}, {20, 15, kNearest}};
  for (const DepthOptions& options : {DepthOptions(), kWhite}) {
    rows.push_back({"inverse", inverse, options, points, {none, "!were filled"}});
  }
  CheckRows(rows);
}

TEST_CASE("samples: 16 bits are kept, and alpha is used instead of the grey levels if wanted") {
  const auto read = [](const std::string& name, Alpha alpha) {
    const std::string file = Seed("files/" + name);
    return ValueOf(DecodeSamples(name, alpha, Bytes(file.begin(), file.end())));
  };
  const Samples coverage = read("rgba16.png", Alpha::kTaken);
  CHECK(coverage.largest == 65535);
  CHECK(coverage.map.values[0] == 0x0607);
  CHECK(coverage.map.values[1] == 0x0e0f);
  CHECK(read("gray.png", Alpha::kTaken).map.values == read("gray.png", Alpha::kIgnored).map.values);
}

TEST_CASE("unknown depth: a gap is filled along its shorter direction, from its farther end") {
  FloatMap map = {5, 4, {1, kNan, kNan, 7, 7,     //
                         1, kNan, 4,    7, kNan,  //
                         1, kNan, kNan, 7, kNan,  //
                         1, 2,    2,    7, kNan}};
  CHECK(FillBehind(&map) == 8);
  CHECK(map.values == std::vector<float>{1, 1, 1, 7, 7,  //
                                         1, 1, 4, 7, 7,  //
                                         1, 1, 2, 7, 7,  //
                                         1, 2, 2, 7, 7});
  FloatMap slope = {1, 6, {0, 9.6F, kNan, kNan, 9.9F, 10}};  // one surface
  CHECK(FillBehind(&slope) == 2);
  CHECK(double(slope.values[2]) == doctest::Approx(9.7));
  CHECK(double(slope.values[3]) == doctest::Approx(9.8));
  FloatMap one = {3, 3, std::vector<float>(9, kNan)};
  one.values[4] = 3;
  CHECK(FillBehind(&one) == 8);
  CHECK(one.values == std::vector<float>(9, 3));
}

// Returns a photo that has edges at the edges of the map.
Image PictureOf(const FloatMap& map) {
  Image picture(map.width, map.height);
  for (size_t k = 0; k < map.values.size(); ++k) {
    for (size_t c = 0; c < 3; ++c) {
      picture.pixels[3 * k + c] =
          static_cast<uint8_t>(40 + 20 * c + double(map.values[k]) * (c == 1 ? 0.4 : 0.7));
    }
  }
  return picture;
}

#ifdef STARFOCUS_HAS_EXIF
TEST_CASE("depth pictures: by its proportions and edges, a picture is rotated with the photo") {
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const bool square : {false, true}) {
      CAPTURE(orientation);
      CAPTURE(square);
      FloatMap map = MapOf({30, 140, 220}, square ? kRows : kColumns);
      FloatMap upright = map;
      TurnMap(orientation, &upright);
      const auto open = [&](const FloatMap& given, DepthOrientation is) {
        DepthOptions options = NearIs(Near::kWhite);
        options.orientation = is;
        const std::string depth = PfmOf(given);
        return ValueOf(OpenWith(PictureOf(map), depth, {"", options}, "", orientation));
      };
      const Capture by_file = open(map, DepthOrientation::kUnknown),
                    by_upright = open(upright, DepthOrientation::kUnknown);
      const FloatMap& expected = by_file.light_field.disparity;
      CHECK(by_upright.light_field.disparity.values == expected.values);
      CHECK(expected.width == upright.width);
      const bool judged = orientation > 1 && (orientation < 5 || square);
      REQUIRE(by_upright.notes.size() == (judged ? 1 : 0));
      if (!judged) continue;
      CHECK(Contains(by_upright.notes[0], "upright already"));
      CHECK(Contains(by_upright.notes[0], "--depth-orientation photo"));
      CHECK(Contains(by_file.notes[0], "--depth-orientation upright"));
      const Capture wrong = open(upright, DepthOrientation::kPhoto);
      CHECK(wrong.notes.empty());
      CHECK(wrong.light_field.disparity.values != expected.values);
      CHECK(open(upright, DepthOrientation::kUpright).light_field.disparity.values ==
            expected.values);
    }
  }
}
#endif

}  // namespace
}  // namespace starfocus::depth_picture_test
