// SPDX-License-Identifier: Apache-2.0
// A program that uses only starfocus.hpp and the shared library, without exceptions and RTTI.
#include <cstdio>
#include <cstdlib>
#include <new>
#include <starfocus/starfocus.hpp>
#include <utility>
#include <vector>

#include "starfocus/starfocus.hpp"

namespace {

bool no_memory = false;  // true if allocations of workspaces and prepared light fields fail

}  // namespace

void* operator new(size_t size, std::align_val_t, const std::nothrow_t&) noexcept {
  return no_memory ? nullptr : std::aligned_alloc(STARFOCUS_ALIGNMENT, (size + 63) / 64 * 64);
}
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }

namespace {

constexpr int kSize = 12;

// A light field of one view. The view has a single colour, so every refocused picture has only this
// colour.
struct Field {
  std::vector<uint8_t> picture = std::vector<uint8_t>(3 * kSize * kSize, 50);
  std::vector<float> disparity = std::vector<float>(kSize * kSize, 0.5f);
  starfocus_light_field field = starfocus::NewLightField();
  starfocus::Config config;
  starfocus::Params params;

  Field() {
    field.views[0] = starfocus_image_rgb(picture.data(), 3 * kSize);
    field.depth = starfocus_depth_float(disparity.data(), kSize * sizeof(float), kSize, kSize);
    config.width = config.height = kSize;
    config.views = 1;
    config.disparity_max = 1;
    config.features |= STARFOCUS_FEATURE_STREAMING;
    config.previews = 1;
    params.focus = 3;
  }

  // Returns true if refocus(out) succeeds and writes a picture of `size` x `size` pixels.
  template <class Refocus>
  static bool Writes(size_t size, const Refocus& refocus) {
    std::vector<uint8_t> out(3 * size * size);
    return refocus(starfocus_image_rgb(out.data(), 3 * size)) == STARFOCUS_OK &&
           out == std::vector<uint8_t>(out.size(), 50);
  }
  bool Refocuses(starfocus::Engine* engine) const {
    return Writes(kSize, [&](const auto& out) { return engine->Refocus(params, field, out); });
  }
  bool RefocusesPrepared(starfocus::Engine* engine) const {
    return Writes(kSize, [&](const auto& out) { return engine->RefocusPrepared(params, out); });
  }
  bool Prepares(starfocus::Engine* engine) const {
    return engine->Init(config) == STARFOCUS_OK && engine->Prepare(field) == STARFOCUS_OK;
  }
  bool RefocusesPreview(starfocus::Engine* engine) const {
    starfocus::Params half = params;
    half.preview_shift = 1;
    return Writes(kSize / 2, [&](const auto& out) { return engine->RefocusPrepared(half, out); });
  }
  bool RefocusesAfter(starfocus::Engine* engine) const {
    const starfocus_previous previous = {sizeof previous, &field, &field.views[0]};
    starfocus::Params after = params;
    after.previous = &previous;
    return Writes(kSize, [&](const auto& out) { return engine->Refocus(after, field, out); });
  }
  bool Streams(starfocus::Engine* engine) const {
    int32_t consumed = 0, written = 0;
    return engine->StreamBegin(params) == STARFOCUS_OK &&
           engine->StreamPush(field, kSize, &consumed) == STARFOCUS_OK && consumed == kSize &&
           Writes(kSize,
                  [&](const auto& out) { return engine->StreamPull(out, kSize, &written); }) &&
           written == kSize;
  }

