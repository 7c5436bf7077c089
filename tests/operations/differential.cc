// SPDX-License-Identifier: Apache-2.0
// Family of calls that must return the same picture: whole, streamed, as regions, from a prepared
// light field, and as a frame of a video. The engines may have been used before, and their runners
// may have failed before.
#include "tests/operations/differential.h"

#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

#include "starfocus/starfocus.hpp"
#include "tests/operations/families.h"
#include "tests/support/config.h"

namespace starfocus::stress {
namespace {

// Largest number of rendered views times pixels, for modes whose number of views grows with the
// radius.
constexpr double kMostWork = 300000;
// Bounds of random setups. Larger blurs have smaller pictures and are selected less often.
constexpr Bounds kRegimes[] = {
    {160, 3, 4, 8}, {160, 6, 4, 500}, {100, 16, 4, 40}, {64, 50, 4, 500}, {40, 128, 4, 500}};

bool IsLineByLine(const Setup& setup) {
  const starfocus::Params& params = setup.params;
  return params.study.renderer == STARFOCUS_RENDERER_LINE_SCAN ||
         params.study.mode == STARFOCUS_MODE_BENCHMARK ||
         (params.study.mode == STARFOCUS_MODE_FRAME &&
          params.study.renderer == STARFOCUS_RENDERER_AUTO && setup.config.views > 1);
}

// Limits the work of the line scan, whose number of views grows with the square of the radius.
void LimitWork(Setup* setup) {
  const double n = 1 + setup->Radius() * std::max(1.0, setup->config.tuning.n_scale);
  const double views = 3.2 * n * n * (setup->params.study.mode == STARFOCUS_MODE_BENCHMARK ? 4 : 1);
  if (!IsLineByLine(*setup) || views * setup->config.width * setup->config.height < kMostWork) {
    return;
  }
  setup->params.study.mode = STARFOCUS_MODE_BLOCK;
  setup->params.study.renderer = STARFOCUS_RENDERER_SLICES;
}

Setup RandomCase(test::Random* random) {
  Setup setup = RandomSetup(kRegimes[std::min(random->Int(0, 4), random->Int(0, 4))], random);
  LimitWork(&setup);
  if (random->Int(0, 7) == 0) setup.config.superblock = 0;  // The library selects the block size.
  if (random->Int(0, 3) == 0)
    setup.config.highlights = float(random->Real(1, STARFOCUS_MAX_HIGHLIGHTS));
  if (random->Int(0, 3) == 0) {
    setup.config.max_blur =
        std::min(STARFOCUS_MAX_BLUR, std::ceil(setup.config.max_blur) + random->Int(0, 8));
  }
  if (random->Int(0, 3) == 0) {
    starfocus_timing& timing = setup.config.tuning.timing;
    for (uint32_t* coefficient : {&timing.block, &timing.field, &timing.a, &timing.b, &timing.c,
                                  &timing.upsample, &timing.span, &timing.hole}) {
      *coefficient = random->Int(0, 2) == 0 ? 0 : random->Next() % (STARFOCUS_MAX_TIMING + 1);
    }
  }
  if (setup.params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN && random->Int(0, 2) == 0) {
    test::RandomViews(&setup.scene, &setup.config, random);
  }
  return setup;
}

// Uses the engine for another call, so that the workspace contains data of that call.
void Distract(const Asked& asked, Rig* rig, test::Random* random) {
  const Setup& setup = asked.setup;
  starfocus::Params params = setup.params;
  params.study.mode = random->Int(0, 1) == 0 ? STARFOCUS_MODE_BLOCK : STARFOCUS_MODE_BLUR;
  params.study.renderer = STARFOCUS_RENDERER_SLICES;
  params.aperture /= random->Int(1, 4);
  const starfocus_light_field field = setup.scene.Field();
  test::Output out(setup.scene.width, setup.scene.height);
  const int what = random->Int(0, 5);
  if (what == 1) params.region = RandomRegion(setup.scene, random);
  rig->SetCallbacks();
  if (what <= 1) {
    test::RefocusRgb(rig->get(), &params, &field, out.bytes.data(), out.stride, nullptr);
  }
  if (what == 2 && test::Has(rig->config().features, STARFOCUS_FEATURE_STREAMING)) {
    int32_t moved = 0;
    starfocus_stream_begin(rig->get(), &params);
    starfocus_stream_push(rig->get(), &field, random->Int(0, setup.scene.height), &moved);
    test::PullRgb(rig->get(), out.bytes.data(), out.stride, random->Int(0, setup.scene.height),
                  &moved, nullptr);
  }
  if (what == 3) rig->Restart();
}

std::string Whole(const Asked& asked, test::Random* random) {
  Rig rig(asked.setup.config, RandomVariant(random));
  Distract(asked, &rig, random);
  test::Output out(asked.setup.scene.width, asked.setup.scene.height, random->Int(0, 5));
  const starfocus_status status = Retried(&rig, random, [&] {
    return test::Refocus(&rig, asked.setup.params, asked.setup.scene, &out, rig.callbacks());
  });
  return Verdict(rig, status, asked.picture, out);
}

std::string Region(const Asked& asked, test::Random* random) {
  Rig rig(asked.setup.config, RandomVariant(random));
  Distract(asked, &rig, random);
  starfocus::Params params = asked.setup.params;
  params.region = RandomRegion(asked.setup.scene, random);
  test::Output out(params.region.width, params.region.height, random->Int(0, 5));
  const starfocus_status status = Retried(&rig, random, [&] {
    return test::Refocus(&rig, params, asked.setup.scene, &out, rig.callbacks());
  });
  return Verdict(rig, status, Crop(asked, params.region), out);
}

// Checks that a map with a bad value is rejected before any output is written. A bad value is
// accepted only if the region does not read the value.
std::string Refused(const Asked& asked, test::Random* random) {
  Rig rig(asked.setup.config, RandomVariant(random));
  Setup setup = asked.setup;
  const starfocus_region whole = {0, 0, setup.scene.width, setup.scene.height};
  const bool part = random->Int(0, 2) > 0;
  const starfocus_region region = part ? RandomRegion(setup.scene, random) : whole;
  if (part) setup.params.region = region;
  const int x = random->Int(0, setup.scene.width - 1), y = random->Int(0, setup.scene.height - 1);
  const bool nan = random->Int(0, 1) == 0;
  setup.scene.Disparity(x, y) = nan ? std::numeric_limits<float>::quiet_NaN() : 1000.0f;
  test::Output out(region.width, region.height);
  const starfocus_status status =
      test::Refocus(&rig, setup.params, setup.scene, &out, rig.callbacks());
  if (status == STARFOCUS_OK && part) return Verdict(rig, status, Crop(asked, region), out);
  if (status != (nan ? STARFOCUS_ERROR_NOT_FINITE : STARFOCUS_ERROR_DISPARITY)) {
    return "the bad disparity at " + std::to_string(x) + "," + std::to_string(y) +
           " is reported as: " + starfocus_status_string(status);
  }
  return out.Untouched() ? ""
                         : "a bad disparity is rejected after a part of the picture was written";
}

// Checks a prepared light field that another engine made.
std::string Prepared(const Asked& asked, test::Random* random) {
  test::Config config = asked.setup.config;
  if (random->Int(0, 1) == 0) config.superblock = 32 << random->Int(0, 3);
  if (random->Int(0, 1) == 0) config.max_blur = random->Real(0.5, 64);
  if (random->Int(0, 1) == 0) config.tuning.gather = 1 - config.tuning.gather;
  if (random->Int(0, 1) == 0) config.previews = random->Int(1, STARFOCUS_MAX_PREVIEW);
  Rig maker(config, RandomVariant(random)), rig(asked.setup.config, RandomVariant(random));
  size_t bytes = 0;
  starfocus_status status = starfocus_prepared_size(&config, &bytes, nullptr);
  if (status != STARFOCUS_OK) return starfocus_status_string(status);
  const Memory memory(bytes, random->Int(0, 255), random);
  starfocus_prepared* prepared = nullptr;
  const starfocus_light_field field = asked.setup.scene.Field();
  status = Retried(&maker, random, [&] {
    maker.SetCallbacks();
    return starfocus_prepare(maker.get(), &field, memory.get(), bytes, &prepared);
  });
  if (status != STARFOCUS_OK) return std::string("preparing: ") + starfocus_status_string(status);
  const bool part = random->Int(0, 1) == 0;
  starfocus::Params params = asked.setup.params;
  if (part) params.region = RandomRegion(asked.setup.scene, random);
  const starfocus_region whole = {0, 0, asked.setup.scene.width, asked.setup.scene.height};
  const starfocus_region region = part ? params.region : whole;
  test::Output out(region.width, region.height, random->Int(0, 5));
  Distract(asked, &rig, random);
  if (config.previews > 0) {
    // A preview must not change later results of the engine.
    test::Output preview(region.width, region.height);
    status = Retried(&rig, random, [&] {
      rig.SetCallbacks();
      return test::PreviewRgb(rig.get(), &params, prepared, config.previews, preview.bytes.data(),
                              preview.stride, nullptr);
    });
    if (status != STARFOCUS_OK) return std::string("preview: ") + starfocus_status_string(status);
  }
  status = Retried(&rig, random, [&] {
    rig.SetCallbacks();
    return test::RefocusPreparedRgb(rig.get(), &params, prepared, out.bytes.data(), out.stride,
                                    nullptr);
  });
  return Verdict(rig, status, Crop(asked, region), out);
}

struct Way {
  const char* name;
  int share;
  std::string (*run)(const Asked& asked, test::Random* random);
};

constexpr Way kWays[] = {{"whole", 3, Whole},     {"streamed", 4, Streamed}, {"region", 2, Region},
                         {"refused", 1, Refused}, {"prepared", 2, Prepared}, {"after", 4, After}};

const Way& RandomWay(test::Random* random) {
  int shares = 0;
  for (const Way& way : kWays) shares += way.share;
  int drawn = random->Int(0, shares - 1);
  const Way* way = kWays;
  for (; drawn >= way->share; ++way) drawn -= way->share;
  return *way;
}

}  // namespace

starfocus_region RandomRegion(const test::Scene& scene, test::Random* random) {
  starfocus_region region = {random->Int(0, scene.width - 1), random->Int(0, scene.height - 1), 1,
                             1};
  if (random->Int(0, 2) == 0) return region;
  region.width = random->Int(1, scene.width - region.x);
  region.height = random->Int(1, scene.height - region.y);
  return region;
}

std::vector<uint8_t> Crop(const Asked& asked, const starfocus_region& region) {
  std::vector<uint8_t> crop;
  const auto row = 3 * static_cast<std::ptrdiff_t>(asked.setup.scene.width);
  for (int y = region.y; y < region.y + region.height; ++y) {
    const auto begin = asked.picture.begin() + y * row + 3 * region.x;
    crop.insert(crop.end(), begin, begin + 3 * region.width);
  }
  return crop;
}

starfocus_status Retried(Rig* rig, test::Random* random,
                         const std::function<starfocus_status()>& call) {
  if (random->Int(0, 3) == 0) {
    rig->FailAfter(random->Int(0, 1) == 0 ? random->Int(0, 5) : random->Int(0, 60));
    const starfocus_status status = call();
    const bool failed = rig->Mend();
    if (failed && status == STARFOCUS_OK) return STARFOCUS_ERROR_RUNNER;
    if (status != STARFOCUS_OK && !(failed && status == STARFOCUS_ERROR_RUNNER)) return status;
  }
  return call();
}

std::string Verdict(const Rig& rig, starfocus_status status, const std::vector<uint8_t>& expected,
                    const test::Output& out) {
  const std::string how = " (" + rig.variant().Text() + ")";
  if (status != STARFOCUS_OK) return starfocus_status_string(status) + how;
  if (!out.PaddingUntouched()) return "the call writes to the padding of rows" + how;
  const std::vector<uint8_t> got = out.Tight();
  size_t first = got.size(), count = 0;
  int largest = 0;
  for (size_t i = 0; i < got.size(); ++i) {
    if (got[i] == expected[i]) continue;
    first = std::min(first, i);
    largest = std::max(largest, std::abs(got[i] - expected[i]));
    ++count;
  }
  if (count == 0) return "";
  const size_t pixel = first / 3, width = static_cast<size_t>(out.width);
  return std::to_string(count) + " of " + std::to_string(got.size()) + " bytes differ, by up to " +
         std::to_string(largest) + ", first at " + std::to_string(pixel % width) + "," +
         std::to_string(pixel / width) + how;
}

Outcome Differential(test::Random* random) {
  Asked asked = {RandomCase(random), {}};
  asked.picture = Refocused(asked.setup, Variant());
  const test::Scene before = asked.setup.scene;
  for (int k = 0; k < 3; ++k) {
    const Way& way = RandomWay(random);
    const std::string failure = way.run(asked, random);
    if (!failure.empty()) return Fail(asked.setup, std::string(way.name) + ": " + failure);
  }
  const test::Scene& after = asked.setup.scene;
  if (before.pictures != after.pictures || before.coverage != after.coverage ||
      before.disparity != after.disparity) {
    return Fail(asked.setup, "the call writes to the light field");
  }
  return {};
}

}  // namespace starfocus::stress
