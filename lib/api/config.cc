// SPDX-License-Identifier: Apache-2.0
// C API: default values, sizes and initialisation of engines, and texts of status codes.
#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "starfocus/depth.h"
#include "starfocus/matte.h"

using namespace starfocus;

namespace starfocus {
namespace {

// Returns the configuration, with a superblock size of 0 replaced by 128. Larger blocks read fewer
// pixels around them (docs/constants.md). A worker uses twice as much memory with superblocks of
// 128 pixels as with superblocks of 64 pixels.
FullConfig Choose(const FullConfig& config) {
  FullConfig chosen = config;
  if (chosen.superblock == 0) chosen.superblock = 128;
  return chosen;
}

// Returns the number of bytes of the workspace of a configuration.
size_t WorkspaceSize(const FullConfig& config, Checker* check) {
  CheckConfig(config, check);
  if (!check->passed()) return 0;
  EngineState* counted = nullptr;
  const size_t needed = LayOut(Choose(config), nullptr, &counted);
  if (needed == kTooLarge) check->Add(STARFOCUS_ERROR_TOO_LARGE);
  return needed;
}

}  // namespace

FullConfig DefaultConfig() {
  FullConfig config = {};
  config.size = sizeof(starfocus_config);
  config.views = 5;
  config.max_blur = 32.0;
  config.max_workers = 1;
  config.highlights = 1;
  config.features = STARFOCUS_FEATURE_COVERAGE;
  config.tuning.size = sizeof(starfocus_tuning);
  config.tuning.max_layer = STARFOCUS_LAYERS - 1;
  config.tuning.deblocking = 35;
  config.tuning.timing = DefaultTiming();
  config.tuning.n_scale = 1.0;
  config.tuning.gather = 1;
  return config;
}

FullParams DefaultParams() {
  FullParams params = {};
  params.mode = STARFOCUS_MODE_BLOCK;
  params.aperture = 1.0;
  params.blades = 5;
  params.theta = 0.26 * 3.14159265358979323846;
  params.ring_inner = 0.5;
  return params;
}

}  // namespace starfocus

const char* starfocus_version(uint32_t* abi) {
  if (abi != nullptr) *abi = STARFOCUS_ABI;
  return STARFOCUS_VERSION_STRING;
}

starfocus_status starfocus_view_position(int32_t index, double* u, double* v,
                                         starfocus_problem* problem) {
  Checker check = Enter(problem);
  check.In({"index", double(index)}, STARFOCUS_FROM_TO(0, 16));
  check.NotNull(u, "u");
  check.NotNull(v, "v");
  if (!check.passed()) return check.status();
  const ViewPosition position = StarPosition(index);
  *u = position.u / static_cast<double>(kViewOne);
  *v = position.v / static_cast<double>(kViewOne);
  return STARFOCUS_OK;
}

starfocus_status starfocus_workspace_size(const starfocus_config* config, size_t* bytes,
                                          starfocus_problem* problem) {
  FullConfig full;
  Checker check = Enter(config, problem, &full);
  check.NotNull(bytes, "bytes");
  const size_t needed = WorkspaceSize(full, &check);
  if (check.passed()) *bytes = needed;
  return check.status();
}

starfocus_status starfocus_init(const starfocus_config* config, void* workspace, size_t bytes,
                                starfocus_engine** engine, starfocus_problem* problem) {
  if (engine != nullptr) *engine = nullptr;
  FullConfig full;
  Checker check = Enter(config, problem, &full);
  check.NotNull(engine, "engine");
  CheckMemory("workspace", workspace, bytes, WorkspaceSize(full, &check), &check);
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
  starfocus_observer observer = {};
  if (callbacks->observer != nullptr) {
    check.Read(*callbacks->observer, "callbacks.observer.size", &observer);
  }
  if (!check.passed()) return check.status();
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  e.jobs->runner = callbacks->runner;
  e.jobs->runner_data = callbacks->runner_data;
  e.jobs->call_progress.SetProgress(callbacks->progress, callbacks->progress_data);
  e.observer = observer;
  return STARFOCUS_OK;
}

const char* starfocus_simd_target(void) { return simd::BestKernels().name; }

const char* starfocus_status_string(starfocus_status status) {
  static constexpr const char* kTexts[] = {
      "success",
      "a required pointer is null",
      "a structure was not initialized by its init function",
      "a field or an argument is outside its range",
      "the call needs a feature or views that the engine was not created with",
      "starfocus_stream_begin was not called, or only some rows of the stream have coverage",
      "the given memory is too small or not aligned to STARFOCUS_ALIGNMENT bytes",
      "the configuration needs more memory than this machine can address",
      "out of memory",
      "a stride is smaller than a row, or a stride or a map is misaligned",
      "an output overlaps an input or the workspace",
      "the aperture times the distance from the focus to the farther end of the disparity "
      "range exceeds max_blur",
      "the disparity map contains a value outside the configured disparity range",
      "the disparity map contains NaN or infinity",
      "the disparity map contains no finite value",
      "the prepared light field has another configuration or format",
      "the runner failed, or did not run each job once on a valid worker; the output is "
      "incomplete",
      "the progress function cancelled the call; the output is incomplete",
  };
  static_assert(sizeof kTexts / sizeof *kTexts == STARFOCUS_ERROR_CANCELLED + 1);
  const bool known = status >= 0 && status <= STARFOCUS_ERROR_CANCELLED;
  return known ? kTexts[status] : "unknown status";
}
