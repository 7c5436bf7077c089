// SPDX-License-Identifier: Apache-2.0
// Strands of one to a few pixels in front of a farther surface, for scenes of thin structure.
#ifndef STARFOCUS_TESTS_SUPPORT_STRANDS_H_
#define STARFOCUS_TESTS_SUPPORT_STRANDS_H_

#include <cstdint>

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

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_STRANDS_H_
