// SPDX-License-Identifier: Apache-2.0
// What `refocus` and `video` have in common: the options of a lens and an engine, and the light
// field they are applied to.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_REFOCUS_PLAN_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_REFOCUS_PLAN_H_

#include <optional>
#include <string>
#include <vector>

#include "examples/cli/engine/engine_run.h"
#include "examples/cli/refocus/aperture.h"
#include "examples/cli/refocus/default_focus.h"
#include "examples/command_line/command.h"
#include "examples/command_line/options.h"
#include "examples/command_line/shape.h"
#include "platform/readers/capture.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct LensOptions {
  std::optional<double> focus;
  std::optional<Pixel> focus_at;
  ApertureOptions aperture;
  starfocus_mode mode = STARFOCUS_MODE_BLOCK;
  starfocus_renderer renderer = STARFOCUS_RENDERER_AUTO;
  Positions views;  // none: all there are
  int threads = 1;
  int superblock = 0;  // 0: the library chooses
  int max_layer = 2, deblocking = 35;
  double n_scale = 1, highlights = 1;
  starfocus_transfer transfer = STARFOCUS_TRANSFER_SRGB;
  std::string timing;
  ShapeOptions shape;
};

void AddLensOptions(Command* command, LensOptions* options);
// The part of them that sets the aperture.
void AddApertureOptions(Command* command, ApertureOptions* options);

struct LensPlan {
  LensOptions options;
  std::string focus_option;  // that the foci come from; empty: none is set yet
  std::vector<double> foci;  // one, or those of a sweep; none while they depend on a pixel
  int x = 0, y = 0;          // that pixel
  ApertureChoice aperture;
  starfocus_region region = {};  // all 0: the whole picture
  Config config;                 // what the shape needs, the timing, and defaults
  starfocus_lens lens = {};      // the shape of the opening, and defaults
};

// All that can be refused before a light field is read, but for the aperture: --focus or
// --focus-at, if one of them is there, the shape and the timing.
Result<LensPlan> PlanLens(const LensOptions& options);
void UseFocus(const DefaultFocus& focus, LensPlan* plan);

// Checks that the renderer is one for these views: line scans need a star.
Error CheckRenderer(const std::string& where, const LensPlan& plan, const Positions& views);

// Measures a map, which is to have no holes. Errors are about `where`.
Result<starfocus_disparity_stats> PrepareDisparity(const std::string& where, const FloatMap& map);

// The disparity of what is at the chosen pixel, if the focus depends on it.
Error ChooseFocus(const FloatMap& map, LensPlan* plan);

// Fits the aperture to the blur of a map before its care, which may take long: a repair, where
// `repaired` is true. The map may have unknown values and another size than the picture.
Error ForeseeBlur(const LightField& light_field, bool repaired, LensPlan* plan);

// Fits the aperture to the blur of the map that is used. Returns the largest blur radius of any
// focus, rounded up to whole pixels.
Result<double> ChooseBlur(const starfocus_disparity_stats& stats, LensPlan* plan);

// The task of the first focus; with a clock when it is to be reported.
EngineTask MakeTask(const LensPlan& plan, const LightField& light_field,
                    const starfocus_disparity_stats& stats, double max_blur, bool reported);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_REFOCUS_PLAN_H_
