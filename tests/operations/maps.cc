// SPDX-License-Identifier: Apache-2.0
// Family of disparity maps: estimates and repairs whose result or symmetry is known.
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/starfocus.hpp"
#include "tests/operations/families.h"
#include "tests/operations/rig.h"
#include "tests/support/config.h"
#include "tests/support/symmetry.h"

namespace starfocus::stress {
namespace {

constexpr int kViewCounts[] = {1, 5, 9, 17};
constexpr float kMost = 6;     // Largest absolute disparity.
constexpr int kPlaneMost = 4;  // Largest absolute disparity of planes.

struct Map {
  starfocus_status status = STARFOCUS_OK;
  std::vector<float> disparity;
  std::vector<uint8_t> confidence;

  bool operator==(const Map& other) const {
    const size_t bytes = sizeof(float) * disparity.size();
    return status == other.status && confidence == other.confidence &&
           std::memcmp(disparity.data(), other.disparity.data(), bytes) == 0;
  }
};

// A light field whose map is repaired or estimated.
struct Question {
  test::Scene scene;
  bool repairs = true;

  std::string Text(const char* what) const {
    char text[120];
    std::snprintf(text, sizeof(text), "%s: %s of %dx%d, %d views", what,
                  repairs ? "repair" : "estimate", scene.width, scene.height, scene.views());
    return text;
  }
};

int RunBackwards(void*, starfocus_job job, void* data, int32_t count) {
  for (int32_t i = count; i-- > 0;) job(data, i, i % 3);
  return 0;
}

Map Make(const Question& question, starfocus_runner runner, test::Random* random) {
  const test::Scene& scene = question.scene;
  test::Config config;
  config.width = scene.width;
  config.height = scene.height;
  config.views = scene.views();
  config.disparity_min = -kMost;
  config.disparity_max = kMost;
  config.max_workers = runner == nullptr ? 1 : 3;
  starfocus_callbacks callbacks = {};
  callbacks.runner = runner;
  size_t bytes = 0;
  Map map;
  map.status = starfocus_map_workspace_size(&config, question.repairs ? 1 : 0, &bytes, nullptr);
  if (map.status != STARFOCUS_OK) return map;
  const Memory memory(bytes, random->Int(0, 256), random);
  const auto width = static_cast<size_t>(scene.width);
  map.disparity.assign(width * static_cast<size_t>(scene.height), 0);
  map.confidence.assign(map.disparity.size(), 0);
  const starfocus_light_field field = scene.Field();
  const auto make = question.repairs ? starfocus_repair_disparity : starfocus_estimate_disparity;
  starfocus_disparity_output out = {
      map.disparity.data(), sizeof(float) * width, map.confidence.data(), width, nullptr, 0, 0};
  map.status = make(&config, &callbacks, &field, &out, memory.get(), bytes, nullptr);
  return map;
}

// Draws a plane of noise, which every view shows shifted by whole pixels.
void DrawPlane(int disparity, test::Random* random, test::Scene* scene) {
  const int margin = std::abs(disparity), stride = scene->width + 2 * margin;
  const std::vector<uint8_t> noise =
      test::RandomBytes(3 * size_t(stride) * size_t(scene->height + 2 * margin), random);
  for (int view = 0; view < scene->views(); ++view) {
    double u = 0, v = 0;
    starfocus_view_position(view, &u, &v, nullptr);
    const int left = margin + int(u * disparity), top = margin + int(v * disparity);
    for (int y = 0; y < scene->height; ++y) {
      std::memcpy(scene->Pixel(view, 0, y),
                  &noise[3 * (size_t(top + y) * size_t(stride) + size_t(left))],
                  3 * size_t(scene->width));
    }
  }
}

// A repair must keep every bit of the map of one plane. A repair must also keep the map of a
// picture of one colour, in which views give no information.
Outcome CheckPlane(Question* question, test::Random* random) {
  test::Scene& scene = question->scene;
  const bool blank = random->Int(0, 1) == 0;
  const int disparity = 2 * random->Int(-kPlaneMost / 2, kPlaneMost / 2);
  if (blank) {
    const uint8_t level = random->Byte();
    for (auto& picture : scene.pictures) picture.assign(picture.size(), level);
  } else {
    DrawPlane(disparity, random, &scene);
  }
  for (float& value : scene.disparity) value = float(disparity);
  const Map map = Make(*question, nullptr, random);
  if (map.status != STARFOCUS_OK) return {0, question->Text(starfocus_status_string(map.status))};
  for (const float value : map.disparity) {
    if (value != float(disparity))
      return {0, question->Text("the repair changes the map of one plane")};
  }
  return {};
}

// For any picture and any map, the mirrored light field must have the mirrored map. The number of
// workers and the previous contents of the memory must not affect the map.
Outcome CheckAgreement(Question* question, test::Random* random) {
  test::Scene& scene = question->scene;
  scene =
      test::RandomScene(scene.width, scene.height, scene.views(), -kMost, kMost, random->Next());
  if (random->Int(0, 1) == 0) test::NoisyDisparity(&scene, random);
  if (question->repairs && random->Int(0, 2) == 0) {
    const int64_t count = int64_t{scene.width} * scene.height / 8;
    for (int64_t k = 0; k < count; ++k) {
      scene.Disparity(random->Int(0, scene.width - 1), random->Int(0, scene.height - 1)) =
          std::numeric_limits<float>::quiet_NaN();
    }
  }
  const Map map = Make(*question, nullptr, random);
  if (map.status == STARFOCUS_ERROR_ALL_INVALID) return {};
  if (map.status != STARFOCUS_OK) return {0, question->Text(starfocus_status_string(map.status))};
  if (!(Make(*question, RunBackwards, random) == map)) {
    return {0, question->Text("the number of workers or the used memory changes the map")};
  }
  const Question mirrored = {test::Move({false, true, false}, scene), question->repairs};
  const Map other = Make(mirrored, nullptr, random);
  if (other.status != STARFOCUS_OK)
    return {0, mirrored.Text(starfocus_status_string(other.status))};
  double largest = 0;
  const auto width = static_cast<size_t>(scene.width);
  for (size_t n = 0; n < map.disparity.size(); ++n) {
    const size_t m = n / width * width + (width - 1 - n % width);
    largest = std::max(largest, double(std::abs(map.disparity[n] - other.disparity[m])));
  }
  if (largest > 0)
    return {0, question->Text("the map of the mirrored light field is not the mirrored map")};
  return {};
}

}  // namespace

Outcome Maps(test::Random* random) {
  Question question;
  const int views = kViewCounts[random->Int(0, 3)];
  question.repairs = views == 1 || random->Int(0, 2) > 0;
  const bool plane = question.repairs && random->Int(0, 2) == 0;
  // The picture is larger than the disparity of the plane. With a larger disparity, side views
  // would show nothing of the centre view.
  const int least = plane ? 2 * kPlaneMost + 1 : 1;
  question.scene =
      test::EmptyScene(random->Int(least, 90), random->Int(least, 60), views, -kMost, kMost);
  return plane ? CheckPlane(&question, random) : CheckAgreement(&question, random);
}

}  // namespace starfocus::stress
