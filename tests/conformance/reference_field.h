// SPDX-License-Identifier: Apache-2.0
// The reference's extended rectangle, and colours of captured views.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FIELD_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FIELD_H_

#include "tests/conformance/reference_line.h"

namespace reference {

// The light of a scene's views, and its disparities.
LightField Load(const test::Scene& scene, int transfer);

// A rectangle of a layer and the border it is rendered from, in the layer's pixels.
struct Rectangle {
  int x, y, width, height;
  int left, right, top, bottom;
};

struct Direction {
  int x, y;
};
constexpr Direction kDirections[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

// A rectangle with its border, from the centre view at some layer, whose edge goes on beyond it.
Picture ExtendedRectangle(const Picture& layer, const Rectangle& rect);

// Where the layer's edge goes on beyond the picture: the surface at the edge of `picture` (at layer
// 0) goes on, and the captured view that looks out there shows as much of it as the
// surface moves from unit to unit, up to what a nearer pixel of the 32 inside covers.
void ExtendEdges(const LightField& field, const Picture& picture, int layer, const Rectangle& rect,
                 Picture* extended);

// What a pixel (x, y) of the centre view is a mixture of that lies beside a depth edge, a step of
// more than `step` (1/64) up to the side: how much of it shows the near surface (0: it is no
// mixture), and the colours of both. The far one is what the captured view that looks
// behind the near surface shows of the pixel; without such a view it is the pixel on the other
// side, if it is of the same surface.
struct Mixed {
  double share;
  Colour near, far;
};
Mixed MixtureAt(const LightField& field, int x, int y, const Direction& side, int step);

// The share of `near` in a subsampled pixel, which fades to 0 towards the limits of a mixture.
double FadedShareOf(const Colour& near, const Colour& far, const Colour& mixed);

// At layer 0: in the rectangle's sharp pixels beside a more defocused surface that surface's part
// gives way to the far colour. The outermost pixels reach nothing.
void Unmix(const LightField& field, const Lens& lens, const Rectangle& rect, Picture* centre);

// A captured view's position, as LightField has it.
using Position = std::pair<int, int>;

// The colour at (x, y) of the layer in the captured view at that position.
Colour Read(const LightField& field, int layer, const Position& view, double x, double y);

// The captured views that look behind depth edges on a side, two at most. They lie within 45
// degrees of its direction; where none does, within the angle of tangent 8. The best is farthest
// out by twice its way towards the side less its way beside it; of equal ones, that with the least
// way beside it, the least u, the least v.
std::vector<Position> LooksOn(const LightField& field, const Direction& side);

// How far a disparity moves along one axis in a view at `position` of that axis: pixels of the
// layer, on the engine's grid of 1/256.
double Moved(int position, int disparity, int layer);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_FIELD_H_
