#include "lib/surfaces.h"

#include <cstring>
#include <initializer_list>

#include "lib/fixed.h"

namespace starfocus {
namespace {

// No surface: also behind a row's end, since kernels look at whole vectors.
void Clear(int16_t* disparity, int32_t count) {
  for (int32_t k = 0; k < count; ++k) disparity[k] = kNoSurface;
}

// What one side shows behind a pixel.
struct Candidate {
  int32_t rank = INT32_MAX;  // the nearer edge first, and those that a captured view sees
  int32_t distance = 0;      // to the edge's far side
  int16_t disparity = kNoSurface;
  bool seen = false, half = false;

  bool Before(const Candidate& other) const {
    return rank != other.rank ? rank < other.rank : disparity > other.disparity;
  }
};
constexpr int32_t kUnseen = 256;  // added to the rank

// Whether there is a step of more than `step` between some of kAtOnce + 1 pixels. Most have none.
// Compilers make vectors of the loop on its own only.
constexpr int32_t kAtOnce = 16;
[[gnu::noinline]] bool AnyEdge(const int16_t* row, int16_t step) {
  int16_t any = 0;
  for (int32_t k = 0; k < kAtOnce; ++k) {
    const auto up = static_cast<int16_t>(row[k] + step);
    const auto down = static_cast<int16_t>(row[k + 1] + step);
    any |= static_cast<int16_t>(row[k + 1] > up || row[k] > down ? -1 : 0);
  }
  return any != 0;
}

constexpr int32_t kBytes = 8;
uint64_t Bytes(const uint8_t* at) {
  uint64_t bytes;
  std::memcpy(&bytes, at, kBytes);
  return bytes;
}

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
  int16_t Disparity(int32_t x, int32_t y) const {
    return surfaces_.disparity[0][surfaces_.At(x, y)];
  }

