// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/reference_fill.h"

#include <algorithm>
#include <cstdlib>

namespace reference {
namespace {

Surface& FarthestOf(std::vector<Surface>* surfaces) {
  Surface* farthest = &surfaces->front();
  for (Surface& surface : *surfaces) {
    if (surface.disparity < farthest->disparity) farthest = &surface;
  }
  return *farthest;
}

class Filler {
 public:
  Filler(int unit, SurfaceMap* map) : unit_(unit), map_(*map) {
    for (std::vector<Surface>& surfaces : map_.pixels) far_.push_back(&FarthestOf(&surfaces));
  }

  void TakeSources() {
    for (int y = 0; y < map_.height; ++y) {
      for (int x = 0; x < map_.width; ++x) TakeSource(x, y);
    }
  }

  // Each smoothing step computes all pixels from the colours before the step.
  void Smooth(int step) {
    std::vector<Colour> before;
    for (const Surface* far : far_) before.push_back(far->colour);
    for (int y = 0; y < map_.height; ++y) {
      for (int x = 0; x < map_.width; ++x) {
        if (2 * Far(x, y).repeated >= step) Far(x, y).colour = Mean(before, x, y, step);
      }
    }
  }

  // Limits colours that differ much from both neighbours across the direction of their source.
  void Limit() {
    std::vector<Colour> before;
    for (const Surface* far : far_) before.push_back(far->colour);
    for (int y = 0; y < map_.height; ++y) {
      for (int x = 0; x < map_.width; ++x) LimitAt(before, x, y);
    }
  }

 private:
  void LimitAt(const std::vector<Colour>& before, int x, int y) {
    Surface& here = Far(x, y);
    bool along = false, down = false;  // true if a source lies on the row or on the column
    for (const Direction& side : here.towards) {
      along = along || side.x != 0;
      down = down || side.y != 0;
    }
    if (here.repeated == 0 || along == down) return;
    const Colour* beside[2];
    for (int k = 0; k < 2; ++k) {
      const int step = 2 * k - 1, column = x + (down ? step : 0), row = y + (along ? step : 0);
      if (column < 0 || column >= map_.width) return;
      const bool inside = row >= 0 && row < map_.height;
      if (inside && std::abs(Far(column, row).disparity - here.disparity) > unit_) return;
      beside[k] = &before[inside ? At(column, row) : At(x, y)];
    }
    for (size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax((*beside[0])[c], (*beside[1])[c]);
      const double more = high - low + 4;  // codes of light
      here.colour[c] = std::clamp(here.colour[c], low - more, high + more);
    }
  }

  size_t At(int x, int y) const { return size_t(y) * size_t(map_.width) + size_t(x); }
  Surface& Far(int x, int y) const { return *far_[At(x, y)]; }

  void TakeSource(int x, int y) const {
    Surface& here = Far(x, y);
    if (here.repeated == 0) return;
    Colour sum = {0, 0, 0};
    for (const Direction& side : here.towards) {
      const Surface& source = Far(x + here.repeated * side.x, y + here.repeated * side.y);
      if (source.repeated != 0 || source.disparity != here.disparity) return;
      for (size_t c = 0; c < 3; ++c) sum[c] += source.colour[c] / double(here.towards.size());
    }
    here.colour = sum;
  }

  Colour Mean(const std::vector<Colour>& before, int x, int y, int step) const {
    const Colour& here = before[At(x, y)];
    Colour mean;
    for (size_t c = 0; c < 3; ++c) mean[c] = here[c] / 2;
    for (const Direction& side : kDirections) {
      const int column = x + step * side.x, row = y + step * side.y;
      const bool inside = column >= 0 && column < map_.width && row >= 0 && row < map_.height;
      const bool same =
          inside && std::abs(Far(column, row).disparity - Far(x, y).disparity) <= unit_;
      const Colour& next = same ? before[At(column, row)] : here;
      for (size_t c = 0; c < 3; ++c) mean[c] += next[c] / 8;
    }
    return mean;
  }

  const int unit_;
  SurfaceMap& map_;
  std::vector<Surface*> far_;
};

}  // namespace

void InpaintHidden(int unit, SurfaceMap* map) {
  Filler filler(unit, map);
  filler.TakeSources();
  for (int step = 16; step > 0; step /= 2) filler.Smooth(step);
  filler.Limit();
}

}  // namespace reference
