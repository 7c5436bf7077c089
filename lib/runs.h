// Runs of one disparity along a line: found once per line, shared by all its views.
#ifndef STARFOCUS_LIB_RUNS_H_
#define STARFOCUS_LIB_RUNS_H_

#include <cstdint>

namespace starfocus {

// Pixels [begin, end) of a line, end being the begin of the run before it in scan order.
struct Run {
  uint16_t begin;
  int16_t disparity;  // kDisparityBits: the middle of the run's range
};

// Scan order of a line. A view to the right of the centre (or below it) is scanned from the right
// end, where the surfaces that cover others come from; a view to the left is the mirror image.
enum class Direction { kRightToLeft, kLeftToRight };

// Splits a line into runs within which the disparity varies by at most `spread` (kDisparityBits),
// greedily in scan order. Positions of runs are mirrored for kLeftToRight: position q stands for
// pixel length - 1 - q. Runs come in scan order, from high positions to low.
// Writes at most `length` runs, returns their number; length in [1, 65535].
int32_t FindRuns(const int16_t* disparity, int32_t length, Direction direction, int32_t spread,
                 Run* runs);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_RUNS_H_
