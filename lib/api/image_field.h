// SPDX-License-Identifier: Apache-2.0
// A light field of images during a call: rows of the centre view and of disparities go into the
// engine's rings, and pixels of side views are converted where they are asked for.
#ifndef STARFOCUS_LIB_API_IMAGE_FIELD_H_
#define STARFOCUS_LIB_API_IMAGE_FIELD_H_

#include "lib/convert/depth_rows.h"
#include "lib/convert/image_rows.h"
#include "lib/engine/engine.h"
#include "lib/input/view_reader.h"
#include "starfocus/image.h"

namespace starfocus {

struct ImageField {
  const simd::ImageKernels* kernels;
  ImageSource views[kMaxViews];
  PlaneViews centre;  // view 0 alone: the engine's ring of its rows
  DepthSource depth;
  bool fills;  // some of the depths may be unknown
};

// Returns the bytes of a row of the map.
uint64_t MapRowBytes(const sf_depth_map& map);

// Makes *field of a field that has been checked; the map's columns go into the engine's memory.
void MakeImageField(const sf_image_field& images, EngineState* engine, ImageField* field);

// Points the engine's windows at its ring of the centre view and at the field, which must stay.
void UseImageField(const ImageField& field, EngineState* engine);

// Returns the status of a depth map of which these DepthFlags are known.
sf_status StatusOfDepth(uint32_t flags, const sf_config& config);

// Looks at the rows of the map that rows [first, last) of the picture are made of, so that reading
// them succeeds.
sf_status CheckDepths(const RowRange& rows, EngineState* engine, ImageField* field);

// Has the runner convert rows of the centre view into the engine's ring, and those of disparities
// into *disparity; null: it has them.
sf_status ReadImageRows(const ImageField& field, const RowRange& rows,
                        const Plane<int16_t>* disparity, const Runner& runner, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_IMAGE_FIELD_H_
