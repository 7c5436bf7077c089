// SPDX-License-Identifier: Apache-2.0
// C API: stabilises the disparity maps of a video.
#include "starfocus/video.h"

#include <cstring>
#include <limits>
#include <new>

#include "lib/api/validate.h"
#include "lib/io/depth_map.h"
#include "lib/io/image.h"
#include "lib/video/stabilise.h"
#include "lib/video/track.h"

using namespace starfocus;

namespace starfocus {
namespace {

// The object of the API.
struct StabiliserState {
  Stabiliser core;
  starfocus_problem problem;
};

// Returns the size of the memory, and the object in `memory` unless that is null.
size_t LayOut(const FullConfig& config, void* memory, StabiliserState** state) {
  Arena arena(memory);
  auto* made = arena.Take<StabiliserState>(1);
  StabiliserState counted = {};
  if (made != nullptr) new (made) StabiliserState();
  TakeStabiliser(config, &arena, made != nullptr ? &made->core : &counted.core);
  *state = made;
  return arena.Bytes();
}

size_t SizeOf(const FullConfig& config, Checker* check) {
  CheckPicture(config, check);
  if (!check->passed()) return 0;
  StabiliserState* counted = nullptr;
  const size_t needed = LayOut(config, nullptr, &counted);
  if (needed == kTooLarge) check->Add(STARFOCUS_ERROR_TOO_LARGE);
  return needed;
}

// Checks the frame and the output planes.
void CheckFrame(const FullConfig& config, const starfocus_light_field& frame,
                const starfocus_disparity_output& map, const Extent& memory, Checker* check) {
  const int32_t width = config.width, height = config.height;
  CheckViews(frame, 1, width, height, false, check);
  CheckDepthMap(frame.depth, width, height, check);
  CheckBytes(frame.coverage, frame.coverage_stride, width, height, "coverage_stride", check);
  CheckMap(map.disparity, map.disparity_stride, width, height, "map.disparity",
           "map.disparity_stride", check);
  CheckBytes(map.confidence, map.confidence_stride, width, height, "map.confidence_stride", check);
  CheckBytes(map.coverage, map.coverage_stride, width, height, "map.coverage_stride", check);
  if (!check->passed()) return;
  const auto columns = static_cast<size_t>(width);
  Extents taken;
  taken.Add(memory);
  AddImage(frame.views[0], width, height, &taken);
  const bool in_place = frame.depth.data == map.disparity;
  if (!in_place) AddDepthMap(frame.depth, &taken);
  if (frame.coverage != nullptr && frame.coverage != map.coverage) {
    taken.AddRows(frame.coverage, frame.coverage_stride, height, columns);
  }
  const Extent written[] = {
      ExtentOf(map.disparity, map.disparity_stride, height, columns * sizeof(float)),
      ExtentOf(map.confidence, map.confidence_stride, height, columns),
      ExtentOf(map.coverage, map.coverage_stride, height, columns)};
  const bool wanted[] = {true, map.confidence != nullptr, map.coverage != nullptr};
  for (int k = 0; k < 3; ++k) {
    if (!wanted[k]) continue;
    check->Apart(written[k], taken, "map");
    taken.Add(written[k]);
  }
}

// Reads the map and the colours of a frame. Returns the flags of the map.
uint32_t ReadFrame(const starfocus_light_field& frame, Stabiliser* s) {
  const FullConfig& config = s->config;
  const simd::ImageKernels& kernels = simd::BestImageKernels();
  StableFrame& now = s->frames[1 - s->current];
  FillColumns(config.width, frame.depth.width, 0, config.width, s->columns);
  const simd::DepthRule rule = RuleOf(frame.depth, MinDisparity(config), MaxDisparity(config));
  const DepthSource source = {frame.depth, rule, config.width, config.height, s->columns};
  const uint32_t flags = ReadDepth(kernels, source, {0, 0, config.width, config.height}, s->given);
  const ImageSource image = PlanesOf<const uint8_t>(frame.views[0]);
  for (int32_t y = 0; y < config.height; ++y) {
    ReadCodes(kernels, image, 0, y, config.width, now.rgb.Row(y));
    if (frame.coverage == nullptr) continue;
    std::memcpy(s->coverage.Row(y), frame.coverage + static_cast<size_t>(y) * frame.coverage_stride,
                static_cast<size_t>(config.width));
  }
  PadColours(config, now.rgb);
  now.has_coverage = frame.coverage != nullptr;
  return flags;
}

void WriteMap(const Stabiliser& s, starfocus_disparity_output* map) {
  const StableFrame& now = s.frames[s.current];
  const auto low = MinDisparity(s.config), high = MaxDisparity(s.config);
  const auto width = static_cast<size_t>(s.config.width);
  constexpr float kPixel = 1.0F / (1 << kDisparityBits);
  for (int32_t y = 0; y < s.config.height; ++y) {
    const auto row = static_cast<size_t>(y);
    float* const out = map->disparity + row * (map->disparity_stride / sizeof(float));
    const int16_t* const disparity = now.disparity.Row(y);
    const uint8_t *const count = now.count.Row(y), *const others = now.others.Row(y);
    for (size_t x = 0; x < width; ++x) {
      const float value = static_cast<float>(disparity[x]) * kPixel;
      out[x] = value < low ? low : value > high ? high : value;
      if (count[x] == 0) out[x] = std::numeric_limits<float>::quiet_NaN();
    }
    for (size_t x = 0; map->confidence != nullptr && x < width; ++x) {
      const int share = count[x] < 2 ? 0 : 255 * count[x] / (count[x] + others[x]);
      map->confidence[row * map->confidence_stride + x] = static_cast<uint8_t>(share);
    }
    if (map->coverage == nullptr || !now.has_coverage) continue;
    std::memcpy(map->coverage + row * map->coverage_stride, now.coverage.Row(y), width);
  }
  map->has_coverage = map->coverage != nullptr && now.has_coverage ? 1 : 0;
}

// Starts an API call that follows a subject.
Checker EnterTrack(starfocus_stabiliser* stabiliser, const starfocus_track* track) {
  auto* const state = reinterpret_cast<StabiliserState*>(stabiliser);
  Checker check = Enter(state == nullptr ? nullptr : &state->problem);
  check.NotNull(stabiliser, "stabiliser");
  check.NotNull(track, "track");
  if (!check.passed()) return check;
  const Stabiliser& s = state->core;
  constexpr auto kLeast = static_cast<int32_t>(simd::kCompared);
  check.Need(s.length > 0, STARFOCUS_ERROR_STATE, {"stabiliser"}, {"a stabilised frame"});
  check.In({"width", double(s.config.width)}, STARFOCUS_FROM_TO(kLeast, STARFOCUS_MAX_SIZE));
  check.In({"height", double(s.config.height)}, STARFOCUS_FROM_TO(kLeast, STARFOCUS_MAX_SIZE));
  return check;
}

}  // namespace
}  // namespace starfocus

