// SPDX-License-Identifier: Apache-2.0
// starfocus-lab steps: draws the intermediate data of refocusing.
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "examples/cli/estimate_run.h"
#include "examples/cli/input.h"
#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "examples/lab/commands.h"
#include "examples/lab/lab_config.h"
#include "examples/lab/steps/step_pictures.h"
#include "platform/file.h"
#include "platform/folder.h"
#include "platform/image_io.h"
#include "platform/problem.h"
#include "starfocus/starfocus.hpp"

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

namespace {

constexpr uint8_t kViolet[3] = {230, 40, 200}, kMagenta[3] = {255, 0, 255};

// Draws the block that the engine has just added to the plan of the current stripe.
struct BlockVisit {
  const EngineState* engine;
  const LightField* light_field;
  StepPictures* pictures;
  void (*draw)(const PlannedBlock& planned, StepPictures* pictures);

  static void Draw(void* data, const starfocus_block*) {
    const auto& visit = *static_cast<BlockVisit*>(data);
    const StripePlan& plan = visit.engine->stripe.plan;
    visit.draw({*visit.engine, plan.blocks[plan.used - 1], *visit.light_field}, visit.pictures);
  }
};

class StepRun {
 public:
  StepRun(const std::string& where, const LightField& light_field, const StepLens& lens)
      : where_(where), light_field_(light_field), lens_(lens) {}

  // Renders all blocks at layer 0, and draws all pictures except `gathered`.
  Result<Image> DrawRenderedBlocks(StepPictures* pictures) const {
    return Refocus(false, {nullptr, &light_field_, pictures, DrawRendered});
  }

  // Refocuses with the default tuning, and marks the cells that are computed by filtering instead
  // of rendering views.
  Result<Image> MarkGatheredCells(StepPictures* pictures) const {
    return Refocus(true, {nullptr, &light_field_, pictures, MarkGathered});
  }

 private:
  Result<Image> Refocus(bool gathers, BlockVisit visit) const {
    starfocus::Config config = ConfigOf(light_field_);
    if (!gathers) config.tuning.gather = config.tuning.max_layer = 0;
    starfocus_problem problem = {};
    Engine engine;
    const starfocus_status status = engine.Init(config, &problem);
    if (status != STARFOCUS_OK) return Refused(status, &problem);
    visit.engine = reinterpret_cast<EngineState*>(engine.get());
    return Run(&engine, &visit);
  }

  Result<Image> Run(Engine* engine, BlockVisit* visit) const {
    starfocus_callbacks callbacks = {};
    starfocus_observer observer;
    starfocus_observer_init(&observer);
    observer.on_block = BlockVisit::Draw;
    observer.on_block_data = visit;
    callbacks.observer = &observer;
    starfocus_status status = engine->SetCallbacks(callbacks);
    starfocus::Params params;
    params.focus = lens_.focus;
    params.aperture = lens_.aperture;
    Image out(light_field_.width(), light_field_.height());
    if (status == STARFOCUS_OK) {
      status = engine->Refocus(params, EngineRows(light_field_),
                               starfocus_image_rgb(out.pixels.data(), out.stride()));
    }
    if (status != STARFOCUS_OK) return Refused(status, engine->problem());
    return out;
  }

  Error Refused(starfocus_status status, const starfocus_problem* problem) const {
    return Expected(where_, "a light field and a lens that the engine accepts",
                    Describe(status, problem).text);
  }

  const std::string& where_;
  const LightField& light_field_;
  const StepLens& lens_;
};

// Tints the pixels of `picture` that are white in `mask`.
void TintMarked(const Image& mask, Image* picture) {
  for (size_t k = 0; k < mask.pixels.size(); k += 3) {
    if (mask.pixels[k] == 255) Tint(kViolet, 45, &picture->pixels[k]);
  }
}

}  // namespace

Result<StepPictures> DrawSteps(const std::string& where, const LightField& light_field,
                               const StepLens& lens) {
  const Image& centre = light_field.views[0];
  const Image black(centre.width, centre.height);
  StepPictures pictures = {black, centre, centre, centre, centre, black, black, black};
  const StepRun run(where, light_field, lens);
  Result<Image> rendered = run.DrawRenderedBlocks(&pictures);
  if (!rendered) return rendered.error();
  Result<Image> refocused = run.MarkGatheredCells(&pictures);
  if (!refocused) return refocused.error();
  TintMarked(pictures.gathered, &*refocused);
  pictures.gathered = std::move(*refocused);
  LightField marked = light_field;
  for (size_t view = 1; view < marked.views.size(); ++view) {
    std::vector<uint8_t>& pixels = marked.views[view].pixels;
    for (size_t k = 0; k < pixels.size(); ++k) pixels[k] = kMagenta[k % 3];
  }
  StepPictures others = pictures;
  rendered = StepRun(where, marked, lens).DrawRenderedBlocks(&others);
  if (!rendered) return rendered.error();
  pictures.holes = std::move(others.view);
  return pictures;
}

}  // namespace starfocus
