#include "lib/surfaces.h"

#include <cstring>

#include "lib/fixed.h"

namespace starfocus {
namespace {

// No surface: also behind a row's end, since kernels look at whole vectors.
void Clear(int16_t* disparity, int32_t count) {
  for (int32_t k = 0; k < count; ++k) disparity[k] = kNoSurface;
}

constexpr int32_t kChunk = static_cast<int32_t>(simd::kSliceLanes);

class SurfaceFinder {
 public:
  SurfaceFinder(const simd::Kernels& kernels, const Window& window, const Field& field,
                Surfaces* surfaces)
      : kernels_(kernels),
        window_(window),
        field_(field),
        surfaces_(*surfaces),
        unit_(int32_t{1} << (kDisparityBits + window.layer)),
        step_(kDepthEdge << window.layer) {}

  void Find() {
    const int32_t height = surfaces_.height;
    FindRange();
    for (int32_t y = 0; y < height; ++y) FindEdgesOfRow(y);
    StartColumns(height - 1, 2);
    for (int32_t y = height - 2; y >= 0; --y) FindEdgesOfColumns(y, y + 1, 2);
    StartColumns(0, 3);
    for (int32_t y = 1; y < height; ++y) FindEdgesOfColumns(y, y - 1, 3);
    for (int32_t y = 0; y < height; ++y) FindRow(y);
  }

 private:
  void FindRange() {
    int16_t low = *Row(0), high = low;
    for (int32_t y = 0; y < surfaces_.height; ++y) {
      const int16_t* row = Row(y);
      for (int32_t x = 0; x < surfaces_.width; ++x) {
        low = row[x] < low ? row[x] : low;
        high = row[x] > high ? row[x] : high;
      }
    }
    surfaces_.low = low;
    surfaces_.high = high;
  }

  uint8_t* Edges(int side, int32_t y) const { return surfaces_.edges[side] + surfaces_.At(0, y); }
  const int16_t* Row(int32_t y) const { return surfaces_.disparity[0] + surfaces_.At(0, y); }

  // As find_edges along a row, but from edge to edge: there are few.
  void FindEdgesOfRow(int32_t y) {
    const auto stride = static_cast<size_t>(surfaces_.stride);
    std::memset(Edges(0, y), 0, stride);
    std::memset(Edges(1, y), 0, stride);
    const int16_t* row = Row(y);
    const int32_t steps = surfaces_.width - 1;
    kernels_.find_steps(row, static_cast<size_t>(steps), static_cast<int16_t>(step_),
                        surfaces_.steps);
    for (int32_t from = 0; from < steps; from += kChunk) {
      const simd::StepBits& bits = surfaces_.steps[from / kChunk];
      ForEachBit(bits.falls, [&](int32_t k) {
        const int32_t x = from + k;
        FollowEdge(row + x, -1, x + 1, Edges(0, y) + x);
      });
      ForEachBit(bits.rises, [&](int32_t k) {
        const int32_t x = from + k + 1;
        FollowEdge(row + x, 1, steps + 1 - x, Edges(1, y) + x);
      });
    }
  }

  // Writes the distances of the edge's near pixel, at `near`, and of up to `count` in all that
  // follow, away from the edge, as far as the next one.
  void FollowEdge(const int16_t* near, int direction, int32_t count, uint8_t* distance) const {
    const int32_t far = near[-direction];
    const int32_t farthest =
        Min(simd::FarthestEdge(kDisparityBits + window_.layer), surfaces_.high - far);
    for (int32_t k = 1, moved = 0; k <= count && moved <= farthest; ++k, moved += unit_) {
      const int32_t depth = *near - far;
      if (depth > step_ && moved <= depth) *distance = static_cast<uint8_t>(k);
      if (k < count && near[direction] - *near > step_) return;
      near += direction;
      distance += direction;
    }
  }

  void StartColumns(int32_t y, int side) {
    std::memset(Edges(side, y), 0, static_cast<size_t>(surfaces_.stride));
    for (int32_t x = 0; x < surfaces_.stride; ++x) {
      surfaces_.moved[x] = INT16_MAX;
      surfaces_.behind[x] = 0;
    }
  }

  void FindEdgesOfColumns(int32_t y, int32_t beside, int side) {
    const simd::EdgeLimits limits = {static_cast<int16_t>(step_), kDisparityBits + window_.layer};
    kernels_.find_edges(Row(y), Row(beside), limits, static_cast<size_t>(surfaces_.width),
                        surfaces_.moved, surfaces_.behind, Edges(side, y));
  }

  void FindRow(int32_t y) {
    const size_t at = surfaces_.At(0, y);
    simd::DepthRow row = {};
    row.disparity = Row(y);
    row.stride = surfaces_.stride;
    row.width = surfaces_.width;
    row.above = y;
    row.below = surfaces_.height - 1 - y;
    row.high = surfaces_.high;
    row.unit_bits = kDisparityBits + window_.layer;
    row.side_views = window_.views > 1;
    row.half_views = window_.views == 17;
    for (int side = 0; side < 4; ++side) row.edges[side] = Edges(side, y);
    const simd::HiddenRow hidden = {{surfaces_.disparity[1] + at, surfaces_.disparity[2] + at},
                                    {surfaces_.sources[0], surfaces_.sources[1]},
                                    surfaces_.share + at};
    const uint64_t chunks = kernels_.look_behind(row, hidden);
    surfaces_.hiding[y] = chunks != 0;
    for (int behind = 1; behind < simd::kSurfaces; ++behind) {
      int32_t from = 0;
      for (uint64_t rest = chunks; rest != 0; rest >>= 1, from += kChunk) {
        if ((rest & 1) != 0) SetColours(from, Min(from + kChunk, surfaces_.width), y, behind);
      }
    }
  }

