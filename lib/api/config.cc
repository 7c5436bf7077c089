// SPDX-License-Identifier: Apache-2.0
// C API: default values, sizes and initialisation of engines, and texts of status codes.
#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "starfocus/depth.h"
#include "starfocus/matte.h"
#include "starfocus/starfocus.h"

using namespace starfocus;

namespace starfocus {
namespace {

// Returns the configuration, with a superblock size of 0 replaced by 64 or 128. Superblocks of 128
// pixels make wide pictures up to 1/8 faster, because the blocks of a superblock share the pixels
// around the superblock. Even with superblocks of 128 pixels, wide pictures have enough superblocks
// for all workers. A worker uses four times as much memory with superblocks of 128 pixels as with
// superblocks of 64 pixels.
starfocus_config Choose(const starfocus_config& config) {
  constexpr int32_t kWide = 1536;
  starfocus_config chosen = config;
  if (chosen.superblock == 0) chosen.superblock = config.width < kWide ? 64 : 128;
  return chosen;
}

}  // namespace

starfocus_config DefaultConfig() {
  starfocus_config config = {};
  config.views = 5;
  config.max_blur = 32.0;
  config.max_workers = 1;
  config.tuning.max_layer = STARFOCUS_LAYERS - 1;
  config.tuning.deblocking = 35;
  config.tuning.timing = DefaultTiming();
  config.tuning.n_scale = 1.0;
  config.tuning.gather = 1;
  config.highlights = 1;
  config.features = STARFOCUS_FEATURE_LINE_SCAN | STARFOCUS_FEATURE_COVERAGE;
  return config;
}

starfocus_params DefaultParams() {
  starfocus_params params = {};
  params.mode = STARFOCUS_MODE_BLOCK;
  params.lens.aperture = 1.0;
  params.lens.blades = 5;
  params.lens.theta = 0.26 * 3.14159265358979323846;
  params.lens.ring_inner = 0.5;
  return params;
}

}  // namespace starfocus

uint32_t starfocus_abi_version(void) { return STARFOCUS_ABI_VERSION; }

const char* starfocus_version(void) { return STARFOCUS_VERSION_STRING; }

