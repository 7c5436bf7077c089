// SPDX-License-Identifier: Apache-2.0
// Tests deblocking on hand-made boundaries, and compares stripes with the reference, which filters
// the whole picture at once as in the paper (V-C).
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "lib/plan/partition.h"
#include "tests/lib/deblock_reference.h"
#include "tests/support/inside.h"
#include "tests/support/test_scene.h"

namespace deblock_test {
namespace {

using namespace starfocus;
using test::DeblockPicture;
using Picture = test::LayeredPicture;

// Deblocks as the engine does, stripe by stripe. The columns of smallest blocks are divided into
// `parts` jobs, which run from right to left.
void DeblockStripes(Picture* picture, int stripe_height, int parts, int beta, int transfer) {
  const int most_rows = stripe_height / kSmallestBlock;
  std::vector<uint8_t> layers(size_t(picture->columns) * size_t(most_rows + 1), 0xEE);
  LayerMap map;
  map.layers = layers.data();
  map.columns = picture->columns;
  for (int y = 0; y < picture->height; y += stripe_height) {
    const int height = std::min(stripe_height, picture->height - y);
    if (y > 0) std::copy_n(&map.At(0, map.rows - 1), map.columns, map.layers);
    map.rows = (height + kSmallestBlock - 1) / kSmallestBlock;
    for (int row = 0; row < map.rows; ++row) {
      for (int column = 0; column < map.columns; ++column) {
        map.At(column, row) = picture->Layer(column, y / kSmallestBlock + row);
      }
    }
    const starfocus::Deblocking job = {&map,
                                       {picture->rgb.data(), 3 * size_t(picture->width), 0, 0},
                                       picture->width,
                                       picture->height,
                                       y,
                                       beta,
                                       &starfocus::TransferOf(transfer),
                                       &starfocus::simd::BestKernels()};
    for (int part = parts - 1; part >= 0; --part) {
      starfocus::DeblockRowBoundaries(
          job, {map.columns * part / parts, map.columns * (part + 1) / parts});
    }
    const int first = std::max(0, y - kDeblockRows);
    const int last = y + height == picture->height ? picture->height : y + height - kDeblockRows;
    for (int row = last - 1; row >= first; --row)
      starfocus::DeblockColumnBoundaries(job, {row, row + 1});
  }
}

Picture RandomPicture(int width, int height, test::Random* random) {
  Picture picture(width, height);
  const int contrast = std::vector<int>{1, 20, 36, 60, 255}[size_t(random->Int(0, 4))];
  const int base = random->Int(0, 255 - contrast);
  for (uint8_t& sample : picture.rgb) sample = uint8_t(base + random->Int(0, contrast));
  const int layers = random->Int(1, 2);
  for (uint8_t& layer : picture.layers) layer = uint8_t(random->Int(0, layers));
  return picture;
}

TEST_CASE("deblock: stripes give the same result as the whole picture") {
  test::Random random(5);
  constexpr int kEdges[] = {1, 2, 3, 4, 5, 15, 16, 17, 18, 19, 20, 21, 32, 33, 35, 36, 48, 50, 63};
  constexpr int kStripes[] = {16, 32, 64, 128, 256};
  int changed = 0;
  for (int round = 0; round < 1500; ++round) {
    const int width = kEdges[random.Int(0, 18)] + 32 * random.Int(0, 2);
    const int height = kEdges[random.Int(0, 18)] + 32 * random.Int(0, 4);
    const Picture before = RandomPicture(width, height, &random);
    const int beta = std::vector<int>{1, 10, 35, 35, 255}[size_t(random.Int(0, 4))];
    Picture expected = before;
    const int transfer = random.Int(0, 1) == 0 ? STARFOCUS_TRANSFER_SRGB : STARFOCUS_TRANSFER_NONE;
    DeblockPicture(&expected, beta, transfer);
    changed += expected.rgb != before.rgb;
    for (const int stripe : kStripes) {
      Picture got = before;
      DeblockStripes(&got, stripe, random.Int(1, 3), beta, transfer);
      CAPTURES(width, height, stripe, beta, transfer);
      const bool same = got.rgb == expected.rgb;
      REQUIRE(same);
    }
  }
  CHECK(changed > 500);
}

// Returns the deblocked row of a picture whose rows are all equal to `levels`. The two blocks of
// the picture are at the layers `before` and `after`.
std::vector<int> DeblockedRow(const std::vector<int>& levels, int before, int after, int beta,
                              bool vertical) {
  const int length = int(levels.size());
  Picture picture(vertical ? 16 : length, vertical ? length : 16);
  for (int along = 0; along < length; ++along) {
    for (int across = 0; across < 16; ++across) {
      uint8_t* pixel = vertical ? picture.Pixel(across, along) : picture.Pixel(along, across);
      for (int c = 0; c < 3; ++c) pixel[c] = uint8_t(levels[size_t(along)]);
    }
  }
  picture.layers[0] = uint8_t(before);
  if (picture.layers.size() > 1) picture.layers[1] = uint8_t(after);
  DeblockStripes(&picture, vertical ? 16 : 32, 1, beta, STARFOCUS_TRANSFER_NONE);
  std::vector<int> out;
  for (int along = 0; along < length; ++along) {
    const uint8_t* first = vertical ? picture.Pixel(0, along) : picture.Pixel(along, 0);
    for (int across = 0; across < 16; ++across) {
      const uint8_t* pixel = vertical ? picture.Pixel(across, along) : picture.Pixel(along, across);
      for (int c = 0; c < 3; ++c) REQUIRE(pixel[c] == first[0]);
    }
    out.push_back(first[0]);
  }
  return out;
}

// Returns 16 pixels of level 100, followed by the levels of `after`.
std::vector<int> Step(const std::vector<int>& after) {
  std::vector<int> levels(16, 100);
  levels.insert(levels.end(), after.begin(), after.end());
  return levels;
}

TEST_CASE("deblock: boundaries between all pairs of layers have the expected levels") {
  const std::vector<int> before = Step({120, 120, 120, 120, 120, 120});
  for (const bool vertical : {false, true}) {
    CAPTURE(vertical);
    const auto deblocked = [&](int p, int q) { return DeblockedRow(before, p, q, 35, vertical); };
    CHECK(deblocked(0, 0) == before);
    CHECK(deblocked(1, 1) == before);
    CHECK(deblocked(2, 2) == before);
    // Weak filter: q0 = (p0 + q1) / 2, on the side of the lower layer.
    CHECK(deblocked(1, 0) == Step({110, 120, 120, 120, 120, 120}));
    std::vector<int> mirrored = before;
    mirrored[15] = 110;
    CHECK(deblocked(0, 1) == mirrored);
    // Strong filter: a line from p0 to q3.
    CHECK(deblocked(2, 0) == Step({105, 110, 115, 120, 120, 120}));
    CHECK(deblocked(2, 1) == Step({105, 110, 115, 120, 120, 120}));
    std::vector<int> strong = before;
    strong[15] = 115;
    strong[14] = 110;
    strong[13] = 105;
    CHECK(deblocked(0, 2) == strong);
    CHECK(deblocked(1, 2) == strong);
  }
}

TEST_CASE("deblock: the filter applies only if the difference is below beta") {
  for (const bool vertical : {false, true}) {
    for (const int sign : {1, -1}) {
      const auto step = [&](std::vector<int> after) {
        for (int& level : after) level = 100 + sign * level;
        return Step(after);
      };
      const auto row = [&](const std::vector<int>& levels, int p, int beta) {
        return DeblockedRow(levels, p, 0, beta, vertical);
      };
      // The weak filter applies if |p0 - q1| < beta.
      CHECK(row(step({40, 20, 40, 40}), 1, 20) == step({40, 20, 40, 40}));
      CHECK(row(step({40, 20, 40, 40}), 1, 19) == step({40, 20, 40, 40}));
      CHECK(row(step({40, 20, 40, 40}), 1, 21) == step({10, 20, 40, 40}));
      // The strong filter applies if |p0 - q3| < beta, with any pixels in between.
      CHECK(row(step({40, 90, 40, 20}), 2, 21) == step({5, 10, 15, 20}));
      CHECK(row(step({40, 90, 40, 20}), 2, 20) == step({40, 90, 40, 20}));
      // If the condition of the strong filter fails, the condition of the weak filter may still
      // hold.
      CHECK(row(step({40, 10, 40, 20}), 2, 20) == step({5, 10, 40, 20}));
      CHECK(row(step({40, 20, 40, 20}), 2, 20) == step({40, 20, 40, 20}));
      // With a beta of 0 no filter applies.
      CHECK(row(step({0, 0, 0, 0}), 2, 0) == step({0, 0, 0, 0}));
    }
  }
}

TEST_CASE("deblock: the filter applies only if all three channels differ by less than beta") {
  for (int c = 0; c < 3; ++c) {
    Picture picture(32, 1);
    std::fill(picture.rgb.begin(), picture.rgb.end(), uint8_t{100});
    picture.layers = {2, 0};
    for (int x = 16; x < 32; ++x) picture.Pixel(x, 0)[c] = 140;
    Picture same = picture;
    DeblockStripes(&picture, 32, 1, 40, STARFOCUS_TRANSFER_NONE);
    CHECK(picture.rgb == same.rgb);
    DeblockStripes(&picture, 32, 1, 41, STARFOCUS_TRANSFER_NONE);
    CHECK(picture.rgb != same.rgb);
    CHECK(int(picture.Pixel(16, 0)[c]) == 110);
    CHECK(int(picture.Pixel(18, 0)[c]) == 130);
    CHECK(int(picture.Pixel(19, 0)[c]) == 140);
  }
}

TEST_CASE("deblock: blocks at the right and bottom edges may be narrower than the filter") {
  for (const bool vertical : {false, true}) {
    const auto row = [&](const std::vector<int>& after, int p) {
      return DeblockedRow(Step(after), p, 0, 35, vertical);
    };
    CHECK(row({120}, 1) == Step({120}));
    CHECK(row({120}, 2) == Step({120}));
    CHECK(row({120, 120}, 1) == Step({110, 120}));
    CHECK(row({120, 120}, 2) == Step({110, 120}));
    CHECK(row({120, 120, 120}, 2) == Step({110, 120, 120}));
    CHECK(row({120, 120, 120, 120}, 2) == Step({105, 110, 115, 120}));
    // A block of the higher layer smooths its neighbour even if the block is narrower than the
    // filter.
    std::vector<int> strong = Step({120});
    strong[15] = 115;
    strong[14] = 110;
    strong[13] = 105;
    CHECK(DeblockedRow(Step({120}), 0, 2, 35, vertical) == strong);
  }
}

TEST_CASE("deblock: constant pictures and pictures of one block do not change") {
  test::Random random(6);
  for (int round = 0; round < 50; ++round) {
    Picture picture = RandomPicture(random.Int(1, 80), random.Int(1, 80), &random);
    std::fill(picture.rgb.begin(), picture.rgb.end(), uint8_t(round * 5));
    const std::vector<uint8_t> before = picture.rgb;
    DeblockStripes(&picture, 32, 1, 255, STARFOCUS_TRANSFER_NONE);
    CHECK(picture.rgb == before);
    Picture small = RandomPicture(random.Int(1, 16), random.Int(1, 16), &random);
    const std::vector<uint8_t> small_before = small.rgb;
    DeblockStripes(&small, 32, 1, 255, STARFOCUS_TRANSFER_NONE);
    CHECK(small.rgb == small_before);
  }
}

}  // namespace
}  // namespace deblock_test
