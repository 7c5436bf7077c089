// SPDX-License-Identifier: Apache-2.0
// Computes disparity maps from captured views through the C API, with the default range, the
// workspace and the progress line, and draws disparity maps.
#ifndef STARFOCUS_EXAMPLES_CLI_ESTIMATE_RUN_H_
#define STARFOCUS_EXAMPLES_CLI_ESTIMATE_RUN_H_

#include <cstdint>
#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/light_field.h"
#include "platform/pfm.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Counts the finite disparities in each of `bins` equal parts of the measured range.
std::vector<int64_t> Histogram(const FloatMap& map, const starfocus_disparity_stats& stats,
                               int bins);

// Draws a finite map as a picture in which the nearest disparity is white.
Image DrawDisparity(const FloatMap& map);

// Colours of DrawDepth at equal steps of disparity, from the farthest to the nearest. The colours
// between two entries are interpolated. These are nine colours of the colour map viridis
// (https://bids.github.io/colormap/, CC0), whose lightness increases from far to near.
inline constexpr uint8_t kDepthColors[9][3] = {{68, 1, 84},    {71, 45, 123},  {59, 82, 139},
                                               {44, 114, 142}, {33, 145, 140}, {40, 174, 128},
                                               {94, 201, 98},  {173, 220, 48}, {253, 231, 37}};

// Draws a finite map in the colours kDepthColors, of which the first means stats.min and the last
// stats.max. All values must be in this range. `map` may be a sample of the map that was measured.
Image DrawDepth(const FloatMap& map, const starfocus_disparity_stats& stats);

// Reduces a map to `width` x `height` pixels. Every pixel of the result has the disparity at its
// centre, so that edges stay sharp.
FloatMap SampleMap(const FloatMap& map, int width, int height);

// Extension of the range that a repair searches beyond the disparities of the map, in pixels. The
// extension is required because blur in a map reduces the extremes of its disparities.
constexpr float kRepairReach = 1;

struct DisparityRange {
  float min = 0, max = 0;
};

struct DisparityEstimate {
  FloatMap map;
  DisparityRange range;  // Searched range; after a repair, the range of the map.
  Image confidence;  // Grey levels: 0 is uncertain, 255 is certain (starfocus_estimate_disparity).
  // Coverage of hair from a repair; empty if not requested or not found.
  std::vector<uint8_t> coverage;
};

struct RepairOptions {
  int threads = 1;
  bool coverage = false, confidence = false;  // additional outputs
};

// Converts grey levels, one for each pixel, to a picture of the size of `centre`. The grey levels
// are confidences or coverage.
Image DrawLevels(const std::vector<uint8_t>& levels, const Image& centre);

// Returns the number of views (1, 5, 9 or 17) of the largest star that the first positions form.
// Maps are repaired only from the views of the largest star.
int StarWithin(const Positions& positions);

// Returns the number of views from which maps are estimated: the views of the largest star of 5 or
// more views, or all views if the first positions form no star.
int EstimateViews(const Positions& positions);

// Returns an error unless the light field has at least 2 views. Error messages start with `where`.
Error CheckEstimateViews(const std::string& where, const LightField& light_field);

// Finds the range of disparities of the views from which maps are estimated, up to an eighth of the
// picture's width. The range is estimated from reduced pictures and extended by a margin.
Result<DisparityRange> FindRange(const std::string& where, const LightField& light_field,
                                 int threads);

// Estimates the map and shows progress. Error messages start with `where`.
Result<DisparityEstimate> EstimateDisparity(const std::string& where, const LightField& light_field,
                                            const DisparityRange& range, int threads);

// Repairs the map of a light field with the largest star among its views. Without a star of 5 or
// more views, the repair uses the centre view alone. Shows progress. Error messages start with
// `where`.
Result<DisparityEstimate> RepairDisparity(const std::string& where, const LightField& light_field,
                                          const RepairOptions& options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_ESTIMATE_RUN_H_
