// SPDX-License-Identifier: Apache-2.0
// Disparity maps from captured views, through the C ABI: the range of disparities where nobody says
// it, workspace, progress.
#ifndef STARFOCUS_EXAMPLES_CLI_DISPARITY_ESTIMATE_RUN_H_
#define STARFOCUS_EXAMPLES_CLI_DISPARITY_ESTIMATE_RUN_H_

#include <cstdint>
#include <string>
#include <vector>

#include "platform/light_field.h"
#include "platform/result.h"

namespace starfocus {

// A repair finds disparities up to this many pixels beyond those of the map: what blurs a map takes
// its peaks off.
constexpr float kRepairReach = 1;

struct DisparityRange {
  float min = 0, max = 0;
};

struct DisparityEstimate {
  FloatMap map;
  DisparityRange range;           // that was looked for; of a repair, that of the map
  Image confidence;               // gray: 0 unknown, 255 sure (starfocus_estimate_disparity)
  std::vector<uint8_t> coverage;  // of a repair; empty: none was asked for, or found
};

struct RepairOptions {
  int threads = 1;
  bool coverage = false, confidence = false;  // what is made beside the map
};

// A gray picture of the size of `centre`, of a level for each pixel: confidence or coverage.
Image DrawLevels(const std::vector<uint8_t>& levels, const Image& centre);

// The number of views of the largest star that the first ones are: maps are made of these alone.
int StarWithin(const Positions& positions);

// Whether these views show disparities: an error about `where` unless 5 or more are a star.
Error CheckStar(const std::string& where, const LightField& light_field);

// Finds the range of disparities of 5, 9 or 17 views, as far as an eighth of the picture's width:
// that of an estimate of small pictures, and a little more.
Result<DisparityRange> FindRange(const std::string& where, const LightField& light_field,
                                 int threads);

// Estimates the map, with a progress line. Errors are about `where`.
Result<DisparityEstimate> EstimateDisparity(const std::string& where, const LightField& light_field,
                                            const DisparityRange& range, int threads);

// Repairs the map of a light field by the star among its views, which may be the centre alone, with
// a progress line. Errors are about `where`.
Result<DisparityEstimate> RepairDisparity(const std::string& where, const LightField& light_field,
                                          const RepairOptions& options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_DISPARITY_ESTIMATE_RUN_H_
