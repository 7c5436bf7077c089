// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/hair_coverage.h"

#include <algorithm>

#include "lib/base/fixed.h"

namespace starfocus {

// Votes of half of the near pixels of a block on whether the block shows hair. All but the first
// two members count pixels 2 to 4 cells inside outlines, where it does not matter if outlines are
// off by a few pixels.
struct HairVotes {
  int32_t near, near_far;  // Number of pixels; of pixels that look like background, times 256.
  // Number of pixels; of pixels that look like background, times 256; of pixels whose colours are
  // nearly the background's.
  int32_t inside, far, same;
  // Sum of coverage, sum of squares, and sum of squared differences from the mean of the pixel's
  // cell; the coverage is in units of 1/256.
  int32_t sum, squares, fine;
  // To what degree the colours in and around the block are those of hair, 0 to 256.
  int32_t found;
  int32_t hair;  // To what degree the block shows hair, 0 to 256.
};

namespace {

constexpr int32_t kCell = kColourCell;
// An edge is a difference of disparity of more than kEdgeStep between two surfaces
// (kDisparityBits) that are at most kSurfaceReach cells from the cell.
constexpr int32_t kEdgeStep = 5 << kDisparityBits;
constexpr int32_t kSurfaceReach = 10;
// Radii in cells. A far cell has no near pixels within kBeside. An inside cell has far pixels
// within kMostInside but not within kBeside.
constexpr int32_t kBeside = 1, kMostInside = 4;
// Hair from which on a cell keeps its disparities.
constexpr uint8_t kHairy = 128;
// log2 of the side of a block, in cells.
constexpr int kBlockBits = 3;
constexpr int32_t kBlock = 1 << kBlockBits;
constexpr int32_t BlocksOf(int32_t cells) { return (cells + kBlock - 1) / kBlock; }

// Picture and memory of the phases of FindHairCoverage. Each phase processes rows of blocks.
struct Search {
  const HairPicture& picture;
  const HairMemory& memory;
  int32_t columns = memory.columns, rows = memory.rows;
  int32_t block_columns = BlocksOf(columns), block_rows = BlocksOf(rows);

