// SPDX-License-Identifier: Apache-2.0
// Repairs maps of one view by the colours of the view: correct disparities are kept, displaced
// edges move to the edges of the picture, and hair gets coverage.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <vector>

#include "tests/depth/depth_scene.h"
#include "tests/depth/disc_photo.h"
#include "tests/support/hair.h"
#include "tests/support/test_scene.h"

namespace one_view_test {
namespace {

using test::Area;
using test::kUnset;
using test::MadeMap;
using test::MakeClosedHair;
using test::MakeDisc;
using test::Photo;
using Portrait = test::ClosedHair;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

MadeMap Repair(const Photo& photo, bool covers = false, float low = -500, float high = 500) {
  const test::PlaneField plane = {photo.width, photo.height, {photo.rgb}};
  return MakeMap(plane, ConfigOf(plane, low, high), photo.map, covers);
}

// Calls change(x, y, distance) for each pixel, with the distance from the middle of the disc.
template <class Change>
void ForPixels(const Photo& photo, const Change& change) {
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) change(x, y, std::hypot(x - 151.3, y - 66.2));
  }
}

// Returns the map at a quarter of its size and interpolated bilinearly to full size, as network
// maps are enlarged.
std::vector<float> Enlarged(const Photo& photo) {
  const int columns = photo.width / 4, rows = photo.height / 4;
  std::vector<float> small(size_t(columns) * size_t(rows)), map;
  for (int y = 0; y < 4 * rows; ++y) {
    for (int x = 0; x < 4 * columns; ++x) {
      small[size_t(y / 4 * columns + x / 4)] += photo.map[photo.At(x, y)] / 16;
    }
  }
  ForPixels(photo, [&](int x, int y, double) {
    const float u = std::clamp((float(x) - 1.5F) / 4, 0.0F, float(columns - 1));
    const float v = std::clamp((float(y) - 1.5F) / 4, 0.0F, float(rows - 1));
    const int left = std::min(int(u), columns - 2), top = std::min(int(v), rows - 2);
    const float* at = small.data() + top * columns + left;
    const float right = u - float(left), down = v - float(top);
    map.push_back((at[0] * (1 - right) + at[1] * right) * (1 - down) +
                  (at[columns] * (1 - right) + at[columns + 1] * right) * down);
  });
  return map;
}

// Makes the edge of the disc softer: a mixture of both surfaces at distances from 38 to 44.
void Soften(Photo* photo) {
  const Photo wall = MakeDisc(-50);
  ForPixels(*photo, [&](int x, int y, double distance) {
    const double far = std::clamp((distance - 38) / 6, 0.0, 1.0);
    if (far == 0 || far == 1) return;
    const uint8_t* behind = wall.rgb.data() + 3 * wall.At(x, y);
    const auto mixed = [&](double near, int c) {
      return int(std::lround(near * (1 - far) + behind[c] * far));
    };
    photo->Paint(x, y, mixed(198, 0), mixed(88, 1), mixed(40, 2));
  });
}

// Displaces rows of the map by up to 2 pixels, and makes the colours noisy. A repair that decided
// about each pixel alone would increase the error.
void Roughen(const Photo& truth, Photo* photo) {
  test::Random random(9);
  for (int y = 0; y < photo->height; ++y) {
    const int by = random.Int(-2, 2);
    for (int x = 0; x < photo->width; ++x) {
      photo->Map(x, y) = truth.map[truth.At(std::clamp(x + by, 0, photo->width - 1), y)];
      const bool near = truth.map[truth.At(x, y)] > 0;
      const int noise = random.Int(-45, 45);
      photo->Paint(x, y, (near ? 150 : 100) + noise, 100 + random.Int(-25, 25), near ? 90 : 130);
    }
  }
}

// Replaces disparities of the disc by a ramp of `slope` pixels per pixel that begins at `outer`.
void MakeRamp(double outer, double slope, Photo* photo) {
  ForPixels(*photo, [&](int x, int y, double distance) {
    photo->Map(x, y) = float(-4 + std::clamp((outer - distance) * slope, 0.0, 10.0));
  });
}

// Makes a picture with a dark near part and a bright far part, its map, and a damaged map.
void MakeParts(bool (*is_near)(int x), float (*map)(int x, int y), Photo* truth, Photo* photo) {
  *truth = Photo(96, 64);
  for (int y = 0; y < truth->height; ++y) {
    for (int x = 0; x < truth->width; ++x) {
      const int level = (is_near(x) ? 40 : 200) + (x * 5 + y * 3) % 7;
      truth->Paint(x, y, level, level, level);
      truth->Map(x, y) = is_near(x) ? 12 : 0;
    }
  }
  *photo = *truth;
  for (int at = 0; at < 96 * 64; ++at) photo->map[size_t(at)] = map(at % 96, at / 96);
}

