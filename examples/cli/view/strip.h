// SPDX-License-Identifier: Apache-2.0
// The pictures of a page: one light field refocused several times, and truths to hold against them.
#ifndef STARFOCUS_EXAMPLES_CLI_VIEW_STRIP_H_
#define STARFOCUS_EXAMPLES_CLI_VIEW_STRIP_H_

#include <functional>
#include <string>
#include <vector>

#include "examples/cli/engine/engine_run.h"
#include "platform/light_field.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct LensAt {
  double focus = 0, aperture = 1;
};

// The largest blur radius of a picture by this lens.
double BlurOf(const LensAt& lens, const starfocus_disparity_stats& stats);

// So many foci at equal steps of disparity, from far to near, between all but the outermost
// hundredths of the map's known values. One where all values are alike.
std::vector<double> StripFoci(const FloatMap& map, int count);

// A picture that a real lens took of what a folder holds: truth_dt<D>_ut<U>.png, as
// `starfocus-lab scene` writes it.
struct TruthFile {
  std::string path;
  LensAt lens;
};

// In the order of their names.
std::vector<TruthFile> FindTruths(const std::string& folder);

// Refocuses the light field of a folder or photo by each of the lenses, whose blur is at most
// STARFOCUS_MAX_BLUR, and shows the result with its blocks.
Error RefocusEach(
    const std::string& where, const LightField& light_field, const starfocus_disparity_stats& stats,
    int threads, const std::vector<LensAt>& lenses,
    const std::function<Error(size_t, const Image&, const std::vector<starfocus_block>&)>& show);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_VIEW_STRIP_H_
