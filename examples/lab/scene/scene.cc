// SPDX-License-Identifier: Apache-2.0
// starfocus-lab scene: ray-traces a light field with exact disparity and ground truth.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "examples/lab/commands.h"
#include "examples/scene/motion.h"
#include "examples/scene/render.h"
#include "platform/file.h"
#include "platform/image_io.h"
#include "platform/light_field.h"
#include "platform/text.h"
#include "platform/writers/deep_picture.h"
#include "platform/writers/png.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

// Largest number of pixels per view. The limit is necessary because memory holds all views at once.
constexpr int64_t kMostPixels = int64_t{1} << 25;
constexpr int kMostSeed = 1000000, kMostFrames = 10000;
constexpr char kSceneNames[] = "portrait, wires, ramp, lamps, hair, grass or cutout";
constexpr char kCoverageFile[] = "coverage.png", kMatteFile[] = "matte.png";
// Exact map of a light field whose map is unstable.
constexpr char kExactFile[] = "exact.pfm";

struct Truth {
  SceneFocus focus;
  double aperture;
};

struct SceneOptions {
  std::string folder, name = "portrait";
  Pixel size = {1024, 768};
  Positions views = StarPositions(17);
  starfocus_transfer transfer = STARFOCUS_TRANSFER_SRGB;
  int threads = 1;
  std::optional<int> seed, frames, unstable;
  std::vector<std::string> truths;
  ShapeOptions shape;
  bool hdr = false;
};

struct Plan {
  Scene scene;
  std::vector<Truth> truths;
  starfocus::Params lens = {};  // lens of the ground-truth pictures, without focus and aperture
};

Result<Truth> ParseTruth(const std::string& text) {
  const std::vector<double> numbers = ReadNumbers(text, ',');
  const bool complete = numbers.size() == 2 || numbers.size() == 3;
  const double near = complete ? numbers[0] : 0;
  const double far = complete ? numbers[numbers.size() - 2] : 0;
  const double aperture = complete ? numbers.back() : 0;
  if (near < far || std::fabs(near) > STARFOCUS_MAX_DISPARITY ||
      std::fabs(far) > STARFOCUS_MAX_DISPARITY || !(aperture > 0) || aperture > 1) {
    return Error::Usage("--truth",
                        "D,U or NEAR,FAR,U with disparities from -" +
                            Short(STARFOCUS_MAX_DISPARITY) + " to " +
                            Short(STARFOCUS_MAX_DISPARITY) +
                            ", NEAR at least FAR, and an aperture above 0 and at most 1",
                        "'" + text + "'");
  }
  return Truth{{far, near}, aperture};
}

// Returns the extension of pictures.
const char* Extension(const SceneOptions& options) { return options.hdr ? ".exr" : ".png"; }

// Returns the name of the file of a truth. Programs that compare pictures with a truth read the
// focus and the aperture from this name, and ignore truths with a range in focus.
std::string TruthName(const Truth& truth, const ShapeOptions& shape, const char* extension) {
  const auto [far, near] = truth.focus;
  return "truth_dt" + Short(near) + (far < near ? "_to" + Short(far) : "") + "_ut" +
         Short(truth.aperture) + ShapeSuffix(shape) + extension;
}

// Returns the name of the file that stores how much of each pixel the foreground covers, or an
// empty string if the light field has no such file. Coverage would not match an unstable map.
std::string AlphaFile(const SceneOptions& options, const Scene& scene) {
  if (!scene.HasForeground() || (options.unstable && !scene.is_matte)) return {};
  return scene.is_matte ? kMatteFile : kCoverageFile;
}

Result<Scene> ChooseScene(const SceneOptions& options) {
  std::optional<Scene> scene = MakeScene(options.name, uint32_t(options.seed.value_or(kSceneSeed)),
                                         options.hdr ? kHdrGlare : kGlare);
  if (!scene) return Error::Usage("--name", kSceneNames, "'" + options.name + "'");
  if (options.seed && !scene->seeded) {
    return Error::Usage("--seed", "--name hair, grass or cutout", "--name " + options.name);
  }
  return std::move(*scene);
}

