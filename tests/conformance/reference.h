// SPDX-License-Identifier: Apache-2.0
// Reference implementation of the method: whole pictures in double precision, written for
// readability. The conformance tests compare the engine with this reference. To decide visibility,
// disparities and focus are rounded to 1/64 pixel and shifts to 1/256 pixel, as in the engine.
// Colours in the reference are unrounded doubles.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_H_

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lib/slices/slice_plane.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/reference_line.h"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace reference {

// --- What tests call ---

// Returns the largest blur radius in pixels of the disparities from `low` to `high`.
double LargestBlur(const starfocus::Params& lens, double low, double high);

// Returns the number of views along the aperture radius: (9), or 2 * ceil(r_max) for the benchmark.
int ViewsAlongRadius(double r_max, int mode);

// A cell of the picture that is blurred by a filter, without rendering views (reference_gather.h).
struct GatheredCell {
  int x, y, width, height;              // In the picture.
  bool on_slope;                        // True if each pixel is blurred by its own radius.
  int at_x, at_y, at_width, at_height;  // Rectangle of the cell, in pixels of the block's layer.
};

// A rectangle of a layer, and the widths of the border that is read to render the rectangle, in
// pixels of the layer.
struct Rectangle {
  int x, y, width, height;
  int left, right, top, bottom;
};

// A block of block mode, and the rectangle of the layer that the views of this block render.
struct Block {
  int x, y, width, height;  // in the picture
  int layer, n;
  Rectangle rendered;                  // with margins
  std::vector<GatheredCell> gathered;  // Cells blurred by a filter instead of rendered by views.
};

// Refocuses in any mode but blur. `blocks` is the partition of the picture, and the transfer
// function is that of `config`;
// boundaries are not deblocked. Returns 3 * width * height unrounded values.
std::vector<double> RefocusBlocks(const test::Scene& scene, const starfocus::Params& params,
                                  const test::Config& config, const std::vector<Block>& blocks);

// A pixel of the coverage of thin structures, split near large depth edges into a near and a far
// surface. Disparities are multiples of 1/64 pixel, as in the engine. Between passes, coverage is
// rounded to 1/128, and the certainty of the farther surface's light is rounded down to 1/256, as
// in the engine; weighted light of near surfaces is rounded, too. All other values are unrounded
// doubles.
struct PartedPixel {
  bool parted = false;
  double alpha = 0;          // Share of the pixel that the near surface covers.
  double near = 0, far = 0;  // Disparities of the nearer and the farther surface, in 1/64 pixel.
  Colour light = {0, 0, 0};  // Light of the far surface.
};

// Returns the pixels of the centre view, row by row. Pixels are split by the coverage of the scene
// if the scene has coverage, and by the map and the colours otherwise.
std::vector<PartedPixel> PartPixels(const test::Scene& scene, int transfer);

// --- Captured and rendered views (reference_views.cc) ---

// Returns the light of all views of a scene, and the disparities of the centre view.
LightField Load(const test::Scene& scene, int transfer);

