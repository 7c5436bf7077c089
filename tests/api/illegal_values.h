// SPDX-License-Identifier: Apache-2.0
// Illegal values of the public structures, and the fields that errors must name.
#ifndef STARFOCUS_TESTS_API_ILLEGAL_VALUES_H_
#define STARFOCUS_TESTS_API_ILLEGAL_VALUES_H_

#include <cstddef>
#include <cstdint>
#include <limits>

#include "starfocus/starfocus.h"

namespace illegal_values {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfF = std::numeric_limits<float>::infinity();
constexpr size_t kHuge = std::numeric_limits<size_t>::max();

// A change that makes a structure illegal, and the expected status and field.
template <class Structure>
struct Bad {
  const char* field;
  void (*spoil)(Structure*);
  starfocus_status status = STARFOCUS_ERROR_RANGE;
};

inline const Bad<starfocus_config> kBadConfigs[] = {
    {"", [](starfocus_config* c) { c->size = 0; }, STARFOCUS_ERROR_STRUCTURE},
    {"", [](starfocus_config* c) { c->size = 4; }, STARFOCUS_ERROR_STRUCTURE},
    {"", [](starfocus_config* c) { c->size = sizeof(starfocus_config) + 1; },
     STARFOCUS_ERROR_STRUCTURE},
    {"", [](starfocus_config* c) { c->size = UINT32_MAX; }, STARFOCUS_ERROR_STRUCTURE},
    {"features", [](starfocus_config* c) { c->features |= 64; }},
    {"features", [](starfocus_config* c) { c->features = 0x80000000u; }},
    {"width", [](starfocus_config* c) { c->width = 0; }},
    {"width", [](starfocus_config* c) { c->width = -1; }},
    {"width", [](starfocus_config* c) { c->width = STARFOCUS_MAX_SIZE + 1; }},
    {"width", [](starfocus_config* c) { c->width = INT32_MAX; }},
    {"width", [](starfocus_config* c) { c->width = INT32_MIN; }},
    {"height", [](starfocus_config* c) { c->height = 0; }},
    {"height", [](starfocus_config* c) { c->height = -1; }},
    {"height", [](starfocus_config* c) { c->height = STARFOCUS_MAX_SIZE + 1; }},
    {"height", [](starfocus_config* c) { c->height = INT32_MAX; }},
    {"views", [](starfocus_config* c) { c->views = 0; }},
    {"views", [](starfocus_config* c) { c->views = -1; }},
    {"views", [](starfocus_config* c) { c->views = 2; }},
    {"views", [](starfocus_config* c) { c->views = 16; }},
    {"views", [](starfocus_config* c) { c->views = 18; }},
    {"disparity_min", [](starfocus_config* c) { c->disparity_min = kNanF; }},
    {"disparity_max", [](starfocus_config* c) { c->disparity_max = kNanF; }},
    {"disparity_min", [](starfocus_config* c) { c->disparity_min = -kInfF; }},
    {"disparity_max", [](starfocus_config* c) { c->disparity_max = kInfF; }},
    {"disparity_max", [](starfocus_config* c) { c->disparity_min = 5; }},
    {"disparity_max", [](starfocus_config* c) { c->disparity_max = 501; }},
    {"disparity_min", [](starfocus_config* c) { c->disparity_min = -501; }},
    {"max_blur", [](starfocus_config* c) { c->max_blur = 0; }},
    {"max_blur", [](starfocus_config* c) { c->max_blur = -1; }},
    {"max_blur", [](starfocus_config* c) { c->max_blur = 128.5; }},
    {"max_blur", [](starfocus_config* c) { c->max_blur = kNan; }},
    {"max_blur", [](starfocus_config* c) { c->max_blur = kInf; }},
    {"superblock", [](starfocus_config* c) { c->superblock = 1; }},
    {"superblock", [](starfocus_config* c) { c->superblock = -64; }},
    {"superblock", [](starfocus_config* c) { c->superblock = 16; }},
    {"superblock", [](starfocus_config* c) { c->superblock = 48; }},
    {"superblock", [](starfocus_config* c) { c->superblock = 512; }},
    {"max_workers", [](starfocus_config* c) { c->max_workers = 0; }},
    {"max_workers", [](starfocus_config* c) { c->max_workers = -1; }},
    {"max_workers", [](starfocus_config* c) { c->max_workers = STARFOCUS_MAX_WORKERS + 1; }},
    {"tuning.max_layer", [](starfocus_config* c) { c->tuning.max_layer = -1; }},
    {"tuning.max_layer", [](starfocus_config* c) { c->tuning.max_layer = STARFOCUS_LAYERS; }},
    {"tuning.max_layer", [](starfocus_config* c) { c->tuning.max_layer = INT32_MIN; }},
    {"tuning.max_layer", [](starfocus_config* c) { c->tuning.max_layer = INT32_MAX; }},
    {"tuning.deblocking", [](starfocus_config* c) { c->tuning.deblocking = -1; }},
    {"tuning.deblocking", [](starfocus_config* c) { c->tuning.deblocking = 256; }},
    {"tuning.deblocking", [](starfocus_config* c) { c->tuning.deblocking = INT32_MIN; }},
    {"tuning.deblocking", [](starfocus_config* c) { c->tuning.deblocking = INT32_MAX; }},
    {"tuning.timing.block",
     [](starfocus_config* c) { c->tuning.timing.block = STARFOCUS_MAX_TIMING + 1; }},
    {"tuning.timing.field",
     [](starfocus_config* c) { c->tuning.timing.field = STARFOCUS_MAX_TIMING + 1; }},
    {"tuning.timing.a", [](starfocus_config* c) { c->tuning.timing.a = STARFOCUS_MAX_TIMING + 1; }},
    {"tuning.timing.b", [](starfocus_config* c) { c->tuning.timing.b = UINT32_MAX; }},
    {"tuning.timing.c", [](starfocus_config* c) { c->tuning.timing.c = 0x80000000u; }},
    {"tuning.timing.span",
     [](starfocus_config* c) { c->tuning.timing.span = STARFOCUS_MAX_TIMING + 1; }},
    {"tuning.timing.hole", [](starfocus_config* c) { c->tuning.timing.hole = UINT32_MAX; }},
    {"tuning.timing.upsample", [](starfocus_config* c) { c->tuning.timing.upsample = UINT32_MAX; }},
    {"tuning.n_scale", [](starfocus_config* c) { c->tuning.n_scale = 0; }},
    {"tuning.n_scale", [](starfocus_config* c) { c->tuning.n_scale = 0.4999; }},
    {"tuning.n_scale", [](starfocus_config* c) { c->tuning.n_scale = 2.0001; }},
    {"tuning.n_scale", [](starfocus_config* c) { c->tuning.n_scale = -1; }},
    {"tuning.n_scale", [](starfocus_config* c) { c->tuning.n_scale = kNan; }},
    {"tuning.n_scale", [](starfocus_config* c) { c->tuning.n_scale = kInf; }},
    {"tuning.gather", [](starfocus_config* c) { c->tuning.gather = -1; }},
    {"tuning.gather", [](starfocus_config* c) { c->tuning.gather = 2; }},
    {"previews", [](starfocus_config* c) { c->previews = -1; }},
    {"previews", [](starfocus_config* c) { c->previews = 4; }},
    {"highlights", [](starfocus_config* c) { c->highlights = 0.99F; }},
    {"highlights", [](starfocus_config* c) { c->highlights = 64.1F; }},
    {"highlights", [](starfocus_config* c) { c->highlights = float(kNan); }},
    {"transfer", [](starfocus_config* c) { c->transfer = -1; }},
    {"transfer", [](starfocus_config* c) { c->transfer = 2; }},
};

// Illegal parameters for an engine with disparities in [-2, 2] and a max_blur of 8.
inline const Bad<starfocus_params> kBadParams[] = {
    {"params.size", [](starfocus_params* p) { p->size = 0; }, STARFOCUS_ERROR_STRUCTURE},
    {"params.size", [](starfocus_params* p) { p->size = 4; }, STARFOCUS_ERROR_STRUCTURE},
    {"params.size", [](starfocus_params* p) { p->size = sizeof(starfocus_params) + 1; },
     STARFOCUS_ERROR_STRUCTURE},
    {"params.size", [](starfocus_params* p) { p->size = UINT32_MAX; }, STARFOCUS_ERROR_STRUCTURE},
    {"mode", [](starfocus_params* p) { p->mode = -1; }},
    {"mode", [](starfocus_params* p) { p->mode = STARFOCUS_MODE_BLUR + 1; }},
    {"mode", [](starfocus_params* p) { p->mode = 1000; }},
    {"renderer", [](starfocus_params* p) { p->renderer = -1; }},
    {"renderer", [](starfocus_params* p) { p->renderer = STARFOCUS_RENDERER_SLICES + 1; }},
    {"lens.focus", [](starfocus_params* p) { p->lens.focus = kNan; }},
    {"lens.focus", [](starfocus_params* p) { p->lens.focus = kInf; }},
    {"lens.focus", [](starfocus_params* p) { p->lens.focus = -kInf; }},
    {"lens.focus", [](starfocus_params* p) { p->lens.focus = 1.1e6; }},
    {"lens.focus", [](starfocus_params* p) { p->lens.focus = -1e300; }},
    {"lens.focus_nearer", [](starfocus_params* p) { p->lens.focus_nearer = kNan; }},
    {"lens.focus_nearer", [](starfocus_params* p) { p->lens.focus_nearer = -0.01; }},
    {"lens.focus_nearer", [](starfocus_params* p) { p->lens.focus_nearer = 1e6 + 1; }},
    {"lens.focus_nearer",
     [](starfocus_params* p) { p->lens.focus = p->lens.focus_nearer = 0.6e6; }},
    {"lens.focus_farther", [](starfocus_params* p) { p->lens.focus_farther = kNan; }},
    {"lens.focus_farther", [](starfocus_params* p) { p->lens.focus_farther = -0.01; }},
    {"lens.focus_farther", [](starfocus_params* p) { p->lens.focus_farther = kInf; }},
    {"lens.focus_farther",
     [](starfocus_params* p) {
       p->lens.focus = -0.6e6;
       p->lens.focus_farther = 0.6e6;
     }},
    {"lens.aperture", [](starfocus_params* p) { p->lens.aperture = -1e-300; }},
    {"lens.aperture", [](starfocus_params* p) { p->lens.aperture = -0.5; }},
    {"lens.aperture", [](starfocus_params* p) { p->lens.aperture = 1.0000001; }},
    {"lens.aperture", [](starfocus_params* p) { p->lens.aperture = kNan; }},
    {"lens.aperture", [](starfocus_params* p) { p->lens.aperture = kInf; }},
    {"lens.shape", [](starfocus_params* p) { p->lens.shape = -1; }},
    {"lens.shape", [](starfocus_params* p) { p->lens.shape = STARFOCUS_SHAPE_RING + 1; }},
    {"lens.shape", [](starfocus_params* p) { p->lens.shape = INT32_MAX; }},
    {"lens.shape", [](starfocus_params* p) { p->lens.shape = INT32_MIN; }},
    {"lens.blades", [](starfocus_params* p) { p->lens.blades = 0; }},
    {"lens.blades", [](starfocus_params* p) { p->lens.blades = STARFOCUS_MIN_BLADES - 1; }},
    {"lens.blades", [](starfocus_params* p) { p->lens.blades = STARFOCUS_MAX_BLADES + 1; }},
    {"lens.blades", [](starfocus_params* p) { p->lens.blades = -5; }},
    {"lens.theta", [](starfocus_params* p) { p->lens.theta = 0; }},
    {"lens.theta", [](starfocus_params* p) { p->lens.theta = 0.157; }},
    {"lens.theta", [](starfocus_params* p) { p->lens.theta = 1.414; }},
    {"lens.theta", [](starfocus_params* p) { p->lens.theta = -0.8; }},
    {"lens.theta", [](starfocus_params* p) { p->lens.theta = kNan; }},
    {"lens.theta", [](starfocus_params* p) { p->lens.theta = kInf; }},
    {"lens.rotation", [](starfocus_params* p) { p->lens.rotation = -360.1; }},
    {"lens.rotation", [](starfocus_params* p) { p->lens.rotation = 360.1; }},
    {"lens.rotation", [](starfocus_params* p) { p->lens.rotation = kNan; }},
    {"lens.rotation", [](starfocus_params* p) { p->lens.rotation = -kInf; }},
    {"lens.curvature", [](starfocus_params* p) { p->lens.curvature = -0.001; }},
    {"lens.curvature", [](starfocus_params* p) { p->lens.curvature = 1.001; }},
    {"lens.curvature", [](starfocus_params* p) { p->lens.curvature = kNan; }},
    {"lens.ring_inner", [](starfocus_params* p) { p->lens.ring_inner = -0.001; }},
    {"lens.ring_inner", [](starfocus_params* p) { p->lens.ring_inner = 0.901; }},
    {"lens.ring_inner", [](starfocus_params* p) { p->lens.ring_inner = kNan; }},
    {"lens.cats_eye", [](starfocus_params* p) { p->lens.cats_eye = -0.001; }},
    {"lens.cats_eye", [](starfocus_params* p) { p->lens.cats_eye = 1.001; }},
    {"lens.cats_eye", [](starfocus_params* p) { p->lens.cats_eye = kNan; }},
    {"lens.shape", [](starfocus_params* p) { p->lens.shape = STARFOCUS_SHAPE_POLYGON; },
     STARFOCUS_ERROR_FEATURE},
    {"lens.cats_eye", [](starfocus_params* p) { p->lens.cats_eye = 1e-9; },
     STARFOCUS_ERROR_FEATURE},
    {"preview_shift", [](starfocus_params* p) { p->preview_shift = 1; }},
    {"lens.aperture", [](starfocus_params* p) { p->lens.focus = 6.5; }, STARFOCUS_ERROR_BLUR},
    {"lens.aperture", [](starfocus_params* p) { p->lens.focus = -6.5; }, STARFOCUS_ERROR_BLUR},
    {"lens.aperture", [](starfocus_params* p) { p->lens.focus = 1e6; }, STARFOCUS_ERROR_BLUR},
};

// Illegal light fields for a width of 20.
inline const Bad<starfocus_light_field> kBadFields[] = {
    {"views[].planes", [](starfocus_light_field* f) { f->views[0].planes[0] = nullptr; },
     STARFOCUS_ERROR_NULL},
    {"views[].planes", [](starfocus_light_field* f) { f->views[16].planes[0] = nullptr; },
     STARFOCUS_ERROR_NULL},
    {"depth.data", [](starfocus_light_field* f) { f->depth.data = nullptr; }, STARFOCUS_ERROR_NULL},
    {"views[].strides", [](starfocus_light_field* f) { f->views[0].strides[0] = 0; },
     STARFOCUS_ERROR_STRIDE},
    {"views[].strides", [](starfocus_light_field* f) { f->views[16].strides[0] = 59; },
     STARFOCUS_ERROR_STRIDE},
    {"views[].strides", [](starfocus_light_field* f) { f->views[3].strides[0] = kHuge; },
     STARFOCUS_ERROR_STRIDE},
    {"depth.stride", [](starfocus_light_field* f) { f->depth.stride = 0; }, STARFOCUS_ERROR_STRIDE},
    {"depth.stride", [](starfocus_light_field* f) { f->depth.stride = 76; },
     STARFOCUS_ERROR_STRIDE},
    {"depth.stride", [](starfocus_light_field* f) { f->depth.stride = 82; },
     STARFOCUS_ERROR_STRIDE},
    {"depth.stride", [](starfocus_light_field* f) { f->depth.stride = kHuge - 3; },
     STARFOCUS_ERROR_STRIDE},
};

}  // namespace illegal_values

#endif  // STARFOCUS_TESTS_API_ILLEGAL_VALUES_H_
