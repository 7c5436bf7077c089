// SPDX-License-Identifier: Apache-2.0
// Coverage of thin structures in the reference: large edges of a map and the two surfaces that meet
// there, the light of the far surface, and the share of each surface.
#include <functional>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "tests/conformance/reference.h"
#include "tests/conformance/reference_line.h"

namespace reference {

namespace {

// Threshold of edges of thin structures: a larger step of disparity, in 1/64 pixel, is an edge.
constexpr int kThinEdge = 5 * 64;

class ThinMap {
 public:
  explicit ThinMap(const Picture& picture) : picture_(picture) {}

  // Returns the disparity of a pixel. Beyond the picture, the outermost pixels are repeated.
  int Disparity(int x, int y) const { return picture_.disparities[picture_.Nearest(x, y)]; }

  bool IsBesideNearer(int x, int y) const {
    for (const Direction& side : kDirections) {
      if (Disparity(x + side.x, y + side.y) - Disparity(x, y) > kThinEdge) return true;
    }
    return false;
  }

  // Returns true if two opposite neighbours of a pixel are farther.
  bool IsStrand(int x, int y) const {
    for (const Direction& to : {kDirections[0], kDirections[2]}) {
      const int beside = std::max(Disparity(x - to.x, y - to.y), Disparity(x + to.x, y + to.y));
      if (Disparity(x, y) - beside > kThinEdge) return true;
    }
    return false;
  }

  // Returns true if the disparity of the pixel lies between the disparities of two opposite pixels
  // at an equal distance of 1 to 3 pixels. Either both steps must be edges, or the pixels must be
  // adjacent, both steps at least half a pixel, and the larger step at most 4 times the smaller
  // one.
  bool IsRamp(int x, int y) const {
    constexpr Direction kOpposite[] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
    for (const Direction& to : kOpposite) {
      for (int k = 1; k <= 3; ++k) {
        const int here = Disparity(x, y);
        const int before = here - Disparity(x - k * to.x, y - k * to.y);
        const int after = Disparity(x + k * to.x, y + k * to.y) - here;
        const int least = std::min(std::abs(before), std::abs(after));
        const int most = std::max(std::abs(before), std::abs(after));
        const bool ramp = least > kThinEdge || (k == 1 && least >= 32 && most <= 4 * least);
        if ((before > 0) == (after > 0) && ramp) return true;
      }
    }
    return false;
  }

  // FindGiven and FindEdge find the disparities of the two surfaces of a pixel, and return false if
  // the pixel has only one surface. FindGiven, for given coverage, uses the nearest surfaces within
  // 32 pixels, without ramps. FindEdge uses the surfaces at the nearest edge within 3 pixels.
  // `square` receives the squared distance to the pixel beyond the edge.
  bool FindGiven(int x, int y, int* low, int* high) const {
    const int here = Disparity(x, y);
    const auto find = [&](int from, int to) {
      return Nearest(x, y, 32, [&](int column, int row) {
        const int there = Disparity(column, row);
        return there >= from && there <= to && !IsRamp(column, row);
      });
    };
    const auto disparity = [&](const std::pair<int, int>& at) {
      return Disparity(x + at.first, y + at.second);
    };
    if (IsRamp(x, y)) {
      *high = disparity(find(here + 1, INT16_MAX));
      *low = disparity(find(INT16_MIN, here - 1));
      if (*high - *low > kThinEdge) return true;
    }
    const auto nearer = find(here + kThinEdge + 1, INT16_MAX);
    const auto farther = find(INT16_MIN, here - kThinEdge - 1);
    const auto square = [](const std::pair<int, int>& at) {
      const int sum = at.first * at.first + at.second * at.second;
      return sum == 0 ? INT32_MAX : sum;
    };
    const bool is_near = square(farther) <= square(nearer);
    *high = is_near ? here : disparity(nearer);
    *low = is_near ? disparity(farther) : here;
    return std::min(square(nearer), square(farther)) != INT32_MAX;
  }

  bool FindEdge(int x, int y, int* low, int* high, int* square) const {
    const int here = Disparity(x, y);
    int other = here;
    *square = 0;
    ForEachAround(3, [&](int dx, int dy) {
      const int there = Disparity(x + dx, y + dy), distance = dx * dx + dy * dy;
      if (std::abs(there - here) <= kThinEdge || (*square != 0 && distance > *square)) return;
      // Among equally near pixels, the one with the largest disparity counts.
      other = distance == *square ? std::max(other, there) : there;
      *square = distance;
    });
    *low = std::min(here, other);
    *high = std::max(here, other);
    return *square != 0;
  }

