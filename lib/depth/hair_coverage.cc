// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/hair_coverage.h"

#include <initializer_list>

#include "lib/base/fixed.h"

namespace starfocus {

// Counts over a tile. `inside` is the number of near pixels that lie 2 to 4 cells inside outlines.
// `far` is the number of such inside pixels that look like background, multiplied by 256.
struct InsideCount {
  int32_t inside, far;
};

namespace {

// Input, output and memory of the phases of FindHairCoverage. Each phase processes one tile at a
// time.
struct HairSearch {
  const ColourMap& map;
  const MapOutput& output;
  const HairCells& cells;
  const HairMemory& memory;

  Rect Tile(int32_t index) const { return TileOf(map.setup, index); }
  uint8_t& CoverageAt(int32_t x, int32_t y) const { return output.coverage.Row(y)[x]; }
};

// ShareOf converts a coverage of 0 to 255 to a fraction of kFullyKnown. FourthPower computes the
// fourth power of a fraction of kFullyKnown.
inline uint32_t ShareOf(uint8_t coverage) { return coverage + coverage / 128U; }
inline uint32_t FourthPower(uint32_t share) {
  const uint32_t square = share * share / kFullyKnown;
  return square * square / kFullyKnown;
}

// One pixel of a cell.
struct CellPixel {
  int32_t x, y;         // Position in the picture.
  int32_t column, row;  // Position in the cell.
  bool is_near;
  uint16_t rgb[3];  // kMeanBits
};

// Calls act(pixel) for all pixels of a cell.
template <class Act>
void ForPixels(const HairSearch& search, int32_t column, int32_t row, const Act& act) {
  const Rect cell = HairCellAt(search.map.setup, column, row);
  const size_t at = search.cells.At(column, row);
  for (int32_t y = 0; y < cell.height; ++y) {
    for (int32_t x = 0; x < cell.width; ++x) {
      CellPixel pixel = {cell.x + x, cell.y + y, x, y, false, {}};
      pixel.is_near =
          search.cells.IsNear(at, search.map.disparity[search.map.setup.At(pixel.x, pixel.y)]);
      const uint8_t* rgb = search.map.Pixel(pixel.x, pixel.y);
      for (int c = 0; c < 3; ++c) pixel.rgb[c] = static_cast<uint16_t>(rgb[c] << kMeanBits);
      act(pixel);
    }
  }
}

// Calls act(column, row, marks) for all cells of a tile.
template <class Act>
void ForMarked(const HairSearch& search, int32_t index, const Act& act) {
  const HairCells& cells = search.cells;
  ForHairCells(search.Tile(index), [&](int32_t column, int32_t row) {
    act(column, row, cells.marks[cells.At(column, row)]);
  });
}

// Writes the mean colour of a cell to the lowest level of `pyramid`. The weight of a pixel is
// weight(pixel).
template <class Weight>
void Pull(const HairSearch& search, int32_t column, int32_t row, const Weight& weight,
          const ColourPyramid& pyramid) {
  ColourSum sum;
  ForPixels(search, column, row,
            [&](const CellPixel& pixel) { sum.Add(pixel.rgb, weight(pixel)); });
  pyramid.levels[0].At(column, row) = sum.Mean();
}

// Returns the squared contrast of a near pixel to the background, or 0 for a far pixel.
int32_t ContrastOf(const CellPixel& pixel, const CellColours& far) {
  if (!pixel.is_near) return 0;
  int32_t sum = 0;
  for (int c = 0; c < 3; ++c) {
    const int32_t difference = pixel.rgb[c] - far.rgb[pixel.row][pixel.column][c];
    sum += difference * difference;
  }
  return sum;
}

// Returns the largest squared contrast to the background in a cell and its eight neighbours.
int32_t ContrastAround(const HairSearch& search, int32_t column, int32_t row) {
  const HairCells& cells = search.cells;
  int32_t most = 0;
  for (int32_t y = Max(row - 1, 0); y <= Min(row + 1, cells.rows - 1); ++y) {
    for (int32_t x = Max(column - 1, 0); x <= Min(column + 1, cells.columns - 1); ++x) {
      most = Max(most, search.memory.contrast[cells.At(x, y)]);
    }
  }
  return most;
}

// Computes background colours for the first pass, from cells without near pixels nearby.
void PullFar(const HairSearch& search, int32_t index) {
  ForMarked(search, index, [&](int32_t column, int32_t row, uint8_t marks) {
    const bool far = (marks & HairCells::kIsFar) != 0;
    if (!far) search.memory.far.levels[0].At(column, row) = {};
    if (far)
      Pull(
          search, column, row, [](const CellPixel&) { return kFullyKnown; }, search.memory.far);
  });
}

// MeasureContrast and PullNear compute foreground colours for the first pass, from near pixels
// weighted by their contrast to the background. MeasureContrast must run first, for all tiles.
void MeasureContrast(const HairSearch& search, int32_t index) {
  ForMarked(search, index, [&](int32_t column, int32_t row, uint8_t marks) {
    int32_t most = 0;
    if (MayHaveNear(marks)) {
      CellColours far;
      InterpolateCell(search.memory.far, column, row, &far);
      ForPixels(search, column, row,
                [&](const CellPixel& pixel) { most = Max(most, ContrastOf(pixel, far)); });
    }
    search.memory.contrast[search.cells.At(column, row)] = most;
  });
}

void PullNear(const HairSearch& search, int32_t index) {
  ForMarked(search, index, [&](int32_t column, int32_t row, uint8_t) {
    if (search.memory.contrast[search.cells.At(column, row)] == 0) {
      search.memory.near.levels[0].At(column, row) = {};
      return;
    }
    const int64_t most = ContrastAround(search, column, row) + int64_t{1};
    CellColours far;
    InterpolateCell(search.memory.far, column, row, &far);
    const auto weight = [&](const CellPixel& pixel) {
      return FourthPower(
          static_cast<uint32_t>(kFullyKnown * int64_t{ContrastOf(pixel, far)} / most));
    };
    Pull(search, column, row, weight, search.memory.near);
  });
}

// Computes foreground and background colours for the second pass, from all pixels weighted by the
// coverage of the first pass.
void PullBoth(const HairSearch& search, int32_t index) {
  ForMarked(search, index, [&](int32_t column, int32_t row, uint8_t marks) {
    if (marks == 0) {
      search.memory.far.levels[0].At(column, row) = {};
      search.memory.near.levels[0].At(column, row) = {};
      return;
    }
    const bool has_hair = (marks & HairCells::kHasHair) != 0;
    const auto share = [&](const CellPixel& pixel) {
      if (!has_hair) return pixel.is_near ? uint32_t{kFullyKnown} : 0;
      return ShareOf(search.CoverageAt(pixel.x, pixel.y));
    };
    Pull(
        search, column, row, [&](const CellPixel& pixel) { return FourthPower(share(pixel)); },
        search.memory.near);
    Pull(
        search, column, row,
        [&](const CellPixel& pixel) { return FourthPower(kFullyKnown - share(pixel)); },
        search.memory.far);
  });
}

constexpr int32_t kWhole = kFullyKnown;
// Square of a colour difference of one code, for mean colours with kMeanBits fractional bits.
constexpr int64_t kSquareCode = int64_t{1} << (2 * kMeanBits);
// Smallest squared contrast at which coverage can be measured.
constexpr int64_t kLeastContrast = 300 * kSquareCode;
// Parameters of the variance of a colour's distance from the line between foreground and background
// colour. The variance is kNoise, which is the square of 9 codes, plus the squared contrast divided
// by kVariation. The second term accounts for variation within surfaces.
constexpr int64_t kNoise = 81 * kSquareCode, kVariation = 16;
// Largest coverage that is attributed to the texture of the background.
constexpr int32_t kTexture = kWhole / 8;

// Result of the comparison of a pixel's colour with the line from the background to the foreground
// colour. `share` is the coverage, which is the position along the line. `trust` decreases with the
// distance of the colour from the line. `share` and `trust` are fractions of kWhole.
struct Unmixed {
  int32_t share, trust;
};

Unmixed Unmix(const int32_t* far, const int32_t* near, const uint16_t* mixed) {
  int64_t along = 0, contrast = 0, distance = 0;  // 30 bits
  for (int c = 0; c < 3; ++c) {
    const int64_t line = near[c] - far[c], from = mixed[c] - far[c];
    along += line * from;
    contrast += line * line;
    distance += from * from;
  }
  if (contrast < kLeastContrast) return {0, 0};
  const int64_t on = along < 0 ? 0 : along > contrast ? contrast : along;
  const int64_t beside = distance - (2 * along - on) * on / contrast;
  const int64_t scale = kNoise + contrast / kVariation;
  // The trust is (2.25 - distance^2 / variance) / 2, clamped to [0, 1].
  const int64_t trust = (9 * scale - 4 * beside) * kWhole / (8 * scale);
  return {static_cast<int32_t>(kWhole * on / contrast),
          static_cast<int32_t>(trust < 0        ? 0
                               : trust > kWhole ? kWhole
                                                : trust)};
}

// Foreground and background colours of the pixels of a cell.
struct CellMixer {
  CellColours far, near;

