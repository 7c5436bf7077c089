// SPDX-License-Identifier: Apache-2.0
// Materials of the scenes. All materials have fine detail everywhere, so that displaced pixels are
// visible.
#ifndef STARFOCUS_EXAMPLES_SCENE_TEXTURES_H_
#define STARFOCUS_EXAMPLES_SCENE_TEXTURES_H_

#include "examples/scene/scene.h"

namespace starfocus {

// Fabrics and skin.
Color PaintKnit(const Surface& s, const Hit& hit);   // knitted ribs, bands of `second`
Color PaintTweed(const Surface& s, const Hit& hit);  // a herringbone pattern
Color PaintSkin(const Surface& s, const Hit& hit);   // plain skin with pores and freckles
Color PaintFace(const Surface& s, const Hit& hit);   // skin with cheeks and a mouth
Color PaintHair(const Surface& s, const Hit& hit);   // strands of hair along y
Color PaintFur(const Surface& s, const Hit& hit);    // a pompom
Color PaintEye(const Surface& s, const Hit& hit);

// Objects.
Color PaintWallpaper(const Surface& s, const Hit& hit);
Color PaintWood(const Surface& s, const Hit& hit);   // wood grain along the local x axis
Color PaintGlaze(const Surface& s, const Hit& hit);  // pottery with painted bands
Color PaintLeaf(const Surface& s, const Hit& hit);   // a leaf with veins
Color PaintBook(const Surface& s, const Hit& hit);   // a lettered spine of a book
Color PaintLandscape(const Surface& s, const Hit& hit);
Color PaintBulb(const Surface& s, const Hit& hit);    // a glowing bulb
Color PaintMatter(const Surface& s, const Hit& hit);  // the colour `color` with grain
Color PaintLamp(const Surface& s, const Hit& hit);    // `color` with a rim of `second`

// Test patterns.
Color PaintChecker(const Surface& s, const Hit& hit);
Color PaintClouds(const Surface& s, const Hit& hit);  // a checker under smooth clouds
Color PaintTwist(const Surface& s, const Hit& hit);   // a two-coloured wire
Color PaintBark(const Surface& s, const Hit& hit);    // vertical cracks over cloudy ground
Color PaintFloor(const Surface& s, const Hit& hit);   // a floor of tiles
Color PaintStrand(const Surface& s, const Hit& hit);  // strands that mix both colours

// Shades a colour by Lambert's law, with light from the upper left and front.
Color Lit(Color color, const Hit& hit);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_TEXTURES_H_