Result<Plan> MakePlan(const SceneOptions& options) {
  Plan plan;
  if (Error error = ChooseScene(options).MoveTo(&plan.scene)) return error;
  const auto& [width, height] = options.size;
  if (width < 1 || height < 1 || int64_t(width) * height > kMostPixels) {
    return Error::Usage(
        "--size",
        "WxH with W and H above 0 and at most " + std::to_string(kMostPixels) + " pixels in total",
        "'" + SizeText(width, height) + "'");
  }
  for (const std::string& text : options.truths) {
    const Result<Truth> truth = ParseTruth(text);
    if (!truth) return truth.error();
    plan.truths.push_back(*truth);
  }
  if (Error error = ParseShape(options.shape).MoveTo(&plan.lens)) return error;
  return plan;
}

// Returns the folder of a frame.
std::string FrameFolder(const SceneOptions& options, int frame) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%04d", frame);
  return (fs::path(options.folder) / name).string();
}

// Rejects folders that contain the coverage, the matte or the exact map of another scene, or old
// views that would mix with the new views.
Error CheckFolder(const SceneOptions& options, const Plan& plan, const std::string& folder) {
  const Positions& views = options.views;
  std::error_code failure;
  if (Error error = CheckFolderOutput({"DIR", folder})) return error;
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    const bool replaced =
        std::any_of(views.begin(), views.end(), [&](const starfocus_position& view) {
          return name == ViewName(view) + Extension(options);
        });
    if (IsViewFile(name) && !replaced) {
      return Expected(entry.path().string(), "no view of another light field", "one");
    }
    if ((name == kCoverageFile || name == kMatteFile) && name != AlphaFile(options, plan.scene)) {
      return Expected(entry.path().string(), "no coverage of another scene", "one");
    }
    if (name == kExactFile && !options.unstable) {
      return Expected(entry.path().string(), "no exact map of another scene", "one");
    }
  }
  return {};
}

// Rejects folders whose views or frames would mix with the new frames.
Error CheckFrames(const SceneOptions& options, const Plan& plan) {
  std::error_code failure;
  if (Error error = CheckFolderOutput({"DIR", options.folder})) return error;
  std::set<std::string> frames;
  for (int frame = 0; frame < *options.frames; ++frame) {
    frames.insert(fs::path(FrameFolder(options, frame)).filename().string());
    if (Error error = CheckFolder(options, plan, FrameFolder(options, frame))) return error;
  }
  for (const auto& entry : fs::directory_iterator(options.folder, failure)) {
    const std::string name = entry.path().filename().string();
    if (IsViewFile(name) || (name.rfind("frame_", 0) == 0 && frames.count(name) == 0)) {
      return Expected(entry.path().string(), "no view or frame of another light field", "one");
    }
  }
  return {};
}

std::string MetaText(const SceneOptions& options, const Plan& plan, const Scene& scene,
                     const RayTracer& renderer, const FloatMap& exact) {
  std::string text = "scene: " + scene.name + ", " + scene.description + "\n";
  text += "size: " + SizeText(options.size.x, options.size.y) + "\n";
  text += "views: " + std::to_string(options.views.size()) + "\n";
  text += std::string("transfer: ") +
          (options.transfer == STARFOCUS_TRANSFER_NONE ? "none" : "srgb") + "\n";
  for (const NamedPoint& point : scene.points) {
    int x, y;
    renderer.ToPixel(point.x, point.y, &x, &y);
    text += std::string(point.name) + ": " + std::to_string(x) + "," + std::to_string(y) +
            " disparity " + Short(exact.at(x, y)) + "\n";
  }
  if (scene.seeded) {
    text += "seed: " + std::to_string(options.seed.value_or(kSceneSeed)) + "\n";
  }
  if (const std::string alpha = AlphaFile(options, scene); !alpha.empty()) {
    text +=
        alpha +
        ": share of each pixel of the centre view that the foreground covers, of 256 rays; 255 is "
        "all of it\n";
  }
  text += "made by: starfocus-lab scene; ";
  text += options.unstable ? kExactFile : "disparity.pfm";
  text +=
      " is exact at pixel centres, in pixels per unit u\n"
      "convention: centre pixel (x, y) appears in view (u, v) at (x - u*d, y - v*d)\n"
      "truth_dt<D>_ut<U>" +
      ShapeSuffix(options.shape) + Extension(options) + ": thin-lens ground truth, " +
      (plan.lens.shape == STARFOCUS_SHAPE_FALL_OFF
           ? "aperture density (3) with theta " + Short(options.shape.theta) + " pi"
           : "aperture " + options.shape.shape) +
      (plan.lens.cats_eye > 0 ? ", cat's eyes " + Short(options.shape.cats_eye) : "") + "\n";
  return text;
}

