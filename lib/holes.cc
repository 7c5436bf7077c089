#include "lib/holes.h"

#include <cstring>

namespace starfocus {
namespace {

int32_t RoundPixel(int64_t shift) { return static_cast<int32_t>(RoundShift(shift, kShiftBits)); }

// Disparity times the distance of the captured view, kShiftBits, in pixels of the layer.
int64_t CapturedShift(const ViewGrid& grid, int32_t disparity, bool half) {
  const int64_t full = int64_t{disparity} * (1 << (kShiftBits - kDisparityBits));
  return RoundShift(full * 2, 1 + grid.layer + (half ? 1 : 0));
}

// Reads captured view (u, v) at the oriented position (x, y) of the layer.
void Read(const CapturedLine& line, int u, int v, int32_t x, int32_t y, uint8_t* rgb) {
  if (line.transposed) {
    ReadCaptured(*line.window, CapturedView(v, u, line.half), y, x, rgb);
  } else {
    ReadCaptured(*line.window, CapturedView(u, v, line.half), x, y, rgb);
  }
}

int32_t Difference(const uint8_t* a, const uint8_t* b) {
  return Abs(a[0] - b[0]) + Abs(a[1] - b[1]) + Abs(a[2] - b[2]);
}

// The diagonal view is missing: of the two views beside it, the one whose pixel looks more like
// the background; their mean when both do equally, so that transposing the picture transposes the
// result.
void ChooseNeighbour(const uint8_t* a, const uint8_t* b, const uint8_t* colour, uint8_t* out) {
  const int32_t order = Difference(a, colour) - Difference(b, colour);
  if (order != 0) {
    std::memcpy(out, order < 0 ? a : b, 3);
    return;
  }
  for (int c = 0; c < 3; ++c) out[c] = static_cast<uint8_t>((a[c] + b[c] + 1) >> 1);
}

}  // namespace

void FillHole(const CapturedLine& line, const ViewGrid& grid, int32_t begin, int32_t end,
              int32_t disparity, int32_t shift, const uint8_t* colour, uint8_t* out) {
  if (line.window->views == 1) {
    for (int32_t p = begin; p < end; ++p, out += 3) std::memcpy(out, colour, 3);
    return;
  }
  const int u = line.sign * line.dx, v = line.sign * line.dy;
  const int64_t captured_shift = CapturedShift(grid, disparity, line.half);
  const int32_t captured = line.sign * RoundPixel(shift - captured_shift);
  const bool interpolate = line.dy != 0 && line.window->views == 5;
  const int32_t centre = line.sign * RoundPixel(shift);
  for (int32_t p = begin; p < end; ++p, out += 3) {
    const int32_t moved = p + captured;
    const int32_t x = line.x + line.dx * moved, y = line.y + line.dy * moved;
    if (!interpolate) {
      Read(line, u, v, x, y, out);
      continue;
    }
    const int32_t still = p + centre;
    uint8_t horizontal[3], vertical[3];
    Read(line, u, 0, x, line.y + line.dy * still, horizontal);
    Read(line, 0, v, line.x + line.dx * still, y, vertical);
    ChooseNeighbour(horizontal, vertical, colour, out);
  }
}

}  // namespace starfocus
