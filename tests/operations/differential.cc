// SPDX-License-Identifier: Apache-2.0
// The differential property: random calls with random conditions, failing runners, invalid rows and
// abandoned calls in between.
#include <algorithm>
#include <limits>
#include <vector>

#include "tests/operations/picture_operations.h"
#include "tests/support/refocused.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace properties {
namespace {

// Runner that runs the jobs one after another in a shuffled order, each as a random worker.
struct RandomRunner {
  int workers;
  test::Random random;
  int jobs_left = -1;  // Number of jobs that are run correctly before one is not; -1: all.
  bool failed = false;

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    RandomRunner& runner = *static_cast<RandomRunner*>(self);
    for (const int32_t index : Shuffled(count, &runner.random)) {
      const int32_t worker = runner.random.Int(0, runner.workers - 1);
      if (runner.jobs_left != 0) {
        if (runner.jobs_left > 0) --runner.jobs_left;
        job(data, index, worker);
        continue;
      }
      runner.jobs_left = -1;
      runner.failed = true;
      switch (runner.random.Int(0, 4)) {
        case 0:
          return 1;  // the runner reports the failure
        case 1:
          break;  // the runner omits the job
        case 2:
          job(data, index, runner.workers);
          break;  // the runner uses an invalid worker
        case 3:
          job(data, count, worker);
          break;  // the runner runs an invalid job
        default:
          job(data, index, worker);
          job(data, index, worker);
      }
    }
    return 0;
  }
  starfocus_callbacks Callbacks() { return test::RunBy(Run, this); }
  // Returns true if a job has failed since jobs_left was set.
  bool Mend() {
    jobs_left = -1;
    const bool had = failed;
    failed = false;
    return had;
  }
};

Setup RandomSetup(test::Random* random) {
  static const std::vector<const starfocus::simd::Kernels*> kTargets = test::SimdTargets();
  const int target = random->Int(-1, int(kTargets.size()) - 1);
  Setup setup;
  setup.workers = random->Int(1, 4);
  setup.used = random->Int(0, 1) == 0;
  setup.kernels = target < 0 ? &starfocus::simd::ReferenceKernels() : kTargets[size_t(target)];
  setup.poison = random->Int(-64, 320);
  if (random->Int(0, 2) == 0) setup.room = random->Real(1, 8);
  setup.spare = random->Int(0, 1) == 0;
  if (random->Int(0, 1) == 0) setup.maker = random->Next() + 1u;
  return setup;
}

// Pushes and pulls rows in random portions, with invalid rows, failing runners and restarts.
struct Streaming {
  Picture picture;
  RandomRunner runner;
  test::Random* random;
  test::Scene scene;  // some rows of this copy are temporarily invalid
  test::Output out;
  int most;  // largest number of rows per call
  int pushed = 0, pulled = 0;
  bool runner_failed = false;
  test::Report report = {};

  starfocus_engine* engine() { return picture.rig()->get(); }

  void Begin() {
    pushed = pulled = 0;
    REQUIRE(starfocus_stream_begin(engine(), &picture.asked().params) == STARFOCUS_OK);
  }
  // Pushes rows, one of which may be invalid. The engine must consume neither the invalid row nor
  // any later row.
  void Push() {
    const int rows = random->Int(0, std::min(most, scene.height - pushed));
    const bool refuses = picture.asked().config.unknown == STARFOCUS_UNKNOWN_REFUSE;
    const int bad = rows > 0 && random->Int(0, 11) == 0 ? random->Int(0, rows - 1) : rows;
    float* spoiled =
        bad < rows ? &scene.Disparity(random->Int(0, scene.width - 1), pushed + bad) : nullptr;
    const float kept = spoiled != nullptr ? *spoiled : 0;
    if (spoiled != nullptr) {
      *spoiled =
          refuses && random->Int(0, 1) == 0 ? std::numeric_limits<float>::quiet_NaN() : -1000.0f;
    }
    const starfocus_light_field field = scene.Field(pushed);
    int32_t consumed = -1;
    const starfocus_status status = starfocus_stream_push(engine(), &field, rows, &consumed);
    if (spoiled != nullptr) *spoiled = kept;
    const bool refused =
        status == STARFOCUS_ERROR_NOT_FINITE || status == STARFOCUS_ERROR_DISPARITY;
    CAPTURES(status, consumed, rows, bad);
    REQUIRE((consumed >= 0 && consumed <= bad));
    REQUIRE((status == STARFOCUS_OK || (refused && bad < rows && consumed == bad)));
    pushed += consumed;
  }
  // Pulls rows. After a failure, the next pull must resume after the last written row.
  void Pull() {
    const int rows = random->Int(0, std::min(most, scene.height - pulled));
    const bool fails = random->Int(0, 15) == 0;
    if (fails) runner.jobs_left = random->Int(0, 8);
    const starfocus_callbacks callbacks = runner.Callbacks();
    REQUIRE(starfocus_set_callbacks(engine(), &callbacks) == STARFOCUS_OK);
    int32_t written = -1;
    const starfocus_status status =
        test::PullRgb(engine(), out.bytes.data() + size_t(pulled) * out.stride, out.stride, rows,
                      &written, &report);
    const bool failed = runner.Mend();
    REQUIRE(status == (failed ? STARFOCUS_ERROR_RUNNER : STARFOCUS_OK));
    runner_failed = runner_failed || failed;
    REQUIRE((written >= 0 && written <= rows));
    pulled += written;
  }
};

