// SPDX-License-Identifier: Apache-2.0
// Gives tests access to the internals of an engine. Among the tests, only this header includes
// lib/engine, so changes of lib/engine affect a single header.
#ifndef STARFOCUS_TESTS_SUPPORT_INSIDE_H_
#define STARFOCUS_TESTS_SUPPORT_INSIDE_H_

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "lib/engine/deblock.h"
#include "lib/engine/engine.h"
#include "lib/engine/prepared.h"
#include "lib/engine/stripe.h"
#include "lib/line_scan/line_scan.h"
#include "lib/slices/compositor.h"
#include "starfocus/experimental.h"
#include "tests/support/config.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace test {

inline starfocus::EngineState& StateOf(starfocus_engine* engine) {
  return *reinterpret_cast<starfocus::EngineState*>(engine);
}

// Returns the kernels of the line scan that belong to the SIMD target of `kernels`.
inline const starfocus::simd::LineScanKernels* LineScanKernelsOf(
    const starfocus::simd::Kernels& kernels) {
  using namespace starfocus::simd;
  static const std::vector<const LineScanKernels*> targets = LineScanTargets();
  for (const LineScanKernels* found : targets) {
    if (std::strcmp(found->name, kernels.name) == 0) return found;
  }
  return &ReferenceLineScanKernels();
}

// Makes an engine use the given kernels instead of the best kernels of the machine, and their SIMD
// target for the line scan. starfocus_init resets the kernels.
inline void UseKernels(const starfocus::simd::Kernels* kernels, starfocus_engine* engine) {
  starfocus::EngineState& state = StateOf(engine);
  state.kernels = kernels;
  for (int32_t k = 0; k < state.config.max_workers; ++k) {
    starfocus::RendererScratch* const memory =
        state.scratch[k].renderers[starfocus::kMaxRenderers - 1];
    if (memory == nullptr) continue;
    static_cast<starfocus::LineScanScratch*>(memory)->kernels = LineScanKernelsOf(*kernels);
  }
}

using starfocus::Borders;

// BordersOf returns the borders that blocks of a configuration read, for blur radii up to
// `max_blur` or the configured maximum.
inline starfocus::Borders BordersOf(const test::Config& config, double max_blur) {
  return starfocus::AddBorders(config, max_blur, true);
}
inline starfocus::Borders BordersOf(const test::Config& config) {
  return starfocus::LargestBorders(config);
}
inline starfocus::Borders BordersOf(double max_blur) {
  test::Config config;
  return BordersOf(config, max_blur);
}

// Blocks of the stripe that was refocused last, and their cells that were blurred without rendering
// views.
struct StripeBlocks {
  std::vector<starfocus::Block> blocks;
  starfocus::GatherMap gathered;
};
inline StripeBlocks PlanOf(starfocus_engine* engine) {
  const starfocus::StripePlan& plan = StateOf(engine).stripe.plan;
  return {{plan.blocks, plan.blocks + plan.used}, plan.gathered};
}

// Refocuses one block of the last stripe again, without deblocking, and returns the picture; all
// other pixels are poisoned.
inline std::vector<uint8_t> RenderOne(const starfocus::Block& block, starfocus_engine* engine) {
  const starfocus::EngineState& state = StateOf(engine);
  const size_t stride = 3 * static_cast<size_t>(state.config.width);
  std::vector<uint8_t> out(stride * static_cast<size_t>(state.config.height), kPoison);
  starfocus::RefocusBlock(state, block, {{out.data(), stride, 0, 0}}, &state.scratch[0]);
  return out;
}

// Returns the picture of RenderOne, but renders the block even if the renderer would copy the
// block.
inline std::vector<uint8_t> RenderUncopied(const starfocus::Block& block,
                                           starfocus_engine* engine) {
  starfocus::Lens& lens = StateOf(engine).lens;
  const starfocus::Renderer* const given = lens.renderer;
  starfocus::Renderer renders = *given;
  renders.nothing_moves = [](const starfocus::RenderJob&) { return false; };
  lens.renderer = &renders;
  std::vector<uint8_t> out = RenderOne(block, engine);
  lens.renderer = given;
  return out;
}

// Returns the number of superblock columns that were subsampled for the last stripe, summed over
// layers 1 and 2.
inline int LayerColumns(starfocus_engine* engine) {
  const starfocus::EngineState& state = StateOf(engine);
  int columns = 0;
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    for (int32_t column = 0; column < starfocus::Columns(state.config); ++column) {
      columns += (state.layers.needed[layer][column] & starfocus::kNeeded) != 0;
    }
  }
  return columns;
}

// Returns a reference to the size in bytes of the first worker's pool of slices. Tests may reduce
// the size of the pool.
inline size_t& PoolBytes(starfocus_engine* engine) {
  starfocus::RendererScratch* const scratch =
      StateOf(engine).scratch[0].renderers[starfocus::kSliceRenderer.index];
  return static_cast<starfocus::CompositorScratch*>(scratch)->pool_bytes;
}

// Returns the size in bytes of the workspace for `config`, or kTooLarge.
inline size_t WorkspaceBytes(const starfocus::FullConfig& config) {
  starfocus::EngineState* counted = nullptr;
  return starfocus::LayOut(config, nullptr, &counted);
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_INSIDE_H_
