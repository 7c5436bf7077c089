// SPDX-License-Identifier: Apache-2.0
// Finds the visible and the hidden surfaces of an extended rectangle, in the reference, and fills
// the hidden surfaces that no captured view shows.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "simd/kernels.h"
#include "tests/conformance/reference.h"

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
    ForEachPixel(map_.width, map_.height, [&](int x, int y) { TakeSource(x, y); });
  }

  // Each smoothing step computes all pixels from the colours before the step.
  void Smooth(int step) {
    std::vector<Colour> before;
    for (const Surface* far : far_) before.push_back(far->colour);
    ForEachPixel(map_.width, map_.height, [&](int x, int y) {
      if (2 * Far(x, y).repeated >= step) Far(x, y).colour = Mean(before, x, y, step);
    });
  }

  // Limits colours that differ much from both neighbours across the direction of their source.
  void Limit() {
    std::vector<Colour> before;
    for (const Surface* far : far_) before.push_back(far->colour);
    ForEachPixel(map_.width, map_.height, [&](int x, int y) { LimitAt(before, x, y); });
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

namespace {

// Far side of a depth edge that lies in one direction from a pixel.
struct Background {
  Direction towards;
  int distance;  // in pixels
  int disparity;
  std::optional<Position> captured;  // view that sees the far side, if any

  // Order of backgrounds: backgrounds that a captured view sees precede other backgrounds, and
  // shorter distances precede longer distances.
  bool SameRank(const Background& other) const {
    return captured.has_value() == other.captured.has_value() && distance == other.distance;
  }
  bool Before(const Background& other) const {
    if (captured.has_value() != other.captured.has_value()) return captured.has_value();
    if (distance != other.distance) return distance < other.distance;
    return disparity > other.disparity;
  }
};

class SurfaceFinder {
 public:
  // (x0, y0) is the position of the extended rectangle in the layer.
  SurfaceFinder(const LightField& field, const Picture& extended, const Lens& lens, int x0, int y0)
      : field_(field),
        extended_(extended),
        lens_(lens),
        x0_(x0),
        y0_(y0),
        unit_(64 << lens.layer) {}

  SurfaceMap Find() const {
    SurfaceMap map = {extended_.width, extended_.height, {}};
    ForEachPixel(map.width, map.height,
                 [&](int x, int y) { map.pixels.push_back(SurfacesOf(x, y)); });
    return map;
  }

 private:
  int Disparity(int x, int y) const { return extended_.disparities[extended_.At(x, y)]; }

  // Returns true for a depth edge: the disparity decreases by more than 3/4 of a pixel of the
  // layer.
  bool IsEdge(int near, int far) const { return near - far > unit_ * 3 / 4; }

  std::vector<Surface> SurfacesOf(int x, int y) const {
    std::vector<Surface> surfaces = {{Disparity(x, y), extended_.colours[extended_.At(x, y)]}};
    for (const Direction& side : kDirections) {
      if (!extended_.Inside(x + side.x, y + side.y)) continue;
      surfaces[0].ends |= NextEdge(x, y, side) == 1;
    }
    AddHidden(x, y, &surfaces);
    AddCopy(x, y, &surfaces);
    Part(x, y, &surfaces);
    return surfaces;
  }

  // Splits a pixel on the far side of a depth edge into the near and the far surface. The pixel is
  // split only if the two surfaces are more than one pixel apart in the outermost view. If several
  // neighbours are nearer than the pixel, the near and the far colour are means over the edges to
  // these neighbours.
  void Part(int x, int y, std::vector<Surface>* surfaces) const {
    const bool outermost =
        x == 0 || y == 0 || x == extended_.width - 1 || y == extended_.height - 1;
    if (outermost || !InPicture(x0_ + x, y0_ + y)) return;
    Surface near = {INT16_MIN, {0, 0, 0}, 0}, far = {Disparity(x, y), {0, 0, 0}};
    double shares = 0;
    for (const Direction& side : kDirections) {
      const int disparity = Disparity(x + side.x, y + side.y);
      if (!IsEdge(disparity, far.disparity)) continue;
      const int moved = lens_.Shift(lens_.n, disparity) - lens_.Shift(lens_.n, far.disparity);
      if (std::abs(moved) <= 256) continue;
      const Mixed mixed =
          lens_.layer == 0 ? MixtureAt(field_, x0_ + x, y0_ + y, side, unit_ * 3 / 4, kContrastFade)
                           : MixtureOfLevel(x, y, side);
      near.disparity = std::max(near.disparity, disparity);
      if (mixed.share == 0) continue;
      near.colour = near.colour + mixed.share * mixed.near;
      far.colour = far.colour + mixed.share * mixed.far;
      near.share = std::max(near.share, mixed.share);
      shares += mixed.share;
    }
    // The share is rounded to 1/128 as in the engine.
    near.share = std::floor(near.share * 128 + 0.5) / 128;
    if (near.share == 0) return;
    near.colour = 1 / shares * near.colour;
    far.colour = 1 / shares * far.colour;
    // AddCopy's copy of the pixel is removed, because the copy has the colour of the mixture.
    if (surfaces->size() > 1 && !IsEdge(far.disparity, (*surfaces)[1].disparity)) {
      surfaces->erase(surfaces->begin() + 1);
    }
    surfaces->front() = far;
    surfaces->insert(surfaces->begin(), near);
    if (surfaces->size() > starfocus::simd::kSurfaces) surfaces->pop_back();
  }

  // Returns true if the pixel is inside the layer. A layer has half the size of the previous layer,
  // plus one pixel.
  bool InPicture(int x, int y) const {
    int width = field_.at({0, 0}).width, height = field_.at({0, 0}).height;
    for (int layer = 0; layer < lens_.layer; ++layer) {
      width = (width + 1) / 2 + 1;
      height = (height + 1) / 2 + 1;
    }
    return x >= 0 && y >= 0 && x < width && y < height;
  }

  // Returns the near share and both colours of a mixed pixel at layers 1 and 2. The colours of both
  // surfaces come from the neighbours or from a captured view.
  Mixed MixtureOfLevel(int x, int y, const Direction& side) const {
    const auto at = [&](int k) { return extended_.Nearest(x + k * side.x, y + k * side.y); };
    const auto same = [&](int a, int b) {
      return std::abs(extended_.disparities[at(a)] - extended_.disparities[at(b)]) <= unit_ * 3 / 4;
    };
    const Colour& mixed = extended_.colours[at(0)];
    const std::vector<Position> occlusion_views = LooksOn(field_, {-side.x, -side.y});
    Colour far = extended_.colours[at(same(-1, 0) ? -1 : 0)];
    if (!occlusion_views.empty()) {
      far = ReadMoved(field_, lens_.layer, occlusion_views.back(), x0_ + x, y0_ + y,
                      extended_.disparities[at(0)]);
    }
    const Colour& near = extended_.colours[at(same(2, 1) ? 2 : 1)];
    return MixtureOf(Divide(near, far, mixed, kContrastFade), near, far, mixed);
  }

  // Adds the hidden surfaces behind the visible surface of a pixel.
  void AddHidden(int x, int y, std::vector<Surface>* hidden) const {
    std::vector<Surface>& surfaces = *hidden;
    std::vector<Background> backgrounds;
    for (const Direction& towards : kDirections) FindHidden(x, y, towards, &backgrounds);
    while (!backgrounds.empty() && surfaces.size() < starfocus::simd::kSurfaces) {
      const Background best =
          *std::min_element(backgrounds.begin(), backgrounds.end(),
                            [](const Background& a, const Background& b) { return a.Before(b); });
      surfaces.push_back({best.disparity, MeanColour(x, y, best, backgrounds)});
      if (!best.captured) {
        surfaces.back().repeated = best.distance;
        for (const Background& other : backgrounds) {
          const bool ties = other.SameRank(best) && other.disparity == best.disparity;
          if (ties) surfaces.back().towards.push_back(other.towards);
        }
      }
      // Surfaces whose disparities differ by at most a pixel count as one surface.
      const auto same = [&](const Background& other) {
        return std::abs(other.disparity - best.disparity) <= unit_;
      };
      backgrounds.erase(std::remove_if(backgrounds.begin(), backgrounds.end(), same),
                        backgrounds.end());
    }
  }

  // Continues the farthest of the eight neighbours of a pixel on the same surface, which is 2/64 to
  // 3/4 of a pixel farther, behind the pixel, because slices that move apart would otherwise open a
  // gap in the surface.
  void AddCopy(int x, int y, std::vector<Surface>* surfaces) const {
    if (x == 0 || y == 0 || x == extended_.width - 1 || y == extended_.height - 1) return;
    const int here = Disparity(x, y);
    int farthest = here;
    ForEachAround(1, [&](int dx, int dy) {
      const int there = Disparity(x + dx, y + dy);
      if (here - there < unit_ * 2 / 64 || IsEdge(here, there)) return;
      farthest = std::min(farthest, there);
    });
    if (farthest == here || surfaces->front().ends) return;
    if (surfaces->size() > 1 && (*surfaces)[1].disparity >= farthest) return;
    surfaces->insert(surfaces->begin() + 1, {farthest, ColourBeside(x, y, farthest)});
    if (surfaces->size() > starfocus::simd::kSurfaces) surfaces->pop_back();
  }

  // Returns the mean of the mean colours of the neighbours of `disparity` in the row and in the
  // column, or, if there are none, of those on both diagonals.
  Colour ColourBeside(int x, int y, int disparity) const {
    std::vector<Colour> means;
    for (const Direction& axis :
         {Direction{1, 0}, Direction{0, 1}, Direction{1, 1}, Direction{-1, 1}}) {
      if (axis.x * axis.y == 1 && !means.empty()) break;
      std::vector<Colour> colours;
      for (const int way : {1, -1}) {
        const int column = x + way * axis.x, row = y + way * axis.y;
        if (Disparity(column, row) != disparity) continue;
        colours.push_back(extended_.colours[extended_.At(column, row)]);
      }
      if (!colours.empty()) means.push_back(MeanOf(colours));
    }
    return MeanOf(means);
  }

  static Colour MeanOf(const std::vector<Colour>& colours) {
    Colour mean = {0, 0, 0};
    for (const Colour& colour : colours) {
      for (size_t c = 0; c < 3; ++c) mean[c] += colour[c] / double(colours.size());
    }
    return mean;
  }

  // Returns true if a pixel hides the point `distance` pixels away beyond an edge. The centre view
  // does not see the hidden point, but a view at distance 1 does.
  bool Hides(int here, int far, int distance) const {
    return IsEdge(here, far) && (distance - 1) * unit_ <= here - far;
  }

  // Returns the distance to the far side of the nearest depth edge in the direction `towards`, or 0
  // if the far side is not hidden. A step does not count as an edge if two conditions hold. The
  // step must be at most an eighth of the depth that the previous edge hides. The near side of the
  // step must hide the far side of the previous edge.
  int NextEdge(int x, int y, const Direction& towards) const {
    int k = 0;
    while (extended_.Inside(x + (k + 1) * towards.x, y + (k + 1) * towards.y)) ++k;
    // Disparity of the last edge's far side, and the distance to this side; a distance of 0 means
    // that no edge was found yet.
    int far = 0, distance = 0;
    for (; k > 0; --k) {
      const int beyond = Disparity(x + k * towards.x, y + k * towards.y);
      const int here = Disparity(x + (k - 1) * towards.x, y + (k - 1) * towards.y);
      if (distance > 0) ++distance;
      const bool goes_on = distance > 0 && Hides(here, far, distance) &&
                           8 * (here - beyond) <= std::min(here - far, INT16_MAX);
      if (!IsEdge(here, beyond) || goes_on) continue;
      far = beyond;
      distance = 1;
    }
    return distance > 0 && Hides(Disparity(x, y), far, distance) ? distance : 0;
  }

  // Finds up to two surfaces behind a pixel: the surfaces beyond the next two edges in the
  // direction `towards`. The second surface is added only if a view can see that far behind the
  // pixel.
  void FindHidden(int x, int y, const Direction& towards, std::vector<Background>* found) const {
    const int next = NextEdge(x, y, towards);
    if (next == 0) return;
    AddBackground(x, y, towards, next, found);
    const int more = NextEdge(x + next * towards.x, y + next * towards.y, towards);
    const int second = next + more;
    if (more == 0 || second > starfocus::simd::kMostDistance) return;
    const int far = Disparity(x + second * towards.x, y + second * towards.y);
    if (Hides(Disparity(x, y), far, second)) AddBackground(x, y, towards, second, found);
  }

  void AddBackground(int x, int y, const Direction& towards, int distance,
                     std::vector<Background>* found) const {
    const int far = Disparity(x + distance * towards.x, y + distance * towards.y);
    Background background = {towards, distance, far, {}};
    for (const Position& view : LooksOn(field_, towards)) {
      if (background.captured || IsCovered(x, y, far, view)) continue;
      background.captured = view;
    }
    found->push_back(background);
  }

  // Returns true if a nearer pixel covers the pixel's background in a captured view. The covering
  // pixel is nearer than `far`, the disparity of the background, by more than half a pixel. In the
  // captured view, the covering pixel lies within 3/4 of a pixel of the background. The pixels that
  // may cover the background lie on a line from the pixel towards the view. In a view too close to
  // the centre view, every background counts as covered.
  bool IsCovered(int x, int y, int far, const Position& view) const {
    const auto [u, v] = view;
    const int size = std::max(std::abs(u), std::abs(v));
    const int unit = (unit_ * kViewUnit + size / 2) / size;
    if (unit > starfocus::simd::kMostUnit) return true;
    const auto along = [&](int m, int axis) {
      const int steps = std::abs(axis) * kViewUnit;  // slope of the line, in 1/kViewUnit
      const int slant =
          std::abs(axis) == size ? kViewUnit : int((int64_t{steps} + size / 2) / size);
      return int(std::floor(double(m) * (axis < 0 ? -slant : slant) / kViewUnit + 0.5));
    };
    for (int m = 0;; ++m) {
      const int column = x + along(m, u), row = y + along(m, v);
      if (!extended_.Inside(column, row)) return false;
      const int nearer = Disparity(column, row) - far;
      if (2 * nearer > unit && 4 * std::abs(nearer - m * unit) < 3 * unit) return true;
    }
  }

  // Returns the colour of the background, which is the mean over all directions of equal rank.
  Colour MeanColour(int x, int y, const Background& best,
                    const std::vector<Background>& backgrounds) const {
    Colour sum = {0, 0, 0};
    int count = 0;
    for (const Background& background : backgrounds) {
      if (!background.SameRank(best) || background.disparity != best.disparity) continue;
      const Colour colour = ColourOf(x, y, background);
      for (size_t c = 0; c < 3; ++c) sum[c] += colour[c];
      ++count;
    }
    for (double& value : sum) value /= count;
    return sum;
  }

  Colour ColourOf(int x, int y, const Background& background) const {
    const auto& [dx, dy] = background.towards;
    if (!background.captured) {  // No captured view shows the background.
      return extended_
          .colours[extended_.At(x + dx * background.distance, y + dy * background.distance)];
    }
    return ReadMoved(field_, lens_.layer, *background.captured, x0_ + x, y0_ + y,
                     background.disparity);
  }

  const LightField& field_;
  const Picture& extended_;
  const Lens& lens_;
  const int x0_, y0_;
  const int unit_;  // disparity that moves a pixel by one pixel per unit of u
};

}  // namespace

SurfaceMap FindLayeredDepth(const LightField& field, const Picture& extended, const Lens& lens,
                            int x0, int y0) {
  SurfaceMap map = SurfaceFinder(field, extended, lens, x0, y0).Find();
  const bool is_excess = !field.begin()->second.light.empty();
  if (!is_excess || field.size() > 1) {
    InpaintHidden(64 << lens.layer, &map);
    return map;
  }
  // A lamp does not continue behind a nearer surface that no other view looks behind.
  for (std::vector<Surface>& surfaces : map.pixels) {
    for (size_t k = 1; k < surfaces.size(); ++k) surfaces[k].colour = {0, 0, 0};
  }
  return map;
}

}  // namespace reference
