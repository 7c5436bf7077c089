// SPDX-License-Identifier: Apache-2.0
// board_refocus: a camera program for Linux boards that refocuses a light field. A rotary encoder
// moves the plane of focus. One button changes the aperture, and a second button takes the picture.
// An output line is high while the engine runs, for an oscilloscope or a power meter.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "examples/board/camera.h"
#include "examples/board/framebuffer.h"
#include "examples/board/gpio.h"
#include "examples/board/panel.h"
#include "examples/command_line/options.h"
#include "examples/command_line/parse.h"
#include "examples/command_line/program.h"
#include "platform/clock.h"
#include "platform/console.h"
#include "platform/file.h"
#include "platform/image_io.h"
#include "starfocus/experimental.h"

namespace {

using namespace starfocus;

struct Options {
  std::string folder, chip = "gpiochip0", out, framebuffer;
  std::optional<Pixel> encoder;
  std::optional<int> aperture, shutter, busy;  // GPIO lines of the controls.
  int debounce = 10;                           // Duration of contact bounce in milliseconds.
  bool active_high = false;
  GpioBias bias = GpioBias::kPullUp;
  std::optional<double> focus, step;
  starfocus_mode mode = STARFOCUS_MODE_BLOCK;
  int threads = 1, pictures = 0;
  bool list = false;
};

constexpr int kLastLine = 100000;

// Checks the options that do not depend on the light field, before the light field is read.
Result<PanelLines> PlanLines(const Options& options) {
  PanelLines lines;
  if (options.encoder) {
    lines.encoder_a = options.encoder->x;
    lines.encoder_b = options.encoder->y;
  }
  lines.aperture = options.aperture.value_or(-1);
  lines.shutter = options.shutter.value_or(-1);
  if (!options.out.empty()) {
    if (Error error = CheckImageOutput(options.out)) return error;
  } else if (options.framebuffer.empty()) {
    return Error::Usage("--out", "a picture file to write, or --framebuffer", "neither");
  }
  if (!options.shutter) return Error::Usage("--shutter", "the line of the shutter button", "none");
  std::vector<int> all = lines.All();
  if (options.busy) all.push_back(*options.busy);
  std::sort(all.begin(), all.end());
  const auto twice = std::adjacent_find(all.begin(), all.end());
  if (twice == all.end()) return lines;
  return Error::Usage("lines", "a different GPIO line for each control",
                      "line " + std::to_string(*twice) + " twice");
}

int64_t Nanoseconds() { return static_cast<int64_t>(Seconds() * 1e9); }

// Returns a numbered file name: "picture-3.png" for "picture.png" and 3.
std::string Numbered(const std::string& path, int number) {
  const size_t dot = path.rfind('.');
  return path.substr(0, dot) + "-" + std::to_string(number) + path.substr(dot);
}

class Board {
 public:
  Board(const Options& options, const PanelLines& lines)
      : options_(options), lines_(lines), camera_(options.threads) {}

  // Requests the GPIO lines before reading the light field, so that a missing line is reported
  // early.
  Error Open() {
    Error error = inputs_.Open(options_.chip, lines_.All(), options_.bias);
    if (!error && options_.busy) error = busy_.Open(options_.chip, *options_.busy);
    if (!error) error = camera_.Load(options_.folder, options_.mode);
    if (error) return error;
    step_ = options_.step.value_or((camera_.nearest() - camera_.farthest()) / 40);
    focus_ = 0.5 * (camera_.nearest() + camera_.farthest());
    if (options_.focus) {
      if (*options_.focus < camera_.farthest() || *options_.focus > camera_.nearest()) {
        return Error::Usage(
            "--focus",
            "a disparity from " + Short(camera_.farthest()) + " to " + Short(camera_.nearest()),
            Short(*options_.focus));
      }
      focus_ = *options_.focus;
    }
    std::printf("ready: focus %g (%g to %g), aperture %g, workspace %zu bytes, %s\n", focus_,
                camera_.farthest(), camera_.nearest(), aperture(), camera_.workspace_bytes(),
                starfocus_simd_target());
    return {};
  }

  // Handles the controls until the requested number of pictures has been taken.
  Error Run() {
    bool a = true, b = true;
    if (lines_.encoder_a >= 0) {
      if (Error error = inputs_.Read(lines_.encoder_a).MoveTo(&a)) return error;
      if (Error error = inputs_.Read(lines_.encoder_b).MoveTo(&b)) return error;
    }
    Panel panel(lines_, !options_.active_high, int64_t{options_.debounce} * 1000000, a, b);
    while (!Finished()) {
      const int64_t wait = panel.Wait(Nanoseconds());
      const auto edges = inputs_.Wait(wait < 0 ? -1 : static_cast<int>(wait / 1000000 + 1));
      if (!edges) return edges.error();
      for (size_t i = 0; i < edges->size() && !Finished(); ++i) {
        const GpioEdge& edge = (*edges)[i];
        if (Error error = Act(panel.Edge(edge.line, edge.high, edge.nanoseconds))) return error;
      }
      if (!edges->empty()) continue;
      if (Error error = Act(panel.Settle(Nanoseconds()))) return error;
    }
    return {};
  }

 private:
  double aperture() const { return camera_.apertures()[aperture_]; }
  bool Finished() const { return options_.pictures != 0 && taken_ >= options_.pictures; }

  Error Act(const PanelActions& actions) {
    if (!actions.any()) return {};
    focus_ =
        std::clamp(focus_ + actions.focus_steps * step_, camera_.farthest(), camera_.nearest());
    aperture_ = (aperture_ + static_cast<size_t>(actions.apertures)) % camera_.apertures().size();
    if (actions.shutters != 0) return TakePicture();
    std::printf("focus %g, aperture %g\n", focus_, aperture());
    return {};
  }

