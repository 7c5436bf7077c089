// SPDX-License-Identifier: Apache-2.0
// Shows how an app implements tap to focus. The program prepares a light field once. The first tap
// computes a preview and then the full picture. The second tap moves the focus in steps to the
// tapped point, with a preview for each step (a focus pull). After the last step, the program
// computes the full picture. The program prints the time of every step, and the PSNR of a preview
// relative to the full picture.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "examples/command_line/options.h"
#include "examples/command_line/parse.h"
#include "examples/command_line/program.h"
#include "examples/scene/render.h"
#include "examples/tap/nearness.h"
#include "platform/clock.h"
#include "platform/image_io.h"
#include "platform/light_field.h"
#include "platform/text.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

// Largest blur radius in pixels. The program chooses the widest aperture whose blur is at most
// kBlur at every focus.
constexpr double kBlur = 32;

struct Options {
  std::string folder, out;
  Pixel size = {4000, 3000};  // picture size of the ray-traced scene, used if `folder` is empty
  std::optional<Pixel> first, second;
  int shift = 2, frames = 12, threads = 1;
};

// A light field, and the pixels of the two taps if the options do not set them.
struct Subject {
  LightField field;
  Pixel first, second;
};

// Reads the light field of a folder. If the options name no folder, ray-traces the portrait scene.
Result<Subject> Open(const Options& options, ThreadRunner* runner) {
  Subject subject;
  LightField& field = subject.field;
  if (!options.folder.empty()) {
    if (Error error = LoadLightField(options.folder, {}).MoveTo(&field)) return error;
    subject.first = {field.width() / 2, field.height() / 2};
    subject.second = {field.width() / 8, field.height() / 8};
    return subject;
  }
  const Scene scene = MakePortrait();
  const RayTracer renderer(scene, options.size.x, options.size.y, STARFOCUS_TRANSFER_SRGB, runner);
  Progress progress("rendering", int64_t{5} * options.size.y);
  for (int view = 0; view < 5; ++view) {
    double u = 0, v = 0;
    starfocus_view_position(view, &u, &v, nullptr);
    field.views.push_back(renderer.View(u, v, &progress));
  }
  field.disparity = renderer.Disparity();
  const NamedPoint &near = scene.points.front(), &far = scene.points.back();
  renderer.ToPixel(near.x, near.y, &subject.first.x, &subject.first.y);
  renderer.ToPixel(far.x, far.y, &subject.second.x, &subject.second.y);
  return subject;
}

Error CheckTap(const std::string& option, const Pixel& point, const LightField& field) {
  if (point.x < field.width() && point.y < field.height()) return {};
  return Error::Usage(option, "a pixel within " + SizeText(field.width(), field.height()),
                      "'" + std::to_string(point.x) + "," + std::to_string(point.y) + "'");
}

// An engine with the prepared light field, and the pictures that the engine computes.
class Session {
 public:
  Session(const LightField& field, const Options& options, ThreadRunner* runner)
      : options_(options),
        runner_(runner),
        map_(field.disparity),
        views_(static_cast<int>(field.views.size())),
        field_(EngineRows(field)),
        full_(field.width(), field.height()),
        preview_((field.width() - 1) / (1 << options.shift) + 1,
                 (field.height() - 1) / (1 << options.shift) + 1) {}

  Error Prepare() {
    const starfocus_disparity_stats stats = MeasureDisparity(map_);
    Config config;
    config.width = map_.width;
    config.height = map_.height;
    config.views = views_;
    config.disparity_min = stats.min;
    config.disparity_max = stats.max;
    config.max_blur = kBlur;
    config.unknown = STARFOCUS_UNKNOWN_FILL;
    config.max_workers = runner_->workers();
    config.previews = options_.shift;
    const double range = double(stats.max) - double(stats.min);
    params_.aperture = std::min(1.0, kBlur / std::max(range, 1e-9));
    const double start = Seconds();
    if (Error error = Outcome(engine_.Init(config))) return error;
    starfocus_callbacks callbacks = {};
    callbacks.runner = ThreadRunner::Run;
    callbacks.runner_data = runner_;
    if (Error error = Outcome(engine_.SetCallbacks(callbacks))) return error;
    Say("make an engine", start);
    const double begin = Seconds();
    Error error = Outcome(engine_.Prepare(field_));
    if (!error) Say("prepare the light field", begin);
    return error;
  }

  Result<double> FocusAt(const Pixel& point) {
    const double start = Seconds();
    double focus = 0;
    Error error = Outcome(starfocus_focus_at(&field_.depth, map_.width, map_.height, point.x,
                                             point.y, &focus, nullptr));
    if (error) return error;
    const std::string tap = std::to_string(point.x) + "," + std::to_string(point.y);
    Say("tap at " + tap + ": focus " + Short(focus), start);
    return focus;
  }

  Error Preview(double focus, const std::string& what) {
    params_.focus = focus;
    const double start = Seconds();
    Params params = params_;
    params.preview_shift = options_.shift;
    const starfocus_image out = starfocus_image_rgb(preview_.pixels.data(), preview_.stride());
    if (Error error = Outcome(engine_.RefocusPrepared(params, out))) return error;
    Say(what + ", 1/" + std::to_string(1 << options_.shift) + " of the size", start);
    return Keep(preview_);
  }

