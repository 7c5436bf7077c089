// SPDX-License-Identifier: Apache-2.0
// Generates the legend of a depth map in colours (DrawDepth) for a page.
//
// Computes the pictures of a page by refocusing a light field several times. Finds ground-truth
// pictures with which the refocused pictures are compared.
#ifndef STARFOCUS_EXAMPLES_CLI_STRIP_H_
#define STARFOCUS_EXAMPLES_CLI_STRIP_H_

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "examples/cli/engine_run.h"
#include "examples/command_line/options.h"
#include "platform/light_field.h"
#include "platform/result.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// CSS rules of the legend. The rules use the colours of the page (page.cc).
extern const char kLegendStyle[];

// Returns HTML of a bar with the colours from the smallest disparity, far, to the largest, near.
// The bar marks the disparities in focus. A focus beyond an end of the bar is marked at this end.
std::string LegendHtml(const starfocus_disparity_stats& stats, std::optional<FocusBand> focus);

struct LensAt {
  double focus = 0, aperture = 1;
};

// Returns the largest blur radius of a picture that is refocused with `lens`.
double BlurOf(const LensAt& lens, const starfocus_disparity_stats& stats);

// Returns `count` foci at equal steps of disparity, from far to near. The foci cover the known
// values of the map except for the lowest and the highest hundredth of these values. Returns one
// focus if all values are equal.
std::vector<double> StripFoci(const FloatMap& map, int count);

// A ground-truth picture of the folder's scene through a real lens: truth_dt<D>_ut<U>.png, as
// `starfocus-lab scene` writes it.
struct TruthFile {
  std::string path;
  LensAt lens;
};

// Returns the ground-truth files of a folder, sorted by name.
std::vector<TruthFile> FindTruths(const std::string& folder);

// Refocuses the light field of a folder or photo for each of the lenses, and calls `show` with each
// picture and its blocks. Blur radii must not exceed STARFOCUS_MAX_BLUR.
Error RefocusEach(
    const std::string& where, const LightField& light_field, const starfocus_disparity_stats& stats,
    int threads, const std::vector<LensAt>& lenses,
    const std::function<Error(size_t, const Image&, const std::vector<starfocus_block>&)>& show);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_STRIP_H_