struct Direction {
  int x, y;
};
constexpr Direction kDirections[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

// Returns a rectangle with its border, from `picture`, the centre view at a layer. Beyond the
// layer, the edge pixels are repeated. The surface at the edge of the centre view is continued
// beyond the picture with colours from the captured view on that side. These colours extend as far
// beyond the picture as the surface moves per unit of u. The extension is shorter if one of the 32
// pixels inside the edge covers the surface in the captured view.
Picture ExtendedRectangle(const LightField& field, const Picture& picture, int layer,
                          const Rectangle& rect);

// Mixture of a pixel (x, y) of the centre view next to a depth edge. At the edge, the disparity
// increases by more than `step` (in 1/64 pixel) in the direction `side`. `share` is the part of the
// pixel that shows the near surface, or 0 if the pixel is not a mixture. The far colour comes from
// the captured view that sees behind the near surface. If no view sees the far surface, the far
// colour comes from the opposite neighbour, if this neighbour is on the far surface.
struct Mixed {
  double share;
  Colour near, far;
};
Mixed MixtureAt(const LightField& field, int x, int y, const Direction& side, int step,
                double contrast_fade);

// Range of the squared contrast over which the share of a mixture rises from 0 in slices. The
// paper's renderer has a range of 64.
constexpr double kContrastFade = 1024;

// Share of the near colour in a pixel, and weight with which the far colour that was read replaces
// the colour of the pixel. Both fade to 0 where the pixel is hardly a mixture of the two colours.
struct Division {
  double share, weight;
};
Division Divide(const Colour& near, const Colour& far, const Colour& mixed, double contrast_fade);
Mixed MixtureOf(const Division& division, const Colour& near, const Colour& far,
                const Colour& mixed);

// Unmixes the rectangle's sharp pixels next to a more defocused near surface, at layer 0: the far
// colour replaces the share of the near surface. The outermost pixels of the rectangle are not
// changed.
void Unmix(const LightField& field, const Lens& lens, const Rectangle& rect, Picture* centre);

// Position of a captured view, as the key of LightField.
using Position = std::pair<int, int>;

// Returns the colour at (x, y) of the layer in the captured view at the position `view`.
Colour Read(const LightField& field, int layer, const Position& view, double x, double y);

// Returns the colour of the point with `disparity` that the centre view shows at (x, y) of the
// layer, in the captured view at the position `view`.
Colour ReadMoved(const LightField& field, int layer, const Position& view, int x, int y,
                 int disparity);

// Returns the captured views that see behind depth edges on a side, at most two. The views lie
// within 45 degrees of the direction of the side. If no view is within 45 degrees, views within 83
// degrees (tangent 8) are used. The best view has the largest value of twice its distance towards
// the side minus its distance across. Ties are resolved by the smallest distance across, then the
// smallest u, then the smallest v.
std::vector<Position> LooksOn(const LightField& field, const Direction& side);

// Returns the shift of a disparity along one axis, in a view at `position` on that axis. The shift
// is in pixels of the layer, on the engine's grid of 1/256.
double Moved(int position, int disparity, int layer);

// --- Surfaces (reference_surfaces.cc) ---

// A visible or hidden surface of a pixel.
struct Surface {
  int disparity;  // in 1/64
  Colour colour;
  double share = 1;   // Share of the pixel that this surface covers; surfaces behind get the rest.
  bool ends = false;  // True if the surface ends at a depth edge next to the pixel.
  // If no captured view sees behind the edge: the distance and the directions of the pixels whose
  // colours this surface repeats.
  int repeated = 0;
  std::vector<Direction> towards = {};
};

// Surfaces of each pixel, the nearest first.
struct SurfaceMap {
  int width, height;
  std::vector<std::vector<Surface>> pixels;

  // Returns the surfaces of a pixel. Beyond the map, the outermost pixels are repeated.
  const std::vector<Surface>& At(int x, int y) const {
    return pixels[size_t(std::clamp(y, 0, height - 1)) * size_t(width) +
                  size_t(std::clamp(x, 0, width - 1))];
  }
};

// Finds the surfaces of an extended rectangle at (x0, y0) of the layer.
SurfaceMap FindLayeredDepth(const LightField& field, const Picture& extended, const Lens& lens,
                            int x0, int y0);

// --- Gathering (reference_gather.cc), line scans (reference_views.cc), and slices
// (reference_slices.cc) ---

// Blurs cells of a block by a filter, without rendering views, from the centre view at the block's
// layer. Writes the cells to `frame`, whose first pixel is (frame_x, frame_y) of the layer. `r_max`
// is the largest blur radius for which there are PSFs.
void GatherCells(const LightField& field, const Picture& of_layer, const Block& block,
                 const Lens& lens, double r_max, int frame_x, int frame_y, Picture* frame);

// Returns the weighted sum of all views over the rectangle. The inputs are the centre view at the
// layer of the lens, with repeated edges, and the captured views of the picture.
Picture RefocusRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                         const Rectangle& rectangle);

// Limits of the number of slices (`most`) and of their total area in pixels (`area`). If a limit is
// exceeded, slices become coarser. `range` is the largest difference of blur, in pixels, between
// pixels of a slice near the focus.
struct Slicing {
  size_t most;
  int area;
  double range;
};

// Refocuses a rectangle as RefocusRectangle does, but composites slices instead of scanning lines.
Picture CompositeRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                           const Rectangle& rectangle, const Slicing& slicing);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_H_
