// SPDX-License-Identifier: Apache-2.0
#include "lib/io/block_pixels.h"

#include <cstring>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// Returns the number of pixels of the layer for `size` pixels of the picture. A stored layer has
// more pixels (LayerSize).
int32_t PixelsInside(int32_t size, int layer) { return (size + (1 << layer) - 1) >> layer; }

// A pixel of a rectangle that lies at an edge of the picture, and the number of pixels of the
// rectangle beyond this edge.
struct EdgePixel {
  int32_t column, row;
  int side;  // index into kSides
  int32_t beyond;

  const int8_t* out() const { return kSides[side]; }
};

// In a field, replaces the repeated edge pixels of the picture by a continuation of the surface at
// the edge. Pixels beyond the edge get their colour from the captured view that shows them. The
// number of pixels that the view shows is the displacement of the edge in that view. The continued
// surface ends earlier if a nearer surface covers the continued surface in the captured view.
// Pixels farther outside repeat the colour of the last continued pixel. Pixels beyond corners, and
// fields of light fields without side views, are not changed.
class Beyond {
 public:
  Beyond(const Input& input, const BlockPixels& field)
      : input_(input),
        field_(field),
        layer_width_(PixelsInside(input.width, field.layer)),
        layer_height_(PixelsInside(input.height, field.layer)) {}

  void Read() {
    // The part of the field inside the picture; `right` and `bottom` are exclusive.
    const int32_t width = field_.width, height = field_.height;
    const int32_t left = Clamp(-field_.x, 0, width), top = Clamp(-field_.y, 0, height);
    const int32_t right = Clamp(layer_width_ - field_.x, 0, width);
    const int32_t bottom = Clamp(layer_height_ - field_.y, 0, height);
    if (right - left == width && bottom - top == height) return;  // the most frequent case
    for (int32_t row = top; row < bottom; ++row) {
      ReadBehind({right - 1, row, 0, width - right});
      ReadBehind({left, row, 1, left});
    }
    for (int32_t column = left; column < right; ++column) {
      ReadBehind({column, bottom - 1, 2, height - bottom});
      ReadBehind({column, top, 3, top});
    }
  }

 private:
  int32_t DisparityAt(int32_t x, int32_t y) const {
    return input_.disparity.Row(y << field_.layer)[x << field_.layer];
  }

  void ReadBehind(const EdgePixel& edge) {
    if (edge.beyond == 0) return;
    const int32_t disparity = DisparityAt(field_.x + edge.column, field_.y + edge.row);
    // Views on the side of the picture's edge show how surfaces of positive disparity continue.
    // Views on the opposite side show how other surfaces continue.
    const OcclusionView& behind =
        input_.occlusion_views.on[disparity < 0 ? edge.side ^ 1 : edge.side][0];
    if (behind.view == 0) return;
    const int32_t moved_x = Moved(behind.at.u, disparity), moved_y = Moved(behind.at.v, disparity);
    const int32_t along = edge.out()[0] != 0 ? moved_x : moved_y;
    int32_t seen = Min(edge.beyond, Abs(along) >> kShiftBits);
    if (disparity < 0 && seen > 0) seen = Uncovered(edge, behind, disparity, seen);
    if (seen == 0) return;
    Read(edge, behind.view, moved_x, moved_y, seen);
    RepeatLast(edge, seen);
  }

  // Returns the displacement of a surface along an axis between the centre view and a view at
  // `position`, in pixels of the layer, kShiftBits.
  int32_t Moved(int32_t position, int32_t disparity) const {
    return ScaledByView(position, disparity,
                        kViewBits + kDisparityBits - kShiftBits + field_.layer);
  }

  // Returns how many of the `seen` pixels beyond the edge precede the first covered pixel. A pixel
  // is covered if the captured view shows a nearer pixel of the picture less than 3/4 of a pixel
  // away. Surfaces of positive disparity are never covered, because the view that shows them moves
  // nearer surfaces farther away.
  int32_t Uncovered(const EdgePixel& edge, const OcclusionView& behind, int32_t disparity,
                    int32_t seen) const {
    const int layer = field_.layer;
    const int32_t unit = int32_t{1} << (kDisparityBits + layer);
    const int8_t* const out = edge.out();
    const int32_t position = out[0] != 0 ? Abs(behind.at.u) : Abs(behind.at.v);
    const int32_t room = Min(kSearchBack >> layer, out[0] != 0 ? layer_width_ : layer_height_);
    int32_t x = field_.x + edge.column, y = field_.y + edge.row;
    for (int32_t m = 0; m < room; ++m, x -= out[0], y -= out[1]) {
      const int32_t nearer = ScaledByView(position, DisparityAt(x, y) - disparity, kViewBits);
      // Distance beyond the edge at which the view shows the nearer pixel, in quarters of `unit`.
      const int32_t place = 4 * (nearer - m * unit);
      if (place <= unit || 2 * nearer <= unit) continue;
      const int32_t first = place > 3 * unit ? (place - 3 * unit) / (4 * unit) + 1 : 1;
      if (4 * unit * first < place + 3 * unit) seen = Min(seen, first - 1);
    }
    return seen;
  }

