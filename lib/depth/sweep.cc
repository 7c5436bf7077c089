// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/sweep.h"

#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/depth/swept.h"
#include "simd/disparities.h"
#include "simd/paths.h"

namespace starfocus {
namespace {

// The given map adds no cost to a label whose disparity differs from the pixel's trusted disparity
// by at most kOwnLabels (kDisparityBits).
constexpr int32_t kOwnLabels = 1 << (kDisparityBits - 1);

// A tile of a sweep: the tile with its border, and the tile's memory.
struct SweptTile {
  const SweepSetup& setup;
  const Rect& bordered;
  const simd::DepthKernels& kernels;
  const TileMemory& memory;
  const uint8_t* swept;  // EstimateMemory::swept
  size_t places;         // Number of elements of a pixel in the arrays of costs (PathLabels).

  // Calls act(begin, end) for each run of swept pixels of row y of the bordered tile (ForSwept).
  template <class Act>
  void ForRow(int32_t y, const Act& act) const {
    ForSwept(setup, swept, y, bordered.x, bordered.x + bordered.width, act);
  }
  // Returns the index of the first element of pixel (x, y) in the arrays of costs.
  size_t At(int32_t x, int32_t y) const {
    const size_t row = static_cast<size_t>(y - bordered.y) * static_cast<size_t>(bordered.width);
    return (row + static_cast<size_t>(x - bordered.x)) * places;
  }
};

// Fills the costs of the pixels of the bordered tile. If `one_side` is true, the views on the side
// whose views fit a pixel best are assumed to see the pixel. Otherwise, all views are assumed to
// see it, except views in which the pixel is known to be hidden. The caller must have loaded the
// views around the bordered tile, and marked the labels (disparities) that nearer surfaces hide in
// each view (LoadTileViews, MarkHidden).
void MeasureCosts(const SweptTile& tile, bool one_side) {
  const SweepSetup& setup = tile.setup;
  const TileViews& views = tile.memory.views;
  simd::LabelRow row = {};
  row.plane = views.plane;
  row.moves = tile.memory.moves;
  row.labels = static_cast<size_t>(setup.labels);
  row.views = static_cast<size_t>(setup.side_views);
  const auto all_views = static_cast<uint16_t>((1U << setup.side_views) - 1);
  if (setup.arms == 0) {
    row.sides = one_side ? setup.sides : &all_views;
    row.side_count = one_side ? static_cast<size_t>(setup.side_count) : 1;
  }
  row.arms = static_cast<size_t>(setup.arms);
  row.rings = static_cast<size_t>(setup.rings);
  row.one_side = one_side;
  row.ends = views.ends;
  // If the views form a star and a pixel moves beyond the edge of a view, the opposite view
  // replaces this view. In an estimate from a star, the opposite view also replaces each view in
  // which a nearer surface hides the pixel. In a repair, such a hidden view remains in use with a
  // limited cost, because the map of a repair may be wrong.
  row.limits = setup.repairs && !one_side;
  for (int32_t y = tile.bordered.y; y < tile.bordered.y + tile.bordered.height; ++y) {
    tile.ForRow(y, [&](int32_t begin, int32_t end) {
      const size_t at = views.At(begin, y);
      row.pixels = views.Centre(0) + at;
      row.hidden = views.all_seen ? nullptr : views.hidden + at;
      tile.kernels.CostLabels(row, static_cast<size_t>(end - begin), tile.places,
                              tile.memory.cost + tile.At(begin, y));
    });
  }
}

// Starts a path at pixel k of a row of paths, with a cost of 0 for all labels.
void BeginAt(const SweptTile& tile, int32_t k, int16_t* path, int16_t* least) {
  const auto labels = static_cast<size_t>(tile.setup.labels), places = tile.places;
  path += k * static_cast<ptrdiff_t>(places);
  std::fill_n(path, labels, int16_t{0});
  std::fill(path + labels, path + places, simd::kNoLabel);
  least[k] = 0;
}

// Starts paths at all pixels of row y in columns [first, last) that are not swept.
void BeginBeside(const SweptTile& tile, int32_t y, int32_t first, int32_t last, int16_t* path,
                 int16_t* least) {
  const Rect& bordered = tile.bordered;
  const bool inside = y >= bordered.y && y < bordered.y + bordered.height;
  const uint8_t* swept =
      tile.swept == nullptr || !inside ? nullptr : tile.swept + ptrdiff_t{y} * tile.setup.width;
  for (int32_t x = first; x < last; ++x) {
    const bool goes_on = inside && x >= bordered.x && x < bordered.x + bordered.width &&
                         (swept == nullptr || swept[x] != 0);
    if (!goes_on) BeginAt(tile, x - bordered.x, path, least);
  }
}

// Adds the costs of the paths from pixels (x - dx, y - dy) to pixels (x, y) of row y of the
// bordered tile to the sums. The paths of the row are stored in path[own] and least[own], those of
// the previous row at the other index. The paths continue from the swept pixels. If `adds` is
// false, the sums are overwritten.
void AddRow(const SweptTile& tile, int32_t y, int32_t dx, int32_t dy, bool adds, int own) {
  const TileMemory& memory = tile.memory;
  const auto labels = static_cast<size_t>(tile.setup.labels);
  const auto places = static_cast<ptrdiff_t>(tile.places);
  const int from = dy == 0 ? own : 1 - own;
  tile.ForRow(y, [&](int32_t begin, int32_t end) {
    const int32_t first = dx < 0 ? end - 1 : begin, k = first - tile.bordered.x;
    if (dy == 0) {
      BeginAt(tile, k - dx, memory.path[from], memory.least[from]);
    } else {
      BeginBeside(tile, y - dy, begin - dx, end - dx, memory.path[from], memory.least[from]);
    }
    const auto count = static_cast<size_t>(end - begin);
    const TileViews& views = memory.views;
    tile.kernels.FindJumps(views.Centre(0) + views.At(begin, y),
                           views.Centre(0) + views.At(begin - dx, y - dy), views.plane, count,
                           memory.jump + (begin - tile.bordered.x));
    simd::PathRow paths = {};
    paths.cost = memory.cost + tile.At(first, y);
    paths.sum = memory.sum + tile.At(first, y);
    paths.adds = adds;
    paths.path = memory.path[own] + k * places;
    paths.least = memory.least[own] + k;
    paths.jump = memory.jump + k;
    paths.before = memory.path[from] + (k - dx) * places;
    paths.before_least = memory.least[from] + k - dx;
    tile.kernels.AddPaths(paths, labels, dx < 0 ? -1 : 1, count);
  });
}

int16_t ToDisparity(const SweepSetup& setup, int32_t choice) {
  const int32_t moved = (choice * setup.step + (1 << (simd::kChoiceBits - 1))) >> simd::kChoiceBits;
  return static_cast<int16_t>(setup.low + moved);
}

// Computes the sums of path costs from the costs of the pixels of the bordered tile.
void AddAllPaths(const SweptTile& tile) {
  const SweepSetup& setup = tile.setup;
  const Rect& bordered = tile.bordered;
  // Set the element before each pixel's first label to kNoLabel, because this element belongs to no
  // label.
  const auto places = static_cast<ptrdiff_t>(tile.places);
  for (int16_t* path : tile.memory.path) {
    for (ptrdiff_t k = -1; k <= bordered.width; ++k) path[k * places - 1] = simd::kNoLabel;
  }
  for (int32_t n = 0; n < setup.directions; ++n) {
    const int8_t* direction = kEightDirections[n * (8 / setup.directions)];
    for (int32_t k = 0; k < bordered.height; ++k) {
      const int32_t y = bordered.y + (direction[1] < 0 ? bordered.height - 1 - k : k);
      AddRow(tile, y, direction[0], direction[1], n > 0, k & 1);
    }
  }
}

// Writes the disparities (kDisparityBits) of the part `tile_rect` of the bordered tile, and the
// certainty of these disparities, to maps of the whole picture. `certainty` may be null.
void ChooseDisparities(const SweptTile& tile, const Rect& tile_rect, int16_t* disparity,
                       uint8_t* certainty) {
  const SweepSetup& setup = tile.setup;
  const TileMemory& memory = tile.memory;
  const auto labels = static_cast<size_t>(setup.labels);
  for (int32_t y = tile_rect.y; y < tile_rect.y + tile_rect.height; ++y) {
    ForSwept(setup, tile.swept, y, tile_rect.x, tile_rect.x + tile_rect.width,
             [&](int32_t begin, int32_t end) {
               const auto count = static_cast<size_t>(end - begin);
               const size_t to = setup.At(begin, y);
               tile.kernels.ChooseLabels(memory.sum + tile.At(begin, y), labels, count,
                                         memory.choice,
                                         certainty == nullptr ? nullptr : certainty + to);
               for (size_t k = 0; k < count; ++k) {
                 disparity[to + k] = ToDisparity(setup, memory.choice[k]);
               }
             });
  }
}

// Writes the initial prior of one pixel: 0 for the labels near the pixel's disparity, and the
// largest cost for all other labels.
void SeedPrior(const SweepSetup& setup, int32_t d, size_t places, uint8_t* prior) {
  std::fill_n(prior, places, simd::kMostPrior);
  if (d == simd::kNoSurface) return;
  const int32_t below = d - kOwnLabels - setup.low;
  const int32_t first = below > 0 ? (below + setup.step - 1) / setup.step : 0;
  const int32_t last = Min((d + kOwnLabels - setup.low) / setup.step, setup.labels - 1);
  for (int32_t l = first; l <= last; ++l) prior[l] = 0;
}

// Returns the label nearest to a disparity.
int32_t LabelOf(const SweepSetup& setup, int32_t d) {
  const int32_t label = (d - setup.low + setup.step / 2) / setup.step;
  return Max(0, Min(label, setup.labels - 1));
}

// Adds a prior cost to the cost of each label at the pixels of the bordered tile. The prior cost of
// a label increases with the distance to the nearest trusted pixel with the label's disparity.
// `trusted` has the size of the picture.
void AddMapPrior(const SweptTile& tile, const int16_t* trusted) {
  const SweepSetup& setup = tile.setup;
  const Rect& bordered = tile.bordered;
  const TileMemory& memory = tile.memory;
  const size_t places = tile.places;
  const ptrdiff_t row_places = bordered.width * static_cast<ptrdiff_t>(places);
  // Propagates the prior costs of row y along the row in direction `step`. If `from` is not 0,
  // prior costs are also propagated from row y + from to row y.
  const auto spread = [&](int32_t y, ptrdiff_t step, int32_t from) {
    const uint8_t* swept = tile.swept + setup.At(0, y + from);
    tile.ForRow(y, [&](int32_t begin, int32_t end) {
      // Pixels for which no disparity is searched (swept[x] == 0) contribute no prior costs.
      for (int32_t x = begin; from != 0 && x < end; ++x) {
        if (swept[x] != 0) continue;
        std::fill_n(memory.prior + tile.At(x, y + from), places, simd::kMostPrior);
      }
      uint8_t* first = memory.prior + tile.At(step > 0 ? begin : end - 1, y);
      tile.kernels.PropagatePrior(first, from != 0 ? first + from * row_places : nullptr, places,
                                  step, static_cast<size_t>(end - begin));
    });
  };
  const int32_t bottom = bordered.y + bordered.height - 1;
  for (int32_t y = bordered.y; y <= bottom; ++y) {
    const int16_t* disparity = trusted + setup.At(0, y);
    tile.ForRow(y, [&](int32_t begin, int32_t end) {
      for (int32_t x = begin; x < end; ++x) {
        SeedPrior(setup, disparity[x], places, memory.prior + tile.At(x, y));
      }
    });
    // First spread the prior forwards along row y and from the row above, then backwards along row
    // y.
    spread(y, 1, y > bordered.y ? -1 : 0);
    spread(y, -1, 0);
  }
  for (int32_t y = bottom; y >= bordered.y; --y) {
    spread(y, -1, y < bottom ? 1 : 0);
    spread(y, 1, 0);
    tile.ForRow(y, [&](int32_t begin, int32_t end) {
      const size_t at = tile.At(begin, y);
      tile.kernels.AddPrior(memory.prior + at, static_cast<size_t>(end - begin) * places,
                            memory.cost + at);
    });
  }
}

// Fills memory.given_cost with the cost of the given disparity, and memory.found_cost with the
// cost of memory.second, for the pixels of `tile_rect`. The written costs exclude the prior costs
// of AddMapPrior.
void WeighEvidence(const SweptTile& tile, const Rect& tile_rect, const EstimateMemory& memory) {
  const SweepSetup& setup = tile.setup;
  ForSwept(setup, tile.swept, tile_rect, [&](int32_t x, int32_t y) {
    const size_t at = setup.At(x, y);
    const int32_t given = memory.given[at];
    const uint8_t* cost = tile.memory.cost + tile.At(x, y);
    const uint8_t* prior = tile.memory.prior + tile.At(x, y);
    const int32_t is = LabelOf(setup, memory.second[at]);
    const int32_t was = given == simd::kNoSurface ? is : LabelOf(setup, given);
    memory.given_cost[at] = static_cast<uint8_t>(cost[was] - prior[was]);
    memory.found_cost[at] = static_cast<uint8_t>(cost[is] - prior[is]);
  });
}

}  // namespace

TileMemory TakeTileMemory(const SweepSetup& setup, const Rect& bordered, Arena* arena) {
  const auto width = static_cast<size_t>(bordered.width);
  const size_t area = width * static_cast<size_t>(bordered.height);
  const auto labels = static_cast<size_t>(setup.labels), places = simd::PathLabels(labels);
  TileMemory tile = {};
  tile.views = TakeTileViews(setup, bordered, arena);
  tile.cost = arena->Take<uint8_t>(area, places);
  tile.prior = setup.repairs ? arena->Take<uint8_t>(area, places) : nullptr;
  tile.sum = arena->Take<int16_t>(area, places);
  for (int k = 0; k < 2; ++k) {
    int16_t* path = arena->Take<int16_t>((width + 2) * places + 1);
    tile.path[k] = path == nullptr ? nullptr : path + places + 1;
    int16_t* least = arena->Take<int16_t>(width + 2);
    tile.least[k] = least == nullptr ? nullptr : least + 1;
  }
  tile.jump = arena->Take<int16_t>(width);
  tile.moves = arena->Take<simd::ViewMove>(labels, static_cast<size_t>(setup.side_views));
  tile.choice = arena->Take<int16_t>(width);
  return tile;
}

void SweepTile(const Sweep& sweep, bool one_side, int32_t index, int32_t worker, int16_t* disparity,
               uint8_t* certainty) {
  const SweepSetup setup = one_side && sweep.setup.repairs ? CoarseSetup(sweep.setup) : sweep.setup;
  const EstimateMemory& memory = sweep.memory;
  TileViews* views = &memory.workers[worker].views;
  const Rect tile_rect = TileOf(setup, index);
  if (tile_rect.width == 0 || tile_rect.height == 0) return;
  const Rect bordered = WithBorder(setup, index);
  LoadTileViews(setup, sweep.light_field, bordered, sweep.kernels, views);
  FindMoves(setup, *views, memory.workers[worker].moves);
  if (one_side) {
    MarkOutside(setup, views);
  } else if (setup.one_sided()) {
    MarkHiddenInMaps(setup, memory.side_maps, views);
  } else {
    MarkHidden(setup, memory.first, bordered, views);
  }
  const SweptTile tile = {setup,         bordered,
                          sweep.kernels, memory.workers[worker],
                          memory.swept,  simd::PathLabels(static_cast<size_t>(setup.labels))};
  MeasureCosts(tile, one_side);
  if (setup.repairs) AddMapPrior(tile, memory.trusted);
  AddAllPaths(tile);
  ChooseDisparities(tile, tile_rect, disparity, certainty);
  if (setup.repairs && !one_side) WeighEvidence(tile, tile_rect, memory);
}

}  // namespace starfocus