  // Of the pixels first ... end - 1 of a row. Behind one edge many are read one after the other.
  void SetColours(int32_t first, int32_t end, int32_t y, int behind) {
    const uint16_t* sources = surfaces_.sources[behind - 1];
    const int16_t* disparity = surfaces_.disparity[behind] + surfaces_.At(0, y);
    uint8_t* const rgb = surfaces_.rgb[behind] + surfaces_.At(0, y);
    for (int32_t x = first; x < end;) {
      const uint32_t source = sources[x];
      if (source == 0) {
        ++x;
        continue;
      }
      int32_t count = 1;
      uint8_t shown[3 * kChunk];
      const uint32_t sides = source & 15;
      if ((sides & (sides - 1)) == 0 && source >> simd::kSourceDistance == 0) {
        while (x + count < end && sources[x + count] == source &&
               disparity[x + count] == disparity[x]) {
          ++count;
        }
        Read({x, y, LowestBit(sides), count}, disparity[x], source, shown);
      } else {
        ReadMean(x, y, disparity[x], source, shown);
      }
      for (const uint8_t* from = shown; count > 0; --count, ++x, from += 3) {
        for (size_t c = 0; c < 3; ++c) rgb[c * surfaces_.plane + static_cast<size_t>(x)] = from[c];
      }
    }
  }

  // The mean of all sides.
  void ReadMean(int32_t x, int32_t y, int16_t disparity, uint32_t source, uint8_t* rgb) const {
    int32_t sums[3] = {0, 0, 0}, count = 0;
    ForEachBit(source & 15, [&](int32_t side) {
      uint8_t shown[3];
      Read({x, y, side, 1}, disparity, source, shown);
      for (int c = 0; c < 3; ++c) sums[c] += shown[c];
      ++count;
    });
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<uint8_t>((sums[c] + count / 2) / count);
  }

  // Pixels of a row, one after the other, of which the same side shows what is behind.
  struct Stretch {
    int32_t x, y, side, count;
  };

  // `source` as look_behind gives it; of one pixel where no view shows it.
  void Read(const Stretch& at, int16_t disparity, uint32_t source, uint8_t* rgb) const {
    const int dx = kSides[at.side][0], dy = kSides[at.side][1];
    const auto distance = static_cast<int32_t>(source >> simd::kSourceDistance);
    if (distance != 0) {
      std::memcpy(rgb, field_.Rgb(at.x + dx * distance, at.y + dy * distance), 3);
      return;
    }
    if (window_.reads != nullptr) window_.reads->side_colours += static_cast<uint64_t>(at.count);
    const bool half = (source >> (simd::kSourceHalf + at.side) & 1) != 0;
    const int64_t full = int64_t{disparity} * (1 << (kShiftBits - kDisparityBits));
    const auto moved =
        static_cast<int32_t>(RoundShift(full * 2, 1 + window_.layer + (half ? 1 : 0)));
    const CapturedLine line = {(field_.x + at.x) * kShiftOne - dx * moved,
                               (field_.y + at.y) * kShiftOne - dy * moved, 1, 0};
    ReadCaptured(window_, CapturedView(dx, dy, half), line, at.count, rgb);
  }

  const simd::Kernels& kernels_;
  const Window& window_;
  const Field& field_;
  Surfaces& surfaces_;
  const int32_t unit_;  // disparity that a pixel of the layer is at distance 1
  const int32_t step_;  // a larger one from pixel to pixel may hide something
};

}  // namespace

void FindSurfaces(const simd::Kernels& kernels, const Window& window, const Field& field,
                  Surfaces* surfaces) {
  surfaces->width = field.width;
  surfaces->height = field.height;
  surfaces->stride = static_cast<int32_t>(simd::SliceSamples(static_cast<size_t>(field.width)));
  surfaces->plane = static_cast<size_t>(surfaces->stride) * static_cast<size_t>(surfaces->height);
  for (int32_t y = 0; y < field.height; ++y) {
    const size_t at = surfaces->At(0, y);
    std::memcpy(surfaces->disparity[0] + at, field.Disparity(0, y),
                static_cast<size_t>(field.width) * sizeof(int16_t));
    Clear(surfaces->disparity[0] + at + field.width, surfaces->stride - field.width);
    kernels.split(field.Rgb(0, y), static_cast<size_t>(field.width), surfaces->plane,
                  surfaces->rgb[0] + at);
  }
  for (int16_t* disparity : surfaces->disparity) {
    Clear(disparity + surfaces->plane, static_cast<int32_t>(simd::kSliceLanes));
  }
  std::memset(surfaces->share + surfaces->plane, simd::kSliceWhole, simd::kSliceLanes);
  SurfaceFinder(kernels, window, field, surfaces).Find();
}

}  // namespace starfocus
