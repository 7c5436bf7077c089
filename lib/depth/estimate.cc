// SPDX-License-Identifier: Apache-2.0
// Estimates a disparity map by two sweeps, and replaces stray disparities of the result. Also takes
// the memory of estimates and repairs.
#include <cstdlib>
#include <new>

#include "lib/base/fixed.h"
#include "lib/depth/sweep.h"
#include "lib/io/image.h"
#include "simd/disparities.h"

namespace starfocus {
namespace {

constexpr int32_t kRadius = 2;
constexpr int32_t kMostVotes = (2 * kRadius + 1) * (2 * kRadius + 1);
// A pixel is stray if its disparity differs from the weighted median of its neighbourhood by more
// than kStray (kDisparityBits). Pixels that are not stray keep their disparity, so that slopes are
// preserved. A neighbour of equal colour has the weight kVote. The weight halves with each kHalving
// grey levels of difference, summed over R, G and B.
constexpr int32_t kStray = 1 << (kDisparityBits - 2);
constexpr int32_t kVote = 64, kHalving = 14;

// Disparities with weights. Unused elements have weight 0. The arrays are members because the
// compiler vectorises the loop over them only then: as local arrays, they cost a tenth more
// instructions of the whole estimate.
struct Votes {
  static constexpr int32_t kPlaces = (kMostVotes + 7) / 8 * 8;  // whole vectors

  int32_t count = 0, weight = 0;
  int16_t disparity[kPlaces] = {};
  int16_t of[kPlaces] = {};

  void Add(int16_t d, int32_t vote) {
    disparity[count] = d;
    of[count++] = static_cast<int16_t>(vote);
    weight += vote;
  }

