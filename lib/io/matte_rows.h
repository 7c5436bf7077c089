// SPDX-License-Identifier: Apache-2.0
// Resamples mattes to the size of the picture. Along an axis on which the matte has at most as many
// samples as the picture, alpha is interpolated by cubic splines, and the contrast of small mattes
// is raised. Along other axes, alpha is the mean over the area of each pixel.
#ifndef STARFOCUS_LIB_IO_MATTE_ROWS_H_
#define STARFOCUS_LIB_IO_MATTE_ROWS_H_

#include <cstddef>
#include <cstdint>

#include "starfocus/matte.h"

namespace starfocus {

// Largest number of columns of MatteRows, whose arrays lie on the stack.
inline constexpr int32_t kMattePiece = 256;

// Samples of one axis that determine the alpha of a pixel. `first` and the samples after it may lie
// beyond the ends of the axis; the outermost samples are repeated there.
struct MatteTaps {
  int32_t first, count;
  int32_t weights[4];  // of the samples of a spline; or of the first, each middle, and the last
};

// One axis of a matte and of the picture.
struct MatteAxis {
  int32_t samples, pixels;

  // Returns true if the alpha of a pixel is a mean. Otherwise, the alpha is interpolated.
  bool Averages() const { return samples > pixels; }
  // Returns the samples of a pixel. The weights of a mean sum to `samples`, and the weights of a
  // spline to 1 << kSplineBits.
  MatteTaps At(int32_t pixel) const;
  // Returns the part of the B-spline in the weights of a spline, in 1 / (1 << kSmoothBits).
  int32_t Smooth() const;
};
inline constexpr int kSplineBits = 14;
inline constexpr int kSmoothBits = 8;

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

  // Returns row `row` of the matte at the columns of the picture, in 1/64.
  const int16_t* Row(int32_t row);
  // Fill such a row from the first sample of a row of the matte.
  void AverageRow(const uint8_t* from, int16_t* to) const;
  void InterpolateRow(const uint8_t* from, int16_t* to) const;

  const starfocus_matte& matte_;
  const size_t step_;  // bytes from sample to sample
  const MatteAxis across_, down_;
  const int32_t count_;
  const int32_t contrast_;  // in 1 / (1 << kSmoothBits)
  MatteTaps columns_[kMattePiece];
  int32_t held_[kHeld] = {-1, -1, -1, -1};  // rows of the matte in rows_
  int16_t rows_[kHeld][kMattePiece];
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_MATTE_ROWS_H_
