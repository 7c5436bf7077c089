// SPDX-License-Identifier: Apache-2.0
// Compares the deblocking of refocused pictures, stripe by stripe, with a reference that filters
// the whole picture at once as in the paper (V-C).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/layered_scene.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"
#include "tests/support/transfer_curve.h"

namespace deblock_test {
namespace {

using test::CodeOf;
using test::LightOf;

constexpr int kUnit = 16;

// A picture and the layers of its smallest blocks.
struct LayeredPicture {
  LayeredPicture(int w, int h)
      : width(w),
        height(h),
        columns((w + kUnit - 1) / kUnit),
        rows((h + kUnit - 1) / kUnit),
        rgb(3 * size_t(w) * size_t(h)),
        layers(size_t(columns) * size_t(rows)) {}

  uint8_t* Pixel(int x, int y) { return rgb.data() + 3 * (size_t(y) * size_t(width) + size_t(x)); }
  uint8_t& Layer(int column, int row) {
    return layers[size_t(row) * size_t(columns) + size_t(column)];
  }
  int LayerOf(int x, int y) { return Layer(x / kUnit, y / kUnit); }

  int width, height, columns, rows;
  std::vector<uint8_t> rgb;
  std::vector<uint8_t> layers;
};

// Returns true if the condition of equations (16) and (17) holds.
bool Artificial(const uint8_t* a, const uint8_t* b, int beta) {
  bool all = true;
  for (int c = 0; c < 3; ++c) all = all && std::abs(int(a[c]) - int(b[c])) < beta;
  return all;
}

// Filters a line of pixels p0, q0, q1, q2, q3. The line starts with p0 at (x, y) and runs in
// direction (dx, dy) within the picture. Interpolates linearly between p0 and q3 if p0 is at layer
// 2 and the strong condition holds, otherwise between p0 and q1.
void FilterLine(LayeredPicture* picture, int x, int y, int dx, int dy, int beta, int transfer) {
  const auto inside = [&](int k) {
    const int qx = x + dx * (k + 1), qy = y + dy * (k + 1);
    return qx >= 0 && qx < picture->width && qy >= 0 && qy < picture->height;
  };
  const auto q = [&](int k) { return picture->Pixel(x + dx * (k + 1), y + dy * (k + 1)); };
  const uint8_t* p0 = picture->Pixel(x, y);
  const bool strong = picture->LayerOf(x, y) == 2;
  int last = 0;  // q[last] does not change
  if (strong && inside(3) && Artificial(p0, q(3), beta)) {
    last = 3;
  } else if (inside(1) && Artificial(p0, q(1), beta)) {
    last = 1;
  }
  for (int c = 0; c < 3; ++c) {
    // Rounds samples to the engine's grid of light, since the conditions of later lines depend on
    // the result.
    const auto light = [&](int code) { return std::floor(128 * LightOf(code, transfer) + 0.5); };
    const double from = light(p0[c]), to = last > 0 ? light(q(last)[c]) : 0;
    for (int k = 0; k < last; ++k) {
      const double mixed = std::floor((from * (last - k) + to * (k + 1)) / (last + 1) + 0.5);
      q(k)[c] = uint8_t(CodeOf(mixed / 128, transfer) + 0.5);
    }
  }
}

// Filters the side of the lower layer at two adjacent pixels of a boundary.
void FilterPair(LayeredPicture* picture, int x0, int y0, int x1, int y1, int beta, int transfer) {
  const int before = picture->LayerOf(x0, y0), after = picture->LayerOf(x1, y1);
  if (before > after) FilterLine(picture, x0, y0, x1 - x0, y1 - y0, beta, transfer);
  if (before < after) FilterLine(picture, x1, y1, x0 - x1, y0 - y1, beta, transfer);
}

// Filters all horizontal boundaries of the picture, then all vertical boundaries.
void DeblockPicture(LayeredPicture* picture, int beta, int transfer) {
  for (int y = kUnit; y < picture->height; y += kUnit) {
    for (int x = 0; x < picture->width; ++x) {
      FilterPair(picture, x, y - 1, x, y, beta, transfer);
    }
  }
  for (int y = 0; y < picture->height; ++y) {
    for (int x = kUnit; x < picture->width; x += kUnit) {
      FilterPair(picture, x - 1, y, x, y, beta, transfer);
    }
  }
}

// Adds the layer of a block to a picture.
void AddLayer(void* data, const starfocus_block* block) {
  auto* to = static_cast<LayeredPicture*>(data);
  for (int y = block->y; y < block->y + block->height; y += kUnit) {
    for (int x = block->x; x < block->x + block->width; x += kUnit) {
      to->Layer(x / kUnit, y / kUnit) = uint8_t(block->layer);
    }
  }
}

// Returns a scene of any size whose tiles of 16 to 64 pixels have blurs of different layers, so
// that boundaries lie at the edges of stripes and next to the edges of the picture.
test::Scene AnyScene(int views, test::Random* random) {
  constexpr int kEdges[] = {1, 2, 3, 4, 5, 15, 16, 17, 18, 19, 20, 21, 32, 33, 35, 36, 48, 50, 63};
  test::Scene scene = test::LayeredScene(kEdges[random->Int(0, 18)] + 32 * random->Int(0, 3),
                                         kEdges[random->Int(0, 18)] + 32 * random->Int(0, 4), views,
                                         8, random->Next());
  const int side = 16 << random->Int(0, 2), contrast = random->Int(0, 3) == 0 ? 255 : 60;
  std::vector<float> tiles(400);
  for (float& tile : tiles) tile = float(8 * random->Int(-1, 1));
  if (random->Int(0, 2) > 0) {
    test::SetDisparity(
        &scene, [&](int x, int y) { return tiles[size_t(x / side + 20 * (y / side)) % 400]; });
  }
  for (auto& picture : scene.pictures) {
    for (uint8_t& sample : picture) sample = uint8_t(sample * contrast / 255);
  }
  return scene;
}

TEST_CASE("deblock: refocused pictures are deblocked like whole pictures") {
  test::Random random(39);
  constexpr int kBetas[] = {10, 35, 100, 255};
  int changed = 0;
  for (int round = 0; round < 200; ++round) {
    const test::Scene scene = AnyScene(test::kStars[round % 4], &random);
    test::Config config = test::ConfigFor(scene, 40);
    config.superblock = 32 << random.Int(0, 3);
    config.tuning.max_layer = random.Int(0, 4) == 0 ? 1 : 2;
    config.tuning.deblocking = 0;
    if (random.Int(0, 1) == 0) config.tuning.timing.block = 0;  // small blocks
    config.transfer = random.Int(0, 1) == 0 ? STARFOCUS_TRANSFER_SRGB : STARFOCUS_TRANSFER_NONE;
    const double aperture = random.Int(0, 1) == 0 ? 1 : random.Real(0.2, 1);
    // Blocks of the line scan reach layer 2 with less blur, also at depth edges.
    const starfocus::Params params =
        test::Params(random.Real(-10, 10), aperture, STARFOCUS_MODE_BLOCK,
                     round % 5 == 0 ? STARFOCUS_RENDERER_SLICES : STARFOCUS_RENDERER_LINE_SCAN);
    test::Engine engine(config);
    LayeredPicture picture(scene.width, scene.height);
    const starfocus_observer observer = test::Visitor(AddLayer, &picture);
    const test::Output out =
        test::OutputOf(&engine, params, scene, nullptr, test::ObservedBy(&observer));
    const int beta = kBetas[random.Int(0, 3)];
    picture.rgb = out.bytes;
    DeblockPicture(&picture, beta, config.transfer);
    changed += picture.rgb != out.bytes;
    config.tuning.deblocking = beta;
    CAPTURES(round, scene.width, scene.height, beta);
    CHECK((test::OutputOf(config, params, scene).bytes == picture.rgb));
  }
  CHECK(changed > 100);
}

}  // namespace
}  // namespace deblock_test