  // Returns the smallest disparity d in [low, high] for which disparities above d have at most half
  // of the total weight.
  int16_t Median(int32_t low, int32_t high) const {
    while (low < high) {
      const int32_t middle = (low + high) >> 1;
      const auto most = static_cast<int16_t>(middle);
      int16_t below = 0;
      for (int32_t k = 0; k < kPlaces; ++k) {
        below = static_cast<int16_t>(below + (disparity[k] <= most ? of[k] : int16_t{0}));
      }
      if (2 * below < weight) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return static_cast<int16_t>(low);
  }
};

int32_t Apart(const uint8_t* a, const uint8_t* b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

// Finds the range of the disparities in the rectangle `around`.
void FindRange(const SweepSetup& setup, const int16_t* map, const Rect& around, int32_t* low,
               int32_t* high) {
  int32_t least = INT16_MAX, most = INT16_MIN;
  ForPixels(around, [&](int32_t x, int32_t y) {
    const int32_t disparity = map[setup.At(x, y)];
    least = Min(least, disparity);
    most = Max(most, disparity);
  });
  *low = least;
  *high = most;
}

// A hidden strip is at most as wide as the largest movement. kBesideHidden is the number of pixels
// next to a hidden strip that may be wrong. The limit kMostHidden bounds the time in pictures in
// which no pixel is seen.
constexpr int32_t kBesideHidden = 16, kMostHidden = 128;

// Returns true if a side view shows pixel (x, y) at disparity d.
bool IsSeen(const SweepSetup& setup, const EstimateMemory& memory, int32_t x, int32_t y,
            int32_t d) {
  for (int32_t k = 0; k < setup.side_views; ++k) {
    const int32_t column = x + WholeMoveBy(setup.side[k].at.u, d);
    const int32_t row = y + WholeMoveBy(setup.side[k].at.v, d);
    if (column < 0 || column >= setup.width || row < 0 || row >= setup.height) continue;
    const int16_t* line = SideMap(setup, memory, k) + ptrdiff_t{row} * setup.width;
    if (Abs(line[column] - d) <= kSurfaceDepth) return true;
  }
  return false;
}

// Returns the disparity of the nearest pixel in a direction from pixel (x, y) that a side view
// shows, or kNoSurface if no side view shows a pixel within `reach` pixels.
int16_t SeenBeside(const SweepSetup& setup, const int16_t* seen, int32_t x, int32_t y,
                   const int8_t* direction) {
  const int32_t reach = Min(setup.reach + kBesideHidden, kMostHidden);
  for (int32_t k = 1; k <= reach; ++k) {
    const int32_t column = x + k * direction[0], row = y + k * direction[1];
    if (column < 0 || column >= setup.width || row < 0 || row >= setup.height) break;
    const int16_t d = seen[ptrdiff_t{row} * setup.width + column];
    if (d != simd::kNoSurface) return d;
  }
  return simd::kNoSurface;
}

// Returns the second smallest disparity of the nearest seen pixels in eight directions. If only one
// pixel is found, returns the disparity of this pixel. If no pixel is found, returns kNoSurface.
// The second smallest disparity is robust to a single disparity that is too small.
int16_t FarBeside(const SweepSetup& setup, const int16_t* seen, int32_t x, int32_t y) {
  int32_t least = INT32_MAX, second = INT32_MAX;
  for (const auto& direction : kEightDirections) {
    const int16_t d = SeenBeside(setup, seen, x, y, direction);
    if (d == simd::kNoSurface) continue;
    second = Min(second, Max(least, d));
    least = Min(least, d);
  }
  if (least == INT32_MAX) return simd::kNoSurface;
  return static_cast<int16_t>(second == INT32_MAX ? least : second);
}

// Makes side view k of the setup the reference of an estimate, whose only side view is the centre
// view.
void MakeSideReference(const SweepSetup& setup, const starfocus_light_field& light_field, int32_t k,
                       SweepSetup* side_setup, starfocus_light_field* side_field) {
  const SideView& view = setup.side[k];
  *side_field = light_field;
  side_field->views[0] = light_field.views[view.index];
  side_field->views[1] = light_field.views[0];
  *side_setup = setup;
  side_setup->side_views = 1;
  side_setup->side[0] = {1, {static_cast<int16_t>(-view.at.u), static_cast<int16_t>(-view.at.v)}};
  side_setup->sides[0] = 1;
}

// Copies memory.second to memory.first for the pixels of `tile`. Pixels that no side view shows
// are set to kNoSurface.
void FindUnseen(const SweepSetup& setup, const Rect& tile, const EstimateMemory& memory) {
  ForPixels(tile, [&](int32_t x, int32_t y) {
    const size_t at = setup.At(x, y);
    const int16_t d = memory.second[at];
    memory.first[at] = IsSeen(setup, memory, x, y, d) ? d : simd::kNoSurface;
  });
}

// Sets each pixel of `tile` that is kNoSurface in memory.first to the disparity of the adjacent
// background, which is the second smallest disparity of the nearest known pixels in eight
// directions. Writes the disparities to memory.second and sets the certainty to 0. Pixels without
// known pixels nearby keep their disparity.
void FillUnseen(const SweepSetup& setup, const Rect& tile, const EstimateMemory& memory) {
  ForPixels(tile, [&](int32_t x, int32_t y) {
    const size_t at = setup.At(x, y);
    if (memory.first[at] != simd::kNoSurface) return;
    memory.certainty[at] = 0;
    const int16_t far = FarBeside(setup, memory.first, x, y);
    if (far != simd::kNoSurface) memory.second[at] = far;
  });
}

// Writes a tile of the result. Pixels that WithoutStray changes get confidence 0.
void WriteTile(const SweepSetup& setup, const Plane<const uint8_t>& centre, const Rect& tile,
               const EstimateMemory& memory, const MapOutput& output) {
  ForPixels(tile, [&](int32_t x, int32_t y) {
    const size_t at = setup.At(x, y);
    const int32_t d = WithoutStray(setup, centre, memory.second, x, y);
    output.Write(x, y, d);
    const bool overruled = std::abs(d - memory.second[at]) > 1 << kDisparityBits;
    output.WriteConfidence(x, y, overruled ? uint8_t{0} : memory.certainty[at]);
  });
}

}  // namespace

int16_t WithoutStray(const SweepSetup& setup, const Plane<const uint8_t>& centre,
                     const int16_t* map, int32_t x, int32_t y) {
  const Rect around = Widened(setup, {x, y, 1, 1}, kRadius);
  const int16_t own = map[setup.At(x, y)];
  int32_t low, high;
  FindRange(setup, map, around, &low, &high);
  // If all disparities in the neighbourhood are within kStray of the pixel's disparity, their
  // median is within kStray.
  if (low >= own - kStray && high <= own + kStray) return own;
  const uint8_t* here = centre.Row(y) + 3 * x;
  Votes votes;
  ForPixels(around, [&](int32_t column, int32_t row) {
    const int32_t halvings = Apart(here, centre.Row(row) + 3 * column) / kHalving;
    const int32_t vote = halvings < 7 ? kVote >> halvings : 0;
    if (vote > 0) votes.Add(map[setup.At(column, row)], vote);
  });
  const int16_t median = votes.Median(low, high);
  return std::abs(own - median) > kStray ? median : own;
}

Jobs* TakeJobs(const SweepSetup& setup, int32_t max_workers, Arena* arena) {
  auto* jobs = arena->Take<Jobs>(1);
  const auto tiles = static_cast<size_t>(setup.columns) * static_cast<size_t>(setup.rows);
  auto* progress = arena->Take<std::atomic<uint32_t>>(ProgressWords(tiles));
  if (jobs == nullptr) return nullptr;
  new (jobs) Jobs();
  jobs->max_workers = max_workers;
  jobs->progress = progress;
  return jobs;
}

EstimateMemory TakeEstimate(const SweepSetup& setup, int32_t max_workers, Arena* arena) {
  const auto width = static_cast<size_t>(setup.width), height = static_cast<size_t>(setup.height);
  const auto tiles = static_cast<size_t>(setup.columns) * static_cast<size_t>(setup.rows);
  EstimateMemory memory = {};
  memory.jobs = TakeJobs(setup, max_workers, arena);
  memory.first = arena->Take<int16_t>(width, height);
  memory.second = arena->Take<int16_t>(width, height);
  arena->Overlap([&] { memory.certainty = arena->Take<uint8_t>(width, height); },
                 [&] { memory.doubt = arena->Take<uint8_t>(width, height); });
  if (setup.one_sided()) {
    memory.side_maps = arena->Take<int16_t>(width * height, static_cast<size_t>(setup.side_views));
  }
  if (setup.repairs) {
    memory.given = arena->Take<int16_t>(width, height);
    memory.trusted = arena->Take<int16_t>(width, height);
    memory.given_cost = arena->Take<uint8_t>(width, height);
    memory.found_cost = arena->Take<uint8_t>(width, height);
    memory.swept = arena->Take<uint8_t>(width, height);
    memory.given_patches = TakeThinPatches(setup, arena);
    memory.found_patches = TakeThinPatches(setup, arena);
    memory.counts = arena->Take<TileCount>(tiles);
  }
  memory.workers = arena->Take<TileMemory>(static_cast<size_t>(max_workers));
  Rect largest = {0, 0, 0, 0};  // largest width and height of all tiles with their borders
  for (int32_t tile = 0; tile < setup.columns * setup.rows; ++tile) {
    const Rect bordered = WithBorder(setup, tile);
    largest.width = Max(largest.width, bordered.width);
    largest.height = Max(largest.height, bordered.height);
  }
  for (int32_t worker = 0; worker < max_workers; ++worker) {
    const TileMemory tile = TakeTileMemory(setup, largest, arena);
    if (memory.workers != nullptr) memory.workers[worker] = tile;
  }
  return memory;
}

starfocus_status Estimate(const SweepSetup& setup, const starfocus_light_field& light_field,
                          const simd::DepthKernels& kernels, const MapOutput& output,
                          const EstimateMemory& memory) {
  const Sweep sweep = {setup, light_field, kernels, memory};
  const bool one_sided = setup.one_sided();
  Sequence run(memory.jobs, one_sided ? setup.side_views + 4 : 3, setup.columns * setup.rows);
  for (int32_t k = 0; one_sided && k < setup.side_views; ++k) {
    SweepSetup side_setup;
    starfocus_light_field side_field;
    MakeSideReference(setup, light_field, k, &side_setup, &side_field);
    const Sweep of_side = {side_setup, side_field, kernels, memory};
    run.Run([&](int32_t index, int32_t worker) {
      SweepTile(of_side, true, index, worker, SideMap(setup, memory, k), nullptr);
    });
  }
  if (!one_sided) {
    run.Run([&](int32_t index, int32_t worker) {
      SweepTile(sweep, true, index, worker, memory.first, nullptr);
    });
  }
  run.Run([&](int32_t index, int32_t worker) {
    SweepTile(sweep, false, index, worker, memory.second,
              output.confidence.data == nullptr ? nullptr : memory.certainty);
  });
  if (one_sided) {
    run.Run([&](int32_t index, int32_t) { FindUnseen(setup, TileOf(setup, index), memory); });
    run.Run([&](int32_t index, int32_t) { FillUnseen(setup, TileOf(setup, index), memory); });
  }
  run.Run([&](int32_t index, int32_t) {
    WriteTile(setup, RowsOf(light_field.views[0]), TileOf(setup, index), memory, output);
  });
  return run.status();
}

}  // namespace starfocus
