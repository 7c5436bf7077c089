// Selection rules of the paper: how many views a blur radius needs.
#ifndef STARFOCUS_LIB_RULES_H_
#define STARFOCUS_LIB_RULES_H_

#include <cstdint>

namespace starfocus {

// Views along the aperture radius by (9). r_max >= 0 in pixels; 0 needs the centre view alone.
int32_t ViewsByPaper(double r_max);

// Views along the aperture radius of the benchmark: 2 * ceil(r_max).
int32_t ViewsOfBenchmark(double r_max);

// Subsampled layer by (12), up to 2, for the smallest blur radius of a block in pixels.
int32_t LayerByPaper(double r_min);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_RULES_H_
