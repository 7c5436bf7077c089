// SPDX-License-Identifier: Apache-2.0
// Runs the engine, and returns the output and the partition that the engine chose. The reference
// then refocuses the blocks of this partition.
#ifndef STARFOCUS_TESTS_CONFORMANCE_ENGINE_BLOCKS_H_
#define STARFOCUS_TESTS_CONFORMANCE_ENGINE_BLOCKS_H_

#include <cstdint>
#include <vector>

#include "simd/kernels.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/reference.h"
#include "tests/support/test_scene.h"

namespace conformance {

struct EngineResult {
  starfocus_status status = STARFOCUS_OK;
  starfocus_report report = starfocus::NewReport();
  std::vector<uint8_t> bytes;            // Output samples, 3 * width * height.
  std::vector<reference::Block> blocks;  // Partition: blocks of all stripes.
};

// Refocuses the scene with the given kernels on an initialised engine.
EngineResult RunEngine(const test::Scene& scene, const starfocus::Params& params,
                       const starfocus::simd::Kernels& kernels, test::Engine* engine);

}  // namespace conformance

#endif  // STARFOCUS_TESTS_CONFORMANCE_ENGINE_BLOCKS_H_
