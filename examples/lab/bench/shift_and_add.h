// SPDX-License-Identifier: Apache-2.0
// Shift-and-add of captured views, the rival with which the bench compares the speed of the engine.
// Used by measure.cc and speed.cc.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_SHIFT_AND_ADD_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_SHIFT_AND_ADD_H_

#include <cstdint>
#include <string>
#include <vector>

#include "examples/lab/bench/field.h"
#include "simd/kernels.h"

namespace starfocus::bench {

// Computes the weighted mean of `views` captured views in 16 bits, each shifted with bilinear
// interpolation so that disparity `focus` is in focus. The weight of a view is the light of the
// part of the default lens with aperture 1 that is nearer to this view than to other views.
class ShiftAndAdd {
 public:
  // `target` is the SIMD target of all loops. If `target` is empty or not a SIMD target of this
  // machine, the best target replaces it.
  ShiftAndAdd(const Field& field, int views, double focus, const std::string& target);
  // Returns the width of the target's vectors in bits.
  int vector_bits() const { return loops_->vector_bits; }
  void Run(Image* out);

  // Loops over the samples of a row, compiled for one SIMD target. `part` and `weight` have 15
  // fractional bits. The loops process whole vectors.
  struct Loops {
    int vector_bits;
    // Interpolates between the rows a and b.
    void (*mix)(const int16_t* a, const int16_t* b, int16_t part, size_t count, int16_t* out);
    // Interpolates between the pixels of a row, and adds the weighted samples to `sums`.
    void (*add)(const int16_t* row, int16_t part, int16_t weight, size_t count, int16_t* sums);
  };

 private:
  struct View {
    int whole_x, whole_y;    // Whole pixels of the shift.
    int16_t part_x, part_y;  // Rest of the shift: 15 fractional bits, in [0, 1).
    int16_t weight;          // 15 fractional bits.
    int decoded[2];          // Indices of the rows in `rows`, or -1.
    std::vector<int16_t> rows[2];
  };
  const int16_t* Decoded(const Image& image, int y, View* view);
  void AddView(const Image& image, int y, View* view);

  const Field& field_;
  const simd::Kernels* kernels_;
  const Loops* loops_;
  size_t pad_;  // Number of samples before and after each row.
  std::vector<View> views_;
  std::vector<uint8_t> codes_;           // Row that kernels may read beyond its end.
  std::vector<int16_t> between_, sums_;  // Row between two rows, and sums of a row of the picture.
};

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_SHIFT_AND_ADD_H_
