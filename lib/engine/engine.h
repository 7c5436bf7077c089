// SPDX-License-Identifier: Apache-2.0
// An engine: what it is made of, by how long that lives.
#ifndef STARFOCUS_LIB_ENGINE_ENGINE_H_
#define STARFOCUS_LIB_ENGINE_ENGINE_H_

#include <cstddef>
#include <cstdint>

#include "lib/engine/jobs.h"
#include "lib/engine/lens.h"
#include "lib/engine/row_store.h"
#include "lib/engine/stripe_state.h"
#include "lib/engine/tables.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Progress of a streamed refocusing, in rows.
struct Stream {
  bool active = false;
  bool covers = false;   // whether the rows pushed have coverage
  int32_t pushed = 0;    // input rows taken
  int32_t next = 0;      // first row of the next stripe
  int32_t finished = 0;  // output rows that no later stripe changes
  int32_t written = 0;   // output rows the caller has pulled
};

// What images need besides the ring of the centre view's rows.
struct ImageMemory {
  uint32_t* columns = nullptr;  // of the picture, in a depth map
  int32_t map_width = 0;        // of that map; 0: there was none yet
  uint8_t* odd_row = nullptr;   // of the output: a row whose chroma waits for the one below
  Plane<uint8_t> alpha;         // with streaming: ring of the centre view's
};

struct EngineState {
  // For the engine's life:
  starfocus_config config;         // whose problem is the engine's own
  starfocus_problem problem = {};  // of the last call
  const simd::Kernels* kernels;
  Tables tables;
  starfocus_allocator allocator = {};  // of the memory; without functions: the caller's own
  size_t bytes = 0;                    // of that, from the allocator
  Workers workers;                     // the workers' memory
  Plane<uint8_t> rings[kMaxViews];     // with streaming: rows that were pushed
  ImageMemory images;                  // and rings[0]: of images

  // Until the next starfocus_set_callbacks, beside the runner and progress function in
  // workers.jobs:
  starfocus_clock clock = nullptr;
  starfocus_block_visitor on_block = nullptr;
  void* on_block_data = nullptr;

  // For one refocusing:
  Lens lens;
  RowStore row_store;
  Stream stream;
  starfocus_report report;

  // For one stripe:
  StripeState stripe;
};

// Sets up the lens for params, told to the workers' CallProgress, and forgets all of the refocusing
// before. Returns STARFOCUS_ERROR_BLUR, STARFOCUS_ERROR_CANCELLED or STARFOCUS_OK. The other fields
// of params must have been checked.
starfocus_status SetLens(const starfocus_params& params, EngineState* engine);

// Adds to the report what the workers counted since the last time; or forgets it.
void TakeCounts(EngineState* engine);
void DropCounts(EngineState* engine);

// Forgets the stripe before the next one: nothing that it made is of use.
void ForgetStripe(StripeState* stripe);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_ENGINE_H_
