// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/analysis/engine_psf.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <vector>

#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/subaperture_rule.h"
#include "examples/lab/analysis/subsampled.h"
#include "examples/lab/analysis/view_psf.h"
#include "lib/engine/engine.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.hpp"

namespace starfocus::analysis {
namespace {

// Side of the engine's superblock, in pixels. The picture's side is at most kBlock, so that the
// picture is one block and one worker's memory holds the whole picture.
constexpr int kBlock = 256;
constexpr uint8_t kWhite = 255;
// Grey level of the dark surface, by layer. Layers 1 and 2 use a grey because the negative lobes of
// their filters would be clipped at black.
constexpr uint8_t kDark[STARFOCUS_LAYERS] = {0, 64, 64};
// Number of pixels by which the layers' filters extend the PSF beyond the blur radius, by layer.
constexpr int kReach[STARFOCUS_LAYERS] = {2, 10, 24};

struct FreeAligned {
  void operator()(void* memory) const {
    ::operator delete (memory, std::align_val_t{STARFOCUS_ALIGNMENT});
  }
};

// A square flat picture with one white pixel at (x, y).
struct Impulse {
  int side;
  std::vector<uint8_t> rgb;
  std::vector<float> disparity;

  Impulse(int s, double d, uint8_t dark)
      : side(s), rgb(3 * Area(s), dark), disparity(Area(s), static_cast<float>(d)) {}
  static size_t Area(int side) { return static_cast<size_t>(side) * static_cast<size_t>(side); }
  void Set(int x, int y, uint8_t level) {
    for (size_t c = 0; c < 3; ++c) rgb[3 * static_cast<size_t>(y * side + x) + c] = level;
  }
};

starfocus::Config ConfigOf(int side, const EngineProbe& probe) {
  starfocus::Config config;
  config.width = config.height = side;
  config.views = 1;  // a flat surface has no holes, so side views are never read
  config.disparity_min = static_cast<float>(probe.r < 0 ? -probe.r_max : 0);
  config.disparity_max = static_cast<float>(probe.r < 0 ? 0 : probe.r_max);
  config.max_blur = std::fmax(probe.r_max, 1);
  config.superblock = kBlock;
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.tuning.line_scan = starfocus_line_scan_renderer();
  config.tuning.gather = 0;  // disables blur by filtering, to measure the PSF of rendered views
  config.tuning.max_layer = probe.layer;
  config.tuning.timing.block = STARFOCUS_MAX_TIMING;  // makes a single block the cheapest partition
  return config;
}

// Owns an engine and the engine's memory.
class Engine {
 public:
  explicit Engine(const starfocus::Config& config) {
    size_t bytes = 0;
    status_ = starfocus_workspace_size(&config, &bytes, nullptr);
    if (status_ != STARFOCUS_OK) return;
    memory_.reset(::operator new (bytes, std::align_val_t{STARFOCUS_ALIGNMENT}));
    status_ = starfocus_init(&config, memory_.get(), bytes, &engine_, nullptr);
  }
  starfocus_status status() const { return status_; }
  const EngineState& state() const { return *reinterpret_cast<const EngineState*>(engine_); }
  const std::vector<uint8_t>& out() const { return out_; }

  starfocus_status Refocus(const Impulse& impulse, const EngineProbe& probe) {
    starfocus::Params params;
    params.study.mode = probe.mode;
    params.study.renderer = probe.renderer;
    starfocus_light_field field = starfocus::NewLightField();
    const size_t side = static_cast<size_t>(impulse.side);
    field.views[0] = starfocus_image_rgb(impulse.rgb.data(), 3 * side);
    field.depth = starfocus_depth_float(impulse.disparity.data(), side * sizeof(float),
                                        int32_t(side), int32_t(side));
    out_.resize(impulse.rgb.size());
    const starfocus_image out = starfocus_image_rgb(out_.data(), 3 * side);
    const starfocus_status status = starfocus_refocus(engine_, &params, &field, &out, nullptr);
    if (status != STARFOCUS_OK) return status;
    return state().stripe.plan.used == 1 ? STARFOCUS_OK : STARFOCUS_ERROR_STATE;
  }

