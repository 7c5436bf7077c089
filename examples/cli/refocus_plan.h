// SPDX-License-Identifier: Apache-2.0
// Parses the options of a lens and an engine, and applies these options to a light field. The
// commands `refocus` and `video` share this header.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_PLAN_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_PLAN_H_

#include <optional>
#include <string>
#include <vector>

#include "examples/cli/engine_run.h"
#include "examples/cli/lens_options.h"
#include "examples/command_line/command.h"
#include "examples/command_line/options.h"
#include "platform/readers/capture.h"
#include "platform/result.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct LensOptions {
  std::optional<double> focus;
  std::optional<FocusBand> focus_range;
  std::optional<Pixel> focus_at;
  ApertureOptions aperture;
  starfocus_mode mode = STARFOCUS_MODE_BLOCK;
  starfocus_renderer renderer = STARFOCUS_RENDERER_AUTO;
  Positions views;     // positions of the views to use; empty: all available views
  int threads = 0;     // 0: the number of cores that the process may use
  int superblock = 0;  // side of the superblocks; 0: chosen by the library
  int max_layer = 2, deblocking = 35;
  double n_scale = 1, highlights = 1;
  std::optional<starfocus_transfer> transfer;  // no value: as the light field's codes require
  std::string timing;
  ShapeOptions shape;
};

void AddLensOptions(Command* command, LensOptions* options);
// Adds only the options that set the aperture.
void AddApertureOptions(Command* command, ApertureOptions* options);

struct LensPlan {
  LensOptions options;
  std::string focus_option;  // option that set the foci; empty: not set
  // One focus, or the foci of a sweep; empty until ChooseFocus sets the focus from a chosen pixel.
  std::vector<double> foci;
  int x = 0, y = 0;  // pixel that determines the focus
  ApertureChoice aperture;
  starfocus_region region = {};  // All 0: the whole picture.
  Config config;  // Timing, and features that the shape requires; other fields have defaults.
  starfocus::Params lens;  // Shape of the aperture and extent of the focus.
};

// Checks the focus, the shape and the timing before a light field is read. The aperture
// is not checked.
Result<LensPlan> PlanLens(const LensOptions& options);
void UseFocus(const DefaultFocus& focus, LensPlan* plan);

// Checks that the renderer supports views at these positions. The line-scan renderer requires the
// standard layout of 1, 5, 9 or 17 views.
Error CheckRenderer(const std::string& where, const LensPlan& plan, const Positions& views);

// Measures a map, which must not have unknown values, unless `may_have_holes` is true: then one
// value must be known. Error messages start with `where`.
Result<starfocus_disparity_stats> PrepareDisparity(const std::string& where, const FloatMap& map,
                                                   bool may_have_holes = false);

// Returns the disparity of the surface at a pixel of a picture of `width` x `height` pixels, or
// nullopt if the map has no known values around the pixel. The map may have another size. Returns
// an error of the option if the pixel is outside the picture.
Result<std::optional<double>> FocusOfPixel(const char* option, const Pixel& at, int width,
                                           int height, const FloatMap& map);

// Sets the focus to the disparity at the chosen pixel, if the focus depends on a pixel.
Error ChooseFocus(const FloatMap& map, LensPlan* plan);

// Describes the focus: "focus 273,595 (disparity 14.2)", "focus at disparity 14.2", "focus from
// disparity 9 to -1" or "25 foci from disparity -3 to 3". The foci must be set.
std::string FocusText(const LensPlan& plan);

// Describes the lens for the line that reports an output: "focus 273,595 (disparity 14.2), f/1.8".
std::string LensText(const LensPlan& plan);

// Prints a note if the map, whose disparities are measured in `stats`, has no pixel in focus.
// `sharp` is the largest blur radius of a pixel in focus.
void TellBlurred(const std::string& path, const starfocus_disparity_stats& stats, double sharp,
                 const LensPlan& plan);

// Fits the aperture to the expected blur. ForeseeBlur is called before the map is processed,
// because processing may take a long time. `repaired` is true if the map will be repaired. The map
// may contain unknown values and may differ in size from the picture.
Error ForeseeBlur(const LightField& light_field, bool repaired, LensPlan* plan);

// Fits the aperture to the blur of the final map. Returns the largest blur radius over all foci,
// rounded up to whole pixels.
Result<double> ChooseBlur(const starfocus_disparity_stats& stats, LensPlan* plan);

// Returns the task of the first focus. The task has a clock if `reported` is true.
EngineTask MakeTask(const LensPlan& plan, const LightField& light_field,
                    const starfocus_disparity_stats& stats, double max_blur, bool reported);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_PLAN_H_