  // Sets the level of the busy line, and returns the level that the line reports. Returns false if
  // the options name no busy line.
  Result<bool> SetBusy(bool high) {
    if (!options_.busy) return false;
    if (Error error = busy_.Set(high)) return error;
    return busy_.Read();
  }

  Error TakePicture() {
    const Result<bool> during = SetBusy(true);
    if (!during) return during.error();
    const double start = Seconds();
    const starfocus_status status = camera_.Take(focus_, aperture());
    const double seconds = Seconds() - start;
    const Result<bool> after = SetBusy(false);
    if (!after) return after.error();
    if (status != STARFOCUS_OK) {
      return Error::Internal("picture", "a refocused picture", starfocus_status_string(status));
    }
    ++taken_;
    std::printf("picture %d: focus %g, aperture %g, %.3f ms", taken_, focus_, aperture(),
                1e3 * seconds);
    if (options_.busy) std::printf(", busy line read back %d, then %d", *during, *after);
    std::printf("\n");
    Keep();
    return {};
  }

  // Shows and writes the picture. Prints errors and continues, because a full disk must not end the
  // camera.
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
    if (error) TellLine("board_refocus: " + error.line());
  }

  const Options& options_;
  const PanelLines& lines_;
  GpioInputs inputs_;
  GpioOutput busy_;
  Camera camera_;
  double focus_ = 0, step_ = 0;
  size_t aperture_ = 0;
  int taken_ = 0;
};

Error List() {
  const Result<std::vector<GpioChip>> chips = ListGpioChips();
  for (const GpioChip& chip : *chips) {
    std::printf("%s: %s, %d lines\n", chip.name.c_str(), chip.label.c_str(), chip.lines);
  }
  return chips.error();
}

Error Run(const Options& options) {
  if (options.list) return List();
  if (options.folder.empty()) return Error::Usage("DIR", "a light-field folder", "none");
  const Result<PanelLines> lines = PlanLines(options);
  if (!lines) return lines.error();
  Board board(options, *lines);
  if (Error error = board.Open()) return error;
  return board.Run();
}

// Adds the options of the GPIO lines.
void AddLineOptions(Options* options, Command* command) {
  AddOptions(
      {
          {"--chip", "CHIP", "GPIO chip: a name such as gpiochip0, a number or a path",
           &options->chip, Use::kDefault},
          {"--encoder", "A,B",
           "Lines of the rotary encoder that moves the focus, 0 to 65535; default: no "
           "encoder",
           Pair(',', &options->encoder)},
          {"--aperture-button", "LINE",
           "Line of the button that changes the aperture, 0 to 100000; default: no button",
           Whole(0, kLastLine, &options->aperture)},
          {"--shutter", "LINE", "Line of the button that takes a picture, 0 to 100000; required",
           Whole(0, kLastLine, &options->shutter)},
          {"--busy", "LINE",
           "Output line that is high exactly while the engine runs, 0 to 100000; default: "
           "none",
           Whole(0, kLastLine, &options->busy)},
          {"--debounce", "MS",
           "Duration of contact bounce of the buttons in milliseconds, 0 to 1000",
           Whole(0, 1000, &options->debounce), Use::kDefault},
          {"--active", "low|high", "Level of a button line while the button is pressed",
           Choice<bool>({{"low", false}, {"high", true}}, &options->active_high), Use::kDefault},
          {"--bias", "pull-up|pull-down|none", "Bias of the input lines",
           Choice<GpioBias>({{"pull-up", GpioBias::kPullUp},
                             {"pull-down", GpioBias::kPullDown},
                             {"none", GpioBias::kAsIs}},
                            &options->bias),
           Use::kDefault},
      },
      command);
}

Error Main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  Options options;
  Program program = {
      {"board_refocus",
       "Refocus a light field with a knob and buttons on GPIO lines.",
       {
           {"DIR", "DIR", "Light-field folder", &options.folder},
           {"--list", nullptr, "List the GPIO chips and exit", &options.list},
           {"--focus", "D",
            "Disparity in focus at the start, within the disparities of the scene; "
            "default: their middle",
            Number(&options.focus)},
           {"--step", "D",
            "Disparity of one step of the encoder; default: 1/40 of the disparity range",
            Number(&options.step)},
           {"--mode", "block|frame",
            "Rendering mode: block gives each block its own number of views, frame uses "
            "one number for the whole picture",
            Choice<starfocus_mode>(
                {{"block", STARFOCUS_MODE_BLOCK}, {"frame", STARFOCUS_MODE_FRAME}}, &options.mode),
            Use::kDefault},
           {"--threads", "N", "Number of threads, 1 to 64", Threads(&options.threads),
            Use::kDefault},
           {"--pictures", "N",
            "Number of pictures after which the program ends, 0 to 1000000; 0 means never",
            Whole(0, 1000000, &options.pictures), Use::kDefault},
           {"--out", "FILE",
            "Picture file to write (.png, .ppm, .jpg or .webp), with a number added to its "
            "name; default: none, only --framebuffer",
            &options.out},
           {"--framebuffer", "FILE",
            "Linux framebuffer that shows the pictures, such as /dev/fb0; default: none",
            &options.framebuffer},
       },
       [&options] { return Run(options); },
       {"board_refocus --list",
        "board_refocus lf --encoder 17,27 --aperture-button 22 --shutter 23 --out picture.png"}},
      {}};
  AddLineOptions(&options, &program.main);
  return RunCommandLine(program, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram("board_refocus", [&] { return Main(argc, argv); });
}
