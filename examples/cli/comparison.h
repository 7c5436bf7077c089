// SPDX-License-Identifier: Apache-2.0
// Pages and strips of several pictures of one light field, for `view` and `refocus --compare`. A
// page is one HTML file: its pictures are data URIs, and it loads no other files. If the
// folder of a light field has ground-truth pictures, they are compared.
#ifndef STARFOCUS_EXAMPLES_CLI_COMPARISON_H_
#define STARFOCUS_EXAMPLES_CLI_COMPARISON_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "examples/cli/engine_run.h"
#include "examples/command_line/options.h"
#include "platform/file.h"
#include "platform/image.h"
#include "platform/light_field.h"
#include "platform/result.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A place in a picture, as fractions of the width and the height of the picture.
struct PagePlace {
  double x = 0, y = 0;
};

struct PageFigure {
  std::string says;  // alternative text of the picture
  std::string caption;
  Image picture;
  std::optional<PagePlace> mark = {};  // centre of a ring over the picture; nullopt: no ring
  std::string legend = "";             // HTML below the picture (legend.h)
};

// Builds the page. Callers pass plain text, and this class escapes HTML characters.
class Page {
 public:
  // The title is the file name of the input `path`. `icc` is the colour profile of all pictures
  // without a legend; empty for sRGB. Pictures with a legend are in sRGB, like the legend.
  Page(const std::string& path, const Bytes& icc);

  void AddTable(const std::vector<std::pair<std::string, std::string>>& rows);

  // Adds figures under a heading, side by side if they fit. Pictures are reduced to at most `width`
  // pixels. Error messages start with `path`, which is the file of the page.
  Error AddFigures(const std::string& path, const std::string& heading,
                   const std::vector<PageFigure>& figures, int width);

  // Adds two pictures of the same size with a divider (slider.h). A page has at most one slider.
  // Error messages start with `path`, which is the file of the page.
  Error AddSlider(const std::string& path, const PageFigure& before, const PageFigure& after);

  // Adds a histogram of bars, and a collapsible table of the numbers.
  void AddHistogram(const std::string& heading, const std::vector<int64_t>& counts,
                    const starfocus_disparity_stats& stats);

  // Returns the complete HTML file.
  std::string Html() const;

 private:
  std::string title_, style_, script_, body_;
  const Bytes icc_;
};

// CSS rules of the slider. The rules use the colours of the page (page.cc).
extern const char kSliderStyle[];

// Script that moves the divider, and its hash for the content security policy of the page. Without
// the script, the divider stays in the middle.
extern const char kSliderScript[];
extern const char kSliderScriptHash[];

// Returns HTML of the slider. `before` and `after` are <img> elements of `width` x `height` pixels.
std::string SliderHtml(const std::string& before, const std::string& after, int width, int height);

// A picture that was refocused.
struct Refocused {
  std::string input;             // path of the input
  const EngineTask* task;        // light field and lens
  const Image* picture;          // result
  double widest = 1;             // f-stop of an aperture of radius 1
  std::optional<Pixel> at = {};  // pixel that determined the focus; nullopt: none
};

// Writes the page to the file `path`, completely or not at all. The picture must have the size of
// the centre view. `icc` is the colour profile of the pictures.
Error WriteComparison(const std::string& path, const Refocused& refocused, const Bytes& icc);

// CSS rules of the legend. The rules use the colours of the page (page.cc).
extern const char kLegendStyle[];

// Returns HTML of a bar with the colours from the smallest disparity, far, to the largest, near.
// The bar marks the disparities in focus. A focus beyond an end of the bar is marked at this end.
std::string LegendHtml(const starfocus_disparity_stats& stats, std::optional<FocusBand> focus);

struct LensAt {
  double focus = 0, aperture = 1;
};

// Returns the largest blur radius of a picture that is refocused with `lens`.
double BlurOf(const LensAt& lens, const starfocus_disparity_stats& stats);

// Returns `count` foci at equal steps of disparity, from far to near. The foci cover the known
// values of the map except for the lowest and the highest hundredth of these values. Returns one
// focus if all values are equal.
std::vector<double> StripFoci(const FloatMap& map, int count);

// A ground-truth picture of the folder's scene through a real lens: truth_dt<D>_ut<U>.png, as
// `starfocus-lab scene` writes it.
struct TruthFile {
  std::string path;
  LensAt lens;
};

// Returns the ground-truth files of a folder, sorted by name.
std::vector<TruthFile> FindTruths(const std::string& folder);

// Refocuses the light field of a folder or photo for each of the lenses, and calls `show` with each
// picture and its blocks. Blur radii must not exceed STARFOCUS_MAX_BLUR.
Error RefocusEach(
    const std::string& where, const LightField& light_field, const starfocus_disparity_stats& stats,
    int threads, const std::vector<LensAt>& lenses,
    const std::function<Error(size_t, const Image&, const std::vector<starfocus_block>&)>& show);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_COMPARISON_H_
