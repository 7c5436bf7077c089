// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/strip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>

#include "examples/cli/estimate_run.h"
#include "examples/cli/refocus_output.h"
#include "examples/cli/refocus_plan.h"
#include "platform/file.h"
#include "platform/text.h"
#include "starfocus/experimental.h"

namespace starfocus {

namespace {

std::string Gradient() {
  std::string colors;
  for (const uint8_t* color : kDepthColors) {
    colors += ", rgb(" + std::to_string(color[0]) + " " + std::to_string(color[1]) + " " +
              std::to_string(color[2]) + ")";
  }
  return "linear-gradient(to right" + colors + ")";
}

}  // namespace

const char kLegendStyle[] =
    ".legend { margin-top: .6rem; } .bar { position: relative; height: 1rem; }\n"
    ".plane { position: absolute; top: -.3rem; bottom: -.3rem; margin-left: -2.5px; "
    "box-sizing: border-box; border: 2.5px solid var(--text); outline: 2px solid var(--ground); }\n"
    ".ends { display: flex; justify-content: space-between; gap: 1rem; padding-top: .4rem; "
    "font-variant-numeric: tabular-nums; }\n";

std::string LegendHtml(const starfocus_disparity_stats& stats, std::optional<FocusBand> focus) {
  const std::string far = "far " + Decimal(stats.min, 2), near = "near " + Decimal(stats.max, 2);
  std::string says = "Colours of disparity: " + far + ", " + near, plane, label;
  if (focus) {
    const double range = double(stats.max) - stats.min;
    const auto place = [&](double disparity) {
      return range > 0 ? 100 * std::clamp((disparity - stats.min) / range, 0.0, 1.0) : 50.0;
    };
    label = "focus " + Decimal(focus->far, 2);
    if (focus->near > focus->far) label += " to " + Decimal(focus->near, 2);
    says += ", " + label;
    const double begin = place(focus->far), width = place(focus->near) - begin;
    plane = "<span class=\"plane\" style=\"left: " + Decimal(begin, 2) + "%; width: calc(" +
            Decimal(width, 2) + "% + 5px)\"></span>";
    label = "<span>" + label + "</span>";
  }
  return "<div class=\"legend\" role=\"img\" aria-label=\"" + EscapeXml(says) +
         "\"><div class=\"bar\" style=\"background: " + Gradient() + "\">" + plane +
         "</div><div class=\"ends\"><span>" + far + "</span>" + label + "<span>" + near +
         "</span></div></div>";
}

namespace {

namespace fs = std::filesystem;

// Parses truth_dt<D>_ut<U>.png. Returns nullopt for a name with a suffix, which denotes an aperture
// shape other than the default.
std::optional<LensAt> ParseTruthName(const fs::path& name) {
  const std::string stem = name.stem().string();
  LensAt lens;
  int end = 0;
  const int parts =
      std::sscanf(stem.c_str(), "truth_dt%lf_ut%lf%n", &lens.focus, &lens.aperture, &end);
  const bool whole = parts == 2 && size_t(end) == stem.size() && name.extension() == ".png";
  if (!whole || std::fabs(lens.focus) > STARFOCUS_MAX_FOCUS) return {};
  return lens.aperture > 0 && lens.aperture <= 1 ? std::optional(lens) : std::nullopt;
}

// Returns the transfer of the folder's pictures. If the file meta.txt contains "transfer: none",
// the pictures are averages of encoded values instead of linear light.
starfocus_transfer TransferOf(const std::string& folder) {
  const Result<Bytes> bytes = ReadSmallFile((fs::path(folder) / "meta.txt").string());
  const std::string text(bytes->begin(), bytes->end());
  return text.find("transfer: none\n") != std::string::npos ? STARFOCUS_TRANSFER_NONE
                                                            : STARFOCUS_TRANSFER_SRGB;
}

}  // namespace

std::vector<double> StripFoci(const FloatMap& map, int count) {
  std::vector<float> values;
  std::copy_if(map.values.begin(), map.values.end(), std::back_inserter(values),
               [](float value) { return std::isfinite(value); });
  if (values.empty()) return {0};
  const auto at = [&values](size_t place) {
    const auto middle = values.begin() + static_cast<ptrdiff_t>(place);
    std::nth_element(values.begin(), middle, values.end());
    return double(*middle);
  };
  const size_t outermost = values.size() / 100;
  const double far = at(outermost), near = at(values.size() - 1 - outermost);
  if (near - far < 1e-3) return {far};
  std::vector<double> foci;
  for (int i = 0; i < count; ++i) foci.push_back(far + (near - far) * i / (count - 1));
  return foci;
}

double BlurOf(const LensAt& lens, const starfocus_disparity_stats& stats) {
  return lens.aperture * FarthestFromFocus(stats, {lens.focus});
}

std::vector<TruthFile> FindTruths(const std::string& folder) {
  std::vector<TruthFile> truths;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::optional<LensAt> lens = ParseTruthName(entry.path().filename());
    if (lens) truths.push_back({entry.path().string(), *lens});
  }
  std::sort(truths.begin(), truths.end(),
            [](const TruthFile& a, const TruthFile& b) { return a.path < b.path; });
  return truths;
}

Error RefocusEach(
    const std::string& where, const LightField& light_field, const starfocus_disparity_stats& stats,
    int threads, const std::vector<LensAt>& lenses,
    const std::function<Error(size_t, const Image&, const std::vector<starfocus_block>&)>& show) {
  LensOptions options;
  options.transfer = TransferOf(where);
  Result<LensPlan> plan = PlanLens(options);
  if (!plan) return plan.error();
  double max_blur = 1;
  for (const LensAt& lens : lenses) {
    max_blur = std::max(max_blur, std::ceil(BlurOf(lens, stats)));
    plan->foci.push_back(lens.focus);
  }
  EngineTask task = MakeTask(*plan, light_field, stats, max_blur, false);
  std::vector<starfocus_block> blocks;
  task.threads = threads;
  task.observer.on_block = CollectBlock;
  task.observer.on_block_data = &blocks;
  EngineRun run(threads, static_cast<int>(lenses.size()));
  Error error = run.Start(where, task);
  if (!error) error = run.Prepare(where, task);
  for (size_t i = 0; i < lenses.size() && !error; ++i) {
    task.params.focus = lenses[i].focus;
    task.params.aperture = lenses[i].aperture;
    blocks.clear();
    EngineResult result;
    error = run.Refocus(where, task).MoveTo(&result);
    if (!error) error = show(i, result.picture, blocks);
  }
  return error;
}

}  // namespace starfocus