  // Returns the mean of the disparities within 2 pixels that are close to the disparity `near`.
  double SmoothNear(int x, int y, int near) const {
    constexpr int kWeights[] = {6, 4, 1};
    double sum = 0, weights = 0;
    ForEachAround(2, [&](int dx, int dy) {
      if (std::abs(Disparity(x + dx, y + dy) - near) > 2 * 64) return;
      const double weight = kWeights[std::abs(dx)] * kWeights[std::abs(dy)];
      sum += weight * (Disparity(x + dx, y + dy) - near);
      weights += weight;
    });
    return weights == 0 ? near : near + std::round(sum / weights);
  }

 private:
  using Is = std::function<bool(int x, int y)>;
  // Returns the offset of the nearest pixel within `reach` for which `is` returns true, or (0, 0)
  // if no pixel is found. Among equally near pixels, the pixel with the smaller maximum of |dx| and
  // |dy| is chosen, then the first in row order.
  std::pair<int, int> Nearest(int x, int y, int reach, const Is& is) const {
    std::pair<int, int> nearest = {0, 0};
    std::pair<int, int> least = {INT32_MAX, 0};
    ForEachAround(reach, [&](int dx, int dy) {
      const std::pair<int, int> rank = {dx * dx + dy * dy, std::max(std::abs(dx), std::abs(dy))};
      if (rank.first == 0 || !(rank < least) || !is(x + dx, y + dy)) return;
      least = rank;
      nearest = {dx, dy};
    });
    return nearest;
  }

  const Picture& picture_;
};

// Side of the tiles that are tested for thin structure, in pixels.
constexpr int kTile = 16;

struct FarLight {
  Colour light = {0, 0, 0};
  double known = 0;      // Certainty of `light`, 0 to 1.
  double disparity = 0;  // Disparity of the farther surface, in units of 1/64 pixel.
};

constexpr int kLastLevel = 4;

// Returns the disparity of the farthest surface with known light in any of the cells, or
// infinity.
double Farthest(const std::vector<FarLight>& cells) {
  double farthest = std::numeric_limits<double>::infinity();
  for (const FarLight& cell : cells) {
    if (cell.known > 0) farthest = std::min(farthest, cell.disparity);
  }
  return farthest;
}

// Returns the weighted mean of the light of the cells that show the surface at `disparity`. The
// weight of a cell is the product of its element of `parts` and FarLight::known. FarLight::known
// of the result is the sum of the weights of all averaged cells.
FarLight MeanOf(const std::vector<FarLight>& cells, const std::vector<double>& parts,
                double disparity) {
  FarLight mean;
  for (size_t k = 0; k < cells.size(); ++k) {
    if (cells[k].known == 0 || std::fabs(cells[k].disparity - disparity) > kThinEdge) continue;
    const double weight = parts[k] * cells[k].known;
    for (size_t c = 0; c < 3; ++c) mean.light[c] += weight * cells[k].light[c];
    mean.disparity += weight * cells[k].disparity;
    mean.known += weight;
  }
  if (mean.known == 0) return mean;
  for (double& light : mean.light) light /= mean.known;
  mean.disparity /= mean.known;
  return mean;
}

// Planes of cells with sides of 1, 2, 4, 8 and 16 pixels. The planes extend beyond the picture by
// one tile on each side.
class FarPyramid {
 public:
  FarPyramid(int columns, int rows) {
    for (int level = 0; level <= kLastLevel; ++level) {
      const int side = kTile >> level;
      levels_.emplace_back(side, side, (columns + 2) * side, (rows + 2) * side);
    }
  }

  FarLight& Pixel(int x, int y) { return levels_[0].At(x, y); }

