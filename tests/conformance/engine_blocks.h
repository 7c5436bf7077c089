// SPDX-License-Identifier: Apache-2.0
// What the engine makes of a light field, and the partition that it chose: what the reference,
// which chooses none of its own, is given.
#ifndef STARFOCUS_TESTS_CONFORMANCE_ENGINE_BLOCKS_H_
#define STARFOCUS_TESTS_CONFORMANCE_ENGINE_BLOCKS_H_

#include <cstdint>
#include <vector>

#include "simd/kernels.h"
#include "starfocus/starfocus.h"
#include "tests/conformance/reference.h"
#include "tests/support/test_scene.h"

namespace conformance {

struct EngineResult {
  starfocus_status status = STARFOCUS_OK;
  starfocus_report report = {};
  std::vector<uint8_t> bytes;            // 3 * width * height
  std::vector<reference::Block> blocks;  // of all stripes
};

// Refocuses the scene by an engine that is set up, on the given kernels.
EngineResult RunEngine(const test::Scene& scene, const starfocus_params& params,
                       const starfocus::simd::Kernels& kernels, test::Engine* engine);

}  // namespace conformance

#endif  // STARFOCUS_TESTS_CONFORMANCE_ENGINE_BLOCKS_H_
