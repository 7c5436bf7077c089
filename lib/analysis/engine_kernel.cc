#include "lib/analysis/engine_kernel.h"

#include <cmath>
#include <memory>
#include <new>
#include <vector>

#include "lib/engine.h"

namespace starfocus::analysis {
namespace {

// The whole picture is one block, so that one worker's accumulators hold all of it.
constexpr int kBlock = 128;
constexpr uint8_t kWhite = 255;

struct FreeAligned {
  void operator()(void* memory) const {
    ::operator delete (memory, std::align_val_t{SF_ALIGNMENT});
  }
};

// A square flat picture with one white pixel in its middle.
struct Impulse {
  int side;
  std::vector<uint8_t> rgb;
  std::vector<float> disparity;

  Impulse(int radius, double d)
      : side(2 * radius + 1), rgb(3 * Area(side)), disparity(Area(side), static_cast<float>(d)) {
    for (size_t c = 0; c < 3; ++c) rgb[rgb.size() / 2 - 1 + c] = kWhite;
  }
  static size_t Area(int side) { return static_cast<size_t>(side) * static_cast<size_t>(side); }
};

sf_config ConfigOf(const Impulse& impulse, const EngineProbe& probe) {
  sf_config config;
  sf_config_init(&config);
  config.width = config.height = impulse.side;
  config.views = 1;  // a flat surface has no holes, so that no captured view is ever read
  config.disparity_min = static_cast<float>(probe.r < 0 ? -probe.r_max : 0);
  config.disparity_max = static_cast<float>(probe.r < 0 ? 0 : probe.r_max);
  config.max_blur = SF_MAX_BLUR;
  config.largest_block = kBlock;
  return config;
}

Kernel ReadKernel(const EngineState& engine, int side) {
  Kernel kernel(side / 2);
  const uint32_t* sums = engine.workers[0].star.accumulators[0];
  const double white = std::ldexp(double{kWhite}, engine.aperture.sum_bits);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      kernel.at(x - side / 2, y - side / 2) = sums[3 * (y * side + x)] / white;
  }
  return kernel;
}

}  // namespace

sf_status MeasureEngineKernel(const EngineProbe& probe, EngineKernel* result) {
  const int radius = static_cast<int>(std::ceil(std::fabs(probe.r))) + 2;
  if (2 * radius + 1 > kBlock) return SF_ERROR_MAX_BLUR;
  const Impulse impulse(radius, probe.r);
  const sf_config config = ConfigOf(impulse, probe);
  size_t bytes = 0;
  sf_status status = sf_workspace_size(&config, &bytes);
  if (status != SF_OK) return status;
  const std::unique_ptr<void, FreeAligned> memory(
      ::operator new (bytes, std::align_val_t{SF_ALIGNMENT}));
  sf_engine* engine = nullptr;
  status = sf_init(&config, memory.get(), bytes, &engine);
  if (status != SF_OK) return status;
  sf_params params;
  sf_params_init(&params);
  params.mode = SF_MODE_FRAME;
  sf_light_field field = {};
  const size_t side = static_cast<size_t>(impulse.side);
  field.views[0] = {impulse.rgb.data(), 3 * side};
  field.disparity = impulse.disparity.data();
  field.disparity_stride = side * sizeof(float);
  std::vector<uint8_t> out(impulse.rgb.size());
  sf_report report;
  status = sf_refocus(engine, &params, &field, out.data(), 3 * side, nullptr, nullptr, &report);
  if (status != SF_OK) return status;
  *result = {ReadKernel(*reinterpret_cast<EngineState*>(engine), impulse.side), report.n};
  return SF_OK;
}

}  // namespace starfocus::analysis