  // Averages cells into cells of twice their side, and fills cells without known light.
  void Fill() {
    for (size_t level = 1; level <= kLastLevel; ++level) {
      const Level& finer = levels_[level - 1];
      levels_[level].ForEach([&](int x, int y) {
        const std::vector<FarLight> below = {finer.At(2 * x, 2 * y), finer.At(2 * x + 1, 2 * y),
                                             finer.At(2 * x, 2 * y + 1),
                                             finer.At(2 * x + 1, 2 * y + 1)};
        FarLight& cell = levels_[level].At(x, y) = MeanOf(below, {1, 1, 1, 1}, Farthest(below));
        cell.known = std::min(cell.known, 1.0);
      });
    }
    filled_ = levels_;
    for (int level = kLastLevel - 1; level > 0; --level) {
      Level& plane = filled_[size_t(level)];
      plane.ForEach([&](int x, int y) {
        FarLight& cell = plane.At(x, y);
        const double disparity = cell.known > 0 ? cell.disparity : Farthest(Above(level, x, y));
        cell = Pushed(level, x, y, cell, disparity);
      });
    }
  }

  // Returns the light of a pixel. Where the light of the pixel is not known, the light of the
  // larger cells around the pixel is used.
  FarLight Filled(int x, int y) const {
    const FarLight& cell = levels_[0].At(x, y);
    return Pushed(0, x, y, cell, cell.disparity);
  }

 private:
  using Level = Grid<FarLight>;

  FarLight Pushed(int level, int x, int y, FarLight cell, double disparity) const {
    if (cell.known >= 1) return cell;
    const FarLight mean = MeanOf(Above(level, x, y), {9, 3, 3, 1}, disparity);
    if (mean.known == 0) return cell;
    cell.light = mean.light + cell.known * (cell.light - mean.light);
    if (cell.known == 0) cell.disparity = mean.disparity;
    cell.known = 1;
    return cell;
  }

  // Returns the filled cells of the next coarser level that surround a cell. The first returned
  // cell contains the given cell.
  std::vector<FarLight> Above(int level, int x, int y) const {
    const int column = int(std::floor(x / 2.0)), row = int(std::floor(y / 2.0));
    const int beside = x == 2 * column ? column - 1 : column + 1;
    const int next = y == 2 * row ? row - 1 : row + 1;
    const Level& coarser = filled_[size_t(level + 1)];
    const auto get = [&](int u, int v) {
      return coarser.Inside(u, v) ? coarser.At(u, v) : FarLight{};
    };
    return {get(column, row), get(beside, row), get(column, next), get(beside, next)};
  }

