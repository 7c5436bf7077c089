// SPDX-License-Identifier: Apache-2.0
// Strands of one to a few pixels in front of a farther surface, and a portrait with hair, which is
// one closed area without gaps in the disparity map, as in maps of monocular networks.
#ifndef STARFOCUS_TESTS_SUPPORT_HAIR_H_
#define STARFOCUS_TESTS_SUPPORT_HAIR_H_

#include <cstddef>
#include <cstdint>
#include <vector>

namespace test {

// Strands of hair, described by a periodic profile of coverage. Coverage and depth range from 0
// (the far surface) to 255.
struct Strands {
  static constexpr int kMostPeriod = 12;

  uint8_t profile[kMostPeriod] = {};  // Coverage of each sample, 0 to 255.
  int period = 0;                     // Number of samples in the profile; 0: no strands.
  // Number of profile samples per pixel to the right, and per pixel down.
  int right = 1, down = 0;
  bool ramps = false;  // true if outlines in the map are ramps, as in maps of neural networks

  bool any() const { return period > 0; }
  int CoverageAt(int x, int y) const {
    const int at = (right * x + down * y) % period;
    return profile[at < 0 ? at + period : at];
  }
  int DepthAt(int x, int y) const {
    if (!ramps) return NearAt(x, y);
    return (NearAt(x - 1, y) + 2 * NearAt(x, y) + NearAt(x + 1, y)) / 4;
  }

 private:
  int NearAt(int x, int y) const { return CoverageAt(x, y) > 127 ? 255 : 0; }
};

template <class Random>
Strands DrawStrands(Random* random) {
  Strands strands;
  for (uint8_t& coverage : strands.profile) coverage = static_cast<uint8_t>(random->Int(0, 255));
  strands.period = random->Int(3, Strands::kMostPeriod);
  strands.down = random->Int(0, 3);
  strands.right = random->Int(strands.down == 0 ? 1 : 0, 3);
  strands.ramps = random->Int(0, 2) == 0;
  return strands;
}

// Returns the level of a pixel that shows `coverage` / 255 of `near` and the rest of `far`.
inline uint8_t Mixture(int coverage, int near, int far) {
  return static_cast<uint8_t>((coverage * near + (255 - coverage) * far) / 255);
}

struct Area {
  int left, top, right, bottom;

  bool Has(int x, int y) const { return x >= left && x < right && y >= top && y < bottom; }
};

// A portrait: a body in front of a wall, with hair on the left part of the body's top edge.
struct ClosedHair {
  static constexpr float kNear = 9, kFar = -4;
  static constexpr int kWidth = 240, kHeight = 181;
  Area body = {40, 110, 240, 181}, hair = {40, 60, 180, 110};
  Area post = {};      // An opaque object at the disparity of the body.
  Strands strands;     // Strands of the hair; without strands, the hair is opaque.
  bool spots = false;  // True if the wall has spots, which contain a part of the near colour.
  int spot_share = 64, spot_period = 9;
  std::vector<uint8_t> rgb, coverage;
  std::vector<float> map;

  void Draw() {
    rgb.clear(), coverage.clear(), map.clear();
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) DrawPixel(x, y);
    }
  }
  size_t At(int x, int y) const { return size_t(y) * kWidth + size_t(x); }

 private:
  void DrawPixel(int x, int y) {
    const int speckle = (x * 7 + y * 13 + x * y % 11) % 17;
    const int near[3] = {90 + speckle, 50 + speckle / 2, 30};
    const int far[3] = {150 + y / 4, 170 + speckle, 200 - x / 8};
    const bool in_hair = hair.Has(x, y), solid = body.Has(x, y) || post.Has(x, y);
    int covers = in_hair || solid ? 255 : 0;
    if (in_hair && strands.any()) covers = strands.CoverageAt(x, y);
    const bool in_spot = spots && x % spot_period < 2 && y % spot_period < 2;
    const int mixed = in_spot && covers == 0 ? spot_share : covers;
    for (int c = 0; c < 3; ++c) rgb.push_back(Mixture(mixed, near[c], far[c]));
    coverage.push_back(uint8_t(covers));
    map.push_back(in_hair || solid ? kNear : kFar);
  }
};

inline ClosedHair MakeClosedHair() {
  ClosedHair portrait;
  const int profile[] = {128, 255, 128, 0, 0, 0, 0};
  for (int k = 0; k < 7; ++k) portrait.strands.profile[k] = uint8_t(profile[k]);
  portrait.strands.period = 7;
  portrait.Draw();
  return portrait;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_HAIR_H_
