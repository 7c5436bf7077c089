// SPDX-License-Identifier: Apache-2.0
// A light field of any format, whole or row by row: the light of any pixel of any view, and rows of
// the disparity map.
#ifndef STARFOCUS_LIB_IO_INPUT_H_
#define STARFOCUS_LIB_IO_INPUT_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/config.h"
#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/base/transfer.h"
#include "lib/io/depth_map.h"
#include "lib/io/image.h"
#include "lib/optics/view_set.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct CoverageMap;
struct Input;
struct LampLengths;
struct RimMap;

// Rows of a light field in memory of the engine. Planes without memory have null data.
struct InputRings {
  // Codes, with the number of rows of `disparity`. With streaming: pushed rows of all views. With
  // images: converted rows of the centre view.
  uint8_t* views[STARFOCUS_MAX_VIEWS] = {};
  Plane<int16_t> disparity;        // Converted rows of the disparity map, kDisparityBits.
  Plane<uint8_t> coverage, alpha;  // With streaming: pushed rows; the alpha of the centre view.
  uint32_t* columns = nullptr;     // With images: see DepthSource::columns.
  int32_t map_width = 0;  // Width of the map for which `columns` was set; 0 if it is not set yet.

  Plane<uint8_t> View(int view) const {
    return {views[view], 3 * disparity.stride, disparity.rows, 0};
  }
};

// Allocates rings of `rows` rows, but of `alpha_rows` rows for alpha, which is read later.
void TakeInput(const FullConfig& config, int32_t rows, int32_t alpha_rows, Arena* arena,
               InputRings* rings);

// Read `count` pixels of a row of packed RGB codes, as the members of Input require.
void ReadPackedLight(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb);
const uint8_t* ReadPackedCodes(const Input& in, int view, int32_t x, int32_t y, int32_t count,
                               uint8_t* room);

// Returns the number of pixels of a layer along an axis of `size` pixels. A layer has one pixel
// more than the picture covers, so that upsampling reads the colour of the edge beyond the edge.
constexpr int32_t LayerSize(int32_t size, int32_t layer) {
  return layer == 0 ? size : (LayerSize(size, layer - 1) + 1) / 2 + 1;
}

// A light field. Pixel (x, y) of layer L is at (x << L, y << L) in the pictures. Only the centre
// view is subsampled completely. Side views are read only at a few pixels, to fill holes. An Input
// can be copied; it does not own the pictures.
struct Input {
  // Functions of the format of the views. They read `count` RGB pixels of a view, starting at
  // (x, y) and continuing along the row. All pixels must be inside the picture. `read_light` writes
  // the light of the pixels. `read_codes` returns the codes of the pixels. The codes are in the
  // picture, or in `room` (3 * count bytes) if the function wrote them there.
  void (*read_light)(const Input& in, int view, int32_t x, int32_t y, int32_t count,
                     int16_t* rgb) = ReadPackedLight;
  const uint8_t* (*read_codes)(const Input& in, int view, int32_t x, int32_t y, int32_t count,
                               uint8_t* room) = ReadPackedCodes;
  const simd::Kernels* kernels = nullptr;
  const simd::ImageKernels* image_kernels = nullptr;  // Null if no pixel or value is converted.
  const simd::Encoding* transfer = nullptr;           // Transfer function of the pictures.
  int32_t width = 0, height = 0;                      // Size of the pictures.
  int32_t views = 0;               // Number of captured views, including the centre view.
  OcclusionViews occlusion_views;  // Captured views that see behind depth edges.

  // Rows of the views. Row 0 of `images` is row `first` of the picture. If `centre` is a ring,
  // packed views are rings with the same number of rows.
  ImageSource images[STARFOCUS_MAX_VIEWS] = {};
  int32_t first = 0;
  Plane<const uint8_t> centre;   // Codes of the centre view.
  bool converts_centre = false;  // True: ReadView must fill `centre` before its rows are read.