  void FindRange() {
    int16_t low = Disparity(0, 0), high = low;
    for (int32_t y = 0; y < surfaces_.height; ++y) {
      const int16_t* row = surfaces_.disparity[0] + surfaces_.At(0, y);
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
    for (int32_t from = 0; from < steps; from += kAtOnce) {
      const int32_t end = Min(from + kAtOnce, steps), tested = Max(end - kAtOnce, 0);
      if (steps >= kAtOnce && !AnyEdge(row + tested, static_cast<int16_t>(step_))) continue;
      for (int32_t x = from; x < end; ++x) {
        if (row[x] - row[x + 1] > step_) FollowEdge(row + x, -1, x + 1, Edges(0, y) + x);
        if (row[x + 1] - row[x] > step_) FollowEdge(row + x + 1, 1, steps - x, Edges(1, y) + x + 1);
      }
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
    for (int behind = 1; behind < simd::kSurfaces; ++behind) {
      Clear(surfaces_.disparity[behind] + at, surfaces_.stride);
    }
    surfaces_.hiding[y] = 0;
    const uint8_t* const* edges = surfaces_.edges;
    for (int32_t from = 0; from < surfaces_.width; from += kBytes) {
      const size_t k = at + static_cast<size_t>(from);
      if ((Bytes(edges[0] + k) | Bytes(edges[1] + k) | Bytes(edges[2] + k) | Bytes(edges[3] + k)) ==
          0) {
        continue;
      }
      for (int32_t x = from; x < Min(from + kBytes, surfaces_.width); ++x) FindPixel(x, y);
    }
  }

  void FindPixel(int32_t x, int32_t y) {
    const size_t at = surfaces_.At(x, y);
    const uint8_t* const* edges = surfaces_.edges;
    if ((edges[0][at] | edges[1][at] | edges[2][at] | edges[3][at]) == 0) return;
    const bool end =
        edges[0][at] == 1 || edges[1][at] == 1 || edges[2][at] == 1 || edges[3][at] == 1;
    if (end) surfaces_.share[at] = simd::kSliceEnd;
    Candidate candidates[4];
    for (int side = 0; side < 4; ++side) candidates[side] = LookBehind(x, y, side);
    int32_t above = INT32_MAX;  // disparities farther than this make another surface
    for (int behind = 1; behind < simd::kSurfaces; ++behind) {
      const Candidate* best = nullptr;
      for (const Candidate& candidate : candidates) {
        if (candidate.rank == INT32_MAX) continue;
        if (above != INT32_MAX && Abs(candidate.disparity - above) <= unit_) continue;
        if (best == nullptr || candidate.Before(*best)) best = &candidate;
      }
      if (best == nullptr) return;
      above = best->disparity;
      SetSurface(x, y, behind, *best, candidates);
    }
  }

  Candidate LookBehind(int32_t x, int32_t y, int side) const {
    Candidate candidate;
    const int32_t distance = Edges(side, y)[x];
    if (distance == 0) return candidate;
    candidate.distance = distance;
    candidate.disparity = Disparity(x + kSides[side][0] * distance, y + kSides[side][1] * distance);
    candidate.rank = distance + kUnseen;
    for (const bool half : {false, true}) {
      if (window_.views == 1 || (half && window_.views != 17)) break;
      if (IsCovered(x, y, side, candidate.disparity, half)) continue;
      candidate.seen = true;
      candidate.half = half;
      candidate.rank = distance;
      break;
    }
    return candidate;
  }

  // Whether some pixel of the line lies before the place behind (x, y) in the captured view towards
  // the side.
  bool IsCovered(int32_t x, int32_t y, int side, int32_t disparity, bool half) const {
    const int32_t unit = half ? 2 * unit_ : unit_;
    const int32_t room = side == 0   ? surfaces_.width - 1 - x
                         : side == 1 ? x
                         : side == 2 ? surfaces_.height - 1 - y
                                     : y;
    const int32_t last = Min(room, (surfaces_.high - disparity) / unit + 1);
    const ptrdiff_t step =
        kSides[side][0] + kSides[side][1] * static_cast<ptrdiff_t>(surfaces_.stride);
    const int16_t* at = surfaces_.disparity[0] + surfaces_.At(x, y);
    for (int32_t u = 0, moved = 0; u <= last; ++u, moved += unit, at += step) {
      const int32_t nearer = *at - disparity;
      if (2 * nearer > unit && 4 * Abs(nearer - moved) < 3 * unit) return true;
    }
    return false;
  }

  void SetSurface(int32_t x, int32_t y, int behind, const Candidate& best,
                  const Candidate* candidates) {
    int32_t sums[3] = {0, 0, 0}, count = 0;
    for (int side = 0; side < 4; ++side) {
      const Candidate& candidate = candidates[side];
      if (candidate.rank != best.rank || candidate.disparity != best.disparity) continue;
      uint8_t rgb[3];
      Read(x, y, side, candidate, rgb);
      for (int c = 0; c < 3; ++c) sums[c] += rgb[c];
      ++count;
    }
    const size_t at = surfaces_.At(x, y);
    surfaces_.disparity[behind][at] = best.disparity;
    surfaces_.hiding[y] = 1;
    for (size_t c = 0; c < 3; ++c) {
      surfaces_.rgb[behind][c * surfaces_.plane + at] =
          static_cast<uint8_t>((sums[c] + count / 2) / count);
    }
  }

  void Read(int32_t x, int32_t y, int side, const Candidate& candidate, uint8_t* rgb) const {
    const int dx = kSides[side][0], dy = kSides[side][1];
    if (!candidate.seen) {
      std::memcpy(rgb, field_.Rgb(x + dx * candidate.distance, y + dy * candidate.distance), 3);
      return;
    }
    if (window_.reads != nullptr) ++window_.reads->side_colours;
    const int64_t full = int64_t{candidate.disparity} * (1 << (kShiftBits - kDisparityBits));
    const auto moved =
        static_cast<int32_t>(RoundShift(full * 2, 1 + window_.layer + (candidate.half ? 1 : 0)));
    const CapturedLine place = {(field_.x + x) * kShiftOne - dx * moved,
                                (field_.y + y) * kShiftOne - dy * moved, 1, 0};
    ReadCaptured(window_, CapturedView(dx, dy, candidate.half), place, 1, rgb);
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
  std::memset(surfaces->share, simd::kSliceWhole, surfaces->plane + simd::kSliceLanes);
  SurfaceFinder(kernels, window, field, surfaces).Find();
}

}  // namespace starfocus
