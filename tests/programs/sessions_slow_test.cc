// SPDX-License-Identifier: Apache-2.0
// Runs the sessions that take seconds, among them those that estimate and repair maps, and the
// calls that the programs must reject.
#include "tests/programs/session.h"
#include "tests/support/test_scene.h"

namespace starfocus::sessions_slow_test {
namespace {

// Writes `worse`, a copy of the light field `lf` with a map whose near objects are 3 pixels wider
// on each side, and which has a value that is not finite.
void MakeWorse(const TempFolder& folder) {
  std::filesystem::copy(folder.file("lf"), folder.file("worse"));
  const FloatMap exact = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
  FloatMap worse = exact;
  for (size_t i = 3; i + 3 < exact.values.size(); ++i) {
    const size_t x = i % size_t(exact.width);
    if (x < 3 || x + 3 >= size_t(exact.width)) continue;
    worse.values[i] = *std::max_element(&exact.values[i - 3], &exact.values[i + 4]);
  }
  worse.values[5] = std::numeric_limits<float>::quiet_NaN();
  REQUIRE(WritePfm(folder.file("worse/disparity.pfm"), worse) == "");
}

// Writes `noisy`, a copy of the light field `lf` with noise of up to 1.5 pixels in its map.
void MakeNoisy(const TempFolder& folder) {
  std::filesystem::copy(folder.file("lf"), folder.file("noisy"));
  FloatMap map = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
  test::Random random(3);
  for (float& value : map.values) value += float(random.Int(-150, 150)) * 0.01F;
  REQUIRE(WritePfm(folder.file("noisy/disparity.pfm"), map) == "");
}

TEST_CASE("sessions: every session of slow_sessions.txt succeeds") {
  RunSessions("programs/slow_sessions.txt", {{"light fields", MakeLightFields},
                                             {"hair", PrepareHair},
                                             {"noisy", MakeNoisy},
                                             {"worse", MakeWorse}});
}

TEST_CASE("sessions: every session of refusals.txt succeeds") {
  RunSessions("programs/refusals.txt", {{"light fields", MakeLightFields}});
}

}  // namespace
}  // namespace starfocus::sessions_slow_test
