// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/hair_unmix.h"

#include "lib/base/fixed.h"
#include "lib/depth/hair_job.h"

namespace starfocus {
namespace {

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

template <bool kAgain>
void UnmixTile(const HairJob& job, int32_t index) {
  ForMarked(job, index, [&](int32_t column, int32_t row, uint8_t marks) {
    if ((marks & HairCells::kHasHair) == 0) return;
    const CellMixer mixer(job.memory, column, row);
    ForPixels(job, column, row, [&](const CellPixel& pixel) {
      uint8_t& coverage = job.CoverageAt(pixel.x, pixel.y);
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

}  // namespace

void CountInside(const void* data, int32_t index, int32_t) {
  const HairJob& job = HairJobOf(data);
  InsideCount count = {0, 0};
  ForMarked(job, index, [&](int32_t column, int32_t row, uint8_t marks) {
    if ((marks & HairCells::kIsInside) == 0) return;
    const CellMixer mixer(job.memory, column, row);
    ForPixels(job, column, row, [&](const CellPixel& pixel) {
      if (!pixel.is_near) return;
      ++count.inside;
      count.far += LooksFar(mixer, pixel);
    });
  });
  job.memory.counts[index] = count;
}

void CountCells(const void* data, int32_t index, int32_t) {
  const HairJob& job = HairJobOf(data);
  ForMarked(job, index, [&](int32_t column, int32_t row, uint8_t marks) {
    int32_t far = 0, near = 0;
    if (MayHaveNear(marks)) {
      const CellMixer mixer(job.memory, column, row);
      ForPixels(job, column, row, [&](const CellPixel& pixel) {
        if (!pixel.is_near) return;
        ++near;
        far += LooksFar(mixer, pixel);
      });
    }
    const size_t at = job.cells.At(column, row);
    job.memory.near_pixels[at] = near;
    job.memory.contrast[at] = far;
  });
}

void UnmixFirst(const void* data, int32_t index, int32_t) {
  UnmixTile<false>(HairJobOf(data), index);
}

void UnmixAgain(const void* data, int32_t index, int32_t) {
  UnmixTile<true>(HairJobOf(data), index);
}

}  // namespace starfocus
