#include "lib/layout.h"

#include "lib/rules.h"

namespace starfocus {
namespace {

SpanMemory TakeSpans(size_t side, Carver* carver) {
  SpanMemory memory;
  memory.span_capacity = 512;
  memory.spans = carver->Take<simd::Span>(memory.span_capacity);
  memory.pixel_capacity = 3 * 2 * side;
  memory.pixels = carver->Take<uint8_t>(memory.pixel_capacity);
  return memory;
}

// E and R of StarScratch.
StarScratch TakeScratch(size_t extended, size_t rectangle, Carver* carver) {
  StarScratch scratch;
  const size_t area = extended * extended, stripe = rectangle * extended;
  for (int k = 0; k < 2; ++k) {
    scratch.field_rgb[k] = carver->Take<uint8_t>(3 * area);
    scratch.field_disparity[k] = carver->Take<int16_t>(area);
    scratch.diagonal_rgb[k] = carver->Take<uint8_t>(3 * area);
    scratch.diagonal_disparity[k] = carver->Take<int16_t>(area);
    scratch.diagonal_offsets[k] = carver->Take<uint32_t>(2 * extended);
    scratch.corner_rgb[k] = carver->Take<uint8_t>(3 * stripe);
    scratch.accumulators[k] = carver->Take<uint32_t>(3 * rectangle * rectangle);
  }
  scratch.runs = carver->Take<Run>(area);
  scratch.run_counts = carver->Take<int32_t>(extended);
  scratch.line_runs = carver->Take<Run>(extended);
  scratch.corner_runs = carver->Take<Run>(extended);
  scratch.strip_rgb = carver->Take<uint8_t>(3 * rectangle * kStripRows);
  scratch.strip_disparity = carver->Take<int16_t>(rectangle * kStripRows);
  scratch.columns_rgb = carver->Take<uint8_t>(3 * stripe);
  scratch.columns_disparity = carver->Take<int16_t>(stripe);
  scratch.line_accumulators = carver->Take<uint32_t>(3 * extended);
  scratch.line_rgb = carver->Take<uint8_t>(3 * extended);
  scratch.spans = TakeSpans(extended, carver);
  scratch.corner_spans = TakeSpans(extended, carver);
  return scratch;
}

}  // namespace

size_t LayOut(const sf_config& config, void* base, EngineState** engine) {
  Carver carver(base);
  const Reach reach = GetReach(config);
  const auto width = static_cast<size_t>(config.width);
  const auto workers = static_cast<size_t>(config.max_workers);
  *engine = carver.Take<EngineState>(1);
  EngineState counted;  // stands in for *engine while counting
  EngineState& e = *engine == nullptr ? counted : **engine;
  e.aperture_weights = carver.Take<uint16_t>(ApertureSize(ViewsOfBenchmark(config.max_blur)));
  e.disparity.rows = reach.disparity;
  e.disparity.stride = width;
  e.disparity.data = carver.Take<int16_t>(width * static_cast<size_t>(reach.disparity));
  e.stripe_out = nullptr;
  if (config.streaming != 0) {
    for (int view = 0; view < config.views; ++view) {
      e.rings[view].rows = reach.views;
      e.rings[view].stride = 3 * width;
      e.rings[view].data = carver.Take<uint8_t>(3 * width * static_cast<size_t>(reach.views));
    }
    e.stripe_out = carver.Take<uint8_t>(3 * width * static_cast<size_t>(reach.stripe));
  }
  e.workers = carver.Take<StarScratch>(workers);
  const auto rectangle = static_cast<size_t>(reach.stripe);
  const size_t extended = rectangle + 2 * static_cast<size_t>(reach.border);
  for (size_t worker = 0; worker < workers; ++worker) {
    const StarScratch scratch = TakeScratch(extended, rectangle, &carver);
    if (*engine != nullptr) e.workers[worker] = scratch;
  }
  return carver.used();
}

Extent Workspace(const EngineState& engine) {
  EngineState* counted = nullptr;
  return ExtentOf(&engine, 0, 1, LayOut(engine.config, nullptr, &counted));
}

}  // namespace starfocus
