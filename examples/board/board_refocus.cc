// SPDX-License-Identifier: Apache-2.0
// board_refocus: a refocusing camera on a board. A rotary encoder moves the focus plane, one button
// changes the aperture, another takes the picture; an output line is high exactly while the engine
// runs, for a scope or a power meter.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "examples/board/camera.h"
#include "examples/board/panel.h"
#include "examples/command_line/options.h"
#include "examples/command_line/parse.h"
#include "examples/command_line/program.h"
#include "platform/clock.h"
#include "platform/file.h"
#include "platform/framebuffer.h"
#include "platform/gpio.h"
#include "platform/image_io.h"

namespace {

using namespace starfocus;

struct Options {
  std::string folder, chip = "gpiochip0", encoder, aperture, shutter, busy;
  std::string debounce = "10", active = "low", bias = "pull-up";
  std::string focus, step, mode = "block", threads = "1", pictures = "0";
  std::string out, framebuffer;
  bool list = false;
};

struct Plan {
  PanelLines lines;
  int busy = -1;
  int debounce = 10;  // milliseconds
  GpioBias bias = GpioBias::kPullUp;
  bool focus_given = false;
  double focus = 0, step = 0;  // step 0: a fortieth of the scene
  int threads = 1, pictures = 0;
};

constexpr int kLastLine = 100000;

Error ParseLine(const std::string& option, const std::string& text, int* line) {
  return text.empty() ? Error() : ParseWhole(option, text, 0, kLastLine, line);
}

Error PlanLines(const Options& options, Plan* plan) {
  Error error;
  PanelLines& lines = plan->lines;
  if (!options.encoder.empty()) {
    error = ParsePair("--encoder", options.encoder, ',', &lines.encoder_a, &lines.encoder_b);
  }
  if (!error) error = ParseLine("--aperture-button", options.aperture, &lines.aperture);
  if (!error) error = ParseLine("--shutter", options.shutter, &lines.shutter);
  if (!error) error = ParseLine("--busy", options.busy, &plan->busy);
  if (error) return error;
  if (lines.shutter < 0) return Error::Usage("--shutter", "the line of the shutter button", "none");
  std::vector<int> all = lines.All();
  if (plan->busy >= 0) all.push_back(plan->busy);
  std::sort(all.begin(), all.end());
  const auto twice = std::adjacent_find(all.begin(), all.end());
  if (twice == all.end()) return {};
  return Error::Usage("lines", "a line for each control", std::to_string(*twice) + " twice");
}

// Everything that can be refused before the light field is read.
Error MakePlan(const Options& options, Plan* plan) {
  Error error = PlanLines(options, plan);
  if (!error) {
    error = ParseWhole("--debounce", options.debounce, 0, 1000, &plan->debounce);
  }
  if (!error && !options.focus.empty()) {
    error = ParseNumber("--focus", options.focus, &plan->focus);
    plan->focus_given = true;
  }
  if (!error && !options.step.empty()) {
    error = ParseNumber("--step", options.step, &plan->step);
  }
  if (!error) {
    error = ParseWhole("--threads", options.threads, 1, SF_MAX_WORKERS, &plan->threads);
  }
  if (!error) error = ParseWhole("--pictures", options.pictures, 0, 1000000, &plan->pictures);
  if (!error && !options.out.empty()) error = CheckImageOutput(options.out);
  if (error) return error;
  if (options.out.empty() && options.framebuffer.empty()) {
    return Error::Usage("--out", "a picture file to write, or --framebuffer", "neither");
  }
  if (options.active != "low" && options.active != "high") {
    return Error::Usage("--active", "low or high", "'" + options.active + "'");
  }
  if (options.mode != "block" && options.mode != "frame") {
    return Error::Usage("--mode", "block or frame", "'" + options.mode + "'");
  }
  if (options.bias == "none") plan->bias = GpioBias::kAsIs;
  if (options.bias == "pull-down") plan->bias = GpioBias::kPullDown;
  if (options.bias == "pull-up" || plan->bias != GpioBias::kPullUp) return {};
  return Error::Usage("--bias", "pull-up, pull-down or none", "'" + options.bias + "'");
}

int64_t Nanoseconds() { return static_cast<int64_t>(Seconds() * 1e9); }

// "picture.png" and 3 make "picture-3.png".
std::string Numbered(const std::string& path, int number) {
  const size_t dot = path.rfind('.');
  return path.substr(0, dot) + "-" + std::to_string(number) + path.substr(dot);
}

class Board {
 public:
  Board(const Options& options, const Plan& plan)
      : options_(options), plan_(plan), camera_(plan.threads) {}

