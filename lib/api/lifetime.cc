// SPDX-License-Identifier: Apache-2.0
// The C ABI of an engine's life: defaults, sizes, init.
#include <new>

#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "lib/engine/layout.h"
#include "starfocus/depth.h"
#include "starfocus/starfocus.h"

using starfocus::EngineState;

namespace starfocus {
namespace {

// The configuration with a superblock in place of 0. Wide pictures are up to an eighth faster in
// blocks of 128, which share what lies around them, and leave enough blocks for all workers; a
// worker takes four times the memory then.
sf_config Choose(const sf_config& config) {
  constexpr int32_t kWide = 1536;
  sf_config chosen = config;
  if (chosen.superblock == 0) chosen.superblock = config.width < kWide ? 64 : 128;
  return chosen;
}

bool AreEqual(const char* a, const char* b) {
  for (; *a == *b; ++a, ++b) {
    if (*a == 0) return true;
  }
  return false;
}

}  // namespace
}  // namespace starfocus

uint32_t sf_abi_version(void) { return SF_ABI_VERSION; }

const char* sf_version(void) { return SF_VERSION_STRING; }

size_t sf_struct_size(const char* name) {
  struct Entry {
    const char* name;
    size_t size;
  };
#define SIZE_OF(type) \
  { #type, sizeof(type) }
  constexpr Entry kSizes[] = {
      SIZE_OF(sf_allocator),       SIZE_OF(sf_block),        SIZE_OF(sf_config),
      SIZE_OF(sf_depth_config),    SIZE_OF(sf_layer_report), SIZE_OF(sf_light_field),
      SIZE_OF(sf_disparity_stats), SIZE_OF(sf_params),       SIZE_OF(sf_callbacks),
      SIZE_OF(sf_problem),         SIZE_OF(sf_position),     SIZE_OF(sf_previous),
      SIZE_OF(sf_region),          SIZE_OF(sf_report),       SIZE_OF(sf_skipped),
      SIZE_OF(sf_timing),          SIZE_OF(sf_tuning),       SIZE_OF(sf_image),
      SIZE_OF(sf_depth_map),       SIZE_OF(sf_map),          SIZE_OF(sf_lens)};
#undef SIZE_OF
  if (name == nullptr) return 0;
  for (const Entry& entry : kSizes) {
    if (starfocus::AreEqual(entry.name, name)) return entry.size;
  }
  return 0;
}

sf_config starfocus::DefaultConfig() {
  sf_config config = {};
  config.views = 5;
  config.max_blur = 32.0;
  config.max_workers = 1;
  config.tuning.max_layer = SF_LAYERS - 1;
  config.tuning.deblocking = 35;
  config.tuning.timing = DefaultTiming();
  config.tuning.n_scale = 1.0;
  config.tuning.skips = 1;
  config.tuning.gather = 1;
  config.highlights = 1;
  config.features = SF_FEATURE_LINE_SCAN | SF_FEATURE_COVERAGE;
  return config;
}

void sf_config_init_sized(sf_config* config, uint32_t size) {
  starfocus::InitSized(starfocus::DefaultConfig(), size, config);
}

sf_params starfocus::DefaultParams() {
  sf_params params = {};
  params.mode = SF_MODE_BLOCK;
  params.lens.aperture = 1.0;
  params.lens.blades = 5;
  params.lens.theta = 0.26 * 3.14159265358979323846;
  params.lens.ring_inner = 0.5;
  return params;
}

void sf_params_init_sized(sf_params* params, uint32_t size) {
  starfocus::InitSized(starfocus::DefaultParams(), size, params);
}

int sf_view_position(int32_t index, double* u, double* v) {
  if (index < 0 || index >= SF_MAX_VIEWS || u == nullptr || v == nullptr) return 0;
  const starfocus::ViewPosition position = starfocus::StarPosition(index);
  *u = position.u / static_cast<double>(starfocus::kViewOne);
  *v = position.v / static_cast<double>(starfocus::kViewOne);
  return 1;
}

sf_status sf_workspace_size(const sf_config* config, size_t* bytes) {
  sf_config full = starfocus::DefaultConfig();
  sf_status status = starfocus::EnterConfig(config, {{"bytes", bytes}}, &full);
  if (status == SF_OK) status = starfocus::CheckConfig(full);
  if (status != SF_OK) return status;
  EngineState* counted = nullptr;
  const size_t needed = starfocus::LayOut(starfocus::Choose(full), nullptr, &counted);
  if (needed == starfocus::kTooLarge)
    return starfocus::TellStatus(SF_ERROR_TOO_LARGE, full.problem);
  *bytes = needed;
  return SF_OK;
}

sf_status sf_init(const sf_config* config, void* workspace, size_t bytes, sf_engine** engine) {
  if (engine != nullptr) *engine = nullptr;
  sf_config full = starfocus::DefaultConfig();
  sf_status status = starfocus::EnterConfig(config, {{"engine", engine}}, &full);
  size_t needed = 0;
  if (status == SF_OK) status = sf_workspace_size(config, &needed);
  if (status != SF_OK) return status;
  status = starfocus::CheckMemory({"workspace", workspace, bytes}, needed, full.problem);
  if (status != SF_OK) return status;
  new (workspace) EngineState();
  EngineState* made = nullptr;
  const sf_config chosen = starfocus::Choose(full);
  starfocus::LayOut(chosen, workspace, &made);
  made->config = chosen;
  made->config.problem = &made->problem;
  made->kernels = &starfocus::simd::BestKernels();
  *engine = reinterpret_cast<sf_engine*>(made);
  return SF_OK;
}

const sf_problem* sf_engine_problem(const sf_engine* engine) {
  return engine == nullptr ? nullptr : &reinterpret_cast<const EngineState*>(engine)->problem;
}

sf_status sf_set_callbacks(sf_engine* engine, const sf_callbacks* callbacks) {
  const sf_status status = starfocus::EnterEngine(engine, {{"callbacks", callbacks}});
  if (status != SF_OK) return status;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  e.workers.jobs.runner = {callbacks->runner, callbacks->runner_data};
  e.workers.jobs.call_progress.SetProgress(callbacks->progress, callbacks->progress_data);
  e.clock = callbacks->clock;
  e.on_block = callbacks->on_block;
  e.on_block_data = callbacks->on_block_data;
  return SF_OK;
}

const char* sf_simd_target(void) { return starfocus::simd::BestKernels().name; }
