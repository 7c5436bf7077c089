// SPDX-License-Identifier: Apache-2.0
// Tools of tests that spoil one argument: fields of public structures by name, values beyond their
// ranges, and calls of the functions that refocus, prepare and stream.
#ifndef STARFOCUS_TESTS_API_CALLS_H_
#define STARFOCUS_TESTS_API_CALLS_H_

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/images.h"
#include "tests/support/refocused.h"

namespace calls {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// A field of a structure in memory.
struct Field {
  void* at;
  int32_t type;  // one of STARFOCUS_FIELD_

  template <class Value>
  void Put(Value value) {
    std::memcpy(at, &value, sizeof value);
  }
  template <class Value>
  double As() const {
    Value value;
    std::memcpy(&value, at, sizeof value);
    return double(value);
  }
  // Returns the number, or 0 if the field is a null pointer.
  double Get() const {
    if (type == STARFOCUS_FIELD_DOUBLE) return As<double>();
    if (type == STARFOCUS_FIELD_POINTER) return As<uintptr_t>();
    return type == STARFOCUS_FIELD_INT32 ? As<int32_t>() : As<uint32_t>();
  }
  // Writes a number, or a null pointer if the field is a pointer. The number -1 in a field without
  // a sign is the largest value of its type.
  void Set(double value) {
    const bool is_real = type == STARFOCUS_FIELD_DOUBLE;
    const int64_t whole = is_real ? 0 : static_cast<int64_t>(value);
    if (is_real) return Put(value);
    if (type == STARFOCUS_FIELD_POINTER) return Put(static_cast<void*>(nullptr));
    if (type == STARFOCUS_FIELD_UINT64) return Put(static_cast<uint64_t>(whole));
    if (type == STARFOCUS_FIELD_UINT32) return Put(static_cast<uint32_t>(whole));
    REQUIRE(type == STARFOCUS_FIELD_INT32);
    Put(static_cast<int32_t>(whole));
  }
};

// Returns the field with a path such as "views[1].planes[0]" in `structure`, which lies at `at`.
// The path may lead through pointers to structures.
inline Field FieldAt(std::string structure, void* at, const std::string& path) {
  const size_t dot = path.find('.');
  const std::string part = path.substr(0, dot);
  const size_t bracket = part.find('[');
  const starfocus_field* fields = nullptr;
  int32_t count = 0;
  starfocus_fields(structure.c_str(), &fields, &count);
  for (const starfocus_field* field = fields; field != fields + count; ++field) {
    if (field->name != part.substr(0, bracket)) continue;
    char* address = static_cast<char*>(at) + field->offset;
    size_t index = 0;
    if (bracket != std::string::npos) index = size_t(std::atoi(part.c_str() + bracket + 1));
    if (dot == std::string::npos) {
      const bool is_short = field->type == STARFOCUS_FIELD_INT32;
      return {address + index * (is_short ? sizeof(int32_t) : sizeof(size_t)), field->type};
    }
    if (field->type == STARFOCUS_FIELD_POINTER) {
      void* target;
      std::memcpy(&target, address, sizeof target);
      address = static_cast<char*>(target);
    }
    address += index * starfocus_fields(field->structure, nullptr, nullptr);
    return FieldAt(field->structure, address, path.substr(dot + 1));
  }
  FAIL("expected a field of ", structure, ", found ", path);
  return {};
}

// Returns values just outside a range, values far outside it, and values that are no numbers.
inline std::vector<double> Outside(int32_t type, double low, double high) {
  if (type == STARFOCUS_FIELD_DOUBLE) {
    return {std::nextafter(low, -kInf), std::nextafter(high, kInf), kNan, kInf, -kInf};
  }
  if (type == STARFOCUS_FIELD_UINT32) return {high + 1, double(1u << 31), double(UINT32_MAX)};
  return {low - 1, high + 1, INT32_MIN, INT32_MAX};
}

// Checks a problem. If the field has a range, the value of the problem must lie outside.
inline void CheckProblem(const starfocus_problem* problem, starfocus_status status,
                         const std::string& field) {
  REQUIRE(problem != nullptr);
  CHECK(problem->status == status);
  CHECK(std::string(problem->field) == field);
  CHECK((problem->expected[0] != 0 || status == STARFOCUS_OK));
  if (status != STARFOCUS_ERROR_RANGE) return;
  CHECK(!(problem->value >= problem->low && problem->value <= problem->high));
}

// Checks that a problem names a field with a value and its range.
inline void CheckRange(const starfocus_problem* problem, const std::string& field, double value,
                       double low, double high) {
  CheckProblem(problem, STARFOCUS_ERROR_RANGE, field);
  CHECK((problem->value == value || (std::isnan(problem->value) && std::isnan(value))));
  CHECK(problem->low == low);
  CHECK(problem->high == high);
}

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
  Field At(std::string path) {
    const auto begins = [&](const std::string& root) {
      return path.compare(0, root.size(), root) == 0;
    };
    const auto in = [&](const std::string& root, const char* structure, void* at) {
      return FieldAt(structure, at, begins(root) ? path.substr(root.size()) : path);
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