  HairVotes& VotesAt(int32_t column, int32_t row) const {
    return memory.votes[ptrdiff_t{row} * block_columns + column];
  }
};

// Calls act(column, row, at) for all cells of the rows of blocks.
template <class Act>
void ForCells(const Search& search, const Range& blocks, const Act& act) {
  for (int32_t row = kBlock * blocks.first; row < Min(kBlock * blocks.last, search.rows); ++row) {
    for (int32_t column = 0; column < search.columns; ++column) {
      act(column, row, search.memory.At(column, row));
    }
  }
}

// One pixel of a cell.
struct CellPixel {
  int32_t column, row;  // Position in the cell.
  bool is_near;
  uint8_t* coverage;
  uint16_t rgb[3];  // kMeanBits
};

// Calls act(pixel) for all pixels of a cell.
template <class Act>
void ForPixels(const Search& search, int32_t column, int32_t row, const Act& act) {
  const HairPicture& picture = search.picture;
  const size_t at = search.memory.At(column, row);
  const int32_t left = column * kCell, top = row * kCell;
  for (int32_t y = top; y < Min(top + kCell, picture.height); ++y) {
    for (int32_t x = left; x < Min(left + kCell, picture.width); ++x) {
      CellPixel pixel = {x - left, y - top, false, picture.coverage.Row(y) + x, {}};
      pixel.is_near = search.memory.IsNear(at, picture.disparity.Row(y)[x]);
      const uint8_t* rgb = picture.rgb.Row(y) + 3 * ptrdiff_t{x};
      for (int c = 0; c < 3; ++c) pixel.rgb[c] = static_cast<uint16_t>(rgb[c] << kMeanBits);
      act(pixel);
    }
  }
}

// Returns true if a cell within `reach` of cell (column, row) has the mark `mark`.
bool HasWithin(const Search& search, int32_t column, int32_t row, int32_t reach, uint8_t mark) {
  const int32_t right = Min(column + reach, search.columns - 1);
  const int32_t bottom = Min(row + reach, search.rows - 1);
  for (int32_t y = Max(row - reach, 0); y <= bottom; ++y) {
    for (int32_t x = Max(column - reach, 0); x <= right; ++x) {
      if ((search.memory.marks[search.memory.At(x, y)] & mark) != 0) return true;
    }
  }
  return false;
}

bool IsFar(const Search& search, int32_t column, int32_t row) {
  return !HasWithin(search, column, row, kBeside, HairMemory::kHasNear);
}

// Measures the lowest and highest disparity of each cell.
void MeasureCells(const Search& search, const Range& blocks) {
  const HairPicture& picture = search.picture;
  ForCells(search, blocks, [&](int32_t column, int32_t row, size_t at) {
    int16_t low = INT16_MAX, high = INT16_MIN;
    for (int32_t y = row * kCell; y < Min((row + 1) * kCell, picture.height); ++y) {
      for (int32_t x = column * kCell; x < Min((column + 1) * kCell, picture.width); ++x) {
        low = std::min(low, picture.disparity.Row(y)[x]);
        high = std::max(high, picture.disparity.Row(y)[x]);
      }
    }
    search.memory.low[at] = low;
    search.memory.high[at] = high;
  });
}

// Joins each row with the row `shift` rows after it, from the first row on, or with the row before
// it, from the last row on. A row has `width` values.
template <class Join>
void JoinRows(int32_t rows, int32_t width, int32_t shift, bool after, const Join& join,
              int16_t* values) {
  for (int32_t k = 0; k + shift < rows; ++k) {
    int16_t* const to = values + ptrdiff_t{after ? k : rows - 1 - k} * width;
    const int16_t* const from = to + ptrdiff_t{after ? shift : -shift} * width;
    for (int32_t x = 0; x < width; ++x) to[x] = join(to[x], from[x]);
  }
}

// Replaces each value with the reduction by `join` over a square with the radius kSurfaceReach.
// With growing shifts, each value is joined with the kSurfaceReach values after it, and then with
// those before it, first along rows and then along columns.
template <class Join>
void JoinAround(const Search& search, const Join& join, int16_t* values) {
  for (const bool after : {true, false}) {
    for (const int32_t shift : {1, 2, 4, kSurfaceReach - 7}) {
      for (int32_t y = 0; y < search.rows; ++y) {
        JoinRows(search.columns, 1, shift, after, join, values + search.memory.At(0, y));
      }
      JoinRows(search.rows, search.columns, shift, after, join, values);
    }
  }
}

// Marks the cells.
void MarkCells(const Search& search, const Range& blocks) {
  const HairMemory& memory = search.memory;
  ForCells(search, blocks, [&](int32_t column, int32_t row, size_t at) {
    uint8_t& marks = memory.marks[at];
    marks = memory.high[at] - memory.low[at] > kEdgeStep ? HairMemory::kHasEdge : uint8_t{0};
    if (marks == 0) return;
    uint8_t has = 0;
    ForPixels(search, column, row, [&](const CellPixel& pixel) {
      has |= pixel.is_near ? HairMemory::kHasNear : HairMemory::kHasFar;
    });
    marks = static_cast<uint8_t>(marks | has);
  });
}

// Writes the mean colour of a cell to the lowest level of `pyramid`. The weight of a pixel is
// weight(pixel).
template <class Weight>
void Pull(const Search& search, int32_t column, int32_t row, const Weight& weight,
          const ColourPyramid& pyramid) {
  ColourSum sum;
  ForPixels(search, column, row,
            [&](const CellPixel& pixel) { sum.Add(pixel.rgb, weight(pixel)); });
  pyramid.levels[0].At(column, row) = sum.Mean();
}

// Computes background colours for the first pass, from far cells.
void PullFar(const Search& search, const Range& blocks) {
  ForCells(search, blocks, [&](int32_t column, int32_t row, size_t at) {
    search.memory.far.levels[0].At(column, row) = {};
    if (search.memory.marks[at] == 0 || !IsFar(search, column, row)) return;
    const auto weight = [](const CellPixel&) { return uint32_t{kFullyKnown}; };
    Pull(search, column, row, weight, search.memory.far);
  });
}

// Returns the squared difference between the colours of a pixel and of the background, in squared
// codes.
int32_t DistanceTo(const CellColours& far, const CellPixel& pixel) {
  int32_t sum = 0;
  for (int c = 0; c < 3; ++c) {
    const int32_t difference = pixel.rgb[c] - far.rgb[pixel.row][pixel.column][c];
    sum += difference * difference;
  }
  return sum >> (2 * kMeanBits);
}

// Returns the squared contrast of a near pixel to the background, in units of 4 squared codes, or 0
// for a far pixel.
uint32_t ContrastOf(const CellPixel& pixel, const CellColours& far) {
  return pixel.is_near ? static_cast<uint32_t>(DistanceTo(far, pixel)) / 4 : 0;
}

// MeasureContrast and PullNear compute foreground colours for the first pass, from near pixels
// weighted by their contrast to the background. MeasureContrast must run first, for all cells.
void MeasureContrast(const Search& search, const Range& blocks) {
  ForCells(search, blocks, [&](int32_t column, int32_t row, size_t at) {
    uint32_t most = 0;
    if ((search.memory.marks[at] & HairMemory::kHasNear) != 0) {
      CellColours far;
      InterpolateCell(search.memory.far, column, row, &far);
      ForPixels(search, column, row,
                [&](const CellPixel& pixel) { most = std::max(most, ContrastOf(pixel, far)); });
    }
    search.memory.contrast[at] = static_cast<uint16_t>(most);
  });
}

// ShareOf converts a coverage of 0 to 255 to a fraction of kFullyKnown. FourthPower computes the
// fourth power of a fraction of kFullyKnown.
constexpr int32_t ShareOf(uint8_t coverage) { return coverage + coverage / 128; }
constexpr uint32_t FourthPower(uint32_t share) {
  const uint32_t square = share * share / kFullyKnown;
  return square * square / kFullyKnown;
}

void PullNear(const Search& search, const Range& blocks) {
  const HairMemory& memory = search.memory;
  ForCells(search, blocks, [&](int32_t column, int32_t row, size_t at) {
    memory.near.levels[0].At(column, row) = {};
    if (memory.contrast[at] == 0) return;
    uint32_t most = 0;  // largest contrast in the cell and its eight neighbours
    for (int32_t y = Max(row - 1, 0); y <= Min(row + 1, search.rows - 1); ++y) {
      for (int32_t x = Max(column - 1, 0); x <= Min(column + 1, search.columns - 1); ++x) {
        most = std::max(most, uint32_t{memory.contrast[memory.At(x, y)]});
      }
    }
    CellColours far;
    InterpolateCell(memory.far, column, row, &far);
    const auto weight = [&](const CellPixel& pixel) {
      return FourthPower(kFullyKnown * ContrastOf(pixel, far) / most);
    };
    Pull(search, column, row, weight, memory.near);
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

// Returns the share `to` where `hair` is 255, the share `from` where it is 0, and mixtures between.
int32_t Faded(int32_t from, int32_t to, uint8_t hair) {
  return from + (to - from) * ShareOf(hair) / kFullyKnown;
}

// Squared difference of colours that are nearly equal, in squared codes.
constexpr int32_t kSame = 100;

// Counts the near pixels of a cell. A pixel looks like background if its coverage is less than a
// quarter.
void CountNear(const Search& search, int32_t column, int32_t row, bool inside, HairVotes* votes) {
  const CellMixer mixer(search.memory, column, row);
  int32_t count = 0, sum = 0, squares = 0;
  ForPixels(search, column, row, [&](const CellPixel& pixel) {
    if (!pixel.is_near) return;
    const Unmixed unmixed = mixer.Part(pixel, 0);
    ++count;
    sum += unmixed.share;
    squares += unmixed.share * unmixed.share;
    const int32_t far = unmixed.share < kWhole / 4 ? unmixed.trust : 0;
    votes->near_far += far;
    if (!inside) return;
    votes->far += far;
    votes->same += DistanceTo(mixer.far, pixel) < kSame ? 1 : 0;
  });
  votes->near += count;
  if (!inside || count == 0) return;
  votes->inside += count;
  votes->sum += sum;
  votes->squares += squares;
  votes->fine += squares - sum * sum / count;
}

// Returns true if a cell votes, which half of the cells of each block do. The pattern is the same
// in a mirrored block.
bool Votes(int32_t column, int32_t row) {
  const auto half = [](int32_t k) { return k ^ (k >> 2); };
  return ((half(column) ^ half(row)) & 1) == 0;
}

void CountVotes(const Search& search, const Range& blocks) {
  for (int32_t row = blocks.first; row < blocks.last; ++row) {
    std::fill_n(&search.VotesAt(0, row), search.block_columns, HairVotes{});
  }
  ForCells(search, blocks, [&](int32_t column, int32_t row, size_t at) {
    search.memory.hair[at] = 0;
    if ((search.memory.marks[at] & HairMemory::kHasNear) == 0 || !Votes(column, row)) return;
    const bool inside = !HasWithin(search, column, row, kBeside, HairMemory::kHasFar) &&
                        HasWithin(search, column, row, kMostInside, HairMemory::kHasFar);
    CountNear(search, column, row, inside,
              &search.VotesAt(column >> kBlockBits, row >> kBlockBits));
  });
}

// Calls act(votes, weight) for the blocks that are at most `reach` blocks away. The weight
// decreases with the distance, from (reach + 1)^2 to 1.
template <class Act>
void ForBlocksAround(const Search& search, int32_t column, int32_t row, int32_t reach,
                     const Act& act) {
  for (int32_t y = Max(row - reach, 0); y <= Min(row + reach, search.block_rows - 1); ++y) {
    for (int32_t x = Max(column - reach, 0); x <= Min(column + reach, search.block_columns - 1);
         ++x) {
      act(search.VotesAt(x, y), (reach + 1 - Abs(x - column)) * (reach + 1 - Abs(y - row)));
    }
  }
}

// Returns 0 up to `low`, 256 from `high` on, and values between.
int32_t Fade(int64_t value, int32_t low, int32_t high) {
  return Clamp(256 * (static_cast<int32_t>(value) - low) / (high - low), 0, 256);
}

// Decides to what degree the colours in and around a block are those of hair, 0 to 256. They are if
// three shares are large: the share of pixels that look like background; the share of pixels that
// have nearly its colour, which surfaces that happen to resemble the background rarely have; and
// the part of the variance of the coverage that lies within cells, because shading varies slowly.
int32_t FindHair(const Search& search, int32_t column, int32_t row) {
  // 2048 votes against hair decide where there are few pixels.
  int64_t inside = 2048, far = 0, same = 0, coarse = 1, fine = 0;
  ForBlocksAround(search, column, row, 3, [&](const HairVotes& votes, int32_t weight) {
    const int64_t sum = votes.sum;
    inside += weight * votes.inside;
    far += weight * votes.far;
    same += weight * votes.same;
    if (votes.inside > 0) coarse += weight * (votes.squares - sum * sum / votes.inside);
    fine += weight * votes.fine;
  });
  const int64_t share = 1024 * far / (kWhole * inside);
  const int64_t colours = share * 16 * same / inside;
  return Fade(colours, 100, 130) * Fade(1024 * fine / coarse, 560, 590) / 256;
}

// Decides to what degree a block shows hair, 0 to 256. Hair extends to the blocks around those with
// the colours of hair, because its tips have few pixels inside outlines, but not to outlines at
// which few pixels look like background.
int32_t ExtendHair(const Search& search, int32_t column, int32_t row) {
  int32_t found = 0, near = 32, far = 0;
  ForBlocksAround(search, column, row, 2,
                  [&](const HairVotes& votes, int32_t) { found = Max(found, votes.found); });
  ForBlocksAround(search, column, row, 1, [&](const HairVotes& votes, int32_t) {
    near += votes.near;
    far += votes.near_far;
  });
  return found * Fade(far / near, 26, 41) / 256;  // shares of 0.10 to 0.16
}

// Returns the degree to which a cell shows hair, 0 to 255, interpolated bilinearly between the
// centres of blocks.
uint8_t HairOf(const Search& search, int32_t column, int32_t row) {
  // Position in half cells behind the centre of the first block.
  const int32_t across = Max(2 * column + 1 - kBlock, 0), down = Max(2 * row + 1 - kBlock, 0);
  const int32_t x = across / (2 * kBlock), y = down / (2 * kBlock);
  const int32_t right = Min(x + 1, search.block_columns - 1);
  const int32_t bottom = Min(y + 1, search.block_rows - 1);
  const int32_t dx = across % (2 * kBlock), dy = down % (2 * kBlock);
  const auto between = [&](int32_t block_row) {
    return (2 * kBlock - dx) * search.VotesAt(x, block_row).hair +
           dx * search.VotesAt(right, block_row).hair;
  };
  const int32_t hair = (2 * kBlock - dy) * between(y) + dy * between(bottom);
  return static_cast<uint8_t>(Min(hair / (4 * kBlock * kBlock), UINT8_MAX));
}

// Decides which cells show hair. Returns true if any cell has hair.
bool FillHair(const Search& search) {
  for (const bool found : {true, false}) {
    for (int32_t row = 0; row < search.block_rows; ++row) {
      for (int32_t column = 0; column < search.block_columns; ++column) {
        HairVotes& votes = search.VotesAt(column, row);
        (found ? votes.found : votes.hair) =
            found ? FindHair(search, column, row) : ExtendHair(search, column, row);
      }
    }
  }
  bool any = false;
  ForCells(search, {0, search.block_rows}, [&](int32_t column, int32_t row, size_t at) {
    if (search.memory.marks[at] == 0) return;
    search.memory.hair[at] = HairOf(search, column, row);
    any = any || search.memory.hair[at] >= kHairy;
  });
  return any;
}

// Returns `share` without the coverage that may be caused by texture of the background.
int32_t WithoutTexture(int32_t share) {
  return Max(0, (share - kTexture) * kWhole / (kWhole - kTexture));
}

// Writes the coverage of cells with hair. In the second pass (kAgain), the background colour of a
// pixel is mixed with the pixel's own colour. The share of the pixel's own colour increases as the
// coverage from the first pass decreases.
template <bool kAgain>
void UnmixCells(const Search& search, const Range& blocks) {
  ForCells(search, blocks, [&](int32_t column, int32_t row, size_t at) {
    if (search.memory.hair[at] == 0) return;
    const CellMixer mixer(search.memory, column, row);
    ForPixels(search, column, row, [&](const CellPixel& pixel) {
      const auto beside = static_cast<uint32_t>(kWhole - ShareOf(*pixel.coverage));
      const uint32_t own = kAgain ? FourthPower(beside) : 0;
      const Unmixed unmixed = mixer.Part(pixel, static_cast<int32_t>(own));
      const int32_t found = pixel.is_near ? unmixed.share : WithoutTexture(unmixed.share);
      const int32_t otherwise = pixel.is_near ? kWhole : 0;
      const int32_t share = unmixed.trust * found + (kWhole - unmixed.trust) * otherwise;
      *pixel.coverage =
          static_cast<uint8_t>((share * UINT8_MAX + kWhole * kWhole / 2) / (kWhole * kWhole));
    });
  });
}

// Computes foreground and background colours for the second pass, from all pixels weighted by the
// coverage of the first pass.
void PullBoth(const Search& search, const Range& blocks) {
  const HairMemory& memory = search.memory;
  ForCells(search, blocks, [&](int32_t column, int32_t row, size_t at) {
    ColourSum near, far;
    if (memory.marks[at] != 0) {
      ForPixels(search, column, row, [&](const CellPixel& pixel) {
        const int32_t given = pixel.is_near ? kWhole : 0;
        // The coverage of cells without hair has not been written.
        const int32_t found = memory.hair[at] == 0 ? given : ShareOf(*pixel.coverage);
        const auto share = static_cast<uint32_t>(Faded(given, found, memory.hair[at]));
        near.Add(pixel.rgb, FourthPower(share));
        far.Add(pixel.rgb, FourthPower(kWhole - share));
      });
    }
    memory.near.levels[0].At(column, row) = near.Mean();
    memory.far.levels[0].At(column, row) = far.Mean();
  });
}

}  // namespace

HairMemory TakeHairMemory(int32_t width, int32_t height, Arena* arena) {
  HairMemory memory = {};
  memory.columns = (width + kCell - 1) / kCell;
  memory.rows = (height + kCell - 1) / kCell;
  const auto columns = static_cast<size_t>(memory.columns);
  const auto rows = static_cast<size_t>(memory.rows);
  memory.low = arena->Take<int16_t>(columns, rows);
  memory.high = arena->Take<int16_t>(columns, rows);
  memory.marks = arena->Take<uint8_t>(columns, rows);
  memory.hair = arena->Take<uint8_t>(columns, rows);
  return memory;
}

void TakeHairColours(int32_t width, int32_t height, Arena* arena, HairMemory* memory) {
  memory->far = TakeColourPyramid(width, height, arena);
  memory->near = TakeColourPyramid(width, height, arena);
  const auto columns = static_cast<size_t>(memory->columns);
  const auto rows = static_cast<size_t>(memory->rows);
  memory->contrast = arena->Take<uint16_t>(columns, rows);
  const auto across = static_cast<size_t>(BlocksOf(memory->columns));
  memory->votes = arena->Take<HairVotes>(across, static_cast<size_t>(BlocksOf(memory->rows)));
}

bool FindHairCoverage(const HairPicture& picture, const HairMemory& memory, Sequence* run) {
  const Search search = {picture, memory};
  bool found = true;
  // Runs a phase of the search. When the phase has finished all cells, `conclude` processes the
  // results for the whole picture. The search ends if `conclude` returns false.
  const auto phase = [&](void (*work)(const Search&, const Range&), const auto& conclude) {
    if (!found) return run->Skip();
    run->Run([&](int32_t index, int32_t) {
      work(search, PartOf({0, search.block_rows}, index, run->count()));
    });
    found = run->status() == STARFOCUS_OK && conclude();
  };
  const auto always = [] { return true; };
  const auto join = [&] {
    const auto least = [](int16_t a, int16_t b) { return std::min(a, b); };
    const auto most = [](int16_t a, int16_t b) { return std::max(a, b); };
    JoinAround(search, least, memory.low);
    JoinAround(search, most, memory.high);
    return true;
  };
  phase(MeasureCells, join);
  phase(MarkCells, always);
  phase(PullFar, [&] { return CarryOnColours(memory.far); });
  phase(MeasureContrast, always);
  phase(PullNear, [&] { return CarryOnColours(memory.near); });
  phase(CountVotes, [&] { return FillHair(search); });
  phase(UnmixCells<false>, always);
  phase(PullBoth, [&] { return CarryOnColours(memory.far) && CarryOnColours(memory.near); });
  phase(UnmixCells<true>, always);
  return found;
}

bool HasHair(const HairMemory& memory, const Rect& rect) {
  for (int32_t y = rect.y / kCell; y <= (rect.y + rect.height - 1) / kCell; ++y) {
    for (int32_t x = rect.x / kCell; x <= (rect.x + rect.width - 1) / kCell; ++x) {
      if (memory.hair[memory.At(x, y)] >= kHairy) return true;
    }
  }
  return false;
}

void CompleteCoverage(const HairMemory& memory, const Range& columns, int32_t y,
                      const int16_t* disparity, uint8_t* coverage, uint8_t* confidence) {
  for (int32_t x = columns.first; x < columns.last; ++x) {
    const int32_t k = x - columns.first;
    const size_t at = memory.At(x / kCell, y / kCell);
    const bool is_near = memory.marks[at] == 0 || memory.IsNear(at, disparity[k]);
    const int32_t given = is_near ? UINT8_MAX : 0;
    if (memory.hair[at] == 0) {
      coverage[k] = static_cast<uint8_t>(given);
    } else {
      coverage[k] = static_cast<uint8_t>(Faded(given, coverage[k], memory.hair[at]));
      if (confidence != nullptr) {
        confidence[k] = static_cast<uint8_t>(UINT8_MAX - Abs(coverage[k] - given));
      }
    }
  }
}

}  // namespace starfocus