// Counts the pixels whose disparity differs by more than `by` pixels from that of their surface.
int CountWrong(const std::vector<float>& map, const Photo& truth, float by = 0.25F) {
  int wrong = 0;
  for (size_t k = 0; k < map.size(); ++k) wrong += !(std::abs(map[k] - truth.map[k]) <= by);
  return wrong;
}

// Pictures whose map is damaged. The numbers are wrong pixels before and after a repair.
struct Damage {
  const char* name;
  int before, after;
  void (*change)(Photo* truth, Photo* photo);
  float by = 0.25F;
};
const Damage kDamages[] = {
    {"the map edge is 3 pixels off, outwards", 600, 7,
     [](Photo*, Photo* photo) { photo->map = MakeDisc(3).map; }},
    {"the map edge is 3 pixels off, inwards", 600, 7,
     [](Photo*, Photo* photo) { photo->map = MakeDisc(-3).map; }},
    {"a ramp", 1800, 7, [](Photo*, Photo* photo) { MakeRamp(46, 10.0 / 12, photo); }},
    {"an enlarged map", 1200, 7,
     [](Photo* truth, Photo* photo) {
       *truth = MakeDisc(0, 12, -4);
       photo->map = Enlarged(*truth);
     }},
    {"a soft edge, whose pixels belong to the surface with the larger share", 600, 30,
     [](Photo* truth, Photo* photo) {
       *truth = MakeDisc(1);
       photo->map = MakeDisc(-3).map;
       Soften(photo);
     }},
    {"a ragged outline in noisy colours", 150, 20,
     [](Photo* truth, Photo* photo) { Roughen(*truth, photo); }},
    {"noise", 10000, 10, [](Photo*, Photo* photo) { AddNoise(photo); }, 0.5F},
    {"a soft map of a bar of three pixels, without a flat pixel", 300, 0,
     [](Photo* truth, Photo* photo) {
       MakeParts([](int x) { return std::abs(x - 24) <= 1; },
                 [](int x, int) { return std::max(0, 4 - std::abs(x - 24)) * 3.0F; }, truth, photo);
     }},
    {"a displaced part, beside an outline without colours", 570, 518,
     [](Photo* truth, Photo* photo) {
       MakeParts([](int x) { return x < 48; },
                 [](int x, int y) { return x < 8                       ? 24.0F
                                           : x < 48 + (y < 20 ? 3 : 0) ? 12
                                                                       : 0; },
                 truth, photo);
     }},
    {"a hard map whose last near pixel is the rest of a ramp", 250, 0,
     [](Photo* truth, Photo* photo) {
       MakeParts([](int x) { return x < 48; },
                 [](int x, int) { return x < 44   ? 12.0F
                                         : x < 45 ? 11
                                                  : 0; }, truth, photo);
     }},
    {"unknown values", 400, 7,
     [](Photo*, Photo* photo) {
       for (int y = 20; y < 40; ++y) {
         for (int x = 130; x < 150; ++x) {
           photo->Map(x, y) = x % 3 == 0 ? kNan : x % 3 == 1 ? kInfinity : -kInfinity;
         }
       }
     }},
};

TEST_CASE("one view: a damaged map becomes the map of the picture") {
  for (const Damage& damage : kDamages) {
    Photo truth = MakeDisc(0), photo = truth;
    damage.change(&truth, &photo);
    CAPTURES(damage.name);
    CHECK(CountWrong(photo.map, truth, damage.by) >= damage.before);
    CHECK(CountWrong(Repair(photo).disparity, truth, damage.by) <= damage.after);
  }
}

// The first pass of a repair moves outlines to places that it has not looked at.
TEST_CASE("one view: a repaired map does not depend on what was in memory") {
  for (int wide = 1; wide < 8; ++wide) {
    Photo photo = MakeDisc(0);
    const Photo grown = MakeDisc(wide);
    ForPixels(photo, [&](int x, int y, double) {
      if (y % 64 < 40) photo.Map(x, y) = grown.map[grown.At(x, y)];
    });
    const test::PlaneField plane = {photo.width, photo.height, {photo.rgb}};
    starfocus_light_field field = plane.Get();
    field.depth = starfocus_depth_float(photo.map.data(), sizeof(float) * size_t(photo.width),
                                        photo.width, photo.height);
    const auto repaired = [&](int fill) {
      return TryMap(ConfigOf(plane, -8, 8), field, test::Makes::kRepair, nullptr, 0, fill);
    };
    CHECK(repaired(0).disparity == repaired(255).disparity);
  }
}

