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
struct DeepTables;
struct Input;
struct LampLengths;
struct RimMap;

// What a tile of kTileColumns pixels of a row contains in any view: the number of bits of its
// largest excess, 0 for none, and a flag for alpha below 1.
struct LightTile {
  static constexpr int32_t kTileColumns = 64;
  uint8_t excess_bits, transparent;

  void Add(const LightTile& tile) {
    excess_bits = tile.excess_bits > excess_bits ? tile.excess_bits : excess_bits;
    transparent |= tile.transparent;
  }
};

// Rows of a light field in memory of the engine. Planes without memory have null data.
struct InputRings {
  // Codes, with the number of rows of `disparity`. With streaming: pushed rows of all views. With
  // images: converted rows of the centre view.
  uint8_t* views[STARFOCUS_MAX_VIEWS] = {};
  Plane<int16_t> disparity;        // Converted rows of the disparity map, kDisparityBits.
  Plane<uint8_t> coverage, alpha;  // With streaming: pushed rows; the alpha of the centre view.
  // Deep engines have these in place of `views`, with the same rows: colours, alpha, and tiles.
  Plane<uint16_t> deep[STARFOCUS_MAX_VIEWS], deep_alpha[STARFOCUS_MAX_VIEWS];
  Plane<LightTile> tiles;
  const DeepTables* tables = nullptr;  // Set by the engine.
  uint32_t* columns = nullptr;         // With images: see DepthSource::columns.
  int32_t map_width = 0;  // Width of the map for which `columns` was set; 0 if it is not set yet.

  Plane<uint8_t> View(int view) const {
    return {views[view], 3 * disparity.stride, disparity.rows, 0};
  }
};

// Views in memory of the library: codes, or colours and alpha of deep pictures.
struct StoredViews {
  Plane<uint8_t> codes[STARFOCUS_MAX_VIEWS];
  Plane<uint16_t> deep[STARFOCUS_MAX_VIEWS], deep_alpha[STARFOCUS_MAX_VIEWS];
  const DeepTables* tables = nullptr;  // Null: the views are codes.
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

  // Not null: the pictures are deep (deep.h). Views without rows in memory are converted from their
  // image when they are read.
  const DeepTables* deep = nullptr;
  Plane<const uint16_t> deep_rows[STARFOCUS_MAX_VIEWS], deep_alpha[STARFOCUS_MAX_VIEWS];
  int32_t deep_transfer = 0;  // starfocus_transfer of the 16-bit codes of deep pictures.
  bool has_alpha = false;     // True: some view has alpha that is refocused.
  int32_t excess_shift = 0;   // ReadDeepExcess multiplies by 2^excess_shift.

  // Rows of the views. Row 0 of `images` is row `first` of the picture. If `centre` is a ring,
  // packed views are rings with the same number of rows.
  ImageSource images[STARFOCUS_MAX_VIEWS] = {};
  int32_t first = 0;
  Plane<const uint8_t> centre;   // Codes of the centre view.
  bool reads_codes = true;       // True: light is that of the codes of the pictures.
  bool is_excess = false;        // True: light is that of lamps beyond white.
  bool converts_centre = false;  // True: ConvertRow must fill `centre` before its rows are read.

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

  // Not null: this input reads the excess or the alpha of `captured` as light. Mixtures of surfaces
  // are found in the light of `captured`. For highlights (highlights.h), `runs` is the cache of
  // their sizes, and `excess_factor` multiplies the rendered excess.
  const Input* captured = nullptr;
  LampLengths* runs = nullptr;
  int32_t excess_factor = 0;

  bool is_deep() const { return kDeep && deep != nullptr; }
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
Input InputOf(const FullConfig& config, const simd::Kernels& kernels, const StoredViews& views,
              const Plane<int16_t>& disparity, const Plane<uint8_t>& coverage);

// Converts row y of the views to `rings`: of the centre view or, with all_views, of all views. Deep
// engines also set the tiles of the row. If the views are already in memory of the library, sets
// only the tiles.
void ConvertRow(const Input& in, int32_t y, bool all_views, const InputRings& rings);

// Return inputs that read, as light, the excess beyond white or the alpha of a deep input.
Input DeepExcessOf(const Input& captured, int32_t shift);
Input DeepAlphaOf(const Input& captured);

// Returns an input that reads all light of a deep input, divided by 2^kExcessBits (deep.h).
Input DeepWholeOf(const Input& captured);

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
