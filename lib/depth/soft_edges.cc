// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/soft_edges.h"

#include "lib/optics/view_set.h"

namespace starfocus {
namespace {

// Pixels whose disparities differ by less than kSame belong to one surface.
constexpr int32_t kSame = 2 << kDisparityBits;
// A colour profile across an edge extends from the third pixel of the nearer surface to the seventh
// pixel of the farther surface.
constexpr int32_t kInside = 3, kOutside = 6;
// Smallest squared distance between the colours at both ends of a profile, in grey levels squared.
// Profiles that measure the softness of the picture require at least kLeastContrast. Profiles that
// decide about a single pixel require at least kLeastPixelContrast.
constexpr int32_t kLeastContrast = 60 * 60, kLeastPixelContrast = 30 * 30;
// Reciprocals of the smallest share of the nearer surface in a mixed pixel: kLeastShare for
// measuring edges, and kLeastPixelShare for widening a surface. At half of all sharp ray-traced
// edges, the nearer surface has a share of less than 0.06 in the mixed pixel. At edges of
// photographs, the nearer surface has a share of 0.09 to 0.34.
constexpr int32_t kLeastShare = 14, kLeastPixelShare = 8;

// The first pixel (x, y) of the farther surface, and the direction (dx, dy) away from the nearer
// surface.
struct ProfileEdge {
  int32_t x, y, dx, dy;
};

bool IsProfile(const ColourMap& map, const ProfileEdge& edge) {
  const auto at = [&](int32_t k) {
    return map.disparity[map.At(edge.x + k * edge.dx, edge.y + k * edge.dy)];
  };
  const int32_t near = at(-1), far = at(0);
  if (near - far <= kSoftStep || Abs(at(-kInside) - near) >= kSame) return false;
  for (int32_t k = 1; k <= kOutside; ++k) {
    if (Abs(at(k) - far) >= kSame) return false;
  }
  return true;
}

// Position of a pixel's colour on the line between the colours at the ends of a profile. `contrast`
// is the squared length of the line. share / contrast is the share of the nearer surface.
struct ProfilePlace {
  int32_t share, contrast;
};

// Returns the position of the colour of the pixel that lies k pixels beyond the first pixel of the
// farther surface.
ProfilePlace PlaceAt(const ColourMap& map, const ProfileEdge& edge, int32_t k) {
  const auto pixel = [&](int32_t at) {
    return map.Pixel(edge.x + at * edge.dx, edge.y + at * edge.dy);
  };
  const uint8_t *const near = pixel(-kInside), *const far = pixel(kOutside), *const here = pixel(k);
  ProfilePlace place = {0, 0};
  for (int c = 0; c < 3; ++c) {
    place.contrast += (near[c] - far[c]) * (near[c] - far[c]);
    place.share += (here[c] - far[c]) * (near[c] - far[c]);
  }
  return place;
}

void CountProfile(const ColourMap& map, const ProfileEdge& edge, SoftCount* count) {
  if (PlaceAt(map, edge, 0).contrast < kLeastContrast) return;
  ++count->edges;
  for (int32_t k = 1; k <= kMostSoft; ++k) {
    const ProfilePlace place = PlaceAt(map, edge, k);
    count->mixed[k - 1] += kLeastShare * place.share >= place.contrast ? 1 : 0;
  }
}

bool ShowsNear(const ProfilePlace& place) {
  return place.contrast >= kLeastPixelContrast && kLeastPixelShare * place.share >= place.contrast;
}

// Returns true if profiles in all four directions at pixel (x, y) lie in the picture.
bool IsInside(const ColourMap& map, int32_t x, int32_t y) {
  return x >= kOutside && x < map.plan.width - kOutside && y >= kOutside &&
         y < map.plan.height - kOutside;
}

}  // namespace

void CountSoft(const ColourMap& map, const Rect& rect, SoftCount* count) {
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x) {
      if (!IsInside(map, x, y)) continue;
      for (const auto& side : kSides) {
        const ProfileEdge edge = {x, y, side[0], side[1]};
        if (IsProfile(map, edge)) CountProfile(map, edge, count);
      }
    }
  }
}

int32_t SoftnessOf(const SoftCount* counts, int32_t tiles) {
  int64_t edges = 0, mixed[kMostSoft] = {};
  for (int32_t tile = 0; tile < tiles; ++tile) {
    edges += counts[tile].edges;
    for (int32_t k = 0; k < kMostSoft; ++k) mixed[k] += counts[tile].mixed[k];
  }
  int32_t soft = 0;
  while (soft < kMostSoft && edges > 0 && 2 * mixed[soft] >= edges) ++soft;
  return soft == 0 ? 0 : Min(soft + 1, kMostSoft);
}

int16_t WidenedAt(const ColourMap& map, int32_t softness, int32_t x, int32_t y) {
  const int16_t own = map.disparity[map.At(x, y)];
  int16_t nearest = own;
  for (const auto& side : kSides) {
    for (int32_t k = 0; k < softness; ++k) {
      const ProfileEdge edge = {x - k * side[0], y - k * side[1], side[0], side[1]};
      if (!IsInside(map, edge.x, edge.y)) break;
      const int16_t near = map.disparity[map.At(edge.x - side[0], edge.y - side[1])];
      if (near - own <= kSoftStep) continue;
      if (near > nearest && ShowsNear(PlaceAt(map, edge, k))) nearest = near;
      break;
    }
  }
  return nearest;
}

}  // namespace starfocus
