// SPDX-License-Identifier: Apache-2.0
// Illegal values of the public structures, and the fields that errors must name.
#ifndef STARFOCUS_TESTS_API_ILLEGAL_VALUES_H_
#define STARFOCUS_TESTS_API_ILLEGAL_VALUES_H_

#include <cstddef>
#include <cstdint>
#include <limits>

#include "starfocus/starfocus.h"
#include "tests/support/config.h"

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

inline const Bad<test::Config> kBadConfigs[] = {
    {"", [](test::Config* c) { c->size = 0; }, STARFOCUS_ERROR_STRUCTURE},
    {"", [](test::Config* c) { c->size = 4; }, STARFOCUS_ERROR_STRUCTURE},
    {"", [](test::Config* c) { c->size = sizeof(starfocus_config) + 1; },
     STARFOCUS_ERROR_STRUCTURE},
    {"", [](test::Config* c) { c->size = UINT32_MAX; }, STARFOCUS_ERROR_STRUCTURE},
    {"features", [](test::Config* c) { c->features |= 64; }},
    {"features", [](test::Config* c) { c->features = 0x80000000u; }},
    {"width", [](test::Config* c) { c->width = 0; }},
    {"width", [](test::Config* c) { c->width = -1; }},
    {"width", [](test::Config* c) { c->width = STARFOCUS_MAX_SIZE + 1; }},
    {"width", [](test::Config* c) { c->width = INT32_MAX; }},
    {"width", [](test::Config* c) { c->width = INT32_MIN; }},
    {"height", [](test::Config* c) { c->height = 0; }},
    {"height", [](test::Config* c) { c->height = -1; }},
    {"height", [](test::Config* c) { c->height = STARFOCUS_MAX_SIZE + 1; }},
    {"height", [](test::Config* c) { c->height = INT32_MAX; }},
    {"views", [](test::Config* c) { c->views = 0; }},
    {"views", [](test::Config* c) { c->views = -1; }},
    {"views", [](test::Config* c) { c->views = 2; }},
    {"views", [](test::Config* c) { c->views = 16; }},
    {"views", [](test::Config* c) { c->views = 18; }},
    {"disparity_min", [](test::Config* c) { c->disparity_min = kNanF; }},
    {"disparity_max", [](test::Config* c) { c->disparity_max = kNanF; }},
    {"disparity_min", [](test::Config* c) { c->disparity_min = -kInfF; }},
    {"disparity_max", [](test::Config* c) { c->disparity_max = kInfF; }},
    {"disparity_max", [](test::Config* c) { c->disparity_min = 5; }},
    {"disparity_max", [](test::Config* c) { c->disparity_max = 501; }},
    {"disparity_min", [](test::Config* c) { c->disparity_min = -501; }},
    {"max_blur", [](test::Config* c) { c->max_blur = 0; }},
    {"max_blur", [](test::Config* c) { c->max_blur = -1; }},
    {"max_blur", [](test::Config* c) { c->max_blur = 128.5; }},
    {"max_blur", [](test::Config* c) { c->max_blur = kNan; }},
    {"max_blur", [](test::Config* c) { c->max_blur = kInf; }},
    {"superblock", [](test::Config* c) { c->superblock = 1; }},
    {"superblock", [](test::Config* c) { c->superblock = -64; }},
    {"superblock", [](test::Config* c) { c->superblock = 16; }},
    {"superblock", [](test::Config* c) { c->superblock = 48; }},
    {"superblock", [](test::Config* c) { c->superblock = 512; }},
    {"max_workers", [](test::Config* c) { c->max_workers = 0; }},
    {"max_workers", [](test::Config* c) { c->max_workers = -1; }},
    {"max_workers", [](test::Config* c) { c->max_workers = STARFOCUS_MAX_WORKERS + 1; }},
    {"tuning.max_layer", [](test::Config* c) { c->tuning.max_layer = -1; }},
    {"tuning.max_layer", [](test::Config* c) { c->tuning.max_layer = STARFOCUS_LAYERS; }},
    {"tuning.max_layer", [](test::Config* c) { c->tuning.max_layer = INT32_MIN; }},
    {"tuning.max_layer", [](test::Config* c) { c->tuning.max_layer = INT32_MAX; }},
    {"tuning.deblocking", [](test::Config* c) { c->tuning.deblocking = -1; }},
    {"tuning.deblocking", [](test::Config* c) { c->tuning.deblocking = 256; }},
    {"tuning.deblocking", [](test::Config* c) { c->tuning.deblocking = INT32_MIN; }},
    {"tuning.deblocking", [](test::Config* c) { c->tuning.deblocking = INT32_MAX; }},
    {"tuning.timing.block",
     [](test::Config* c) { c->tuning.timing.block = STARFOCUS_MAX_TIMING + 1; }},
    {"tuning.timing.field",
     [](test::Config* c) { c->tuning.timing.field = STARFOCUS_MAX_TIMING + 1; }},
    {"tuning.timing.a", [](test::Config* c) { c->tuning.timing.a = STARFOCUS_MAX_TIMING + 1; }},
    {"tuning.timing.b", [](test::Config* c) { c->tuning.timing.b = UINT32_MAX; }},
    {"tuning.timing.c", [](test::Config* c) { c->tuning.timing.c = 0x80000000u; }},
    {"tuning.timing.span",
     [](test::Config* c) { c->tuning.timing.span = STARFOCUS_MAX_TIMING + 1; }},
    {"tuning.timing.hole", [](test::Config* c) { c->tuning.timing.hole = UINT32_MAX; }},
    {"tuning.timing.upsample", [](test::Config* c) { c->tuning.timing.upsample = UINT32_MAX; }},
    {"tuning.n_scale", [](test::Config* c) { c->tuning.n_scale = 0; }},
    {"tuning.n_scale", [](test::Config* c) { c->tuning.n_scale = 0.4999; }},
    {"tuning.n_scale", [](test::Config* c) { c->tuning.n_scale = 2.0001; }},
    {"tuning.n_scale", [](test::Config* c) { c->tuning.n_scale = -1; }},
    {"tuning.n_scale", [](test::Config* c) { c->tuning.n_scale = kNan; }},
    {"tuning.n_scale", [](test::Config* c) { c->tuning.n_scale = kInf; }},
    {"tuning.gather", [](test::Config* c) { c->tuning.gather = -1; }},
    {"tuning.gather", [](test::Config* c) { c->tuning.gather = 2; }},
    {"previews", [](test::Config* c) { c->previews = -1; }},
    {"previews", [](test::Config* c) { c->previews = 4; }},
    {"highlights", [](test::Config* c) { c->highlights = 0.99F; }},
    {"highlights", [](test::Config* c) { c->highlights = 64.1F; }},
    {"highlights", [](test::Config* c) { c->highlights = float(kNan); }},
    {"transfer", [](test::Config* c) { c->transfer = -1; }},
    {"transfer", [](test::Config* c) { c->transfer = 2; }},
};