  // The lines are taken before the light field is read: their absence is known sooner.
  Error Open() {
    Error error = inputs_.Open(options_.chip, plan_.lines.All(), plan_.bias);
    if (!error && plan_.busy >= 0) error = busy_.Open(options_.chip, plan_.busy);
    if (!error) {
      error =
          camera_.Load(options_.folder, options_.mode == "block" ? SF_MODE_BLOCK : SF_MODE_FRAME);
    }
    if (error) return error;
    step_ = plan_.step != 0 ? plan_.step : (camera_.nearest() - camera_.farthest()) / 40;
    focus_ = 0.5 * (camera_.nearest() + camera_.farthest());
    if (plan_.focus_given) {
      if (plan_.focus < camera_.farthest() || plan_.focus > camera_.nearest()) {
        return Error::Usage("--focus",
                            "a disparity of the scene, " + Short(camera_.farthest()) + " to " +
                                Short(camera_.nearest()),
                            Short(plan_.focus));
      }
      focus_ = plan_.focus;
    }
    std::printf("ready: focus %g (%g to %g), aperture %g, workspace %zu bytes, %s\n", focus_,
                camera_.farthest(), camera_.nearest(), aperture(), camera_.workspace_bytes(),
                sf_simd_target());
    return {};
  }

  // Serves the controls until the wanted number of pictures is taken.
  Error Run() {
    bool a = true, b = true;
    Error error;
    if (plan_.lines.encoder_a >= 0) {
      error = inputs_.Read(plan_.lines.encoder_a, &a);
      if (!error) error = inputs_.Read(plan_.lines.encoder_b, &b);
    }
    Panel panel(plan_.lines, options_.active == "low", int64_t{plan_.debounce} * 1000000, a, b);
    std::vector<GpioEdge> edges;
    while (!error && !Finished()) {
      const int64_t wait = panel.Wait(Nanoseconds());
      error = inputs_.Wait(wait < 0 ? -1 : static_cast<int>(wait / 1000000 + 1), &edges);
      for (size_t i = 0; i < edges.size() && !error && !Finished(); ++i) {
        error = Act(panel.Edge(edges[i].line, edges[i].high, edges[i].nanoseconds));
      }
      if (!error && edges.empty()) error = Act(panel.Settle(Nanoseconds()));
    }
    return error;
  }

 private:
  double aperture() const { return camera_.apertures()[aperture_]; }
  bool Finished() const { return plan_.pictures != 0 && taken_ >= plan_.pictures; }

  Error Act(const PanelActions& actions) {
    if (!actions.any()) return {};
    focus_ =
        std::clamp(focus_ + actions.focus_steps * step_, camera_.farthest(), camera_.nearest());
    aperture_ = (aperture_ + static_cast<size_t>(actions.apertures)) % camera_.apertures().size();
    if (actions.shutters != 0) return TakePicture();
    std::printf("focus %g, aperture %g\n", focus_, aperture());
    return {};
  }

  Error SetBusy(bool high, bool* read_back) {
    if (plan_.busy < 0) return {};
    if (Error error = busy_.Set(high)) return error;
    return busy_.Read(read_back);
  }

