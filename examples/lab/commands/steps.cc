// SPDX-License-Identifier: Apache-2.0
// starfocus-lab steps: draws the intermediate data of refocusing.
#include <filesystem>
#include <memory>
#include <utility>

#include "examples/cli/estimate_run.h"
#include "examples/cli/input.h"
#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "examples/lab/commands.h"
#include "examples/lab/steps/step_pictures.h"
#include "platform/folder.h"
#include "platform/image_io.h"

namespace starfocus {
namespace {

struct StepsOptions {
  InputOptions input;
  std::string out;
  std::optional<double> focus;
  double aperture = 1;
};

Error Run(const StepsOptions& options) {
  const std::string& where = options.input.path;
  if (Error error = CheckFolderApart({"--output", options.out}, {where})) return error;
  if (Error error = CheckFolderOutput({"--output", options.out})) return error;
  Result<Capture> capture = OpenInput(options.input);
  if (!capture) return capture.error();
  if (Error error = LoadInput({}, 1, &*capture)) return error;
  if (Error error = CareForMap({}, 1, &*capture)) return error;
  const LightField& light_field = capture->light_field;
  const Result<StepPictures> drawn =
      DrawSteps(where, light_field, {*options.focus, options.aperture});
  if (!drawn) return drawn.error();
  const Image disparity = DrawDisparity(light_field.disparity);
  const std::pair<const char*, const Image&> files[] = {
      {"disparity", disparity},  {"mean", drawn->mean},   {"slices", drawn->slices},
      {"hidden", drawn->hidden}, {"matte", drawn->matte}, {"coverage", drawn->coverage},
      {"view", drawn->view},     {"holes", drawn->holes}, {"gathered", drawn->gathered}};
  OutputFolder made;
  if (Error error = made.Create(options.out)) return error;
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
  Command command = {
      "steps",
      "Draw the intermediate data of refocusing: disparities, surfaces, slices, views, coverage "
      "and gathered cells",
      {},
      [options] { return Run(*options); },
      {"starfocus-lab steps lf -o steps --focus 4",
       "starfocus-lab steps lf -o steps --focus -5.7 --aperture 0.5"}};
  AddInputOptions(&command, &options->input);
  AddOptions(
      {
          {"-o,--output", "FOLDER", "Folder for the PNG pictures", &options->out, Use::kRequired},
          {"--focus", "D", "Disparity in focus", Number(&options->focus), Use::kRequired},
          {"--aperture", "U", "Radius of the aperture, 0.01 to 1",
           Number(0.01, 1, "a radius from 0.01 to 1", &options->aperture), Use::kDefault},
      },
      &command);
  return command;
}

}  // namespace starfocus