// Illegal parameters for an engine with disparities in [-2, 2] and a max_blur of 8.
inline const Bad<starfocus::Params> kBadParams[] = {
    {"params.size", [](starfocus::Params* p) { p->size = 0; }, STARFOCUS_ERROR_STRUCTURE},
    {"params.size", [](starfocus::Params* p) { p->size = 4; }, STARFOCUS_ERROR_STRUCTURE},
    {"params.size", [](starfocus::Params* p) { p->size = sizeof(starfocus_params) + 1; },
     STARFOCUS_ERROR_STRUCTURE},
    {"params.size", [](starfocus::Params* p) { p->size = UINT32_MAX; }, STARFOCUS_ERROR_STRUCTURE},
    {"study.mode", [](starfocus::Params* p) { p->study.mode = -1; }},
    {"study.mode", [](starfocus::Params* p) { p->study.mode = STARFOCUS_MODE_BLUR + 1; }},
    {"study.mode", [](starfocus::Params* p) { p->study.mode = 1000; }},
    {"study.renderer", [](starfocus::Params* p) { p->study.renderer = -1; }},
    {"study.renderer",
     [](starfocus::Params* p) { p->study.renderer = STARFOCUS_RENDERER_SLICES + 1; }},
    {"focus", [](starfocus::Params* p) { p->focus = kNan; }},
    {"focus", [](starfocus::Params* p) { p->focus = kInf; }},
    {"focus", [](starfocus::Params* p) { p->focus = -kInf; }},
    {"focus", [](starfocus::Params* p) { p->focus = 1.1e6; }},
    {"focus", [](starfocus::Params* p) { p->focus = -1e300; }},
    {"focus_nearer", [](starfocus::Params* p) { p->focus_nearer = kNan; }},
    {"focus_nearer", [](starfocus::Params* p) { p->focus_nearer = -0.01; }},
    {"focus_nearer", [](starfocus::Params* p) { p->focus_nearer = 1e6 + 1; }},
    {"focus_nearer", [](starfocus::Params* p) { p->focus = p->focus_nearer = 0.6e6; }},
    {"focus_farther", [](starfocus::Params* p) { p->focus_farther = kNan; }},
    {"focus_farther", [](starfocus::Params* p) { p->focus_farther = -0.01; }},
    {"focus_farther", [](starfocus::Params* p) { p->focus_farther = kInf; }},
    {"focus_farther",
     [](starfocus::Params* p) {
       p->focus = -0.6e6;
       p->focus_farther = 0.6e6;
     }},
    {"aperture", [](starfocus::Params* p) { p->aperture = -1e-300; }},
    {"aperture", [](starfocus::Params* p) { p->aperture = -0.5; }},
    {"aperture", [](starfocus::Params* p) { p->aperture = 1.0000001; }},
    {"aperture", [](starfocus::Params* p) { p->aperture = kNan; }},
    {"aperture", [](starfocus::Params* p) { p->aperture = kInf; }},
    {"shape", [](starfocus::Params* p) { p->shape = -1; }},
    {"shape", [](starfocus::Params* p) { p->shape = STARFOCUS_SHAPE_RING + 1; }},
    {"shape", [](starfocus::Params* p) { p->shape = INT32_MAX; }},
    {"shape", [](starfocus::Params* p) { p->shape = INT32_MIN; }},
    {"blades", [](starfocus::Params* p) { p->blades = 0; }},
    {"blades", [](starfocus::Params* p) { p->blades = STARFOCUS_MIN_BLADES - 1; }},
    {"blades", [](starfocus::Params* p) { p->blades = STARFOCUS_MAX_BLADES + 1; }},
    {"blades", [](starfocus::Params* p) { p->blades = -5; }},
    {"theta", [](starfocus::Params* p) { p->theta = 0; }},
    {"theta", [](starfocus::Params* p) { p->theta = 0.157; }},
    {"theta", [](starfocus::Params* p) { p->theta = 1.414; }},
    {"theta", [](starfocus::Params* p) { p->theta = -0.8; }},
    {"theta", [](starfocus::Params* p) { p->theta = kNan; }},
    {"theta", [](starfocus::Params* p) { p->theta = kInf; }},
    {"rotation", [](starfocus::Params* p) { p->rotation = -360.1; }},
    {"rotation", [](starfocus::Params* p) { p->rotation = 360.1; }},
    {"rotation", [](starfocus::Params* p) { p->rotation = kNan; }},
    {"rotation", [](starfocus::Params* p) { p->rotation = -kInf; }},
    {"curvature", [](starfocus::Params* p) { p->curvature = -0.001; }},
    {"curvature", [](starfocus::Params* p) { p->curvature = 1.001; }},
    {"curvature", [](starfocus::Params* p) { p->curvature = kNan; }},
    {"ring_inner", [](starfocus::Params* p) { p->ring_inner = -0.001; }},
    {"ring_inner", [](starfocus::Params* p) { p->ring_inner = 0.901; }},
    {"ring_inner", [](starfocus::Params* p) { p->ring_inner = kNan; }},
    {"cats_eye", [](starfocus::Params* p) { p->cats_eye = -0.001; }},
    {"cats_eye", [](starfocus::Params* p) { p->cats_eye = 1.001; }},
    {"cats_eye", [](starfocus::Params* p) { p->cats_eye = kNan; }},
    {"shape", [](starfocus::Params* p) { p->shape = STARFOCUS_SHAPE_POLYGON; },
     STARFOCUS_ERROR_FEATURE},
    {"cats_eye", [](starfocus::Params* p) { p->cats_eye = 1e-9; }, STARFOCUS_ERROR_FEATURE},
    {"preview_shift", [](starfocus::Params* p) { p->preview_shift = 1; }},
    {"aperture", [](starfocus::Params* p) { p->focus = 6.5; }, STARFOCUS_ERROR_BLUR},
    {"aperture", [](starfocus::Params* p) { p->focus = -6.5; }, STARFOCUS_ERROR_BLUR},
    {"aperture", [](starfocus::Params* p) { p->focus = 1e6; }, STARFOCUS_ERROR_BLUR},
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
