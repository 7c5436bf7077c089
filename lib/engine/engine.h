// SPDX-License-Identifier: Apache-2.0
// State of an engine, grouped by lifetime.
#ifndef STARFOCUS_LIB_ENGINE_ENGINE_H_
#define STARFOCUS_LIB_ENGINE_ENGINE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/jobs.h"
#include "lib/engine/lens.h"
#include "lib/engine/scratch.h"
#include "lib/engine/stripe_state.h"
#include "lib/engine/tables.h"
#include "lib/io/input.h"
#include "lib/io/layers.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Progress of a streamed refocusing, in rows.
struct Stream {
  bool active = false;
  bool covers = false;   // True: pushed rows include coverage.
  int32_t pushed = 0;    // Number of pushed input rows.
  int32_t next = 0;      // First row of the next stripe.
  int32_t finished = 0;  // Number of output rows that no later stripe changes.
  int32_t written = 0;   // Number of output rows that the caller has pulled.
};

struct EngineMemory;

// Copies of an engine share its tables, jobs and memory.
struct EngineState {
  // The following members are valid for the life of the engine.
  starfocus_config config;         // config.problem points to `problem` of this struct.
  starfocus_problem problem = {};  // Problem that the last call reported.
  const simd::Kernels* kernels;
  Tables* tables;
  Jobs* jobs;                  // Runs the jobs; has room for MaxJobs jobs.
  Scratch* scratch = nullptr;  // Scratch memory of each worker.
  // Memory of the engine, its size, and the part that TakePicture divides into pieces.
  EngineMemory* memory = nullptr;
  size_t bytes = 0;
  uint8_t* picture_memory = nullptr;
  // Frees the memory of the engine. If the allocator's functions are null, the caller owns the
  // memory.
  starfocus_allocator allocator = {};
  InputRings rings;
  uint8_t* odd_row = nullptr;  // With images: see Output::odd_row.

  // The following members are valid until the next call of starfocus_set_callbacks, like the runner
  // and the progress function in `jobs`.
  starfocus_clock clock = nullptr;
  starfocus_block_visitor on_block = nullptr;
  void* on_block_data = nullptr;

  // The following members are valid for one refocusing.
  Lens lens;
  Input input;
  StripeLayers layers;
  Stream stream;
  starfocus_report report;

  // The following member is valid for one stripe.
  StripeState stripe;
};

// Sets up the lens for `params` and discards the state of the previous refocusing. Reports progress
// through the workers' CallProgress. Returns STARFOCUS_ERROR_BLUR, STARFOCUS_ERROR_CANCELLED or
// STARFOCUS_OK. The caller must have checked all other requirements on `params`.
starfocus_status SetLens(const starfocus_params& params, EngineState* engine);

// TakeCounts moves the workers' counts to the report. DropCounts discards these counts.
void TakeCounts(EngineState* engine);
void DropCounts(EngineState* engine);

// Discards the state of the previous stripe, so that the next stripe reuses no data.
void ForgetStripe(StripeState* stripe);

// Discards the rows of the layers, which belong to another picture or are incomplete.
void ForgetLayers(const starfocus_config& config, StripeLayers* layers);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_ENGINE_H_
