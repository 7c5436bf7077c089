// SPDX-License-Identifier: Apache-2.0
// Measures and corrects the vertical differences between the two pictures of a stereo pair. Two
// cameras, or two photos from the hand, seldom show a point at exactly the same height. Estimates
// of disparities require equal heights.
#ifndef STARFOCUS_PLATFORM_READERS_PAIR_ALIGNMENT_H_
#define STARFOCUS_PLATFORM_READERS_PAIR_ALIGNMENT_H_

#include "platform/image.h"

namespace starfocus {

// Vertical differences between corresponding points of two pictures.
struct PairAlignment {
  // Least number of points from which a pair is judged.
  static constexpr int kLeastPoints = 40;

  int corners = 0;     // Number of points that can be recognized in the left picture.
  int matches = 0;     // Number of these points that were found in the right picture.
  int repeated = 0;    // Number of these points that resemble several points of the right picture.
  int consistent = 0;  // Number of matches within a pixel of the reduced pictures from the plane.
  // Point (x, y) of the left picture is at height y + offset + across * x + down * y in the right
  // picture, in pixels.
  double offset = 0, across = 0, down = 0;

  double At(double x, double y) const { return offset + across * x + down * y; }
  // True if there are enough matches to judge the pair.
  bool known() const { return matches >= kLeastPoints; }
  // True if most corners that are not repeated have no match, most matches contradict each other,
  // or the pictures are rotated by more than 3 degrees or scaled by more than 5 %.
  bool contradicts() const;
};

// Finds points of the left picture in the right picture, up to an eighth of the width to the sides,
// and up to a sixteenth of the height above or below. The pictures must have the same size.
PairAlignment MeasureAlignment(const Image& left, const Image& right);

// Returns the largest absolute vertical difference in a picture.
double LargestDifference(const PairAlignment& alignment, const Image& picture);

// Rotates, scales and moves the right picture, so that its points have the heights that they have
// in the left picture.
Image AlignedPicture(const PairAlignment& alignment, const Image& right);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PAIR_ALIGNMENT_H_
