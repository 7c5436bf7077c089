// SPDX-License-Identifier: Apache-2.0
// starfocus-lab calibrate: measures the coefficients of the timing model on this machine.
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "examples/cli/engine_run.h"
#include "examples/cli/input.h"
#include "examples/cli/json.h"
#include "examples/command_line/program.h"
#include "examples/lab/calibrate/scene_times.h"
#include "examples/lab/commands.h"
#include "examples/scene/render.h"
#include "platform/file.h"
#include "platform/runner.h"
#include "starfocus/experimental.h"

namespace starfocus {
namespace {

constexpr int kWidth = 1024, kHeight = 768, kViews = 9;  // size of ray-traced scenes
constexpr int kRepetitions = 5;

struct CalibrateOptions {
  std::string out, folder, check;
};

LightField Trace(const std::string& name) {
  ThreadRunner runner(starfocus_pool_cores());
  const Scene scene = MakeScene(name).value();
  const RayTracer renderer(scene, kWidth, kHeight, STARFOCUS_TRANSFER_SRGB, &runner);
  LightField light_field;
  {
    Progress progress("rendering " + name, int64_t{kHeight} * kViews);
    for (int i = 0; i < kViews; ++i) {
      double u = 0, v = 0;
      starfocus_view_position(i, &u, &v, nullptr);
      light_field.views.push_back(renderer.View(u, v, &progress));
    }
  }
  light_field.disparity = renderer.Disparity();
  return light_field;
}

Result<LightField> Load(const std::string& folder) {
  InputOptions input;
  input.path = folder;
  Result<Capture> capture = OpenInput(input);
  if (!capture) return capture.error();
  if (Error error = LoadInput({}, 1, &*capture)) return error;
  return std::move(capture->light_field);
}

using Scenes = std::vector<std::unique_ptr<SceneTimes>>;

// Opens the scene to which the model is fitted, and then the scenes that check the model.
Result<Scenes> OpenScenes(const CalibrateOptions& options) {
  Scenes scenes;
  const auto add = [&](const std::string& folder, const std::string& name) -> Error {
    Result<LightField> light_field = folder.empty() ? Trace(name) : Load(folder);
    if (!light_field) return light_field.error();
    scenes.push_back(std::make_unique<SceneTimes>());
    return scenes.back()->Open(folder.empty() ? name : folder, std::move(*light_field));
  };
  Error error = add(options.folder, "portrait");
  if (!options.check.empty()) {
    if (!error) error = add(options.check, "");
  } else {
    if (!error) error = add("", "wires");
    if (!error) error = add("", "ramp");
  }
  if (error) return error;
  return scenes;
}

// Measures the scenes alternately, so that slow phases of the machine affect all scenes and sizes
// equally.
void Measure(const Scenes& scenes) {
  int64_t blocks = 0;
  for (const auto& scene : scenes) blocks += scene->blocks();
  Progress progress("measuring", blocks * kRepetitions);
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    for (const auto& scene : scenes) scene->Measure(&progress);
  }
}

void PrintCoefficients(const starfocus_timing& timing) {
  std::printf("coefficients on %s, picoseconds:\n", starfocus_simd_target());
  for (const TimingTerm& term : kTimingTerms) {
    std::printf("%10s %9u per %s\n", term.name, unsigned{timing.*term.coefficient}, term.unit);
  }
}

// Prints how well the model predicts the times of the scene, and returns the result as JSON. A low
// agreement is not an error, because effects outside the model reduce the agreement even on a good
// machine.
Json Judge(const char* role, const SceneTimes& scene, const starfocus_timing& timing) {
  const Agreement configurations = Compare(timing, scene.Configurations());
  const Agreement blocks = Compare(timing, scene.Blocks());
  std::printf("R2 %.4f (weighted %.4f; single blocks %.4f), %s: %s, %lld blocks\n",
              configurations.plain, configurations.weighted, blocks.plain, role,
              scene.name().c_str(), static_cast<long long>(scene.blocks()));
  Json json;
  json.Set("scene", scene.name());
  json.Set("blocks", scene.blocks());
  json.Set("r2", configurations.plain);
  json.Set("r2_weighted", configurations.weighted);
  json.Set("r2_single_blocks", blocks.plain);
  return json;
}

Error CheckOutput(const CalibrateOptions& options) {
  if (options.out.empty()) return {};
  if (Error error = CheckTextOutput({"--output", options.out}, OutputKind::kJson)) return error;
  std::vector<std::string> folders;
  for (const std::string& folder : {options.folder, options.check}) {
    if (!folder.empty()) folders.push_back(folder);
  }
  return CheckApart({{"--output", options.out}}, {folders, {}});
}

Error Calibrate(const CalibrateOptions& options) {
  if (Error error = CheckOutput(options)) return error;
  const Result<Scenes> opened = OpenScenes(options);
  if (!opened) return opened.error();
  const Scenes& scenes = *opened;
  Measure(scenes);
  const starfocus_timing timing = FitTiming(scenes[0]->Configurations());
  PrintCoefficients(timing);
  Json json;
  json.Set("simd_target", starfocus_simd_target());
  json.Set("timing", TimingJson(timing));
  json.Set("fit", Judge("fit", *scenes[0], timing));
  Json checks = Json::Array();
  for (size_t i = 1; i < scenes.size(); ++i) {
    checks.Add(Judge("check", *scenes[i], timing));
  }
  json.Set("checks", std::move(checks));
  return options.out.empty() ? Error() : WriteText(options.out, json.Text(2) + "\n");
}

}  // namespace

Command CalibrateCommand() {
  const auto options = std::make_shared<CalibrateOptions>();
  return {"calibrate",
          "Measure the coefficients of the timing model, which selects the blocks of --mode block",
          {
              {"-o,--output", "FILE",
               "JSON file to write, for refocus --timing; default: print the coefficients only",
               &options->out},
              {"--light-field", "DIR",
               "Light-field folder that the model is fitted to; default: the scene portrait",
               &options->folder},
              {"--check", "DIR",
               "Light-field folder that the model is checked with; default: the scenes wires "
               "and ramp",
               &options->check},
          },
          [options] { return Calibrate(*options); },
          {"starfocus-lab calibrate -o timing.json",
           "starfocus-lab calibrate -o timing.json --light-field lf --check other"},
          "The machine should be idle. Pictures that are computed with other coefficients differ."};
}

}  // namespace starfocus
