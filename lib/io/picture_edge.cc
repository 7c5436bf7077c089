// SPDX-License-Identifier: Apache-2.0
#include "lib/io/picture_edge.h"

#include <cstring>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// Part of a rectangle of the layer that lies inside the picture, in pixels from the upper left
// corner of the rectangle. `right` and `bottom` are exclusive.
struct InsidePart {
  int32_t left, right, top, bottom;

  InsidePart(const Window& window, const Rect& rect)
      : left(Clamp(-rect.x, 0, rect.width)),
        right(Clamp(Inside(window.picture_width, window.layer) - rect.x, 0, rect.width)),
        top(Clamp(-rect.y, 0, rect.height)),
        bottom(Clamp(Inside(window.picture_height, window.layer) - rect.y, 0, rect.height)) {}

  // Returns the number of pixels of the layer for `size` pixels of the picture. A stored layer has
  // more pixels (LayerSize).
  static int32_t Inside(int32_t size, int layer) { return (size + (1 << layer) - 1) >> layer; }
};

// A pixel of a rectangle that lies at an edge of the picture, and the number of pixels of the
// rectangle beyond this edge.
struct EdgePixel {
  int32_t column, row;
  int side;  // index into kSides
  int32_t beyond;

  const int8_t* out() const { return kSides[side]; }
};

// Position or displacement in x and y, kShiftBits.
struct ShiftedPlace {
  int32_t x, y;
};

// Fills the pixels of a field beyond the edges of the picture.
class Beyond {
 public:
  Beyond(const Window& window, BlockPixels* field)
      : window_(window), field_(*field), rect_{field->x, field->y, field->width, field->height} {}

  void Look() {
    const int32_t width = rect_.width, height = rect_.height;
    const InsidePart part(window_, rect_);
    const bool inside = part.right - part.left == width && part.bottom - part.top == height;
    if (inside) return;  // most fields lie inside the picture
    for (int32_t row = part.top; row < part.bottom; ++row) {
      LookOver({part.right - 1, row, 0, width - part.right});
      LookOver({part.left, row, 1, part.left});
    }
    for (int32_t column = part.left; column < part.right; ++column) {
      LookOver({column, part.bottom - 1, 2, height - part.bottom});
      LookOver({column, part.top, 3, part.top});
    }
  }

 private:
  int32_t DisparityAt(int32_t x, int32_t y) const {
    return window_.disparity.Row(y << window_.layer)[x << window_.layer];
  }

  void LookOver(const EdgePixel& edge) {
    if (edge.beyond == 0) return;
    const int32_t disparity = DisparityAt(rect_.x + edge.column, rect_.y + edge.row);
    // Views on the side of the picture's edge show how surfaces of positive disparity continue.
    // Views on the opposite side show how other surfaces continue.
    const OcclusionView& look =
        window_.occlusion_views.on[disparity < 0 ? edge.side ^ 1 : edge.side][0];
    if (look.view == 0) return;
    const ShiftedPlace moved = {Moved(look.at.u, disparity), Moved(look.at.v, disparity)};
    const int32_t along = edge.out()[0] != 0 ? moved.x : moved.y;
    int32_t seen = Min(edge.beyond, Abs(along) >> kShiftBits);
    if (disparity < 0 && seen > 0) seen = Uncovered(edge, look, disparity, seen);
    if (seen == 0) return;
    Read(edge, look, moved, seen);
    RepeatLast(edge, seen);
  }

  // Returns the displacement of a surface along an axis between the centre view and a view at
  // `position`, in pixels of the layer, kShiftBits.
  int32_t Moved(int32_t position, int32_t disparity) const {
    return ScaledByView(position, disparity,
                        kViewBits + kDisparityBits - kShiftBits + window_.layer);
  }

  // Returns how many of the `seen` pixels beyond the edge precede the first covered pixel. A pixel
  // is covered if the captured view shows a nearer pixel of the picture less than 3/4 of a pixel
  // away. Surfaces of positive disparity are never covered, because the view that shows them moves
  // nearer surfaces farther away.
  int32_t Uncovered(const EdgePixel& edge, const OcclusionView& look, int32_t disparity,
                    int32_t seen) const {
    const int layer = window_.layer;
    const int32_t unit = int32_t{1} << (kDisparityBits + layer);
    const int32_t width = InsidePart::Inside(window_.picture_width, layer);
    const int32_t height = InsidePart::Inside(window_.picture_height, layer);
    const int8_t* const out = edge.out();
    const int32_t position = out[0] != 0 ? Abs(look.at.u) : Abs(look.at.v);
    const int32_t room = Min(kLookBack >> layer, out[0] != 0 ? width : height);
    int32_t x = rect_.x + edge.column, y = rect_.y + edge.row;
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

  void Read(const EdgePixel& edge, const OcclusionView& look, const ShiftedPlace& moved,
            int32_t seen) {
    const int dx = edge.out()[0], dy = edge.out()[1];
    constexpr int32_t kAtOnce = 16;
    int16_t rgb[3 * kAtOnce];
    for (int32_t first = 1; first <= seen; first += kAtOnce) {
      const int32_t count = Min(kAtOnce, seen + 1 - first);
      const int32_t x = (rect_.x + edge.column + first * dx) * kShiftOne - moved.x;
      const int32_t y = (rect_.y + edge.row + first * dy) * kShiftOne - moved.y;
      ReadCaptured(window_, look.view, {x, y, dx, dy}, count, rgb);
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

  const Window& window_;
  const BlockPixels& field_;
  const Rect rect_;
};

}  // namespace

void ExtendEdges(const Window& window, BlockPixels* field) {
  if (window.views > 1) Beyond(window, field).Look();
}

}  // namespace starfocus
