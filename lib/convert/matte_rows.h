// SPDX-License-Identifier: Apache-2.0
// Resamples mattes to the size of the picture. Along an axis on which the matte has fewer samples
// than the picture, or equally many, alpha is interpolated by Catmull-Rom splines. Along other
// axes, alpha is the mean over the area of the pixel.
#ifndef STARFOCUS_LIB_CONVERT_MATTE_ROWS_H_
#define STARFOCUS_LIB_CONVERT_MATTE_ROWS_H_

#include <cstddef>
#include <cstdint>

#include "starfocus/matte.h"

namespace starfocus {

// Largest number of columns of MatteRows, whose arrays lie on the stack.
inline constexpr int32_t kMattePiece = 256;

// Weights of neighbouring samples of an axis. The weights sum to MatteAxis::total().
struct MatteTaps {
  int32_t first, count;     // samples; may lie beyond the ends of the axis
  int32_t weights[4] = {};  // of a spline; or of the first, each middle, and the last sample
  bool averages;

  int32_t Weight(int32_t k) const {
    return weights[!averages ? k : k == 0 ? 0 : k == count - 1 ? 2 : 1];
  }
};

// Positions of the pixels of a row or column of the picture in the matte.
struct MatteAxis {
  int32_t samples, pixels;

  bool averages() const { return samples > pixels; }
  int32_t total() const;
  MatteTaps At(int32_t pixel) const;
};

// Columns of a picture whose alpha is read row by row. Neighbouring rows of the picture share
// resampled rows of the matte.
class MatteRows {
 public:
  // Reads `count` columns, at most kMattePiece, starting at column x, of a picture of
  // width x height.
  MatteRows(const starfocus_matte& matte, int32_t width, int32_t height, int32_t x, int32_t count);

  // Writes the alpha of row y of the picture.
  void Read(int32_t y, uint8_t* alpha);

 private:
  static constexpr int32_t kHeld = 4;  // rows that a spline reads

  // Returns row `row` of the matte at the columns of the picture, in 1/64 (kAlphaBits).
  const int16_t* Row(int32_t row);

  const starfocus_matte& matte_;
  const MatteAxis across_, down_;
  const int32_t count_;
  MatteTaps columns_[kMattePiece];
  int32_t held_[kHeld] = {-1, -1, -1, -1};  // rows of the matte in rows_
  int16_t rows_[kHeld][kMattePiece];
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_CONVERT_MATTE_ROWS_H_
