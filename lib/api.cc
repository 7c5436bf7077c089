// The C ABI: checks, then hands over to the engine.
#include <cstring>
#include <new>

#include "lib/engine.h"
#include "lib/layout.h"
#include "lib/stripe.h"
#include "lib/validate.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

EngineState* Cast(sf_engine* engine) { return reinterpret_cast<EngineState*>(engine); }

// Whether `out` overlaps the workspace or `rows` rows of the light field.
bool OutputOverlaps(const EngineState& engine, const sf_light_field* light_field,
                    const uint8_t* out, size_t stride, int32_t rows) {
  const size_t row_bytes = 3 * static_cast<size_t>(engine.config.width);
  const Extent extent = ExtentOf(out, stride, rows, row_bytes);
  if (Overlaps(extent, Workspace(engine))) return true;
  if (light_field == nullptr) return false;
  for (int view = 0; view < engine.config.views; ++view) {
    const sf_plane& plane = light_field->views[view];
    if (Overlaps(extent, ExtentOf(plane.data, plane.stride, rows, row_bytes))) return true;
  }
  return Overlaps(extent, ExtentOf(light_field->disparity, light_field->disparity_stride, rows,
                                   sizeof(float) * static_cast<size_t>(engine.config.width)));
}

// The whole map is checked before the first pixel is written.
sf_status CheckDisparity(const sf_config& config, const sf_light_field& light_field) {
  sf_disparity_stats stats;
  const sf_status status = sf_measure_disparity(light_field.disparity, light_field.disparity_stride,
                                                config.width, config.height, &stats);
  if (status != SF_OK) return status;
  if (stats.invalid != 0) return SF_ERROR_NOT_FINITE;
  const bool inside = stats.min >= config.disparity_min && stats.max <= config.disparity_max;
  return inside ? SF_OK : SF_ERROR_DISPARITY;
}

const float* DisparityRow(const sf_light_field& light_field, int32_t y) {
  return light_field.disparity +
         static_cast<size_t>(y) * (light_field.disparity_stride / sizeof(float));
}

sf_status RefocusPictures(EngineState* engine, const sf_light_field& light_field, uint8_t* out,
                          size_t out_stride, const Runner& runner) {
  const int32_t height = engine->config.height, side = engine->config.largest_block;
  Plane<const uint8_t> views[kMaxViews];
  for (int view = 0; view < engine->config.views; ++view) {
    views[view] = {light_field.views[view].data, light_field.views[view].stride, 0, 0};
  }
  SetViews(views, engine);
  for (int32_t y = 0; y < height; y += side) {
    const int32_t needed = Min(height, y + side + engine->reach.rows);
    while (engine->disparity_rows < needed) {
      const sf_status status =
          PushDisparity(DisparityRow(light_field, engine->disparity_rows), engine);
      if (status != SF_OK) return status;
    }
    const sf_status status = RefocusStripe(engine, y, {out, out_stride, 0, 0}, runner);
    if (status != SF_OK) return status;
  }
  return SF_OK;
}

}  // namespace
}  // namespace starfocus

using starfocus::Cast;
using starfocus::EngineState;

uint32_t sf_abi_version(void) { return SF_ABI_VERSION; }

void sf_config_init(sf_config* config) {
  if (config == nullptr) return;
  std::memset(config, 0, sizeof(*config));
  config->version = SF_ABI_VERSION;
  config->views = 5;
  config->max_blur = 32.0;
  config->largest_block = 64;
  config->max_workers = 1;
  config->theta = 0.26 * 3.14159265358979323846;
  config->max_layer = SF_LAYERS - 1;
  config->deblocking = 35;
  config->timing = starfocus::DefaultTiming();
  config->n_scale = 1.0;
  config->skips = 1;
}

void sf_params_init(sf_params* params) {
  if (params == nullptr) return;
  std::memset(params, 0, sizeof(*params));
  params->version = SF_ABI_VERSION;
  params->mode = SF_MODE_BLOCK;
  params->aperture = 1.0;
}

int sf_view_position(int32_t index, double* u, double* v) {
  if (index < 0 || index >= SF_MAX_VIEWS || u == nullptr || v == nullptr) return 0;
  const starfocus::ViewPosition position = starfocus::CapturedPosition(index);
  *u = 0.5 * position.u2;
  *v = 0.5 * position.v2;
  return 1;
}

sf_status sf_workspace_size(const sf_config* config, size_t* bytes) {
  if (config == nullptr || bytes == nullptr) return SF_ERROR_NULL;
  const sf_status status = starfocus::CheckConfig(*config);
  if (status != SF_OK) return status;
  EngineState* counted = nullptr;
  *bytes = starfocus::LayOut(*config, nullptr, &counted);
  return SF_OK;
}

sf_status sf_init(const sf_config* config, void* workspace, size_t bytes, sf_engine** engine) {
  if (engine == nullptr) return SF_ERROR_NULL;
  *engine = nullptr;
  if (config == nullptr || workspace == nullptr) return SF_ERROR_NULL;
  size_t needed = 0;
  const sf_status status = sf_workspace_size(config, &needed);
  if (status != SF_OK) return status;
  if (reinterpret_cast<uintptr_t>(workspace) % SF_ALIGNMENT != 0) {
    return SF_ERROR_WORKSPACE_ALIGNMENT;
  }
  if (bytes < needed) return SF_ERROR_WORKSPACE_SMALL;
  new (workspace) EngineState();
  EngineState* made = nullptr;
  starfocus::LayOut(*config, workspace, &made);
  made->config = *config;
  made->kernels = &starfocus::simd::BestKernels();
  starfocus::MakeTables(made);
  *engine = reinterpret_cast<sf_engine*>(made);
  return SF_OK;
}

sf_status sf_refocus(sf_engine* engine, const sf_params* params, const sf_light_field* light_field,
                     uint8_t* out, size_t out_stride, sf_runner runner, void* runner_data,
                     sf_report* report) {
  if (engine == nullptr || params == nullptr || light_field == nullptr) return SF_ERROR_NULL;
  EngineState& e = *Cast(engine);
  sf_status status = starfocus::CheckParams(*params);
  if (status == SF_OK) status = starfocus::CheckLightField(e.config, *light_field);
  if (status == SF_OK) status = starfocus::CheckOutput(e.config, out, out_stride);
  if (status != SF_OK) return status;
  if (starfocus::OutputOverlaps(e, light_field, out, out_stride, e.config.height)) {
    return SF_ERROR_OVERLAP;
  }
  status = starfocus::CheckDisparity(e.config, *light_field);
  if (status != SF_OK) return status;
  e.stream.active = false;
  status = starfocus::SetLens(*params, &e);
  if (status != SF_OK) return status;
  status = starfocus::RefocusPictures(&e, *light_field, out, out_stride, {runner, runner_data});
  if (status == SF_OK && report != nullptr) *report = starfocus::GetReport(e);
  return status;
}

const char* sf_simd_target(void) { return starfocus::simd::BestKernels().name; }