TEST_CASE("one view: no bit of a correct map with steps, planes and fractions changes") {
  const Photo disc = MakeDisc(0, 6.0123F, -3.987F);
  Photo plane = MakeDisc(0);
  ForPixels(plane,
            [&](int x, int y, double) { plane.Map(x, y) = 0.013F * float(x) - 0.07F * float(y); });
  for (const Photo& photo : {disc, plane}) {
    const std::vector<float> map = Repair(photo).disparity;
    CHECK(std::memcmp(map.data(), photo.map.data(), map.size() * sizeof(float)) == 0);
  }
}

TEST_CASE("one view: in a picture of one colour, only the outline may change, without confidence") {
  Photo photo = MakeDisc(0);
  std::fill(photo.rgb.begin(), photo.rgb.end(), uint8_t{kUnset});
  const MadeMap repaired = Repair(photo);
  CHECK(CountWrong(repaired.disparity, photo) < 60);
  CHECK(repaired.confidence[photo.At(5, 5)] == 255);
  CHECK(repaired.confidence[photo.At(151, 26)] < 100);
}

TEST_CASE("one view: unknown values get the disparity of the nearest known pixel or row") {
  for (const int at : {0, 17, 34}) {
    Photo photo(7, 5);
    std::fill(photo.map.begin(), photo.map.end(), kNan);
    photo.map[size_t(at)] = 2.5F;
    for (const float d : Repair(photo).disparity) CHECK(d == 2.5F);
  }
  Photo photo(2, 8);
  std::fill(photo.map.begin(), photo.map.end(), kNan);
  photo.Map(0, 2) = 1, photo.Map(1, 2) = 4;
  photo.Map(0, 6) = 3, photo.Map(1, 6) = 2;
  // A row that is equally near to two known rows gets the farther surface.
  CHECK(Repair(photo).disparity ==
        std::vector<float>{1, 4, 1, 4, 1, 4, 1, 4, 1, 2, 3, 2, 3, 2, 3, 2});
}

TEST_CASE("one view: disparities stay within the configured range") {
  for (const int width : {1, 2, 3, 5, 16, 33}) {
    for (const int height : {1, 2, 4, 17}) {
      Photo photo(width, height);
      for (size_t k = 0; k < photo.map.size(); ++k) {
        photo.map[k] = float(int(k * k % 23) - 11) * 45.0F;
        photo.rgb[3 * k] = uint8_t(k * 37);
      }
      test::CheckWithin(Repair(photo).disparity, -500, 500);
    }
  }
  Photo noisy(64, 64);
  test::Random random(11);
  const float low = 1.003F, high = 7;  // 1.003 is not a multiple of 1/64
  for (size_t at = 0; at < noisy.map.size(); ++at) {
    noisy.map[at] = at % 64 < 16 ? low : float(random.Real(4, high));
  }
  const std::vector<float> found = Repair(noisy, false, low, high).disparity;
  CHECK(found != noisy.map);
  test::CheckWithin(found, low, high);
}

// Converts a portrait into a picture with a map.
Photo PhotoOf(const Portrait& portrait) {
  Photo photo(Portrait::kWidth, Portrait::kHeight);
  photo.rgb = portrait.rgb;
  photo.map = portrait.map;
  return photo;
}

// Returns the mean absolute difference of two planes in an area.
double Difference(const Area& area, const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  int64_t sum = 0, count = 0;
  for (int y = area.top; y < area.bottom; ++y) {
    for (int x = area.left; x < area.right; ++x, ++count) {
      const size_t at = size_t(y) * Portrait::kWidth + size_t(x);
      sum += std::abs(a[at] - b[at]);
    }
  }
  return double(sum) / double(count);
}

