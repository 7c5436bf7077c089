// SPDX-License-Identifier: Apache-2.0
// Measures how many bytes of a workspace each part of the engine uses, from the engine's own
// layout.
#ifndef STARFOCUS_TESTS_SUPPORT_MEMORY_PARTS_H_
#define STARFOCUS_TESTS_SUPPORT_MEMORY_PARTS_H_

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lib/line_scan/line_scan.h"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/test_scene.h"

namespace test {

struct MemoryPart {
  const char* name;
  bool shared;  // True if other tasks of the worker share this memory.
  // Start of the part, or null if the engine does not have this part.
  const void* first;
  size_t begin = 0, end = 0;

  size_t bytes() const { return end - begin; }
};

// Returns the parts of an engine with one worker, in the order of allocation.
inline std::vector<MemoryPart> PartsOf(const starfocus::EngineState& e) {
  const starfocus::Scratch& scratch = e.scratch[0];
  const auto& slices = *static_cast<starfocus::CompositorScratch*>(
      scratch.renderers[starfocus::kSliceRenderer.index]);
  const auto* const line_scan = static_cast<starfocus::LineScanScratch*>(
      scratch.renderers[starfocus_line_scan_renderer()->renderer.index]);
  return {
      {"engine state", false, &e},
      {"slices: apertures of every N", false, e.tables->apertures[0].weights_by_n},
      {"line scan: apertures of every N", false, e.tables->apertures[1].weights_by_n},
      {"aperture of the benchmark mode", false, e.tables->benchmark_weights},
      {"point-spread functions", false, e.tables->psfs},
      {"jobs", false, e.jobs->progress},
      {"state of the workers", false, e.scratch},
      {"sums of a block", false, scratch.sums},
      {"line scan", true, line_scan == nullptr ? nullptr : line_scan->block_rgb[0]},
      {"a block at its layer", true, scratch.layer_samples},
      {"gathering, mode `blur`", true, scratch.block_rgb},
      {"upsampling of layers", true, scratch.upsample.line},
      {"subsampling of layers", true, scratch.resample.even},
      {"splitting blocks", true, scratch.candidates},
      {"slices: surfaces", true, slices.surfaces.disparity[0] - starfocus::simd::kSliceLanes},
      {"slices: offsets in the views, sums of a tile", true, slices.offsets},
      {"slices: finding surfaces", true, slices.surfaces.sources[0]},
      {"slices: the block and its edges", true, slices.block_rgb},
      {"slices: filling surfaces", true, slices.fill.disparity},
      {"slices: pixels of slices and tiles", true, slices.pool},
      {"disparities: ring of rows", false, e.rings.disparity.data},
      {"views: rings of rows", false, e.rings.views[0]},
      {"images", false, e.rings.columns},
      {"finished rows", false, e.stripe.out.codes.data},
      {"layer 1: ring of rows", false, e.layers.planes[1].samples.data},
      {"layer 2: ring of rows", false, e.layers.planes[2].samples.data},
      {"8x8 cells", false, e.stripe.cells.cells},
      {"blocks and flags of columns", false, e.stripe.plan.wanted},
  };
}

// Measures the parts of an engine with one worker for `config`. Returns an empty list if a part
// starts at another address or in another order than PartsOf states.
inline std::vector<MemoryPart> MeasureParts(const test::Config& config) {
  Engine memory(config);
  if (memory.status() != STARFOCUS_OK) return {};
  starfocus::EngineState* engine = &StateOf(memory.get());
  struct Walk {
    std::vector<MemoryPart> parts;
    const unsigned char* base;
    size_t next = 0;
  } walk;
  walk.base = static_cast<const unsigned char*>(memory.workspace());
  for (const MemoryPart& part : PartsOf(*engine)) {
    if (part.first != nullptr) walk.parts.push_back(part);
  }
  const auto visit = [](void* data, size_t begin, size_t end) {
    Walk& w = *static_cast<Walk*>(data);
    if (w.next < w.parts.size() && w.parts[w.next].first == w.base + begin) {
      w.parts[w.next++].begin = begin;
    }
    if (w.next > 0) w.parts[w.next - 1].end = end;
  };
  const starfocus::PieceVisitor visitor = {visit, &walk};
  starfocus::EngineState* counted = nullptr;
  starfocus::LayOut(engine->config, nullptr, &counted, &visitor);
  return walk.next == walk.parts.size() ? walk.parts : std::vector<MemoryPart>();
}

// Total size of the parts, and size of the shared memory, in bytes. The total includes shared
// memory once.
struct MemorySum {
  size_t all = 0, shared = 0;
};
inline MemorySum SumOf(const std::vector<MemoryPart>& parts) {
  MemorySum sum;
  size_t begin = SIZE_MAX, end = 0;
  for (const MemoryPart& part : parts) {
    if (!part.shared) sum.all += part.bytes();
    if (part.shared) begin = std::min(begin, part.begin);
    if (part.shared) end = std::max(end, part.end);
  }
  sum.shared = end - begin;
  sum.all += sum.shared;
  return sum;
}

// Returns a configuration as in docs/boards.md, without memory for thin structures.
inline test::Config BoardConfig(int width, int height, int views, int block, double blur,
                                int streaming) {
  test::Config config;
  config.width = width;
  config.height = height;
  config.views = views;
  config.disparity_min = -16;
  config.disparity_max = 16;
  config.max_blur = blur;
  config.superblock = block;
  test::SetFeature(STARFOCUS_FEATURE_STREAMING, streaming, &config.features);
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  return config;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_MEMORY_PARTS_H_