 private:
  std::unique_ptr<void, FreeAligned> memory_;
  std::vector<uint8_t> out_;
  starfocus_engine* engine_ = nullptr;
  starfocus_status status_ = STARFOCUS_OK;
};

// Returns the grey levels of the last refocused picture before the rounding to bytes.
std::vector<double> ReadLevels(const Engine& measured) {
  const EngineState& engine = measured.state();
  const Block& block = engine.stripe.plan.blocks[0];
  const Scratch& scratch = engine.scratch[0];
  const ViewWeights& aperture = WeightsOf(engine.lens, block.n);
  const int bits =
      block.layer == 0 ? engine.lens.renderer->sum_bits(aperture) : int{simd::kLayerBits};
  const double one = std::ldexp(1.0, bits);
  std::vector<double> levels(measured.out().size() / 3);
  for (size_t k = 0; k < levels.size(); ++k) {
    const double sample = block.layer == 0 ? scratch.sums[3 * k] : scratch.picture_samples[3 * k];
    // If pixels are copied rather than rendered, the levels are read from the output.
    levels[k] = engine.report.copied_pixels > 0 ? measured.out()[3 * k] : sample / one;
  }
  return levels;
}

// Returns the difference between the picture with a white pixel at (x, y) and the flat picture,
// within `radius` of (x, y).
SampledPsf ReadPsf(const std::vector<double>& levels, const std::vector<double>& flat, int side,
                   int x, int y, int radius) {
  SampledPsf psf(radius);
  for (int m = -radius; m <= radius; ++m) {
    for (int n = -radius; n <= radius; ++n) {
      const auto at = static_cast<size_t>((y + m) * side + x + n);
      psf.at(n, m) = levels[at] - flat[at];
    }
  }
  return psf;
}

}  // namespace

starfocus_status MeasureEnginePsf(const EngineProbe& probe, EnginePsf* result) {
  if (probe.layer < 0 || probe.layer >= STARFOCUS_LAYERS) return STARFOCUS_ERROR_RANGE;
  const int radius = static_cast<int>(std::ceil(std::fabs(probe.r))) + kReach[probe.layer];
  const int places = 1 << probe.layer;
  const int middle = (radius + places - 1) / places * places, side = middle + places + radius;
  if (side > kBlock) return STARFOCUS_ERROR_BLUR;
  const uint8_t dark = kDark[probe.layer];
  Impulse impulse(side, probe.r, dark);
  Engine engine(ConfigOf(side, probe));
  if (engine.status() != STARFOCUS_OK) return engine.status();
  // The reference is the refocused flat picture, because rounding in a layer adds up to 2/64 of a
  // grey level to a sample.
  const starfocus_status flat_status = engine.Refocus(impulse, probe);
  if (flat_status != STARFOCUS_OK) return flat_status;
  const std::vector<double> flat = ReadLevels(engine);
  SampledPsf sum(radius);
  double squares = 0;
  // Measuring half of the white pixel's positions is sufficient, because transposing the picture
  // transposes the PSF.
  for (int a = 0; a < places; ++a) {
    for (int b = 0; b <= a; ++b) {
      impulse.Set(middle + a, middle + b, kWhite);
      const starfocus_status status = engine.Refocus(impulse, probe);
      if (status != STARFOCUS_OK) return status;
      impulse.Set(middle + a, middle + b, dark);
      SampledPsf psf = ReadPsf(ReadLevels(engine), flat, side, middle + a, middle + b, radius);
      psf.Scale(1.0 / (kWhite - dark));
      squares += (a == b ? 1 : 2) * Energy(psf);
      for (int n = -radius; n <= radius; ++n) {
        for (int m = -radius; m <= radius; ++m) {
          sum.at(n, m) += psf(n, m) + (a == b ? 0 : psf(m, n));
        }
      }
    }
  }
  sum.Scale(1.0 / (places * places));
  const double aliasing = squares / (places * places) - Energy(sum);
  const Block& block = engine.state().stripe.plan.blocks[0];
  *result = {sum, aliasing, block.n, block.layer};
  return STARFOCUS_OK;
}

namespace {

SampledPsf Through(SampledPsf psf, int layer) {
  for (int k = 0; k < layer; ++k) psf = ThroughLayer(psf, kBetaDown);
  return psf;
}

}  // namespace

LayerTheory MakeLayerTheory(double r, int layer) {
  if (layer == 0) return {0, 0};
  const SampledPsf small = IdealPsf(r / (1 << layer), kDefaultTheta);
  return {SquaredError(Through(small, layer), IdealPsf(r, kDefaultTheta)),
          LayerAliasing(small, layer, kBetaDown)};
}

starfocus_status MeasureStep(const EngineProbe& probe, EngineStep* step) {
  EnginePsf measured = {SampledPsf(0), 0, 0, 0};
  const starfocus_status status = MeasureEnginePsf(probe, &measured);
  if (status != STARFOCUS_OK) return status;
  const double theta = kDefaultTheta;
  const int n = measured.n, layer = measured.layer;
  const double r = std::fabs(probe.r), small = r / (1 << layer);
  const bool wide = probe.renderer == STARFOCUS_RENDERER_SLICES;
  const SampledPsf ideal = IdealPsf(r, theta);
  const SampledPsf star =
      Through(StarPsf(small, n, theta, wide ? Subapertures::kWide : Subapertures::kNarrow), layer);
  const auto error = [&](const SampledPsf& psf) {
    return SquaredError(Through(psf, layer), ideal);
  };
  const SampledPsf both =
      n == 0 ? IdealPsf(0, theta) : ViewPsf(small, n, theta, std::clamp(small / n, 1e-6, 1.0));
  *step = {probe.r,
           n,
           layer,
           wide,
           SquaredError(measured.psf, ideal),
           SquaredError(star, ideal),
           error(SubaperturePsf(small, n, theta)),
           error(n == 0 ? IdealPsf(0, theta) : PaperPsf(small, n, theta)),
           error(both),
           SquaredError(measured.psf, star),
           measured.aliasing};
  return STARFOCUS_OK;
}

std::string Explain(const EngineStep& step) {
  if (step.engine <= kThreshold) return "";
  if (step.apart > kExplained[step.layer]) {
    return "unexplained: the measured PSF differs from StarPsf";
  }
  // Tests possible causes from the most to the least fundamental, and returns the first cause that
  // explains the error.
  const double r = std::fabs(step.r);
  if (MakeLayerTheory(r, step.layer).error > kThreshold) {
    return "the filters between layers raise the error of the ideal PSF above 1e-3";
  }
  if (step.subapertures > kThreshold) {
    return "too few views: with this N, the error of exact subapertures exceeds 1e-3";
  }
  if (step.wide)
    return "wide subapertures are boxes; boxes above 3 pixels cover whole pixels and are "
           "interpolated";
  if (step.both_axes > kThreshold) {
    return "subapertures are one pixel wide, but the views are r / N > 1 pixels apart";
  }
  return r > step.n * (1 << step.layer) ? "type B views are spread along their diagonal only, and "
                                          "subapertures are one pixel wide"
                                        : "type B views are spread along their diagonal only";
}

}  // namespace starfocus::analysis