  Error TakePicture() {
    bool during = false, after = false;
    if (Error error = SetBusy(true, &during)) return error;
    const double start = Seconds();
    const sf_status status = camera_.Take(focus_, aperture());
    const double seconds = Seconds() - start;
    if (Error error = SetBusy(false, &after)) return error;
    if (status != SF_OK) {
      return Error::Internal("picture", "a refocused one", sf_status_string(status));
    }
    ++taken_;
    std::printf("picture %d: focus %g, aperture %g, %.3f ms", taken_, focus_, aperture(),
                1e3 * seconds);
    if (plan_.busy >= 0) std::printf(", busy line read back %d, then %d", during, after);
    std::printf("\n");
    Keep();
    return {};
  }

  // A full disk must not end the camera.
  void Keep() {
    Error error;
    if (!options_.framebuffer.empty()) {
      error = ShowOnFramebuffer(options_.framebuffer, camera_.picture());
    }
    if (!error && !options_.out.empty()) {
      const std::string path = Numbered(options_.out, taken_);
      error = WriteImage(path, camera_.picture());
      if (!error) std::printf("wrote %s\n", path.c_str());
    }
    if (error) std::fprintf(stderr, "board_refocus: %s\n", error.line().c_str());
  }

  const Options& options_;
  const Plan& plan_;
  GpioInputs inputs_;
  GpioOutput busy_;
  Camera camera_;
  double focus_ = 0, step_ = 0;
  size_t aperture_ = 0;
  int taken_ = 0;
};

Error List() {
  std::vector<GpioChip> chips;
  const Error error = ListGpioChips(&chips);
  for (const GpioChip& chip : chips) {
    std::printf("%s: %s, %d lines\n", chip.name.c_str(), chip.label.c_str(), chip.lines);
  }
  return error;
}

Error Run(const Options& options) {
  if (options.list) return List();
  if (options.folder.empty()) return Error::Usage("DIR", "a light-field folder", "nothing");
  Plan plan;
  Error error = MakePlan(options, &plan);
  Board board(options, plan);
  if (!error) error = board.Open();
  if (!error) error = board.Run();
  return error;
}

Error Main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  Options options;
  const Program program = {
      {"board_refocus",
       "Refocuses a light field by knob and buttons on GPIO lines.",
       {
           {"DIR", "TEXT", "Light-field folder", &options.folder},
           {"--list", nullptr, "List the GPIO chips and end", &options.list},
           {"--chip", "TEXT", "GPIO chip: gpiochip0, 0 or a path", &options.chip, Use::kDefault},
           {"--encoder", "TEXT", "Lines A,B of the rotary encoder for the focus", &options.encoder},
           {"--aperture-button", "TEXT", "Line of the button for the aperture", &options.aperture},
           {"--shutter", "TEXT", "Line of the button that takes a picture", &options.shutter},
           {"--busy", "TEXT", "Output line, high exactly while the engine runs", &options.busy},
           {"--debounce", "TEXT", "Milliseconds a button may bounce", &options.debounce,
            Use::kDefault},
           {"--active", "TEXT", "Level of a pressed button: low or high", &options.active,
            Use::kDefault},
           {"--bias", "TEXT", "Bias of the inputs: pull-up, pull-down or none", &options.bias,
            Use::kDefault},
           {"--focus", "TEXT", "Disparity to begin with; default: the middle", &options.focus},
           {"--step", "TEXT", "Disparity of an encoder step; default: 1/40 of all", &options.step},
           {"--mode", "TEXT", "block or frame", &options.mode, Use::kDefault},
           {"--threads", "TEXT", "1 to 64", &options.threads, Use::kDefault},
           {"--pictures", "TEXT", "End after so many; 0: never", &options.pictures, Use::kDefault},
           {"--out", "TEXT", "Picture file (.png, .ppm, .jpg); a number is added", &options.out},
           {"--framebuffer", "TEXT", "Linux framebuffer, such as /dev/fb0", &options.framebuffer},
       },
       [&options] { return Run(options); }},
      {}};
  return RunCommandLine(program, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram("board_refocus", [&] { return Main(argc, argv); });
}