  std::vector<Level> levels_, filled_;
};

// Smallest numbers of pixels with a nearer neighbour, and of pixels of strands one pixel wide, in
// a tile of thin structure.
constexpr int kLeastRagged = 36, kLeastStrands = 2;

// Rounds coverage, and the certainty of the farther surface's light, as the engine rounds these
// values between passes.
double RoundedCoverage(double alpha) { return std::floor(alpha * 128 + 0.5) / 128; }
double Kept(double known) { return std::floor(known * 256) / 256; }
double EighthPower(double value) { return Kept(std::pow(value, 8)); }

double Dot(const Colour& a, const Colour& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Values of a pixel, computed in several passes.
struct Pixel {
  bool two = false;             // True if the pixel is near an edge and shows two surfaces.
  double near = 0, far = 0;     // Disparities of the nearer and the farther surface.
  double guess = 1, first = 1;  // Coverage according to the map, and after the first pass.
};

class Parter {
 public:
  Parter(const LightField& field, const std::vector<uint8_t>& given)
      : field_(field),
        centre_(field.at({0, 0})),
        map_(centre_),
        given_(given),
        columns_((centre_.width + kTile - 1) / kTile),
        rows_((centre_.height + kTile - 1) / kTile),
        pixels_(size_t(centre_.width) * size_t(centre_.height)),
        far_(columns_, rows_) {}

  std::vector<PartedPixel> Part() {
    MarkRagged();
    ForEach([&](int x, int y) { StartPixel(x, y); });
    far_.Fill();
    if (given_.empty()) FirstPass();
    MarkMixed();
    if (!IsGivenAlone()) {
      ForEach([&](int x, int y) {
        if (At(x, y).two && IsThin(x, y)) FindHidden(x, y);
      });
      far_.Fill();
    }
    std::vector<PartedPixel> parted(pixels_.size());
    ForEach([&](int x, int y) {
      if (At(x, y).two && IsThin(x, y)) parted[Index(x, y)] = Parted(x, y);
    });
    return parted;
  }

 private:
  using Act = std::function<void(int x, int y)>;
  void ForEach(const Act& act) const {
    ForEachPixel(centre_.width, centre_.height, [&](int x, int y) { act(x, y); });
  }
  size_t Index(int x, int y) const { return centre_.At(x, y); }
  Pixel& At(int x, int y) { return pixels_[Index(x, y)]; }
  const Pixel& At(int x, int y) const { return pixels_[Index(x, y)]; }
  const Colour& Light(int x, int y) const { return centre_.colours[Index(x, y)]; }

  double GivenAt(int x, int y) const { return RoundedCoverage(given_[Index(x, y)] / 255.0); }

  // Returns true if coverage is given, and no side view shows far surfaces.
  bool IsGivenAlone() const { return !given_.empty() && field_.size() == 1; }

  // --- Tiles ---

  using Tiles = std::set<std::pair<int, int>>;
  static bool Any(const Tiles& tiles, int x, int y, int reach) {
    for (int row = y / kTile - reach; row <= y / kTile + reach; ++row) {
      for (int column = x / kTile - reach; column <= x / kTile + reach; ++column) {
        if (tiles.count({column, row}) > 0) return true;
      }
    }
    return false;
  }
  bool IsStarted(int x, int y) const { return Any(ragged_, x, y, given_.empty() ? 1 : 2); }
  bool IsThin(int x, int y) const {
    return IsStarted(x, y) && (given_.empty() || Any(mixed_, x, y, 0));
  }

  void MarkRagged() {
    ForEachPixel(columns_, rows_, [&](int column, int row) {
      int low = map_.Disparity(column * kTile, row * kTile), high = low;
      int beside = 0, strands = 0;
      ForEachIn(-1, -1, kTile + 1, kTile + 1, [&](int x, int y) {
        const bool inside = x >= 0 && x < kTile && y >= 0 && y < kTile;
        const int left = column * kTile + x, top = row * kTile + y;
        low = std::min(low, map_.Disparity(left, top));
        high = std::max(high, map_.Disparity(left, top));
        beside += inside && map_.IsBesideNearer(left, top) ? 1 : 0;
        strands += inside && map_.IsStrand(left, top) ? 1 : 0;
      });
      const bool thin = beside >= kLeastRagged && strands >= kLeastStrands;
      if (high - low > kThinEdge && (!given_.empty() || thin)) ragged_.insert({column, row});
    });
  }

  // Marks the tiles in which any pixel has given coverage and two surfaces.
  void MarkMixed() {
    ForEach([&](int x, int y) {
      const Pixel& pixel = At(x, y);
      if (!given_.empty() && pixel.two) mixed_.insert({x / kTile, y / kTile});
    });
  }

  // Returns true if the given coverage of any pixel within 3 pixels along both axes is above
  // 2/128 and below 115/128, from where the near surface covers the whole pixel.
  bool IsBesideMixture(int x, int y) const {
    bool any = false;
    ForEachAround(3, [&](int dx, int dy) {
      if (!centre_.Inside(x + dx, y + dy)) return;
      const double alpha = GivenAt(x + dx, y + dy);
      any = any || (alpha > 2 / 128.0 && alpha < 115 / 128.0);
    });
    return any;
  }

  // Finds the two surfaces of a pixel with given coverage. Returns false if the pixel is not
  // split, because no edge is near, or because the coverage only repeats the map.
  bool FindGiven(int x, int y, int* low, int* high) const {
    const int here = map_.Disparity(x, y);
    if (!map_.FindGiven(x, y, low, high)) return false;
    const double guess = 2 * here >= *low + *high ? 1 : 0;
    const double alpha = GivenAt(x, y);
    const bool differs = guess > 0 ? alpha < 115 / 128.0 : alpha > 2 / 128.0;
    return differs || map_.IsRamp(x, y) || IsBesideMixture(x, y);
  }

  // Computes the mean of the near light around a pixel with given coverage, and returns the trust
  // in this light, which is 0 if no pixel shows the near surface alone.
  double GivenNearLight(int x, int y, Colour* light) const {
    double weights = 0;
    *light = {0, 0, 0};
    ForEachAround(3, [&](int dx, int dy) {
      if (!centre_.Inside(x + dx, y + dy)) return;
      const double weight = EighthPower(GivenAt(x + dx, y + dy));
      weights += weight;
      *light = *light + weight * Light(x + dx, y + dy);
    });
    if (weights > 0) *light = 1 / weights * *light;
    return std::min(64 * weights, 1.0);
  }

  // Returns the light of a pixel without the light of its near surface, which is the mean of the
  // near light around the pixel.
  Colour WithoutNear(int x, int y) const {
    Colour near, light = Light(x, y);
    const double alpha = At(x, y).first, known = GivenNearLight(x, y, &near);
    return Clamped(light + alpha * known / (1 - alpha) * (light - near));
  }

  void StartPixel(int x, int y) {
    Pixel& pixel = At(x, y);
    const int here = map_.Disparity(x, y);
    pixel.near = pixel.far = here;
    if (!IsStarted(x, y)) return;
    int low = here, high = here, square = 0;
    const bool given = !given_.empty();
    pixel.two = given ? FindGiven(x, y, &low, &high) : map_.FindEdge(x, y, &low, &high, &square);
    double known = 1;
    if (pixel.two) {
      pixel.near = map_.SmoothNear(x, y, high);
      pixel.far = low;
      pixel.guess = pixel.first = 2 * here >= low + high ? 1 : 0;
      if (given) {
        pixel.first = GivenAt(x, y);
        known = EighthPower(1 - pixel.first);
      } else {
        // Near a strand in the map, pixels may show strands that the map lacks.
        known = here == high ? 0 : square <= 2 ? 1 / 16.0 : square <= 5 ? 1 / 4.0 : 1;
      }
    }
    const bool unmixes = IsGivenAlone() && pixel.first > 0 && pixel.first < 1;
    if (unmixes) known = Kept(std::pow(1 - pixel.first, 5));
    far_.Pixel(x, y) = {unmixes ? WithoutNear(x, y) : Light(x, y), known, pixel.far};
  }

  // --- Coverage computed from colours ---

  // Computes the light of the near surface around a pixel. The weight of each neighbour (x, y)
  // includes the factor shown(x, y). Returns the trust in the light, which is 0 if all weights
  // are 0.
  double NearLight(int x, int y, const std::function<double(int x, int y)>& shown,
                   Colour* light) const {
    constexpr double kTaps[3][3] = {{10, 8, 4}, {8, 7, 3}, {4, 3, 2}};
    double weights = 0;
    *light = {0, 0, 0};
    ForEachAround(2, [&](int dx, int dy) {
      if (!centre_.Inside(x + dx, y + dy)) return;
      if (std::fabs(At(x + dx, y + dy).near - At(x, y).near) > kThinEdge) return;
      const double weight = kTaps[std::abs(dy)][std::abs(dx)] * shown(x + dx, y + dy);
      weights += weight;
      // The engine rounds each product, which matters where all weights are small.
      const Colour& there = Light(x + dx, y + dy);
      for (size_t c = 0; c < 3; ++c) (*light)[c] += std::floor(weight * there[c] + 0.5);
    });
    for (double& value : *light) value /= weights > 0 ? weights : 1;
    return std::min(1.0, weights / 4);
  }

  // Returns the coverage of a mixed pixel. The less the colours determine the coverage, the more
  // `guess` replaces the result. `trust` is the trust in `near`.
  static double AlphaOf(const Colour& near, const Colour& far, const Colour& mixed, double guess,
                        double trust) {
    const Colour whole = near - far, part = mixed - far;
    const double contrast = Dot(whole, whole), along = Dot(whole, part);
    if (contrast == 0) return guess;
    const double beside = Dot(part, part) - along * along / contrast;
    const double square = 81 + contrast / 16;
    trust *= contrast / (contrast + 1500) * square / (square + beside);
    return guess + (std::clamp(along / contrast, 0.0, 1.0) - guess) * trust;
  }

  void FirstPass() {
    // The weight of a pixel near an edge increases with the coverage in its 3x3 neighbourhood.
    const auto shown = [&](int x, int y) {
      double count = 0;
      ForEachAround(
          1, [&](int dx, int dy) { count += pixels_[centre_.Nearest(x + dx, y + dy)].guess; });
      return 3 * count * count * At(x, y).guess / 256;
    };
    ForEach([&](int x, int y) {
      Pixel& pixel = At(x, y);
      const FarLight far = far_.Filled(x, y);
      Colour near;
      if (!pixel.two || !Any(ragged_, x, y, 0) || far.known == 0) return;
      const double trust = NearLight(x, y, shown, &near);
      pixel.first = RoundedCoverage(AlphaOf(near, far.light, Light(x, y), pixel.guess, trust));
    });
  }

  // --- Light of far surfaces, read from all views ---

  // Returns the largest coverage by nearer surfaces in a view, at the point where the view shows
  // a pixel's far surface. Only nearer pixels that the view shows within 1.5 pixels of the far
  // surface's point are counted.
  double CoveredIn(const Position& view, int x, int y) const {
    const bool down = std::abs(view.second) > std::abs(view.first);
    const int along = down ? view.second : view.first, across = down ? view.first : view.second;
    const int sign = along < 0 ? -1 : 1;
    double covered = 0;
    for (int m = 0; m <= 32; ++m) {
      const int beside = int(Rounded(int64_t{sign} * m * (across * kViewUnit / along), 14));
      for (int k = beside - 1; k <= beside + 1; ++k) {
        const int column = x + (down ? k : sign * m), row = y + (down ? sign * m : k);
        if (!centre_.Inside(column, row)) continue;
        const Pixel& pixel = At(column, row);
        const double nearer = pixel.near - At(x, y).far;
        // The engine rounds movements to 1/32 pixel.
        const double moved = 2 * std::floor(nearer * std::abs(along) / kViewUnit / 2 + 0.5);
        if (nearer <= 64 || std::fabs(moved - 64 * m) > 96) continue;
        covered = std::max(covered, pixel.first);
      }
    }
    return covered;
  }

  void FindHidden(int x, int y) {
    std::set<Position> views;
    for (const Direction& side : kDirections) {
      for (const Position& view : LooksOn(field_, side)) views.insert(view);
    }
    const Pixel& pixel = At(x, y);
    // The centre view has a smaller weight, since pixels of the centre view are mixtures near
    // edges.
    double known = Kept(EighthPower(1 - pixel.first) / 8);
    Colour sum = Light(x, y);
    for (double& light : sum) light *= known;
    for (const Position& view : views) {
      const double weight = EighthPower(1 - CoveredIn(view, x, y));
      const Colour light = ReadMoved(field_, 0, view, x, y, int(pixel.far));
      for (size_t c = 0; c < 3; ++c) sum[c] += weight * light[c];
      known += weight;
    }
    FarLight& far = far_.Pixel(x, y);
    far.known = Kept(std::min(known * (given_.empty() ? 0.5 : 4), 1.0));
    for (size_t c = 0; c < 3 && known > 0; ++c) far.light[c] = sum[c] / known;
  }

  // Returns the light of the far surface of a pixel with detail. The far surface gets
  // (1 - coverage)^3 of the light that `far` and the mean light of the near surface do not
  // explain, and half as much with side views.
  Colour WithDetail(int x, int y, const Colour& far) const {
    Colour near;
    const double alpha = At(x, y).first, known = GivenNearLight(x, y, &near);
    const double part = std::pow(1 - alpha, 3) / (field_.size() > 1 ? 2 : 1);
    return Clamped(far + part * (Light(x, y) - far - alpha * known * (near - far)));
  }

  PartedPixel Parted(int x, int y) const {
    const Pixel& pixel = At(x, y);
    const FarLight far = far_.Filled(x, y);
    const bool known = far.known > 0;
    PartedPixel parted = {true, pixel.first, pixel.near, pixel.far, far.light};
    if (!given_.empty()) {
      const bool is_mixed = known && pixel.first > 0 && pixel.first < 1;
      parted.parted = known || pixel.first >= 0.5;
      if (!known) parted.alpha = 1;
      if (is_mixed && !IsGivenAlone()) parted.light = WithDetail(x, y, far.light);
      return parted;
    }
    if (!known) {
      parted.alpha = pixel.guess;
      return parted;
    }
    const auto shown = [&](int column, int row) { return EighthPower(At(column, row).first); };
    Colour near;
    const double trust = NearLight(x, y, shown, &near);
    parted.alpha = AlphaOf(near, far.light, Light(x, y), pixel.first, trust);
    return parted;
  }

  const LightField& field_;
  const Picture& centre_;
  const ThinMap map_;
  const std::vector<uint8_t>& given_;
  const int columns_, rows_;
  std::vector<Pixel> pixels_;
  FarPyramid far_;
  Tiles ragged_, mixed_;
};

}  // namespace

std::vector<PartedPixel> PartPixels(const test::Scene& scene, int transfer) {
  const LightField field = Load(scene, transfer);
  return Parter(field, scene.coverage).Part();
}

}  // namespace reference