  Error Full(double focus) {
    params_.focus = focus;
    const double start = Seconds();
    const starfocus_image out = starfocus_image_rgb(full_.pixels.data(), full_.stride());
    if (Error error = Outcome(engine_.RefocusPrepared(params_, out))) return error;
    Say("full picture", start);
    return Keep(full_);
  }

  // Compares the last preview with the last full picture. The preview and the full picture must
  // have the same focus.
  void SayNearness() const {
    std::printf("%8.1f dB  PSNR of the preview relative to the reduced full picture\n",
                PreviewPsnr(preview_, full_, options_.shift));
  }

  // Computes a focus pull: previews at evenly spaced foci after `from`, up to and including `to`.
  Error Pull(double from, double to) {
    const double start = Seconds();
    for (int k = 1; k <= options_.frames; ++k) {
      const double share = double(k) / options_.frames;
      const std::string what =
          "focus pull " + std::to_string(k) + " of " + std::to_string(options_.frames);
      if (Error error = Preview(from + share * (to - from), what)) return error;
    }
    if (options_.out.empty()) {
      std::printf("%8.1f pictures per second in the focus pull\n",
                  options_.frames / std::max(Seconds() - start, 1e-9));
    }
    return {};
  }

 private:
  static Error Outcome(starfocus_status status) {
    return status == STARFOCUS_OK ? Error()
                                  : Error(ErrorKind::kInput, starfocus_status_string(status));
  }

  static void Say(const std::string& what, double start) {
    std::printf("%8.1f ms  %s\n", 1e3 * (Seconds() - start), what.c_str());
  }

  Error Keep(const Image& picture) {
    if (options_.out.empty()) return {};
    char name[32];
    std::snprintf(name, sizeof(name), "frame_%04d.png", kept_++);
    return WriteImage((std::filesystem::path(options_.out) / name).string(), picture);
  }

  const Options& options_;
  ThreadRunner* const runner_;
  const FloatMap& map_;
  const int views_;
  const starfocus_light_field field_ = starfocus::NewLightField();
  Image full_, preview_;
  Engine engine_;
  Params params_;
  int kept_ = 0;
};

Error Tap(const Options& options) {
  if (options.size.x < 1 || options.size.y < 1)
    return Error::Usage("--size", "WxH with W and H above 0",
                        SizeText(options.size.x, options.size.y));
  ThreadRunner runner(options.threads);
  const Result<Subject> subject = Open(options, &runner);
  if (!subject) return subject.error();
  const LightField& field = subject->field;
  const Pixel first = options.first.value_or(subject->first);
  const Pixel second = options.second.value_or(subject->second);
  if (Error error = CheckTap("--first", first, field)) return error;
  if (Error error = CheckTap("--second", second, field)) return error;
  if (!options.out.empty()) std::filesystem::create_directories(options.out);
  std::printf("%d x %d, %zu views, %d threads\n", field.width(), field.height(), field.views.size(),
              runner.workers());
  Session session(field, options, &runner);
  double from = 0, to = 0;
  Error error = session.Prepare();
  if (!error) error = session.FocusAt(first).MoveTo(&from);
  if (!error) error = session.Preview(from, "first preview");
  if (!error) error = session.Full(from);
  if (!error) session.SayNearness();
  if (!error) error = session.FocusAt(second).MoveTo(&to);
  if (!error) error = session.Pull(from, to);
  if (!error) error = session.Full(to);
  return error;
}

Error Main(int argc, char** argv) {
  Options options;
  const Program program = {
      {"tap",
       "Simulate tap to focus: time previews, a focus pull and full pictures.",
       {
           {"DIR", "DIR", "Light-field folder; default: a ray-traced portrait", &options.folder},
           {"--size", "WxH", "Width and height of the ray-traced portrait in pixels",
            Pair('x', &options.size), Use::kDefault},
           {"--first", "X,Y",
            "Pixel of the first tap, counted from 0,0; default: the centre, or the nearest "
            "point of the portrait",
            Pair(',', &options.first)},
           {"--second", "X,Y",
            "Pixel of the second tap, to which the focus is pulled; default: a pixel near "
            "the top left, or the farthest point of the portrait",
            Pair(',', &options.second)},
           {"--preview", "1|2|3",
            "Size of the previews: 1, 2 or 3 for 1/2, 1/4 or 1/8 of the picture's width "
            "and height",
            Whole(1, STARFOCUS_MAX_PREVIEW, &options.shift), Use::kDefault},
           {"--frames", "N", "Number of previews of the focus pull, 1 to 1000",
            Whole(1, 1000, &options.frames), Use::kDefault},
           ThreadsOption(&options.threads),
           {"--out", "DIR",
            "Folder for all pictures, frame_0000.png, frame_0001.png, ...; default: none "
            "are written",
            &options.out},
       },
       [&options] { return Tap(options); },
       {"tap --size 1000x750", "tap lf --first 320,240 --second 40,40 --out frames"}},
      {}};
  return RunCommandLine(program, argc, argv);
}

}  // namespace
}  // namespace starfocus

int main(int argc, char** argv) {
  return starfocus::RunProgram("tap", [&] { return starfocus::Main(argc, argv); });
}
