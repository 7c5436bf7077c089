// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/reference.h"

#include <algorithm>
#include <array>

#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/transfer_curve.h"

namespace reference {
namespace {

// Returns the position of a view in the units that LightField uses as its key.
std::pair<int, int> PositionOf(const test::Scene& scene, int view) {
  const starfocus_position at = scene.PositionOf(view);
  return {int(std::lround(kViewUnit * at.u)), int(std::lround(kViewUnit * at.v))};
}

bool IsHighlight(const uint8_t* codes) {
  return std::count_if(codes, codes + 3, [](uint8_t code) { return code >= 251; }) >= 2;
}

// Returns the number of consecutive highlight pixels on the line through (x, y) with direction (dx,
// dy). Returns a very large number if the highlights reach the edge of the picture.
int RunThrough(const test::Scene& scene, int view, int x, int y, int dx, int dy) {
  int run = 1;
  for (const int side : {1, -1}) {
    for (int k = 1;; ++k) {
      const int column = x + side * k * dx, row = y + side * k * dy;
      if (column < 0 || column >= scene.width || row < 0 || row >= scene.height) return 1 << 20;
      if (!IsHighlight(scene.Pixel(view, column, row))) break;
      ++run;
    }
  }
  return run;
}

bool HasHighlights(const test::Scene& scene) {
  bool any = false;
  for (int view = 0; view < scene.views(); ++view) {
    ForEachPixel(scene.width, scene.height,
                 [&](int x, int y) { any = any || IsHighlight(scene.Pixel(view, x, y)); });
  }
  return any;
}

// Loads the excess of a scene: the light of highlights beyond white. A clipped sample has an excess
// of its light.
LightField LoadExcess(const test::Scene& scene, int transfer) {
  LightField field = Load(scene, transfer);
  const int lamp = std::clamp(scene.width / 32, 16, 128);
  for (int view = 0; view < scene.views(); ++view) {
    Picture& picture = field.at(PositionOf(scene, view));
    picture.light = picture.colours;
    ForEachPixel(scene.width, scene.height, [&](int x, int y) {
      const uint8_t* codes = scene.Pixel(view, x, y);
      Colour& colour = picture.colours[picture.At(x, y)];
      colour = {0, 0, 0};
      if (!IsHighlight(codes)) return;
      const int run =
          std::min(RunThrough(scene, view, x, y, 1, 0), RunThrough(scene, view, x, y, 0, 1));
      const double share = std::clamp(2 - double(run) / lamp, 0.0, 1.0);
      // The second largest code decides for all colours.
      std::array<uint8_t, 3> sorted = {codes[0], codes[1], codes[2]};
      std::sort(sorted.begin(), sorted.end());
      const double step = std::max(0, sorted[1] - 250) / 5.0;
      const Colour& light = picture.light[picture.At(x, y)];
      for (size_t c = 0; c < 3; ++c) colour[c] = light[c] * step * step * share;
    });
  }
  return field;
}

Lens MakeLens(const starfocus::Params& params, const ApertureShape& opening, int n, int layer,
              bool wide = false) {
  Lens lens;
  lens.n = n;
  lens.most = n * n;
  lens.radius = params.aperture;
  lens.opening = opening;
  lens.far = RoundedTo64(params.focus - params.focus_farther);
  lens.near = RoundedTo64(params.focus + params.focus_nearer);
  double extent = 1;
  if (wide) {
    // The centres of the outermost subapertures are up to 5/32 of a subaperture beyond the rim of
    // the lens.
    lens.subapertures = n == 1 ? 1 : n == 3 ? 3 - 2 / 32.0 : n == 4 ? 4 - 5 / 32.0 : n - 11 / 32.0;
    const double farthest = lens.subapertures + 5 / 32.0;
    lens.n = int(farthest);
    lens.most = int(farthest * farthest);
    extent = lens.n / lens.subapertures;
  }
  const auto step = int64_t(params.aperture * extent * (1 << 24));
  lens.step = std::max<int64_t>(1, Rounded(2 * step, 1 + layer));
  lens.layer = layer;
  return lens;
}

// --- Layers ---

// Taps at 0, +-1 and +-3 of sinc(n / 2) with a Kaiser window.
struct Taps {
  double centre, near, far;

