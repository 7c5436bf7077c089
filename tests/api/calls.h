// SPDX-License-Identifier: Apache-2.0
// Calls of the functions that refocus, prepare and stream. Tests spoil one argument of a call.
#ifndef STARFOCUS_TESTS_API_CALLS_H_
#define STARFOCUS_TESTS_API_CALLS_H_

#include <doctest/doctest.h>

#include <cstring>
#include <string>

#include "starfocus/starfocus.hpp"
#include "tests/api/field_values.h"
#include "tests/support/config.h"
#include "tests/support/image_field.h"
#include "tests/support/prepared_memory.h"

namespace calls {

constexpr int kHeight = 12;

// Bits for the public functions under test, and sets of these functions.
enum : unsigned {
  kRefocus = 1,
  kAfter = 2,  // starfocus_refocus with params.previous
  kPrepared = 4,
  kPreview = 8,  // starfocus_refocus_prepared with params.preview_shift
  kBegin = 16,
  kPrepare = 32,
  kPush = 64,
  kPull = 128,
  kAll = 255,
  kTakesParams = kRefocus | kAfter | kPrepared | kPreview | kBegin,
  kTakesField = kRefocus | kAfter | kPrepare | kPush,
  kTakesOut = kRefocus | kAfter | kPrepared | kPreview | kPull,
};

// A light field, either of R, G, B or of images in three formats, and the engines and memory that
// the calls use.
struct Fixture {
  explicit Fixture(bool with_images) : images(with_images) {}

  test::ImageField MakeImages() const {
    test::Random random(61);
    test::ImageKind kinds[3];
    kinds[1].format = STARFOCUS_FORMAT_NV12;
    kinds[2].format = STARFOCUS_FORMAT_I420;
    return test::MakeImageField(
        scene, {kinds, kinds + 3},
        test::MakeDepth(scene, 10, 9, STARFOCUS_DEPTH_U16, STARFOCUS_DEPTH_RECIPROCAL, 0), &random);
  }
  test::Config MakeConfig(uint32_t features) const {
    test::Config made = images ? test::ImageConfig(image) : test::ConfigFor(scene, 8);
    made.features = (made.features & ~STARFOCUS_FEATURE_IMAGES) | features;
    made.previews = 2;
    return made;
  }

  const bool images;
  const int width = images ? 21 : 20;
  test::Scene scene = images ? test::LayeredScene(width, kHeight, 5, 7, 3)
                             : test::RandomScene(width, kHeight, 17, -2, 2, 1);
  test::ImageField image = MakeImages();
  starfocus_light_field field = images ? image.Field() : scene.Field();
  test::Config config = MakeConfig(STARFOCUS_FEATURE_STREAMING | STARFOCUS_FEATURE_IMAGES);
  test::Engine engine{config}, plain{MakeConfig(STARFOCUS_FEATURE_STREAMING)};
  test::PreparedMemory memory{engine}, free{engine};
  starfocus_prepared* prepared = memory.Prepare(engine.get(), field);
  test::ImageMemory blank{width, kHeight, image.views[images ? 2 : 0].kind()};
};

// A call of one of the functions; the constructor makes all arguments legal.
struct Call {
  Call(Fixture* of, unsigned to) : f(*of), function(to) {
    Poison(&report);
    if (function == kAfter) params.previous = &before;
    if (function == kPreview) params.preview_shift = 1;
    for (test::Engine* one : {&f.engine, &f.plain}) {
      if (function != kPush && function != kPull) continue;
      REQUIRE(starfocus_stream_begin(one->get(), &params) == STARFOCUS_OK);
      if (function != kPull || (f.images && one == &f.plain)) continue;
      REQUIRE(starfocus_stream_push(one->get(), &field, kHeight, &count) == STARFOCUS_OK);
    }
    count = -1;
  }
  starfocus_status Run() {
    switch (function) {
      case kRefocus:
      case kAfter:
        return starfocus_refocus(engine, params_at, field_at, out_at, report_at);
      case kPrepared:
      case kPreview:
        return starfocus_refocus_prepared(engine, params_at, prepared, out_at, report_at);
      case kBegin:
        return starfocus_stream_begin(engine, params_at);
      case kPrepare:
        return starfocus_prepare(engine, field_at, memory, bytes, made_at);
      case kPush:
        return starfocus_stream_push(engine, field_at, rows, count_at);
      default:
        return starfocus_stream_pull(engine, out_at, rows, count_at, report_at);
    }
  }
  static void Poison(starfocus_report* report) {
    std::memset(report, test::kPoison, sizeof *report);
    report->size = sizeof *report;
    report->layers = nullptr;
  }
  // Returns the field with a path as errors name it, with indices: "out.strides[0]", "aperture".
  field_values::Field At(std::string path) {
    const auto begins = [&](const std::string& root) {
      return path.compare(0, root.size(), root) == 0;
    };
    const auto in = [&](const std::string& root, const char* structure, void* at) {
      return field_values::FieldAt(structure, at, begins(root) ? path.substr(root.size()) : path);
    };
    if (begins("out.")) return in("out.", "starfocus_image", &out);
    if (begins("report.")) return in("report.", "starfocus_report", &report);
    if (begins("previous.")) return in("previous.", "starfocus_previous", &before);
    if (begins("light_field.") || begins("views") || begins("depth")) {
      return in("light_field.", "starfocus_light_field", &field);
    }
    return in("params.", "starfocus_params", static_cast<starfocus_params*>(&params));
  }
  // Makes `at` the argument or the pointer field with a name.
  void Pass(const std::string& name, void* at) {
    if (name == "params") {
      params_at = static_cast<const starfocus_params*>(at);
    } else if (name == "light_field") {
      field_at = static_cast<const starfocus_light_field*>(at);
    } else if (name == "report") {
      report_at = static_cast<starfocus_report*>(at);
    } else {
      At(name).Put(at);
    }
  }
  // Returns true if no output was written.
  bool Untouched() const {
    starfocus_report poison;
    Poison(&poison);
    poison.size = report.size;  // tests may spoil the size
    return picture == f.blank && std::memcmp(&report, &poison, sizeof report) == 0;
  }

  Fixture& f;
  unsigned function;
  starfocus_engine* engine = f.engine.get();
  starfocus::Params params = test::Params(0.5);
  starfocus_light_field field = f.field;
  test::ImageMemory picture = f.blank, picture_before = f.blank;
  starfocus_image out = picture.Out();
  starfocus_light_field field_before = field;
  starfocus_image out_before = picture_before.Out();
  starfocus_previous before = {sizeof before, &field_before, &out_before};
  starfocus_report report;
  uint8_t* memory = f.free.get();
  size_t bytes = f.free.bytes;
  starfocus_prepared* made = f.prepared;
  int32_t rows = kHeight, count = -1;

  const starfocus_params* params_at = &params;
  const starfocus_light_field* field_at = &field;
  const starfocus_image* out_at = &out;
  const starfocus_prepared* prepared = f.prepared;
  starfocus_prepared** made_at = &made;
  int32_t* count_at = &count;
  starfocus_report* report_at = &report;
};

}  // namespace calls

#endif  // STARFOCUS_TESTS_API_CALLS_H_