  // Returns true if `engine` has no prepared light field.
  bool IsUnprepared(starfocus::Engine* engine) const {
    std::vector<uint8_t> out(picture.size());
    return engine->RefocusPrepared(params, starfocus_image_rgb(out.data(), 3 * kSize)) ==
           STARFOCUS_ERROR_NULL;
  }
  // Returns true if `engine` is empty: all calls must return STARFOCUS_ERROR_NULL.
  bool IsEmpty(starfocus::Engine* engine) const {
    std::vector<uint8_t> out(picture.size());
    const starfocus_image image = starfocus_image_rgb(out.data(), 3 * kSize);
    int32_t rows = 0;
    return engine->get() == nullptr && IsUnprepared(engine) &&
           engine->Refocus(params, field, image) == STARFOCUS_ERROR_NULL &&
           engine->Prepare(field) == STARFOCUS_ERROR_NULL &&
           engine->StreamBegin(params) == STARFOCUS_ERROR_NULL &&
           engine->StreamPush(field, kSize, &rows) == STARFOCUS_ERROR_NULL &&
           engine->StreamPull(image, kSize, &rows) == STARFOCUS_ERROR_NULL;
  }
};

bool EveryCall() {
  const Field f;
  starfocus::Engine engine;
  if (!f.IsEmpty(&engine)) return false;
  starfocus::Config bad;
  bad.width = -1;
  if (engine.Init(bad) != STARFOCUS_ERROR_RANGE || !f.IsEmpty(&engine)) return false;
  return f.Prepares(&engine) && f.Refocuses(&engine) && f.RefocusesPrepared(&engine) &&
         f.RefocusesPreview(&engine) && f.RefocusesAfter(&engine) && f.Streams(&engine);
}

// If a second Init fails, the engine and its prepared light field must remain. If a second Init
// succeeds, the new engine must have no prepared light field.
bool SecondInit() {
  const Field f;
  starfocus::Engine engine;
  starfocus::Config bad;
  if (!f.Prepares(&engine) || engine.Init(bad) != STARFOCUS_ERROR_RANGE) return false;
  no_memory = true;
  const starfocus_status status = engine.Init(f.config);
  no_memory = false;
  return status == STARFOCUS_ERROR_MEMORY && f.Refocuses(&engine) && f.RefocusesPrepared(&engine) &&
         engine.Init(f.config) == STARFOCUS_OK && f.IsUnprepared(&engine) && f.Refocuses(&engine);
}

bool Moves() {
  const Field f;
  starfocus::Engine first;
  if (!f.Prepares(&first)) return false;
  {
    starfocus::Engine second = std::move(first), third;
    if (!f.IsEmpty(&first) || !f.RefocusesPrepared(&second) || !f.Prepares(&third)) return false;
    third = std::move(second);
    if (!f.IsEmpty(&second)) return false;
    starfocus::Engine& same = third;
    third = std::move(same);
    if (!f.Refocuses(&third) || !f.RefocusesPrepared(&third)) return false;
  }
  // An engine that was moved from is empty.
  return f.IsEmpty(&first) && first.Init(f.config) == STARFOCUS_OK && f.Refocuses(&first);
}

// After a failed Prepare, the engine has no prepared light field.
bool SecondPrepare() {
  Field f;
  starfocus::Engine engine;
  if (engine.Init(f.config) != STARFOCUS_OK) return false;
  for (int round = 0; round < 2; ++round) {
    if (engine.Prepare(f.field) != STARFOCUS_OK || !f.RefocusesPrepared(&engine)) return false;
    no_memory = round == 0;
    f.disparity[7] = 2;
    const starfocus_status status = engine.Prepare(f.field);
    f.disparity[7] = 0.5f;
    no_memory = false;
    if (status != (round == 0 ? STARFOCUS_ERROR_MEMORY : STARFOCUS_ERROR_DISPARITY)) return false;
    if (!f.IsUnprepared(&engine)) return false;
  }
  return f.Refocuses(&engine);
}

bool Passes(const char* name, bool (*test)()) {
  const bool passed = test();
  if (!passed) std::fprintf(stderr, "%s: failed\n", name);
  return passed;
}

}  // namespace

int main() {
  bool passed = Passes("every call", EveryCall);
  passed &= Passes("a second Init", SecondInit);
  passed &= Passes("moves", Moves);
  passed &= Passes("a second Prepare", SecondPrepare);
  return passed ? 0 : 1;
}