  CellMixer(const HairMemory& memory, int32_t column, int32_t row) {
    InterpolateCell(memory.far, column, row, &far);
    InterpolateCell(memory.near, column, row, &near);
  }
  // Computes the coverage of a pixel. `own` is the share of the pixel's own colour in the
  // background colour, as a fraction of kWhole.
  Unmixed Part(const CellPixel& pixel, int32_t own) const {
    int32_t behind[3];
    for (int c = 0; c < 3; ++c) {
      const int32_t around = far.rgb[pixel.row][pixel.column][c];
      behind[c] = (own * pixel.rgb[c] + (kWhole - own) * around + kWhole / 2) / kWhole;
    }
    return Unmix(behind, near.rgb[pixel.row][pixel.column], pixel.rgb);
  }
};

// Returns the degree to which a near pixel looks like background, as a fraction of kWhole.
int32_t LooksFar(const CellMixer& mixer, const CellPixel& pixel) {
  const Unmixed unmixed = mixer.Part(pixel, 0);
  return unmixed.share < kWhole / 4 ? unmixed.trust : 0;
}

// Returns `share` without the coverage that may be caused by texture of the background.
int32_t WithoutTexture(int32_t share) {
  return Max(0, (share - kTexture) * kWhole / (kWhole - kTexture));
}

// Writes the coverage of cells with hair. In the second pass (kAgain), the background colour of a
// pixel is mixed with the pixel's own colour. The share of the pixel's own colour increases as the
// coverage from the first pass decreases.
template <bool kAgain>
void UnmixTile(const HairSearch& search, int32_t index) {
  ForMarked(search, index, [&](int32_t column, int32_t row, uint8_t marks) {
    if ((marks & HairCells::kHasHair) == 0) return;
    const CellMixer mixer(search.memory, column, row);
    ForPixels(search, column, row, [&](const CellPixel& pixel) {
      uint8_t& coverage = search.CoverageAt(pixel.x, pixel.y);
      const uint32_t own = kAgain ? FourthPower(kWhole - ShareOf(coverage)) : 0;
      const Unmixed unmixed = mixer.Part(pixel, static_cast<int32_t>(own));
      const int32_t found = pixel.is_near ? unmixed.share : WithoutTexture(unmixed.share);
      const int32_t otherwise = pixel.is_near ? kWhole : 0;
      const int32_t share = unmixed.trust * found + (kWhole - unmixed.trust) * otherwise;
      coverage =
          static_cast<uint8_t>((share * UINT8_MAX + kWhole * kWhole / 2) / (kWhole * kWhole));
    });
  });
}

// Counts the near pixels that look like background, in the cells with kIsInside.
void CountInside(const HairSearch& search, int32_t index) {
  InsideCount count = {0, 0};
  ForMarked(search, index, [&](int32_t column, int32_t row, uint8_t marks) {
    if ((marks & HairCells::kIsInside) == 0) return;
    const CellMixer mixer(search.memory, column, row);
    ForPixels(search, column, row, [&](const CellPixel& pixel) {
      if (!pixel.is_near) return;
      ++count.inside;
      count.far += LooksFar(mixer, pixel);
    });
  });
  search.memory.counts[index] = count;
}

// Counts the near pixels that look like background in each cell.
void CountCells(const HairSearch& search, int32_t index) {
  ForMarked(search, index, [&](int32_t column, int32_t row, uint8_t marks) {
    int32_t far = 0, near = 0;
    if (MayHaveNear(marks)) {
      const CellMixer mixer(search.memory, column, row);
      ForPixels(search, column, row, [&](const CellPixel& pixel) {
        if (!pixel.is_near) return;
        ++near;
        far += LooksFar(mixer, pixel);
      });
    }
    const size_t at = search.cells.At(column, row);
    search.memory.near_pixels[at] = near;
    search.memory.contrast[at] = far;
  });
}

// A map has hair with closed outlines if, of the pixels 2 to 4 cells inside outlines, a share of
// more than kLeastFar looks like background. Shares are in units of 1/256. In maps that neural
// networks compute for the hair scene, a share of 80/256 looks like background. In exact maps, maps
// that are wrong by 3 pixels, and photographs, the share that looks like background is at most
// 28/256 (docs/depth.md).
constexpr int64_t kLeastFar = 48;

void MeasureTile(const HairSearch& search, int32_t index) {
  ForHairCells(search.Tile(index), [&](int32_t column, int32_t row) {
    MeasureHairCell(search.map, column, row, search.cells);
  });
}

// Returns true if the map has hair with closed outlines.
bool HasClosedHair(const HairSearch& search) {
  int64_t inside = 0, far = 0;
  for (int32_t k = 0; k < search.map.setup.columns * search.map.setup.rows; ++k) {
    inside += search.memory.counts[k].inside;
    far += search.memory.counts[k].far;
  }
  return far > kLeastFar * inside;
}

}  // namespace

HairMemory TakeHairMemory(const SweepSetup& setup, Arena* arena) {
  HairMemory memory;
  memory.far = TakeColourPyramid(setup.width, setup.height, arena);
  memory.near = TakeColourPyramid(setup.width, setup.height, arena);
  const ColourLevel& cells = memory.far.levels[0];
  for (int32_t** plane : {&memory.contrast, &memory.near_pixels}) {
    *plane =
        arena->Take<int32_t>(static_cast<size_t>(cells.columns), static_cast<size_t>(cells.rows));
  }
  memory.counts =
      arena->Take<InsideCount>(static_cast<size_t>(setup.columns), static_cast<size_t>(setup.rows));
  return memory;
}

bool FindHairCoverage(const ColourMap& map, const MapOutput& output, const HairCells& cells,
                      const HairMemory& memory, Sequence* run) {
  const HairSearch search = {map, output, cells, memory};
  bool found = true;
  // Runs a phase of the search. When the phase has finished all tiles, `conclude` processes the
  // results for the whole picture. The search ends if `conclude` returns false.
  const auto phase = [&](void (*work)(const HairSearch&, int32_t), const auto& conclude) {
    if (!found) return run->Skip();
    run->Run([&](int32_t index, int32_t) { work(search, index); });
    found = run->status() == STARFOCUS_OK && conclude();
  };
  const auto always = [] { return true; };
  phase(MeasureTile, [&] { return MarkEdges(cells); });
  phase(PullFar, [&] { return CarryOnColours(memory.far); });
  phase(MeasureContrast, always);
  phase(PullNear, [&] { return CarryOnColours(memory.near); });
  phase(CountInside, [&] { return HasClosedHair(search); });
  phase(CountCells, [&] { return MarkHair(cells, memory.near_pixels, memory.contrast); });
  phase(UnmixTile<false>, always);
  phase(PullBoth, [&] { return CarryOnColours(memory.far) && CarryOnColours(memory.near); });
  phase(UnmixTile<true>, always);
  return found;
}

void CompleteCoverage(const ColourMap& map, const MapOutput& output, const HairCells& cells,
                      const Rect& tile) {
  ForHairCells(tile, [&](int32_t column, int32_t row) {
    const size_t at = cells.At(column, row);
    const Rect cell = HairCellAt(map.setup, column, row);
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      const float* disparities = output.disparity.Row(y);
      uint8_t* coverage = output.coverage.Row(y);
      for (int32_t x = cell.x; x < cell.x + cell.width; ++x) {
        const bool is_near = cells.marks[at] == 0 || cells.IsNear(at, ToFixed(disparities[x]));
        if ((cells.marks[at] & HairCells::kHasHair) == 0) {
          coverage[x] = is_near ? UINT8_MAX : uint8_t{0};
        } else {
          output.WriteConfidence(
              x, y, static_cast<uint8_t>(is_near ? coverage[x] : UINT8_MAX - coverage[x]));
        }
      }
    }
  });
}

}  // namespace starfocus