struct Pictures {
  LightField light_field;  // with the exact map
  GreyImage matte;         // no levels: the scene has no matte
  std::vector<Image> truths;
  std::vector<DeepImage> hdr_truths;  // with --hdr, in place of `truths`
};

Pictures Render(const SceneOptions& options, const Plan& plan, const RayTracer& renderer) {
  const SceneOpening opening(plan.lens);
  const bool covers = !AlphaFile(options, plan.scene).empty();
  const int64_t costs = int64_t(options.views.size()) + (covers ? RayTracer::kCoverageCost : 0) +
                        RayTracer::kTruthCost * int64_t(plan.truths.size());
  Progress progress("rendering", options.size.y * costs);
  Pictures pictures;
  pictures.light_field.positions = options.views;
  for (const starfocus_position& view : options.views) {
    const SceneLight light = renderer.ViewLight(view.u, view.v, &progress);
    if (options.hdr) pictures.light_field.deep.push_back(renderer.Halves(light));
    if (!options.hdr) pictures.light_field.views.push_back(renderer.Encoded(light));
  }
  pictures.light_field.disparity = renderer.Disparity();
  if (covers) pictures.light_field.coverage = renderer.Coverage(&progress);
  if (plan.scene.is_matte) {
    std::vector<uint8_t>& alpha = pictures.light_field.coverage;
    pictures.matte = {options.size.x, options.size.y, {alpha.begin(), alpha.end()}};
    alpha.clear();
  }
  for (const Truth& truth : plan.truths) {
    const SceneLight light = renderer.TruthLight(
        truth.focus, truth.aperture, opening,
        options.hdr || options.frames ? kFineLensSamples : kLensSamples, &progress);
    if (options.hdr) pictures.hdr_truths.push_back(renderer.Halves(light));
    if (!options.hdr) pictures.truths.push_back(renderer.Encoded(light));
  }
  return pictures;
}

// Writes the light field, and the exact map if the map of the light field is unstable.
Error SaveMaps(const SceneOptions& options, const std::string& folder, int frame,
               ThreadRunner* runner, LightField* light_field) {
  if (!options.unstable) return SaveLightField(folder, *light_field, runner);
  FloatMap* map = &light_field->disparity;
  FloatMap unstable = UnstableMap(*map, uint32_t(*options.unstable), frame);
  std::swap(*map, unstable);
  Error error = SaveLightField(folder, *light_field, runner);
  std::swap(*map, unstable);
  return error ? error : WritePfm((fs::path(folder) / kExactFile).string(), *map);
}

Error RenderFrame(const SceneOptions& options, const Plan& plan, const std::string& folder,
                  int frame, ThreadRunner* runner) {
  const Scene scene = options.frames ? SceneAt(plan.scene, frame) : plan.scene;
  const RayTracer renderer(scene, options.size.x, options.size.y, options.transfer, runner);
  Pictures pictures = Render(options, plan, renderer);
  Error error = SaveMaps(options, folder, frame, runner, &pictures.light_field);
  if (!error && !pictures.matte.levels.empty()) {
    const std::string path = (fs::path(folder) / kMatteFile).string();
    error = WriteFile(path, EncodeGreyPng(path, pictures.matte));
  }
  for (size_t i = 0; i < plan.truths.size() && !error; ++i) {
    const std::string name = TruthName(plan.truths[i], options.shape, Extension(options));
    const std::string path = (fs::path(folder) / name).string();
    std::vector<std::string> notes;
    error = options.hdr ? WriteDeepImage(path, pictures.hdr_truths[i], {}, &notes)
                        : WriteImage(path, pictures.truths[i]);
  }
  if (error) return error;
  const std::string meta = MetaText(options, plan, scene, renderer, pictures.light_field.disparity);
  return WriteText((fs::path(folder) / "meta.txt").string(), meta);
}

