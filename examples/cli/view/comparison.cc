// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/view/comparison.h"

#include <algorithm>

#include "examples/cli/disparity/map_figures.h"
#include "examples/cli/pictures/shrink.h"
#include "examples/cli/pictures/tint.h"
#include "examples/cli/refocus/aperture.h"
#include "examples/cli/view/legend.h"
#include "examples/cli/view/page.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

constexpr int kSliderSide = 1600, kFigureSide = 600;  // Largest sides of pictures in pixels.
constexpr uint8_t kFocusColor[3] = {255, 140, 0};
constexpr int kFocusPercent = 60;  // Share of kFocusColor in the tint of pixels in focus.

// Returns the disparities that a lens does not blur.
FocusBand BandOf(const starfocus::Params& lens) {
  return {lens.focus - lens.focus_farther, lens.focus + lens.focus_nearer};
}

// Returns true if a lens blurs a disparity by at most `radius` pixels.
bool IsSharp(const starfocus::Params& lens, double disparity, double radius) {
  const FocusBand band = BandOf(lens);
  return lens.aperture * std::max(band.far - disparity, disparity - band.near) <= radius;
}

// Draws the picture in grey, with the pixels in focus tinted. `map` has the size of the picture.
Image DrawFocus(const Image& picture, const FloatMap& map, const starfocus::Params& lens,
                double radius) {
  Image drawn = picture;
  for (size_t i = 0; i < map.values.size(); ++i) {
    const bool sharp = IsSharp(lens, double(map.values[i]), radius);
    Tint(kFocusColor, sharp ? kFocusPercent : 0, &drawn.pixels[3 * i]);
  }
  return drawn;
}

void AddLens(const Refocused& refocused, double radius, Page* page) {
  const starfocus::Params& lens = refocused.task->params;
  const FloatMap& map = refocused.task->light_field->disparity;
  const auto sharp = std::count_if(map.values.begin(), map.values.end(), [&](float disparity) {
    return IsSharp(lens, double(disparity), radius);
  });
  const FocusBand band = BandOf(lens);
  std::string focus = "disparity " + Decimal(band.far, 2);
  if (band.near > band.far) focus += " to " + Decimal(band.near, 2);
  if (refocused.at) {
    focus +=
        ", at pixel " + std::to_string(refocused.at->x) + "," + std::to_string(refocused.at->y);
  }
  const std::string f_stop =
      lens.aperture > 0 ? "f/" + Decimal(refocused.widest / lens.aperture, 1) + ", " : "";
  page->AddTable(
      {{"Focus", focus},
       {"Aperture", f_stop + "radius " + Decimal(lens.aperture, 3)},
       {"In focus", Decimal(100.0 * double(sharp) / double(map.values.size()), 1) +
                        " % of the pixels, blurred by at most " + Decimal(radius, 1) + " pixels"}});
}

}  // namespace

Error WriteComparison(const std::string& path, const Refocused& refocused, const Bytes& icc) {
  const LightField& light_field = *refocused.task->light_field;
  const starfocus::Params& lens = refocused.task->params;
  const Image& before = light_field.views[0];
  const starfocus_disparity_stats stats = MeasureDisparity(light_field.disparity);
  const double radius = SharpRadius(before.width, before.height);
  const Image small = Shrink(before, kFigureSide, kFigureSide);
  const FloatMap map = SampleMap(light_field.disparity, small.width, small.height);
  std::optional<PagePlace> mark;
  if (refocused.at) {
    mark =
        PagePlace{(refocused.at->x + 0.5) / before.width, (refocused.at->y + 0.5) / before.height};
  }
  const std::string ring = mark ? "; the ring marks the focused pixel" : "";
  Page page(refocused.input, icc);
  Error error = page.AddSlider(
      path, {"The picture before, sharp everywhere", "", Shrink(before, kSliderSide, kSliderSide)},
      {"The refocused picture", "", Shrink(*refocused.picture, kSliderSide, kSliderSide)});
  if (error) return error;
  AddLens(refocused, radius, &page);
  error = page.AddFigures(path, "Depth and focus",
                          {{"The disparity map in colours", "Disparity in pixels" + ring,
                            DrawDepth(map, stats), mark, LegendHtml(stats, BandOf(lens))},
                           {"The picture in grey, with the pixels in focus in orange",
                            "In focus: orange" + ring, DrawFocus(small, map, lens, radius), mark}},
                          kFigureSide);
  return error ? error : WriteText(path, page.Html());
}

}  // namespace starfocus