void CheckStreaming(const Case& of, test::Random* random) {
  Way way;
  way.entry = Entry::kStream;
  const Setup setup = RandomSetup(random);
  const int most = random->Int(0, 1) == 0 ? random->Int(1, 9) : of.scene.height;
  Streaming stream = {{of, way, setup}, {setup.workers, test::Random(random->Next())},    random,
                      of.scene,         test::Output(of.scene.width, of.scene.height, 5), most};
  stream.Begin();
  if (random->Int(0, 7) == 0) {
    stream.Push();
    stream.Pull();
    stream.Begin();
  }
  int idle = 0;
  while (stream.pulled < of.scene.height) {
    const int moved = stream.pushed + stream.pulled;
    if (random->Int(0, 3) > 0) stream.Push();
    if (random->Int(0, 3) > 0) stream.Pull();
    idle = stream.pushed + stream.pulled == moved ? idle + 1 : 0;
    REQUIRE(idle < 1000);
  }
  test::Report whole;
  const test::Output expected = test::OutputOf(of.config, of.params, of.scene, &whole);
  CHECK((stream.out.Tight() == expected.bytes));
  CHECK(stream.out.PaddingUntouched());
  // A job that is done again after a failed runner measures its cells again.
  CHECK(stream.report.measured_pixels >= whole.measured_pixels);
  if (stream.runner_failed) whole.measured_pixels = stream.report.measured_pixels;
  CHECK(stream.report.IsLike(whole));
}

// A bad disparity must be refused before anything is written, unless a region does not need it.
void CheckRefusal(const Case& of, test::Random* random) {
  const bool nan = of.config.unknown == STARFOCUS_UNKNOWN_REFUSE && random->Int(0, 1) == 0;
  Case spoiled = of;
  Way way = RandomWay(of, random);
  way.images = -1;
  if (way.entry != Entry::kPrepare) way.entry = Entry::kWhole;
  const int x = random->Int(0, of.scene.width - 1), y = random->Int(0, of.scene.height - 1);
  spoiled.scene.Disparity(x, y) = nan                      ? std::numeric_limits<float>::quiet_NaN()
                                  : random->Int(0, 1) == 0 ? -1000.0f
                                                           : 1000.0f;
  CAPTURES(x, y, way.Text());
  const bool prepares = way.entry == Entry::kPrepare;
  way.entry = Entry::kWhole;
  Setup setup = RandomSetup(random);
  setup.used = false;
  Picture picture(spoiled, way, setup), good(of, way, {});
  RandomRunner runner = {setup.workers, test::Random(random->Next())};
  const starfocus_status refusal = nan ? STARFOCUS_ERROR_NOT_FINITE : STARFOCUS_ERROR_DISPARITY;
  if (prepares) {
    size_t bytes = 0;
    REQUIRE(starfocus_prepared_size(&picture.rig()->config(), &bytes, nullptr) == STARFOCUS_OK);
    const Bytes blank(bytes, test::kPoison);
    const Memory memory(bytes, test::kPoison);
    starfocus_prepared* prepared = nullptr;
    const starfocus_light_field field = picture.Field();
    CHECK(starfocus_prepare(picture.rig()->get(), &field, memory.get(), bytes, &prepared) ==
          refusal);
    CHECK(std::equal(blank.begin(), blank.end(), static_cast<const uint8_t*>(memory.get())));
    return;
  }
  Bytes got;
  const starfocus_status status = picture.Ask(runner.Callbacks(), &got);
  const Bytes expected = Expected(good);
  const auto begins = [&](const Bytes& bytes) {
    return std::equal(bytes.begin(), bytes.end(), got.begin());
  };
  if (status == STARFOCUS_OK && way.region.width > 0) {
    CHECK(begins(expected));
    return;
  }
  CHECK(status == refusal);
  CHECK(begins(Bytes(expected.size(), test::kPoison)));
}

}  // namespace

void CheckWay(const Case& of, const Way& way, test::Random* random) {
  const Setup setup = RandomSetup(random);
  const std::string target = setup.kernels->name;
  CAPTURES(way.Text(), target, setup.workers, setup.used, setup.poison, setup.room, setup.maker);
  Picture picture(of, way, setup);
  const test::Scene before = picture.asked().scene;
  RandomRunner runner = {setup.workers, test::Random(random->Next())};
  Bytes got;
  if (random->Int(0, 3) == 0) {
    runner.jobs_left = random->Int(0, 1) == 0 ? random->Int(0, 5) : random->Int(0, 60);
    const starfocus_status status = picture.Ask(runner.Callbacks(), &got);
    CHECK(status == (runner.Mend() ? STARFOCUS_ERROR_RUNNER : STARFOCUS_OK));
  }
  REQUIRE(picture.Ask(runner.Callbacks(), &got) == STARFOCUS_OK);
  const Bytes expected = Expected(picture);
  REQUIRE(got.size() > expected.size());
  size_t first = 0, differ = 0;
  for (size_t n = expected.size(); n-- > 0;) {
    if (got[n] == expected[n]) continue;
    first = n;
    ++differ;
  }
  CAPTURES(first, expected.size());
  CHECK(differ == 0);
  const test::Scene& after = picture.asked().scene;
  CHECK((before.pictures == after.pictures && before.coverage == after.coverage));
}

void CheckAnyCall(const Case& of, test::Random* random) {
  const int kind = random->Int(0, 7);
  CAPTURE(of.Text());
  if (kind == 0) return CheckRefusal(of, random);
  if (kind < 3) return CheckStreaming(of, random);
  CheckWay(of, RandomWay(of, random), random);
}

}  // namespace properties