  // Reads the first `seen` pixels beyond the edge from a captured view, in which their surface is
  // displaced by (moved_x, moved_y), kShiftBits.
  void Read(const EdgePixel& edge, int view, int32_t moved_x, int32_t moved_y, int32_t seen) {
    const int dx = edge.out()[0], dy = edge.out()[1];
    constexpr int32_t kAtOnce = 16;
    int16_t rgb[3 * kAtOnce];
    for (int32_t first = 1; first <= seen; first += kAtOnce) {
      const int32_t count = Min(kAtOnce, seen + 1 - first);
      const int32_t x = (field_.x + edge.column + first * dx) * kShiftOne - moved_x;
      const int32_t y = (field_.y + edge.row + first * dy) * kShiftOne - moved_y;
      ReadCaptured(input_, field_.layer, view, {x, y, dx, dy}, count, rgb);
      for (int32_t k = 0; k < count; ++k) std::memcpy(Rgb(edge, first + k), rgb + 3 * k, kBytes);
    }
  }

  // Copies the colour of pixel `last` beyond the edge to all pixels farther outside.
  void RepeatLast(const EdgePixel& edge, int32_t last) {
    for (int32_t k = last + 1; k <= edge.beyond; ++k) {
      std::memcpy(Rgb(edge, k), Rgb(edge, last), kBytes);
    }
  }

  // Returns a pointer to the k-th pixel beyond an edge.
  int16_t* Rgb(const EdgePixel& edge, int32_t k) const {
    return field_.Rgb(edge.column + k * edge.out()[0], edge.row + k * edge.out()[1]);
  }

  static constexpr size_t kBytes = 3 * sizeof(int16_t);  // bytes of one pixel

  const Input& input_;
  const BlockPixels& field_;
  const int32_t layer_width_, layer_height_;  // size of the picture in pixels of the layer
};

// Fills the pixels outside [first, last) of a row with the nearest pixel inside. The range must not
// be empty.
void RepeatEdges(int32_t first, int32_t last, int32_t width, int16_t* rgb, int16_t* disparity) {
  for (int32_t column = 0; column < first; ++column) {
    std::memcpy(rgb + 3 * column, rgb + 3 * first, 3 * sizeof(*rgb));
    disparity[column] = disparity[first];
  }
  for (int32_t column = last; column < width; ++column) {
    std::memcpy(rgb + 3 * column, rgb + 3 * (last - 1), 3 * sizeof(*rgb));
    disparity[column] = disparity[last - 1];
  }
}

// Copies every 2^kLayer-th value. The inner loop has a fixed length, so that the compiler can
// unroll the loop.
template <int kLayer>
void CopyEvery(const int16_t* from, int32_t count, int16_t* to) {
  constexpr int32_t kGroup = 8;
  int32_t n = 0;
  for (; n + kGroup <= count; n += kGroup, from += kGroup << kLayer, to += kGroup) {
    for (int32_t k = 0; k < kGroup; ++k) to[k] = from[k << kLayer];
  }
  for (int32_t k = 0; n + k < count; ++k) to[k] = from[k << kLayer];
}

// Copies the disparities of `count` pixels of the layer from column x on. The last column of a
// layer may lie outside the picture.
void CopyDisparity(const Input& input, int layer, const int16_t* row, int32_t x, int32_t count,
                   int16_t* disparity) {
  const int32_t column = x * (1 << layer), last = input.width - 1;
  const int32_t inside = Clamp((last >> layer) + 1 - x, 0, count);
  if (layer == 0) {
    std::memcpy(disparity, row + x, sizeof(*disparity) * static_cast<size_t>(inside));
  } else if (layer == 1) {
    CopyEvery<1>(row + column, inside, disparity);
  } else {
    CopyEvery<2>(row + column, inside, disparity);
  }
  for (int32_t k = inside; k < count; ++k) disparity[k] = row[last];
}

}  // namespace

void LoadLight(const Input& input, int layer, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  if (layer == 0) {
    if (count > 0) input.Light(0, x, y, count, rgb);
    return;
  }
  const int16_t* from = input.layers[layer].Row(y) + 3 * x;
  for (int32_t k = 0; k < 3 * count; ++k) {
    rgb[k] = static_cast<int16_t>(from[k] << (kLightBits - simd::kLayerBits));
  }
}

void LoadBlock(const Input& input, int layer, const Rect& rect, const Border& border,
               BlockPixels* field) {
  field->transposed = false;
  field->layer = layer;
  field->width = border.left + rect.width + border.right;
  field->height = border.top + rect.height + border.bottom;
  field->x = rect.x - border.left;
  field->y = rect.y - border.top;
  field->inner = {border.left, border.top, rect.width, rect.height};
  const int32_t first = Clamp(-field->x, 0, field->width);
  const int32_t last = Clamp(input.Width(layer) - field->x, 0, field->width);  // exclusive
  const int32_t bottom = input.Height(layer) - 1;
  for (int32_t row = 0; row < field->height; ++row) {
    const int32_t y = Clamp(field->y + row, 0, bottom);
    int16_t* rgb = field->Rgb(0, row);
    int16_t* disparity = field->Disparity(0, row);
    const int16_t* from_disparity = input.disparity.Row(Min(y << layer, input.height - 1));
    LoadLight(input, layer, field->x + first, y, last - first, rgb + 3 * first);
    CopyDisparity(input, layer, from_disparity, field->x + first, last - first, disparity + first);
    RepeatEdges(first, last, field->width, rgb, disparity);
  }
  if (input.views > 1) Beyond(input, *field).Read();
}

}  // namespace starfocus
