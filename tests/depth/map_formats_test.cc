// SPDX-License-Identifier: Apache-2.0
// Tests that estimates and repairs of light fields in any format give the bytes that they give for
// the converted light field.
#include <doctest/doctest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "starfocus/depth.h"
#include "tests/depth/depth_scene.h"
#include "tests/operations/operations.h"
#include "tests/support/config.h"
#include "tests/support/images.h"

namespace map_formats_test {
namespace {

using test::ImageField;
using test::ImageKind;
using test::MadeMap;

test::Config ConfigOf(const test::Scene& scene) {
  test::Config config;
  config.width = scene.width;
  config.height = scene.height;
  config.views = scene.views();
  config.disparity_min = scene.disparity_min;
  config.disparity_max = scene.disparity_max;
  return config;
}

MadeMap Make(const ImageField& field, bool repairs, uint32_t features, int workers = 1,
             const starfocus_callbacks* callbacks = nullptr) {
  test::Config config = ConfigOf(field.converted);
  config.features = features;
  config.max_workers = workers;
  return TryMap(config, features != 0 ? field.Field() : field.converted.Field(),
                repairs ? test::Makes::kRepair : test::Makes::kEstimate, callbacks);
}

// Returns views in different formats, and a map of a type in about a quarter of the size, in which
// some values are unknown.
ImageField Field(int views, starfocus_depth_type type, starfocus_depth_meaning meaning,
                 test::Random* random) {
  const test::Scene scene = test::LayeredScene(101, 67, views, 7, 5);
  std::vector<ImageKind> kinds;
  for (int k = 0; k < views; ++k) {
    kinds.push_back(test::AnyKind((STARFOCUS_FORMAT_NV12 + k) % 8, random));
  }
  test::DepthMemory depth = test::MakeDepth(scene, 26, 17, type, meaning, 3);
  depth.map.has_invalid = 1;
  depth.map.invalid = depth.Get(8, 9);
  return test::MakeImageField(scene, kinds, std::move(depth), random);
}

TEST_CASE("maps of any format: the result is that of the converted light field") {
  test::Random random(3);
  for (const int views : {1, 5}) {
    for (const auto type : {STARFOCUS_DEPTH_U16, STARFOCUS_DEPTH_HALF, STARFOCUS_DEPTH_DEPTH16}) {
      for (const auto meaning : {STARFOCUS_DEPTH_LINEAR, STARFOCUS_DEPTH_RECIPROCAL}) {
        const ImageField field = Field(views, type, meaning, &random);
        for (const bool repairs : {true, false}) {
          if (views == 1 && !repairs) continue;
          CAPTURES(views, type, meaning, repairs);
          const MadeMap expected = Make(field, repairs, 0);
          const MadeMap found = Make(field, repairs, STARFOCUS_FEATURE_IMAGES);
          REQUIRE(expected.status == STARFOCUS_OK);
          REQUIRE(found.status == STARFOCUS_OK);
          CHECK((found.disparity == expected.disparity));
          CHECK((found.confidence == expected.confidence));
        }
      }
    }
  }
}

// Repairs the map of a picture of three tiles, whose view and map are converted by three jobs each.
properties::Operation OperationOnImages() {
  constexpr int kWidth = 400, kHeight = 40;
  test::Random random(6);
  test::ImageKind kind;
  kind.format = STARFOCUS_FORMAT_NV12;
  const test::Scene scene = test::LayeredScene(kWidth, kHeight, 1, 4, 5);
  test::DepthMemory depth = test::MakeDepth(scene, kWidth / 4, kHeight / 4, STARFOCUS_DEPTH_U16,
                                            STARFOCUS_DEPTH_LINEAR, 0);
  // Images contain pointers to their memory, so they are shared instead of copied.
  const auto field = std::make_shared<const ImageField>(
      test::MakeImageField(scene, {kind}, std::move(depth), &random));
  // The view, the map, and each of the 6 phases of a repair by colours are a set of three jobs.
  return {"repair of images", kHeight, 3 * (2 + 6),
          [field](const properties::Setup& setup) -> properties::Run {
            return [field, setup](const starfocus_callbacks& callbacks, properties::Bytes* out) {
              const MadeMap made =
                  Make(*field, true, STARFOCUS_FEATURE_IMAGES, setup.workers, &callbacks);
              *out = made.confidence;
              const size_t bytes = made.disparity.size() * sizeof(float);
              out->resize(out->size() + bytes);
              std::memcpy(out->data() + made.confidence.size(), made.disparity.data(), bytes);
              return made.status;
            };
          }};
}

TEST_CASE("maps of any format: workers, cancelling and failed runners") {
  const properties::Operation operation = OperationOnImages();
  properties::CheckWorkers(operation);
  properties::CheckFailingRunner(operation);
  properties::CheckCancelling(operation);
}

TEST_CASE("maps of any format: without the feature, other formats are rejected") {
  test::Random random(4);
  const ImageField field = Field(1, STARFOCUS_DEPTH_U16, STARFOCUS_DEPTH_LINEAR, &random);
  test::Config config = ConfigOf(field.converted);
  const auto check_refused = [&](const starfocus_light_field& given, const char* named) {
    const MadeMap made = TryMap(config, given, test::Makes::kRepair);
    CHECK(made.status == STARFOCUS_ERROR_FEATURE);
    CHECK(std::string(made.problem.field) == named);
    const std::string feature = ", or STARFOCUS_FEATURE_IMAGES in config.features";
    CHECK(std::string(made.problem.expected).find(feature) != std::string::npos);
    CHECK(made.IsUnset());
  };
  const starfocus_light_field images = field.Field();
  check_refused(images, "views[].format");
  starfocus_light_field mixed = images;
  mixed.views[0] = field.converted.Field().views[0];
  check_refused(mixed, "depth");
  size_t without = 0, with = 0;
  REQUIRE(starfocus_map_workspace_size(&config, 1, &without, nullptr) == STARFOCUS_OK);
  config.features = STARFOCUS_FEATURE_IMAGES;
  REQUIRE(starfocus_map_workspace_size(&config, 1, &with, nullptr) == STARFOCUS_OK);
  const MadeMap lacking = TryMap(config, images, test::Makes::kRepair, nullptr, with - without);
  CHECK(lacking.status == STARFOCUS_ERROR_WORKSPACE);
  CHECK(lacking.IsUnset());
  const double more = double(with - without) / (config.width * config.height);
  CHECK(more == doctest::Approx(7).epsilon(0.2));
}

TEST_CASE("maps of any format: values of the map are checked before the map is converted") {
  test::Random random(5);
  ImageField field = Field(1, STARFOCUS_DEPTH_U16, STARFOCUS_DEPTH_LINEAR, &random);
  field.converted.disparity_max = field.converted.disparity_min + 1;
  const MadeMap outside = Make(field, true, STARFOCUS_FEATURE_IMAGES);
  CHECK(outside.status == STARFOCUS_ERROR_DISPARITY);
  CHECK(outside.problem.value > outside.problem.high);
  field.converted.disparity_min = static_cast<float>(outside.problem.value) + 1;
  field.converted.disparity_max = field.converted.disparity_min + 1;
  const MadeMap below = Make(field, true, STARFOCUS_FEATURE_IMAGES);
  CHECK(below.status == STARFOCUS_ERROR_DISPARITY);
  CHECK(below.problem.value < below.problem.low);
  for (int y = 0; y < field.depth.map.height; ++y) {
    for (int x = 0; x < field.depth.map.width; ++x) field.depth.Put(x, y, field.depth.map.invalid);
  }
  const MadeMap unknown = Make(field, true, STARFOCUS_FEATURE_IMAGES);
  CHECK(unknown.status == STARFOCUS_ERROR_ALL_INVALID);
  CHECK(unknown.IsUnset());
}

}  // namespace
}  // namespace map_formats_test
