// The engine: the stripe loop that ties the modules together.
#ifndef STARFOCUS_LIB_ENGINE_H_
#define STARFOCUS_LIB_ENGINE_H_

#include <cstddef>
#include <cstdint>

#include "lib/star.h"
#include "lib/view_grid.h"
#include "lib/window.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Rows of one stripe of blocks and how far beyond it anything may be read, in rows.
struct Reach {
  int32_t stripe;     // rows of a stripe: the largest block
  int32_t border;     // largest border of a block
  int32_t disparity;  // rows of the disparity ring
  int32_t views;      // rows of a view's line ring
};
Reach GetReach(const sf_config& config);

// Progress of a streamed refocusing.
struct Stream {
  bool active = false;
  int32_t pushed = 0;    // input rows taken
  int32_t finished = 0;  // rows of stripes refocused
  int32_t written = 0;   // rows the caller has pulled
};

struct EngineState {
  sf_config config;
  const simd::Kernels* kernels;
  uint32_t fall_off;  // ApertureFallOff(config.theta)

  // The lens of the refocusing under way.
  ViewGrid grid;
  int32_t border;
  sf_report report;

  Window window;
  Plane<int16_t> disparity;         // ring of converted rows
  int32_t disparity_rows;           // converted so far
  Plane<uint8_t> rings[kMaxViews];  // with streaming
  uint8_t* stripe_out;              // with streaming: the last stripe's rows, packed
  Stream stream;

  uint16_t* aperture_weights;  // ApertureSize of the benchmark's largest N
  StarScratch* workers;        // config.max_workers
};

// Sets engine->grid, border and report for params; SF_ERROR_BLUR_TOO_LARGE or SF_OK. The other
// fields of params must have been checked.
sf_status SetLens(const sf_params& params, EngineState* engine);

// Converts one disparity row, checking that it lies in the configured range.
sf_status PushDisparity(const float* row, EngineState* engine);

// Who runs the jobs.
struct Runner {
  sf_runner run;
  void* data;
};

// Refocuses the stripe that starts at row y, a multiple of the stripe height, into out. All rows
// within reach are in the window. SF_OK or SF_ERROR_RUNNER.
sf_status RefocusStripe(EngineState* engine, int32_t y, uint8_t* out, size_t out_stride,
                        const Runner& runner);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_H_