starfocus_status starfocus_stabiliser_size(const starfocus_config* config, size_t* bytes,
                                           starfocus_problem* problem) {
  FullConfig full;
  Checker check = Enter(config, problem, &full);
  check.NotNull(bytes, "bytes");
  const size_t needed = SizeOf(full, &check);
  if (check.passed()) *bytes = needed;
  return check.status();
}

starfocus_status starfocus_stabiliser_init(const starfocus_config* config, void* memory,
                                           size_t bytes, starfocus_stabiliser** stabiliser,
                                           starfocus_problem* problem) {
  FullConfig full;
  Checker check = Enter(config, problem, &full);
  check.NotNull(memory, "memory");
  check.NotNull(stabiliser, "stabiliser");
  const size_t needed = SizeOf(full, &check);
  CheckMemory("memory", memory, bytes, needed, &check);
  if (!check.passed()) return check.status();
  StabiliserState* state = nullptr;
  LayOut(full, memory, &state);
  state->core.config.problem = &state->problem;
  *stabiliser = reinterpret_cast<starfocus_stabiliser*>(state);
  return STARFOCUS_OK;
}

starfocus_status starfocus_stabilise_disparity(starfocus_stabiliser* stabiliser,
                                               const starfocus_callbacks* callbacks,
                                               const starfocus_light_field* frame,
                                               starfocus_disparity_output* map,
                                               starfocus_stabiliser_report* report) {
  if (stabiliser == nullptr) return STARFOCUS_ERROR_NULL;
  auto* const state = reinterpret_cast<StabiliserState*>(stabiliser);
  Stabiliser* const s = &state->core;
  const FullConfig& config = s->config;
  starfocus_light_field field = {};
  Checker check = Enter(&state->problem);
  check.NotNull(frame, "frame");
  check.NotNull(map, "map");
  if (check.passed()) check.Read(*frame, "frame.size", &field);
  if (!check.passed()) return check.status();
  StabiliserState* counted = nullptr;
  const auto begin = reinterpret_cast<uintptr_t>(stabiliser);
  CheckFrame(config, field, *map, {begin, begin + LayOut(config, nullptr, &counted)}, &check);
  if (!check.passed()) return check.status();
  const uint32_t flags = ReadFrame(field, s);
  check.Need((flags & simd::kDepthOutside) == 0, STARFOCUS_ERROR_DISPARITY, {"disparity"},
             {"disparity_min to disparity_max", config.disparity_min, config.disparity_max});
  if (!check.passed()) return TellPlace(check.status(), field.depth, 0, &state->problem);
  Jobs* const jobs = s->jobs;
  jobs->runner = callbacks != nullptr ? callbacks->runner : nullptr;
  jobs->runner_data = callbacks != nullptr ? callbacks->runner_data : nullptr;
  jobs->call_progress.SetProgress(callbacks != nullptr ? callbacks->progress : nullptr,
                                  callbacks != nullptr ? callbacks->progress_data : nullptr);
  jobs->call_progress.Begin(0, config.height);
  StabiliserReport found;
  if (check.Add(Stabilise(s, &found)) != STARFOCUS_OK) return check.status();
  WriteMap(*s, map);
  if (report != nullptr) {
    *report = {found.followed, found.followed - found.kept, found.is_cut ? 1 : 0,
               1 + found.drift.scale / static_cast<double>(1 << kDriftBits),
               found.drift.offset / static_cast<double>(1 << kDisparityBits)};
  }
  return check.status();
}