// Portraits with a map in which the outline of the hair is closed, so that the map alone implies a
// coverage of 255 everywhere in the hair, with a mean error of 182.
struct Hair {
  const char* name;
  void (*change)(Portrait* portrait);
  // Mean errors of the coverage in areas; without areas, the repair must not find coverage.
  struct Bound {
    Area area;
    double most;
  };
  std::vector<Bound> bounds;
  Area near = {};  // All disparities of the repaired map are near.
};
const Hair kHairs[] = {
    {"hair on a body",
     [](Portrait*) {},
     {{{44, 64, 176, 108}, 24}, {{60, 124, 232, 178}, 0.5}, {{60, 30, 160, 56}, 4}},
     {44, 64, 176, 106}},
    {"the outline of the body next to the hair is 2 pixels too low, and stays opaque",
     [](Portrait* portrait) {
       for (int y = 110; y < 112; ++y) {
         for (int x = 182; x < 240; ++x) portrait->map[portrait->At(x, y)] = Portrait::kFar;
       }
     },
     {{{232, 110, 238, 112}, 0}, {{234, 108, 235, 109}, 0}},
     {232, 110, 238, 112}},
    {"hair at the edge of the picture, and a post",
     [](Portrait* portrait) {
       portrait->hair = {0, 60, 70, 110};
       portrait->body = {0, 110, 240, 181};
       portrait->post = {170, 10, 220, 110};
       portrait->Draw();
     },
     {{{4, 64, 66, 106}, 24}, {{140, 14, 240, 181}, 0}}},
    {"a wall with spots",
     [](Portrait* portrait) {
       portrait->spots = true;
       portrait->Draw();
     },
     {{{60, 40, 160, 56}, 0.5}}},
    {"a pattern of the wall that the map covers",
     [](Portrait* portrait) {
       portrait->strands = {};
       portrait->strands.period = 1;  // The strands cover nothing.
       portrait->spots = true;
       portrait->spot_share = 100;
       portrait->spot_period = 7;
       portrait->body = {};
       portrait->Draw();
     },
     {}},
    {"a map without edges",
     [](Portrait* portrait) { portrait->map.assign(portrait->map.size(), Portrait::kNear); },
     {}},
    {"hair across the picture",
     [](Portrait* portrait) {
       portrait->hair = {0, 60, 240, 110};
       portrait->body = {0, 110, 240, 181};
       portrait->Draw();
     },
     {{{0, 64, 240, 108}, 60}, {{0, 112, 240, 113}, 0}}},
};

TEST_CASE("hair: a repair finds coverage where the map has closed the outline of hair") {
  uint64_t checksum = 0;
  for (const Hair& hair : kHairs) {
    Portrait portrait = MakeClosedHair();
    hair.change(&portrait);
    const Photo photo = PhotoOf(portrait);
    const MadeMap found = Repair(photo, true, -12, 12);
    CAPTURES(hair.name);
    CHECK(found.has_coverage == int(!hair.bounds.empty()));
    for (const Hair::Bound& bound : hair.bounds) {
      CHECK(Difference(bound.area, found.coverage, portrait.coverage) <= bound.most);
    }
    for (int y = hair.near.top; y < hair.near.bottom; ++y) {
      for (int x = hair.near.left; x < hair.near.right; ++x) {
        REQUIRE(found.disparity[photo.At(x, y)] == Portrait::kNear);
      }
    }
    for (size_t at = 0; at < found.disparity.size(); ++at) {
      const auto steps = int64_t(found.disparity[at] * 64);
      checksum = checksum * 31 + uint64_t(steps) + found.coverage[at] * 3 + found.confidence[at];
    }
  }
  // Changes with any bit of a map, a coverage or a confidence.
  CHECK(checksum == 12921222515237035788u);
}

TEST_CASE("hair: confidence is high where map and coverage agree") {
  const Photo photo = PhotoOf(MakeClosedHair());
  const MadeMap found = Repair(photo, true);
  REQUIRE(found.has_coverage == 1);
  // In these rows and columns, all pixels of the map are near.
  CHECK(Difference({60, 70, 160, 100}, found.confidence, found.coverage) == 0);
}

TEST_CASE("hair: without hair, a request for coverage changes neither map nor confidence") {
  Portrait portrait;
  portrait.Draw();
  for (size_t k = 0; k < portrait.map.size(); k += 7) portrait.map[k] += 0.01F;
  const Photo photo = PhotoOf(portrait);
  const MadeMap asked = Repair(photo, true), unasked = Repair(photo);
  CHECK(asked.has_coverage == 0);
  CHECK(unasked.has_coverage == 0);
  CHECK(asked.disparity == unasked.disparity);
  CHECK(asked.confidence == unasked.confidence);
  CHECK(unasked.coverage == std::vector<uint8_t>(unasked.coverage.size(), kUnset));
}

}  // namespace
}  // namespace one_view_test
