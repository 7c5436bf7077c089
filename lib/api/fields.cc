// SPDX-License-Identifier: Apache-2.0
// C API: the fields of public structures, from which bindings build their structures, and the
// defaults of structures with a field `size`.
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
  if (std::is_same_v<Type, const char*>) return STARFOCUS_FIELD_STRING;
  if (std::is_function_v<std::remove_pointer_t<Type>>) return STARFOCUS_FIELD_FUNCTION;
  if (std::is_pointer_v<Type>) return STARFOCUS_FIELD_POINTER;
  if (std::is_floating_point_v<Type>) return STARFOCUS_FIELD_DOUBLE;
  if (sizeof(Type) == 4) {
    return std::is_signed_v<Type> ? STARFOCUS_FIELD_INT32 : STARFOCUS_FIELD_UINT32;
  }
  return std::is_signed_v<Type> ? STARFOCUS_FIELD_INT64 : STARFOCUS_FIELD_UINT64;
}

// `structure` is the name of Nested, the structure that the field contains or points to. If there
// is none, `structure` is null and Nested is void.
template <class Member, class Nested>
constexpr starfocus_field FieldOf(const char* name, const char* structure, size_t offset) {
  using Target = std::remove_cv_t<std::remove_pointer_t<std::remove_extent_t<Member>>>;
  static_assert(std::is_void_v<Nested> || std::is_same_v<Nested, Target>);
  constexpr auto kCount = static_cast<uint32_t>(std::extent_v<Member>);
  return {name, structure, static_cast<uint32_t>(offset), kCount == 0 ? 1 : kCount,
          TypeOf<std::remove_extent_t<Member>>()};
}

#define FIELD_OF(name, structure, Nested) \
  FieldOf<decltype(Type::name), Nested>(#name, structure, offsetof(Type, name))
#define FIELD_AS(name, nested) FIELD_OF(name, "starfocus_" #nested, starfocus_##nested)
#define FIELD(name) FIELD_OF(name, nullptr, void)
#define STRUCTURE(type, ...)                                         \
  if (AreEqual(structure, "starfocus_" #type)) {                     \
    using Type = starfocus_##type;                                   \
    static constexpr starfocus_field kFields[] = {__VA_ARGS__};      \
    if (fields != nullptr) *fields = kFields;                        \
    if (count != nullptr) *count = sizeof kFields / sizeof *kFields; \
    return sizeof(Type);                                             \
  }

}  // namespace
}  // namespace starfocus

using namespace starfocus;

size_t starfocus_fields(const char* structure, const starfocus_field** fields, int32_t* count) {
  if (structure == nullptr) return 0;
  STRUCTURE(image, FIELD(format), FIELD(matrix), FIELD(range), FIELD(pixel_stride), FIELD(planes),
            FIELD(strides))
  STRUCTURE(depth_map, FIELD(data), FIELD(stride), FIELD(width), FIELD(height), FIELD(type),
            FIELD(meaning), FIELD(scale), FIELD(offset), FIELD(invalid), FIELD(has_invalid))
  STRUCTURE(problem, FIELD(status), FIELD(index), FIELD(field), FIELD(expected), FIELD(value),
            FIELD(low), FIELD(high), FIELD(x), FIELD(y))
  STRUCTURE(callbacks, FIELD(runner), FIELD(runner_data), FIELD(progress), FIELD(progress_data),
            FIELD_AS(observer, observer))
  STRUCTURE(position, FIELD(u), FIELD(v))
  STRUCTURE(config, FIELD(size), FIELD(width), FIELD(height), FIELD(views), FIELD(disparity_min),
            FIELD(disparity_max), FIELD(max_blur), FIELD(superblock), FIELD(max_workers),
            FIELD(features), FIELD(unknown), FIELD(previews), FIELD(transfer), FIELD(highlights),
            FIELD_AS(positions, position), FIELD_AS(tuning, tuning))
  STRUCTURE(allocator, FIELD(data), FIELD(allocate), FIELD(release))
  STRUCTURE(region, FIELD(x), FIELD(y), FIELD(width), FIELD(height))
  STRUCTURE(light_field, FIELD(size), FIELD_AS(views, image), FIELD_AS(depth, depth_map),
            FIELD(coverage), FIELD(coverage_stride))
  STRUCTURE(previous, FIELD(size), FIELD_AS(light_field, light_field), FIELD_AS(out, image))
  STRUCTURE(params, FIELD(size), FIELD(shape), FIELD(blades), FIELD(preview_shift), FIELD(focus),
            FIELD(focus_nearer), FIELD(focus_farther), FIELD(aperture), FIELD(theta),
            FIELD(rotation), FIELD(curvature), FIELD(ring_inner), FIELD(cats_eye),
            FIELD_AS(region, region), FIELD_AS(previous, previous), FIELD_AS(study, study))
  STRUCTURE(report, FIELD(size), FIELD(n), FIELD(rendered_views), FIELD(superblock), FIELD(r_max),
            FIELD(rendered_samples), FIELD(copied_pixels), FIELD(gathered_pixels),
            FIELD(reused_blocks), FIELD(unknown_pixels), FIELD_AS(layers, layer_report),
            FIELD(converted_pixels), FIELD(measured_pixels))
  STRUCTURE(disparity_stats, FIELD(min), FIELD(max), FIELD(invalid))
  STRUCTURE(field, FIELD(name), FIELD(structure), FIELD(offset), FIELD(count), FIELD(type))
  STRUCTURE(disparity_output, FIELD(disparity), FIELD(disparity_stride), FIELD(confidence),
            FIELD(confidence_stride), FIELD(coverage), FIELD(coverage_stride), FIELD(has_coverage))
  STRUCTURE(matte, FIELD(data), FIELD(stride), FIELD(pixel_stride), FIELD(width), FIELD(height))
  STRUCTURE(matte_stats, FIELD(covered), FIELD(left), FIELD(top), FIELD(right), FIELD(bottom),
            FIELD(horizon), FIELD(ground))
  STRUCTURE(matte_depth, FIELD(subject), FIELD(background), FIELD(horizon), FIELD(ground))
  STRUCTURE(study, FIELD(size), FIELD(mode), FIELD(renderer))
  STRUCTURE(timing, FIELD(block), FIELD(field), FIELD(a), FIELD(b), FIELD(c), FIELD(upsample),
            FIELD(span), FIELD(hole))
  STRUCTURE(tuning, FIELD(size), FIELD(max_layer), FIELD(deblocking), FIELD(gather), FIELD(n_scale),
            FIELD_AS(timing, timing), FIELD(line_scan))
  STRUCTURE(block, FIELD(x), FIELD(y), FIELD(width), FIELD(height), FIELD(layer), FIELD(n))
  STRUCTURE(layer_report, FIELD(blocks), FIELD(pixels), FIELD(views), FIELD(rendered_samples),
            FIELD(predicted_ps), FIELD(measured_ns), FIELD(surface_pixels), FIELD(hidden_pixels),
            FIELD(filled_pixels), FIELD(selected_pixels), FIELD(shifted_pixels),
            FIELD(composited_pixels))
  STRUCTURE(observer, FIELD(size), FIELD(clock), FIELD(clock_data), FIELD(on_block),
            FIELD(on_block_data))
  return 0;
}

#undef STRUCTURE
#undef FIELD
#undef FIELD_AS
#undef FIELD_OF

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
