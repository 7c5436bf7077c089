// SPDX-License-Identifier: Apache-2.0
// Extended rectangles of the reference, and the colours of captured views.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FIELD_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FIELD_H_

#include "tests/conformance/reference_line.h"

namespace reference {

// Returns the light of all views of a scene, and the disparities of the centre view.
LightField Load(const test::Scene& scene, int transfer);

// A rectangle of a layer, and the widths of the border that is read to render the rectangle, in
// pixels of the layer.
struct Rectangle {
  int x, y, width, height;
  int left, right, top, bottom;
};

struct Direction {
  int x, y;
};
constexpr Direction kDirections[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

// Returns a rectangle with its border, from a layer of the centre view. Beyond the layer, the edge
// pixels are repeated.
Picture ExtendedRectangle(const Picture& layer, const Rectangle& rect);

// Continues the surface at the edge of `picture` (at layer 0) beyond the picture, with colours from
// the captured view on that side. The colours from the view extend as far beyond the picture as the
// surface moves per unit of u. The extension is shorter if one of the 32 pixels inside the edge
// covers the surface in the captured view.
void ExtendEdges(const LightField& field, const Picture& picture, int layer, const Rectangle& rect,
                 Picture* extended);

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

// Returns the captured views that see behind depth edges on a side, at most two. The views lie
// within 45 degrees of the direction of the side. If no view is within 45 degrees, views within 83
// degrees (tangent 8) are used. The best view has the largest value of twice its distance towards
// the side minus its distance across. Ties are resolved by the smallest distance across, then the
// smallest u, then the smallest v.
std::vector<Position> LooksOn(const LightField& field, const Direction& side);

// Returns the shift of a disparity along one axis, in a view at `position` on that axis. The shift
// is in pixels of the layer, on the engine's grid of 1/256.
double Moved(int position, int disparity, int layer);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FIELD_H_