Error Run(const SceneOptions& options) {
  const Result<Plan> plan = MakePlan(options);
  if (!plan) return plan.error();
  ThreadRunner runner(options.threads);
  if (!options.frames) {
    if (Error error = CheckFolder(options, *plan, options.folder)) return error;
    return RenderFrame(options, *plan, options.folder, 0, &runner);
  }
  if (Error error = CheckFrames(options, *plan)) return error;
  for (int frame = 0; frame < *options.frames; ++frame) {
    const std::string folder = FrameFolder(options, frame);
    if (Error error = RenderFrame(options, *plan, folder, frame, &runner)) return error;
  }
  return {};
}

}  // namespace

Command SceneCommand() {
  const auto options = std::make_shared<SceneOptions>();
  Command command = {"scene",
                     "Ray-trace a light field with exact disparities into a folder",
                     {},
                     [options] { return Run(*options); },
                     {"starfocus-lab scene lf --views 5 --truth 4,1 --shape disc",
                      "starfocus-lab scene clip --views 5 --frames 8 --unstable 1"}};
  AddOptions(
      {
          {"DIR", "DIR", "Light-field folder to write", &options->folder, Use::kRequired},
          {"--name", "portrait|wires|ramp|lamps|hair|grass|cutout", "Scene to render",
           &options->name, Use::kDefault},
          {"--seed", "N",
           "Seed for the positions of the strands of hair, grass and cutout, 0 to 1000000; "
           "default: 1",
           Whole(0, kMostSeed, &options->seed)},
          {"--frames", "N",
           "Render N frames, 1 to 10000, in which camera and foreground move, into the folders "
           "DIR/frame_0000, DIR/frame_0001 and so on; default: one light field without motion in "
           "DIR",
           Whole(1, kMostFrames, &options->frames)},
          {"--unstable", "SEED",
           "Write maps with errors that change from frame to frame, and the exact maps as "
           "exact.pfm: outlines that grow or shrink by up to 2 pixels, smooth noise of up to 0.5, "
           "and an offset of up to 0.3; the seed is 0 to 1000000; default: exact maps",
           Whole(0, kMostSeed, &options->unstable)},
          {"--size", "WxH",
           "Width and height of each view in pixels, at most 33554432 pixels in total",
           Pair('x', &options->size), Use::kDefault},
          {"--views", "17|9|5|1|U,V:U,V",
           "Views to render: the star of 17, 9, 5 or 1 views, or positions U,V:U,V from "
           "-1 to 1 that begin with 0,0",
           Views(&options->views), Use::kDefault},
          {"--truth", "D,U ...",
           "Also render the ground-truth picture of a lens focused at disparity D, -500 to 500, "
           "with aperture U, above 0 and at most 1; NEAR,FAR,U instead of D,U keeps disparities "
           "from FAR to NEAR in focus; may be repeated; default: none",
           &options->truths},
          {"--transfer", "srgb|none",
           "srgb averages light and codes it as sRGB; none averages the values themselves",
           Transfer(&options->transfer), Use::kDefault},
      },
      &command);
  AddShapeOptions(&command, &options->shape);
  AddOptions(
      {
          {"--hdr", nullptr,
           "Write half floats of linear light in OpenEXR files (.exr), with lamps up to 64 times "
           "as bright as white",
           &options->hdr},
          ThreadsOption(&options->threads),
      },
      &command);
  return command;
}

}  // namespace starfocus