size_t starfocus_struct_size(const char* name) {
#define SIZE_OF(type) \
  { #type, sizeof(type) }
  constexpr struct {
    const char* name;
    size_t size;
  } kSizes[] = {SIZE_OF(starfocus_allocator),
                SIZE_OF(starfocus_block),
                SIZE_OF(starfocus_config),
                SIZE_OF(starfocus_depth_config),
                SIZE_OF(starfocus_layer_report),
                SIZE_OF(starfocus_light_field),
                SIZE_OF(starfocus_disparity_stats),
                SIZE_OF(starfocus_params),
                SIZE_OF(starfocus_callbacks),
                SIZE_OF(starfocus_problem),
                SIZE_OF(starfocus_position),
                SIZE_OF(starfocus_previous),
                SIZE_OF(starfocus_region),
                SIZE_OF(starfocus_report),
                SIZE_OF(starfocus_timing),
                SIZE_OF(starfocus_tuning),
                SIZE_OF(starfocus_image),
                SIZE_OF(starfocus_depth_map),
                SIZE_OF(starfocus_disparity_output),
                SIZE_OF(starfocus_matte),
                SIZE_OF(starfocus_matte_stats),
                SIZE_OF(starfocus_matte_depth),
                SIZE_OF(starfocus_lens)};
#undef SIZE_OF
  if (name == nullptr) return 0;
  for (const auto& entry : kSizes) {
    if (AreEqual(entry.name, name)) return entry.size;
  }
  return 0;
}

void starfocus_config_init_sized(starfocus_config* config, uint32_t size) {
  InitSized(DefaultConfig(), size, config);
}

void starfocus_params_init_sized(starfocus_params* params, uint32_t size) {
  InitSized(DefaultParams(), size, params);
}

int starfocus_view_position(int32_t index, double* u, double* v) {
  if (index < 0 || index >= STARFOCUS_MAX_VIEWS || u == nullptr || v == nullptr) return 0;
  const ViewPosition position = StarPosition(index);
  *u = position.u / static_cast<double>(kViewOne);
  *v = position.v / static_cast<double>(kViewOne);
  return 1;
}

starfocus_status starfocus_workspace_size(const starfocus_config* config, size_t* bytes) {
  starfocus_config full = DefaultConfig();
  Checker check = Enter(config, &full);
  check.NotNull(bytes, "bytes");
  CheckConfig(full, &check);
  if (!check.passed()) return check.status();
  EngineState* counted = nullptr;
  const size_t needed = LayOut(Choose(full), nullptr, &counted);
  if (needed == kTooLarge) return check.Add(STARFOCUS_ERROR_TOO_LARGE);
  *bytes = needed;
  return STARFOCUS_OK;
}

starfocus_status starfocus_init(const starfocus_config* config, void* workspace, size_t bytes,
                                starfocus_engine** engine) {
  if (engine != nullptr) *engine = nullptr;
  starfocus_config full = DefaultConfig();
  Checker check = Enter(config, &full);
  check.NotNull(engine, "engine");
  size_t needed = 0;
  if (check.passed()) check.Add(starfocus_workspace_size(config, &needed));
  CheckMemory("workspace", workspace, bytes, needed, &check);
  if (!check.passed()) return check.status();
  EngineState* made = nullptr;
  LayOut(Choose(full), workspace, &made);
  *engine = reinterpret_cast<starfocus_engine*>(made);
  return STARFOCUS_OK;
}

const starfocus_problem* starfocus_engine_problem(const starfocus_engine* engine) {
  return engine == nullptr ? nullptr : &reinterpret_cast<const EngineState*>(engine)->problem;
}

starfocus_status starfocus_set_callbacks(starfocus_engine* engine,
                                         const starfocus_callbacks* callbacks) {
  Checker check = Enter(engine);
  check.NotNull(callbacks, "callbacks");
  if (!check.passed()) return check.status();
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  e.jobs->runner = callbacks->runner;
  e.jobs->runner_data = callbacks->runner_data;
  e.jobs->call_progress.SetProgress(callbacks->progress, callbacks->progress_data);
  e.clock = callbacks->clock;
  e.on_block = callbacks->on_block;
  e.on_block_data = callbacks->on_block_data;
  return STARFOCUS_OK;
}

const char* starfocus_simd_target(void) { return simd::BestKernels().name; }

const char* starfocus_status_string(starfocus_status status) {
  switch (status) {
    case STARFOCUS_OK:
      return "success";
    case STARFOCUS_ERROR_NULL:
      return "a required pointer is null";
    case STARFOCUS_ERROR_STRUCTURE:
      return "a structure was not initialized by its init function";
    case STARFOCUS_ERROR_RANGE:
      return "a field or an argument is outside its range";
    case STARFOCUS_ERROR_FEATURE:
      return "the call needs a feature or views that the engine was not created with";
    case STARFOCUS_ERROR_STATE:
      return "starfocus_stream_begin was not called, or only some rows of the stream have coverage";
    case STARFOCUS_ERROR_WORKSPACE:
      return "the given memory is too small or not aligned to STARFOCUS_ALIGNMENT bytes";
    case STARFOCUS_ERROR_TOO_LARGE:
      return "the configuration needs more memory than this machine can address";
    case STARFOCUS_ERROR_MEMORY:
      return "out of memory";
    case STARFOCUS_ERROR_STRIDE:
      return "a stride is smaller than a row or misaligned";
    case STARFOCUS_ERROR_OVERLAP:
      return "an output overlaps an input or the workspace";
    case STARFOCUS_ERROR_BLUR:
      return "the aperture times the distance from the focus to the farther end of the disparity "
             "range exceeds max_blur";
    case STARFOCUS_ERROR_DISPARITY:
      return "the disparity map contains a value outside the configured disparity range";
    case STARFOCUS_ERROR_NOT_FINITE:
      return "the disparity map contains NaN or infinity";
    case STARFOCUS_ERROR_ALL_INVALID:
      return "the disparity map contains no finite value";
    case STARFOCUS_ERROR_PREPARED:
      return "the prepared light field has another configuration or format";
    case STARFOCUS_ERROR_RUNNER:
      return "the runner failed, or did not run each job once on a valid worker; the output is "
             "incomplete";
    case STARFOCUS_ERROR_CANCELLED:
      return "the progress function cancelled the call; the output is incomplete";
  }
  return "unknown status";
}
