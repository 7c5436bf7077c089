// SPDX-License-Identifier: Apache-2.0
// C API: the fields of public structures, from which bindings build their structures, and the
// defaults of structures with a field `size`.
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "lib/api/validate.h"
#include "starfocus/experimental.h"
#include "starfocus/matte.h"

namespace starfocus {
namespace {

template <class Type>
constexpr int32_t TypeOf() {
  if (std::is_class_v<Type>) return STARFOCUS_FIELD_STRUCTURE;
  if (std::is_pointer_v<Type>) return STARFOCUS_FIELD_POINTER;
  if (std::is_floating_point_v<Type>) return STARFOCUS_FIELD_DOUBLE;
  if (sizeof(Type) == 4) {
    return std::is_signed_v<Type> ? STARFOCUS_FIELD_INT32 : STARFOCUS_FIELD_UINT32;
  }
  return std::is_signed_v<Type> ? STARFOCUS_FIELD_INT64 : STARFOCUS_FIELD_UINT64;
}

template <class Member>
constexpr starfocus_field FieldOf(const char* name, const char* structure, size_t offset) {
  constexpr auto kCount = static_cast<uint32_t>(std::extent_v<Member>);
  return {name, structure, static_cast<uint32_t>(offset), kCount == 0 ? 1 : kCount,
          TypeOf<std::remove_extent_t<Member>>()};
}

#define NESTED(type, name, nested) \
  FieldOf<decltype(starfocus_##type::name)>(#name, nested, offsetof(starfocus_##type, name))
#define FIELD(type, name) NESTED(type, name, nullptr)

constexpr starfocus_field kImage[] = {
    FIELD(image, format),       FIELD(image, matrix), FIELD(image, range),
    FIELD(image, pixel_stride), FIELD(image, planes), FIELD(image, strides),
};
constexpr starfocus_field kDepthMap[] = {
    FIELD(depth_map, data),        FIELD(depth_map, stride), FIELD(depth_map, width),
    FIELD(depth_map, height),      FIELD(depth_map, type),   FIELD(depth_map, meaning),
    FIELD(depth_map, scale),       FIELD(depth_map, offset), FIELD(depth_map, invalid),
    FIELD(depth_map, has_invalid),
};
constexpr starfocus_field kProblem[] = {
    FIELD(problem, status),   FIELD(problem, index), FIELD(problem, field),
    FIELD(problem, expected), FIELD(problem, value), FIELD(problem, low),
    FIELD(problem, high),     FIELD(problem, x),     FIELD(problem, y),
};
constexpr starfocus_field kCallbacks[] = {
    FIELD(callbacks, runner),        FIELD(callbacks, runner_data), FIELD(callbacks, progress),
    FIELD(callbacks, progress_data), FIELD(callbacks, observer),
};
constexpr starfocus_field kPosition[] = {
    FIELD(position, u),
    FIELD(position, v),
};
constexpr starfocus_field kConfig[] = {
    FIELD(config, size),
    FIELD(config, width),
    FIELD(config, height),
    FIELD(config, views),
    FIELD(config, disparity_min),
    FIELD(config, disparity_max),
    FIELD(config, max_blur),
    FIELD(config, superblock),
    FIELD(config, max_workers),
    FIELD(config, features),
    FIELD(config, unknown),
    FIELD(config, previews),
    FIELD(config, transfer),
    FIELD(config, highlights),
    NESTED(config, positions, "starfocus_position"),
    FIELD(config, tuning),
};
constexpr starfocus_field kAllocator[] = {
    FIELD(allocator, data),
    FIELD(allocator, allocate),
    FIELD(allocator, release),
};
constexpr starfocus_field kRegion[] = {
    FIELD(region, x),
    FIELD(region, y),
    FIELD(region, width),
    FIELD(region, height),
};
constexpr starfocus_field kLightField[] = {
    FIELD(light_field, size),
    NESTED(light_field, views, "starfocus_image"),
    NESTED(light_field, depth, "starfocus_depth_map"),
    FIELD(light_field, coverage),
    FIELD(light_field, coverage_stride),
};
constexpr starfocus_field kPrevious[] = {
    FIELD(previous, size),
    FIELD(previous, light_field),
    FIELD(previous, out),
};
constexpr starfocus_field kParams[] = {
    FIELD(params, size),          FIELD(params, shape),
    FIELD(params, blades),        FIELD(params, preview_shift),
    FIELD(params, focus),         FIELD(params, focus_nearer),
    FIELD(params, focus_farther), FIELD(params, aperture),
    FIELD(params, theta),         FIELD(params, rotation),
    FIELD(params, curvature),     FIELD(params, ring_inner),
    FIELD(params, cats_eye),      NESTED(params, region, "starfocus_region"),
    FIELD(params, previous),      FIELD(params, study),
};
constexpr starfocus_field kReport[] = {
    FIELD(report, size),           FIELD(report, n),
    FIELD(report, rendered_views), FIELD(report, superblock),
    FIELD(report, r_max),          FIELD(report, rendered_samples),
    FIELD(report, copied_pixels),  FIELD(report, gathered_pixels),
    FIELD(report, reused_blocks),  FIELD(report, unknown_pixels),
    FIELD(report, layers),
};
constexpr starfocus_field kDisparityStats[] = {
    FIELD(disparity_stats, min),
    FIELD(disparity_stats, max),
    FIELD(disparity_stats, invalid),
};
constexpr starfocus_field kField[] = {
    FIELD(field, name),  FIELD(field, structure), FIELD(field, offset),
    FIELD(field, count), FIELD(field, type),
};
constexpr starfocus_field kDisparityOutput[] = {
    FIELD(disparity_output, disparity),    FIELD(disparity_output, disparity_stride),
    FIELD(disparity_output, confidence),   FIELD(disparity_output, confidence_stride),
    FIELD(disparity_output, coverage),     FIELD(disparity_output, coverage_stride),
    FIELD(disparity_output, has_coverage),
};
constexpr starfocus_field kMatte[] = {
    FIELD(matte, data),  FIELD(matte, stride), FIELD(matte, pixel_stride),
    FIELD(matte, width), FIELD(matte, height),
};
constexpr starfocus_field kMatteStats[] = {
    FIELD(matte_stats, covered), FIELD(matte_stats, left),   FIELD(matte_stats, top),
    FIELD(matte_stats, right),   FIELD(matte_stats, bottom), FIELD(matte_stats, horizon),
    FIELD(matte_stats, ground),
};
constexpr starfocus_field kMatteDepth[] = {
    FIELD(matte_depth, subject),
    FIELD(matte_depth, background),
    FIELD(matte_depth, horizon),
    FIELD(matte_depth, ground),
};
constexpr starfocus_field kStudy[] = {
    FIELD(study, size),
    FIELD(study, mode),
    FIELD(study, renderer),
};
constexpr starfocus_field kTiming[] = {
    FIELD(timing, block), FIELD(timing, field),    FIELD(timing, a),    FIELD(timing, b),
    FIELD(timing, c),     FIELD(timing, upsample), FIELD(timing, span), FIELD(timing, hole),
};
constexpr starfocus_field kTuning[] = {
    FIELD(tuning, size),      FIELD(tuning, max_layer), FIELD(tuning, deblocking),
    FIELD(tuning, gather),    FIELD(tuning, n_scale),   NESTED(tuning, timing, "starfocus_timing"),
    FIELD(tuning, line_scan),
};
constexpr starfocus_field kBlock[] = {
    FIELD(block, x),      FIELD(block, y),     FIELD(block, width),
    FIELD(block, height), FIELD(block, layer), FIELD(block, n),
};
constexpr starfocus_field kLayerReport[] = {
    FIELD(layer_report, blocks),       FIELD(layer_report, pixels),
    FIELD(layer_report, views),        FIELD(layer_report, rendered_samples),
    FIELD(layer_report, predicted_ps), FIELD(layer_report, measured_ns),
};
constexpr starfocus_field kObserver[] = {
    FIELD(observer, size),     FIELD(observer, clock),         FIELD(observer, clock_data),
    FIELD(observer, on_block), FIELD(observer, on_block_data),
};

#undef FIELD
#undef NESTED

constexpr struct {
  const char* name;
  const starfocus_field* fields;
  int32_t count;
  size_t size;
} kStructures[] = {
#define STRUCTURE(type, fields) \
  { "starfocus_" #type, fields, sizeof fields / sizeof *fields, sizeof(starfocus_##type) }
    STRUCTURE(image, kImage),
    STRUCTURE(depth_map, kDepthMap),
    STRUCTURE(problem, kProblem),
    STRUCTURE(callbacks, kCallbacks),
    STRUCTURE(position, kPosition),
    STRUCTURE(config, kConfig),
    STRUCTURE(allocator, kAllocator),
    STRUCTURE(region, kRegion),
    STRUCTURE(light_field, kLightField),
    STRUCTURE(previous, kPrevious),
    STRUCTURE(params, kParams),
    STRUCTURE(report, kReport),
    STRUCTURE(disparity_stats, kDisparityStats),
    STRUCTURE(field, kField),
    STRUCTURE(disparity_output, kDisparityOutput),
    STRUCTURE(matte, kMatte),
    STRUCTURE(matte_stats, kMatteStats),
    STRUCTURE(matte_depth, kMatteDepth),
    STRUCTURE(study, kStudy),
    STRUCTURE(timing, kTiming),
    STRUCTURE(tuning, kTuning),
    STRUCTURE(block, kBlock),
    STRUCTURE(layer_report, kLayerReport),
    STRUCTURE(observer, kObserver),
#undef STRUCTURE
};

}  // namespace
}  // namespace starfocus

using namespace starfocus;

size_t starfocus_fields(const char* structure, const starfocus_field** fields, int32_t* count) {
  if (structure == nullptr) return 0;
  for (const auto& entry : kStructures) {
    if (!AreEqual(entry.name, structure)) continue;
    if (fields != nullptr) *fields = entry.fields;
    if (count != nullptr) *count = entry.count;
    return entry.size;
  }
  return 0;
}

starfocus_status starfocus_defaults(const char* structure, void* to, uint32_t size) {
  if (structure == nullptr) return STARFOCUS_ERROR_NULL;
  const auto is = [&](const char* name) { return AreEqual(structure, name); };
  // Writes the defaults to the part of the caller's structure that the library knows, and zeros to
  // the rest.
  const auto set = [&](auto defaults) {
    if (to == nullptr || size < sizeof size) return STARFOCUS_OK;
    defaults.size = size;
    if (size > sizeof defaults) std::memset(to, 0, size);
    std::memcpy(to, &defaults, size < sizeof defaults ? size : sizeof defaults);
    return STARFOCUS_OK;
  };
  const FullConfig config = DefaultConfig();
  if (is("starfocus_config")) return set(static_cast<const starfocus_config&>(config));
  if (is("starfocus_tuning")) return set(config.tuning);
  const FullParams params = DefaultParams();
  if (is("starfocus_params")) return set(static_cast<const starfocus_params&>(params));
  if (is("starfocus_study")) return set(starfocus_study{0, params.mode, params.renderer});
  if (is("starfocus_light_field")) return set(starfocus_light_field{});
  if (is("starfocus_previous")) return set(starfocus_previous{});
  if (is("starfocus_report")) return set(starfocus_report{});
  if (is("starfocus_observer")) return set(starfocus_observer{});
  return STARFOCUS_ERROR_RANGE;
}
