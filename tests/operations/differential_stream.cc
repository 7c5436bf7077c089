// SPDX-License-Identifier: Apache-2.0
// Pushes and pulls rows in portions of random size, with invalid rows, failing runners and restarts
// in between.
#include <limits>

#include "starfocus/starfocus.hpp"
#include "tests/operations/differential.h"

namespace starfocus::stress {
namespace {

struct Streaming {
  Rig* rig;
  const Asked& asked;
  test::Random* random;
  test::Scene scene;  // some rows of this copy are temporarily invalid
  test::Output out;
  int most;  // largest number of rows per call
  int pushed = 0, pulled = 0;
  std::string failure = {};

  int height() const { return scene.height; }

  void Begin() {
    pushed = pulled = 0;
    const starfocus_status status = starfocus_stream_begin(rig->get(), &asked.setup.params);
    if (status != STARFOCUS_OK) failure = std::string("begin: ") + starfocus_status_string(status);
  }

  // Pushes rows, one of which may be invalid. The engine must consume neither the invalid row nor
  // any later row.
  void Push() {
    const int rows = random->Int(0, std::min(most, height() - pushed));
    const int bad = rows > 0 && random->Int(0, 11) == 0 ? random->Int(0, rows - 1) : rows;
    float* spoiled =
        bad < rows ? &scene.Disparity(random->Int(0, scene.width - 1), pushed + bad) : nullptr;
    const float kept = spoiled != nullptr ? *spoiled : 0;
    if (spoiled != nullptr) {
      *spoiled = random->Int(0, 1) == 0 ? std::numeric_limits<float>::quiet_NaN() : -1000.0f;
    }
    const starfocus_light_field field = scene.Field(pushed);
    int32_t consumed = -1;
    const starfocus_status status = starfocus_stream_push(rig->get(), &field, rows, &consumed);
    if (spoiled != nullptr) *spoiled = kept;
    const bool refused =
        status == STARFOCUS_ERROR_NOT_FINITE || status == STARFOCUS_ERROR_DISPARITY;
    if (consumed < 0 || consumed > bad || (refused && consumed != bad) ||
        (status != STARFOCUS_OK && !(refused && bad < rows))) {
      failure = std::string("push: ") + starfocus_status_string(status) + ", " +
                std::to_string(consumed) + " of " + std::to_string(rows) + " rows consumed, row " +
                std::to_string(bad) + " is bad";
    }
    pushed += consumed;
  }

  // Pulls rows. After a failure, the next pull must resume after the last written row.
  void Pull() {
    const int rows = random->Int(0, std::min(most, height() - pulled));
    const bool fails = random->Int(0, 15) == 0;
    if (fails) rig->FailAfter(random->Int(0, 8));
    rig->SetCallbacks();
    int32_t written = -1;
    const starfocus_status status =
        test::PullRgb(rig->get(), out.bytes.data() + size_t(pulled) * out.stride, out.stride, rows,
                      &written, nullptr);
    const bool failed = fails && rig->Mend();
    if (status != (failed ? STARFOCUS_ERROR_RUNNER : STARFOCUS_OK) || written < 0 ||
        written > rows) {
      failure = std::string("pull: ") + starfocus_status_string(status) + ", " +
                std::to_string(written) + " of " + std::to_string(rows) + " rows written";
    }
    pulled += written;
  }
};

}  // namespace

std::string Streamed(const Asked& asked, test::Random* random) {
  Variant variant = RandomVariant(random);
  variant.stream = true;
  Rig rig(asked.setup.config, variant);
  const test::Scene& scene = asked.setup.scene;
  const int most = random->Int(0, 1) == 0 ? random->Int(1, 9) : scene.height;
  Streaming stream = {&rig, asked, random, scene, test::Output(scene.width, scene.height, 3), most};
  stream.Begin();
  if (random->Int(0, 7) == 0) {
    stream.Push();
    stream.Pull();
    if (stream.failure.empty()) stream.Begin();
  }
  int idle = 0;
  while (stream.failure.empty() && stream.pulled < scene.height) {
    const int moved = stream.pushed + stream.pulled;
    if (random->Int(0, 3) > 0) stream.Push();
    if (stream.failure.empty() && random->Int(0, 3) > 0) stream.Pull();
    idle = stream.pushed + stream.pulled == moved ? idle + 1 : 0;
    if (idle > 1000) stream.failure = "1000 attempts to push and pull move no row";
  }
  if (!stream.failure.empty()) return stream.failure + " (" + variant.Text() + ")";
  return Verdict(rig, STARFOCUS_OK, asked.picture, stream.out);
}

}  // namespace starfocus::stress
