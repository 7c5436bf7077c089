// SPDX-License-Identifier: Apache-2.0
// starfocus-lab steps: draws the intermediate data of refocusing.
#include <filesystem>
#include <memory>
#include <utility>

#include "examples/cli/disparity/map_figures.h"
#include "examples/command_line/options.h"
#include "examples/command_line/outputs.h"
#include "examples/lab/commands.h"
#include "examples/lab/steps/step_pictures.h"
#include "platform/folder.h"
#include "platform/image_io.h"

namespace starfocus {
namespace {

struct StepsOptions {
  std::string light_field, out;
  std::optional<double> focus;
  double aperture = 1;
};

Error Run(const StepsOptions& options) {
  const std::string& where = options.light_field;
  if (Error error = CheckFolderApart({"--output", options.out}, {where})) return error;
  if (Error error = CheckFolderOutput(options.out)) return error;
  const Result<LightField> light_field = LoadLightField(where, {});
  if (!light_field) return light_field.error();
  const Result<StepPictures> drawn =
      DrawSteps(where, *light_field, {*options.focus, options.aperture});
  if (!drawn) return drawn.error();
  const Image disparity = DrawDisparity(light_field->disparity);
  const std::pair<const char*, const Image&> files[] = {
      {"disparity", disparity},  {"mean", drawn->mean},   {"slices", drawn->slices},
      {"hidden", drawn->hidden}, {"matte", drawn->matte}, {"coverage", drawn->coverage},
      {"view", drawn->view},     {"holes", drawn->holes}, {"gathered", drawn->gathered}};
  if (Error error = MakeFolder(options.out)) return error;
  for (const auto& [name, picture] : files) {
    const std::string file = std::string(name) + ".png";
    const std::string path = (std::filesystem::path(options.out) / file).string();
    if (Error error = WriteImage(path, picture)) return error;
  }
  return {};
}

}  // namespace

Command StepsCommand() {
  const auto options = std::make_shared<StepsOptions>();
  return {
      "steps",
      "Draw the intermediate data of refocusing: disparities, surfaces, slices, views, coverage "
      "and gathered cells",
      {
          {"DIR", "DIR", "Light-field folder", &options->light_field, Use::kRequired},
          {"-o,--output", "FOLDER", "Folder for the PNG pictures", &options->out, Use::kRequired},
          {"--focus", "D", "Disparity in focus", Number(&options->focus), Use::kRequired},
          {"--aperture", "U", "Radius of the aperture, 0.01 to 1",
           Number(0.01, 1, "a radius from 0.01 to 1", &options->aperture), Use::kDefault},
      },
      [options] { return Run(*options); },
      {"starfocus-lab steps lf -o steps --focus 4",
       "starfocus-lab steps lf -o steps --focus -5.7 --aperture 0.5"}};
}

}  // namespace starfocus