  DepthSource map = {};        // Map to convert (ReadMap); without data: `disparity` is complete.
  bool fills_unknown = false;  // True: ReadMap fills unknown disparities.
  Plane<const int16_t> disparity;  // Disparities at the size of the pictures, kDisparityBits.
  Plane<const int16_t> layers[STARFOCUS_LAYERS];  // Centre view at layers 1 and 2, kLayerBits.
  bool has_layers = false;  // True: `layers` are complete; false: they contain rows of a stripe.
  // Coverage that the light field provides, from 0 to 255 (fully covered); null if the light field
  // has no coverage.
  Plane<const uint8_t> given_coverage;
  // Coverage computed from `given_coverage` or for thin structures; null: no coverage.
  const CoverageMap* coverage = nullptr;
  // Contaminated rims beside outlines; null: no rims.
  const RimMap* rims = nullptr;

  // Not null: this input reads the excess of the highlights of `captured`, at layer 0, instead of
  // its light (highlights.h). `runs` is the cache of their sizes. `excess_factor` multiplies the
  // rendered excess.
  const Input* captured = nullptr;
  LampLengths* runs = nullptr;
  int32_t excess_factor = 0;

  void Light(int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) const {
    read_light(*this, view, x, y, count, rgb);
  }
  const uint8_t* Codes(int view, int32_t x, int32_t y, int32_t count, uint8_t* room) const {
    return read_codes(*this, view, x, y, count, room);
  }
  // Size of a layer in pixels.
  int32_t Width(int layer) const { return LayerSize(width, layer); }
  int32_t Height(int layer) const { return LayerSize(height, layer); }
};

// Returns a valid light field of the caller, whose rows start with row `first` of the picture.
// Views are read in place if all views are packed RGB. If a view has another format, rows of the
// centre view are converted into its ring, and pixels of side views are converted when they are
// read. Disparities are converted into their ring. If the map is smaller than the picture, sets the
// columns of `rings`.
Input InputOf(const FullConfig& config, const simd::Kernels& kernels,
              const starfocus_light_field& given, int32_t first, InputRings* rings);

// Returns a light field in memory of the library. The planes of `views` have the same geometry.
Input InputOf(const FullConfig& config, const simd::Kernels& kernels, const Plane<uint8_t>* views,
              const Plane<int16_t>& disparity, const Plane<uint8_t>& coverage);

// Writes the codes of row y of a view, converted from its image.
void ReadView(const Input& in, int view, int32_t y, uint8_t* rgb);

// Returns the flags (simd::kUnknownDepth) of the values of the map on which `rows` depend. If `out`
// is not null, also writes the disparities of the rows. If in.fills_unknown, unknown disparities
// are filled along their row, and their number is added to *unknown.
uint32_t ReadMap(const Input& in, const Range& rows, const Plane<int16_t>* out, uint64_t* unknown);

// Copies rows of all views to rings, and rows of coverage and alpha to their rings if these exist.
// If the centre view has no alpha, its alpha is 255.
void CopyRows(const Input& from, const Range& rows, const InputRings& to);

// Sequence of positions in a captured view. The first position is (x, y) of the layer, kShiftBits.
// Neighbouring positions are (dx, dy) pixels of the layer apart.
struct CapturedLine {
  int32_t x, y, dx, dy;
};

// Reads the light at the first `count` positions of a line in captured view `view`, in RGB order.
// For positions outside the picture, the nearest pixel inside is read. At layer 0 (L = 0) the light
// is interpolated linearly. At L > 0 the view is subsampled around the nearest pixel of the
// picture, with a triangular filter of 2^(L+1) - 1 taps per axis. A triangular filter is
// sufficient, because refocusing later blurs a hole of a defocused block by at least 3 pixels of
// the layer.
void ReadCaptured(const Input& in, int layer, int view, const CapturedLine& line, int32_t count,
                  int16_t* rgb);

// Returns the number of pixels of the picture that ReadCaptured reads around a position.
constexpr int32_t CapturedBorder(int layer) { return layer == 0 ? 1 : (1 << layer) - 1; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_INPUT_H_
