// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/matte.h"

#include <algorithm>
#include <cmath>

#include "platform/problem.h"
#include "platform/readers/map_orientation.h"
#include "platform/text.h"
#include "starfocus/matte.h"

namespace starfocus {
namespace {

starfocus_matte EngineMatte(const Matte& matte) {
  return {matte.alpha.data(), size_t(matte.width), 1, matte.width, matte.height};
}

// Returns an error unless a call of the engine succeeded. CheckMatte leaves only sizes beyond the
// limit of the engine.
Error Judge(const std::string& where, starfocus_status status) {
  if (status == STARFOCUS_OK) return {};
  return Expected(where,
                  "a picture and a matte of up to " + std::to_string(STARFOCUS_MAX_SIZE) +
                      " pixels in width and height",
                  std::string("the error \"") + Describe(status, nullptr).text + "\"");
}

// The jobs of CoverByMatte, each of which fills kRows rows.
struct CoverTask {
  static constexpr int kRows = 128;

  const starfocus_matte matte;
  const starfocus_depth_map depth;
  uint8_t* const coverage;
  std::vector<starfocus_status> statuses;  // one per job

  static void Run(void* data, int32_t index, int32_t) {
    CoverTask& task = *static_cast<CoverTask*>(data);
    const int32_t width = task.depth.width, height = task.depth.height, top = index * kRows;
    const starfocus_region rows = {0, top, width, std::min(kRows, height - top)};
    starfocus_disparity_output out = {};
    out.coverage = task.coverage + size_t(top) * size_t(width);
    out.coverage_stride = size_t(width);
    task.statuses[size_t(index)] =
        starfocus_matte_coverage(&task.matte, &task.depth, width, height, &rows, &out, nullptr);
  }
};

}  // namespace

Matte::Matte(const FloatMap& map) : width(map.width), height(map.height) {
  alpha.reserve(map.values.size());
  for (const float value : map.values) {
    const float level = std::isnan(value) ? 0 : std::clamp(value, 0.0F, 1.0F);
    alpha.push_back(static_cast<uint8_t>(level * 255 + 0.5F));
  }
}

std::string Description(const Matte& matte) {
  starfocus_matte_stats stats = {};
  const starfocus_matte engine = EngineMatte(matte);
  starfocus_measure_matte(&engine, &stats, nullptr);
  return SizeText(matte.width, matte.height) + ", the subject covers " +
         std::to_string(std::lround(100 * stats.covered)) + " % of the picture";
}

MatteContent ContentOf(const FloatMap& matte) {
  const auto is_subject = [](float alpha) { return alpha >= 0.5F; };
  const auto subject = std::count_if(matte.values.begin(), matte.values.end(), is_subject);
  if (subject == 0) return MatteContent::kEmpty;
  return size_t(subject) < matte.values.size() ? MatteContent::kBoth : MatteContent::kFull;
}

Error CheckMatte(const std::string& where, const FloatMap& matte, const Image& picture,
                 bool is_frame) {
  if (!HasSameProportions(matte, picture.width, picture.height) &&
      !IsStretched(matte, picture.width, picture.height)) {
    return Expected(
        where, "a matte with the proportions of the picture, or a square matte of a network",
        SizeText(matte.width, matte.height) + " for " + SizeText(picture.width, picture.height));
  }
  const MatteContent content = ContentOf(matte);
  if (is_frame || content == MatteContent::kBoth) return {};
  if (content == MatteContent::kEmpty) {
    const float largest = *std::max_element(matte.values.begin(), matte.values.end());
    return Expected(where, "a matte with a subject, alpha 0.5 or more",
                    "an empty matte, alpha up to " + NumberText(double(largest)));
  }
  return Expected(where, "a matte with a background", "a full matte, alpha 0.5 or more everywhere");
}

Error FillTwoSurfaces(const std::string& where, const Matte& matte, double subject, bool floor,
                      LightField* light_field) {
  const Image& picture = light_field->views[0];
  const size_t pixels = size_t(picture.width) * size_t(picture.height);
  FloatMap& map = light_field->disparity;
  map = {picture.width, picture.height, std::vector<float>(pixels)};
  light_field->coverage.resize(pixels);
  starfocus_disparity_output out = {};
  out.disparity = map.values.data();
  out.disparity_stride = map.stride();
  out.coverage = light_field->coverage.data();
  out.coverage_stride = size_t(picture.width);
  starfocus_matte_depth depth = {subject, 0, 0, 0};
  const starfocus_matte engine = EngineMatte(matte);
  if (floor) {
    starfocus_matte_stats stats = {};
    if (Error error = Judge(where, starfocus_measure_matte(&engine, &stats, nullptr))) return error;
    depth.horizon = stats.horizon;
    depth.ground = stats.ground;
  }
  return Judge(where, starfocus_matte_field(&engine, &depth, picture.width, picture.height, nullptr,
                                            &out, nullptr));
}

Error CoverByMatte(const std::string& where, const Matte& matte, ThreadRunner* runner,
                   LightField* light_field) {
  const FloatMap& map = light_field->disparity;
  light_field->coverage.resize(map.values.size());
  const int jobs = (map.height + CoverTask::kRows - 1) / CoverTask::kRows;
  CoverTask task = {EngineMatte(matte), EngineMap(map), light_field->coverage.data(),
                    std::vector<starfocus_status>(size_t(jobs))};
  ThreadRunner::Run(runner, CoverTask::Run, &task, jobs);
  const auto failed = std::find_if(task.statuses.begin(), task.statuses.end(),
                                   [](starfocus_status status) { return status != STARFOCUS_OK; });
  return failed == task.statuses.end() ? Error() : Judge(where, *failed);
}

}  // namespace starfocus
