// SPDX-License-Identifier: Apache-2.0
// Materials of the scenes. All materials have fine detail everywhere, so that displaced pixels are
// visible.
#ifndef STARFOCUS_EXAMPLES_SCENE_TEXTURES_H_
#define STARFOCUS_EXAMPLES_SCENE_TEXTURES_H_

#include "examples/scene/scene.h"

namespace starfocus {

// Fabrics and skin.
Color PaintKnit(const Surface& s, const Hit& hit);   // Ribs of V stitches, with bands of `second`.
Color PaintTweed(const Surface& s, const Hit& hit);  // A herringbone pattern.
Color PaintSkin(const Surface& s, const Hit& hit);   // Plain skin with pores and freckles.
Color PaintFace(const Surface& s, const Hit& hit);   // Skin with cheeks and a mouth.
Color PaintHair(const Surface& s, const Hit& hit);   // Strands of hair along y.
Color PaintFur(const Surface& s, const Hit& hit);    // A pompom.
Color PaintEye(const Surface& s, const Hit& hit);

// Objects.
Color PaintWallpaper(const Surface& s, const Hit& hit);
Color PaintWood(const Surface& s, const Hit& hit);   // Wood grain along the local x axis.
Color PaintGlaze(const Surface& s, const Hit& hit);  // Pottery with painted bands.
Color PaintLeaf(const Surface& s, const Hit& hit);   // A leaf with veins from the midrib.
Color PaintBook(const Surface& s, const Hit& hit);   // A lettered spine of a book.
Color PaintLandscape(const Surface& s, const Hit& hit);
Color PaintBulb(const Surface& s, const Hit& hit);    // A glowing bulb.
Color PaintMatter(const Surface& s, const Hit& hit);  // The colour `color` with grain.
Color PaintLamp(const Surface& s, const Hit& hit);    // Unshaded `color`, with a rim of `second`.

// Test patterns.
Color PaintChecker(const Surface& s, const Hit& hit);
Color PaintClouds(const Surface& s, const Hit& hit);  // A checker under smooth clouds.
Color PaintTwist(const Surface& s, const Hit& hit);   // A two-coloured wire.
Color PaintBark(const Surface& s, const Hit& hit);    // Vertical cracks over cloudy ground.
Color PaintFloor(const Surface& s, const Hit& hit);   // A floor of tiles.
Color PaintStrand(const Surface& s, const Hit& hit);  // A mixture of both colours per strand.

// Shades a colour by Lambert's law, with light from the upper left and front.
Color Lit(Color color, const Hit& hit);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_TEXTURES_H_