starfocus_status starfocus_track_begin(starfocus_stabiliser* stabiliser, int32_t x, int32_t y,
                                       starfocus_track* track) {
  Checker check = EnterTrack(stabiliser, track);
  if (!check.passed()) return check.status();
  const Stabiliser& s = reinterpret_cast<StabiliserState*>(stabiliser)->core;
  check.In({"x", double(x)}, {"inside the picture", 0, s.config.width - 1.0});
  check.In({"y", double(y)}, {"inside the picture", 0, s.config.height - 1.0});
  if (check.passed()) BeginTrack(s, x, y, track);
  return check.status();
}

starfocus_status starfocus_track_focus(starfocus_stabiliser* stabiliser, starfocus_track* track) {
  Checker check = EnterTrack(stabiliser, track);
  if (!check.passed()) return check.status();
  const Stabiliser& s = reinterpret_cast<StabiliserState*>(stabiliser)->core;
  check.In({"track.x", double(track->x)}, {"inside the picture", 0, s.config.width - 1.0});
  check.In({"track.y", double(track->y)}, {"inside the picture", 0, s.config.height - 1.0});
  check.In({"track.focus", track->focus},
           STARFOCUS_FROM_TO(-STARFOCUS_MAX_DISPARITY, STARFOCUS_MAX_DISPARITY));
  if (check.passed()) FollowTrack(s, track);
  return check.status();
}

void starfocus_stabiliser_restart(starfocus_stabiliser* stabiliser) {
  if (stabiliser != nullptr) reinterpret_cast<StabiliserState*>(stabiliser)->core.length = 0;
}

const starfocus_problem* starfocus_stabiliser_problem(const starfocus_stabiliser* stabiliser) {
  return stabiliser == nullptr ? nullptr
                               : &reinterpret_cast<const StabiliserState*>(stabiliser)->problem;
}