  explicit Taps(double beta) {
    const auto kaiser = [&](int n) {
      return std::cyl_bessel_i(0.0, beta * std::sqrt(1 - n * n / 9.0)) /
             std::cyl_bessel_i(0.0, beta);
    };
    const double pi = 3.14159265358979323846;
    centre = 1;
    near = std::sin(pi / 2) / (pi / 2) * kaiser(1);
    far = std::sin(3 * pi / 2) / (3 * pi / 2) * kaiser(3);
  }
};

// Subsamples a picture by two. The result has half the size plus one pixel, with edges repeated.
// Disparities are taken from every second pixel.
Picture Down(const Picture& from, bool excess) {
  Taps taps(1.28);
  if (excess) taps.near = 0.5, taps.far = 0;
  const double unit = 1 / (taps.centre + 2 * (taps.near + taps.far));
  const auto filtered = [&](const auto& at) {
    return unit *
           (taps.centre * at(0) + taps.near * (at(-1) + at(1)) + taps.far * (at(-3) + at(3)));
  };
  Picture half((from.width + 1) / 2 + 1, from.height);
  ForEachPixel(half.width, half.height, [&](int x, int y) {
    half.colours[half.At(x, y)] =
        filtered([&](int k) { return from.colours[from.Nearest(2 * x + k, y)]; });
  });
  Picture to(half.width, (from.height + 1) / 2 + 1);
  ForEachPixel(to.width, to.height, [&](int x, int y) {
    to.colours[to.At(x, y)] =
        Clamped(filtered([&](int k) { return half.colours[half.Nearest(x, 2 * y + k)]; }));
  });
  return to;
}

// Returns the centre view at layers 0, 1 and 2, with disparities in pixels of the picture. Layers
// of the excess of lamps have the filter 1 2 1.
std::vector<Picture> MakeLayers(const Picture& picture, bool excess) {
  std::vector<Picture> layers = {picture};
  for (int layer = 1; layer <= 2; ++layer) {
    layers.push_back(Down(layers.back(), excess));
    Picture& to = layers.back();
    ForEachPixel(to.width, to.height, [&](int x, int y) {
      to.disparities[to.At(x, y)] = picture.disparities[picture.Nearest(x << layer, y << layer)];
    });
  }
  return layers;
}

// Part of a layer: pixel (0, 0) of `picture` is pixel (x, y) of the layer.
struct Part {
  int x, y;
  Picture picture;
};

// Upsamples `from` by two and returns the result's width x height pixels that start at (x, y).
// `from` includes a margin.
Part Up(const Part& from, int x, int y, int width, int height) {
  const Taps taps(2.17);
  const double near = 0.5 * taps.near / (taps.near + taps.far), far = 0.5 - near;
  const auto between = [&](const auto& at, int position) {
    const int before = position >> 1;
    if (position % 2 == 0) return at(before);
    return near * (at(before) + at(before + 1)) + far * (at(before - 1) + at(before + 2));
  };
  Part to = {x, y, Picture(width, height)};
  ForEachPixel(width, height, [&](int column, int row) {
    to.picture.colours[to.picture.At(column, row)] = Clamped(between(
        [&](int k) -> Colour {
          return between(
              [&](int l) -> Colour {
                return from.picture.colours[from.picture.At(k - from.x, l - from.y)];
              },
              y + row);
        },
        x + column));
  });
  return to;
}

// Upsamples the rendered pixels of a block's layer and returns the block's rectangle of the
// picture.
Picture Finished(const Block& block, const Picture& rendered) {
  Part part = {block.rendered.x, block.rendered.y, rendered};
  if (block.layer == 2) {
    part = Up(part, (block.x >> 1) - 2, (block.y >> 1) - 2, (block.width + 1) / 2 + 4,
              (block.height + 1) / 2 + 4);
  }
  if (block.layer > 0) part = Up(part, block.x, block.y, block.width, block.height);
  return part.picture;
}

void Put(const Picture& from, int x0, int y0, int width, std::vector<double>* rgb) {
  ForEachPixel(from.width, from.height, [&](int x, int y) {
    std::copy_n(from.colours[from.At(x, y)].data(), 3,
                &(*rgb)[3 * (size_t(y0 + y) * size_t(width) + size_t(x0 + x))]);
  });
}

// Converts light to codes and adds the excess of highlights. `excess` is empty if there are no
// highlights.
void Encode(const test::Config& config, const std::vector<double>& excess,
            std::vector<double>* rgb) {
  for (size_t i = 0; i < rgb->size(); ++i) {
    double& value = (*rgb)[i];
    if (!excess.empty()) value = std::min(255.0, value + (config.highlights - 1) * excess[i]);
    value = test::CodeOf(value, config.transfer);
  }
}

}  // namespace

LightField Load(const test::Scene& scene, int transfer) {
  LightField field;
  for (int view = 0; view < scene.views(); ++view) {
    Picture picture(scene.width, scene.height);
    ForEachPixel(scene.width, scene.height, [&](int x, int y) {
      const uint8_t* rgb = scene.Pixel(view, x, y);
      Colour& colour = picture.colours[picture.At(x, y)];
      for (size_t c = 0; c < 3; ++c) colour[c] = test::LightOf(rgb[c], transfer);
      picture.disparities[picture.At(x, y)] = RoundedTo64(scene.Disparity(x, y));
    });
    field.emplace(PositionOf(scene, view), std::move(picture));
  }
  return field;
}

double LargestBlur(const starfocus::Params& lens, double low, double high) {
  const double near = lens.focus + lens.focus_nearer, far = lens.focus - lens.focus_farther;
  return lens.aperture * std::max({0.0, high - near, far - low});
}

int ViewsAlongRadius(double r_max, int mode) {
  if (mode == STARFOCUS_MODE_BENCHMARK) return 2 * int(std::ceil(r_max));
  if (r_max < 4) return int(std::ceil(r_max));
  return std::max(4, int(std::ceil(0.787 * r_max)));
}

namespace {

// Copies `from` to position (x0, y0) of `to`.
void Paste(const Picture& from, int x0, int y0, Picture* to) {
  ForEachPixel(from.width, from.height, [&](int x, int y) {
    to->colours[to->At(x0 + x, y0 + y)] = from.colours[from.At(x, y)];
  });
}

// For all blocks, adds the rendered views and the cells that are blurred without rendering views to
// the result.
void RefocusAll(const LightField& field, const starfocus::Params& params,
                const test::Config& config, const std::vector<Block>& blocks, bool excess,
                std::vector<double>* rgb) {
  const Picture& centre = field.at({0, 0});
  const std::vector<Picture> layers = MakeLayers(centre, excess);
  const bool benchmark = params.study.mode == STARFOCUS_MODE_BENCHMARK;
  const double r_max = LargestBlur(params, config.disparity_min, config.disparity_max);
  const int widest = std::max(int(r_max), 32) + 3;  // reach of the most blurred slice
  const Slicing slicing = {size_t(benchmark ? 32 : 16), 5 * (widest + 16) * (widest + 16),
                           benchmark ? 0.125 : 0.375};
  for (const Block& block : blocks) {
    const bool by_subaperture = params.study.renderer == STARFOCUS_RENDERER_SLICES && block.n > 0;
    const ApertureShape here = ApertureShape(params).At(block.x, block.y, block.width, block.height,
                                                        centre.width, centre.height);
    const Lens lens = MakeLens(params, here, block.n, block.layer, by_subaperture);
    const Rectangle& rectangle = block.rendered;
    // Upsampling reads the block at its layer, with a margin as wide as the filter of `Up`.
    const int scale = 1 << block.layer, margin = block.layer == 0 ? 0 : block.layer + 1;
    Block framed = block;
    framed.rendered.x = block.x / scale - margin;
    framed.rendered.y = block.y / scale - margin;
    Picture frame((block.width + scale - 1) / scale + 2 * margin,
                  (block.height + scale - 1) / scale + 2 * margin);
    const Picture& layer = layers[size_t(block.layer)];
    if (rectangle.width > 0) {
      const Picture rendered = by_subaperture
                                   ? CompositeRectangle(field, layer, lens, rectangle, slicing)
                                   : RefocusRectangle(field, layer, lens, rectangle);
      Paste(rendered, rectangle.x - framed.rendered.x, rectangle.y - framed.rendered.y, &frame);
    }
    GatherCells(field, layer, block, lens, r_max, framed.rendered.x, framed.rendered.y, &frame);
    Put(Finished(framed, frame), block.x, block.y, centre.width, rgb);
  }
}

}  // namespace

std::vector<double> RefocusBlocks(const test::Scene& scene, const starfocus::Params& params,
                                  const test::Config& config, const std::vector<Block>& blocks) {
  std::vector<double> rgb(3 * size_t(scene.width) * size_t(scene.height)), excess;
  RefocusAll(Load(scene, config.transfer), params, config, blocks, false, &rgb);
  if (config.highlights > 1 && HasHighlights(scene)) {
    excess.resize(rgb.size());
    RefocusAll(LoadExcess(scene, config.transfer), params, config, blocks, true, &excess);
  }
  Encode(config, excess, &rgb);
  return rgb;
}

}  // namespace reference
