// SPDX-License-Identifier: Apache-2.0
// The ways of running an engine. The bytes of a picture must not depend on any of them.
#ifndef STARFOCUS_TESTS_STRESS_RIG_H_
#define STARFOCUS_TESTS_STRESS_RIG_H_

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "starfocus/starfocus.h"
#include "tests/stress/setup.h"
#include "tests/support/test_scene.h"

namespace starfocus::stress {

struct Variant {
  const simd::Kernels* kernels = nullptr;  // null: the best of this machine
  int workers = 1;
  bool stream = false;
  int push_rows = 1, pull_rows = 1;
  uint64_t order = 0;  // of the jobs; 0: no runner
  double room = 1;     // factor of starfocus_config.max_blur
  int poison = -1;     // of the workspace, as Memory's

  std::string Text() const;
};

// Tables of kernels of every SIMD target of this machine, and the plain reference.
const std::vector<const simd::Kernels*>& AllKernels();

Variant RandomVariant(test::Random* random);

// Aligned memory of exactly so many bytes, each of the value `poison`; of noise if that is above
// 255, as the heap gave them if it is negative.
class Memory {
 public:
  Memory(size_t bytes, int poison, test::Random* random);
  void* get() const { return memory_.get(); }

 private:
  struct Free {
    void operator()(void* memory) const;
  };
  std::unique_ptr<void, Free> memory_;
};

// The engine of a variant, in memory of exactly the size it asked for, and the runner of its jobs.
class Rig {
 public:
  Rig(const starfocus_config& config, const Variant& variant);

  // Makes the engine anew in the memory that it used.
  void Restart();

  starfocus_status status() const { return status_; }
  starfocus_engine* get() const { return engine_; }
  const starfocus_config& config() const { return config_; }
  const Variant& variant() const { return variant_; }

  // Without a runner when the engine is to run the jobs by itself.
  starfocus_callbacks callbacks() {
    return test::RunBy(variant_.order == 0 && jobs_left_ < 0 ? nullptr : Run, this);
  }
  // Sets these for the next call.
  void SetCallbacks() {
    const starfocus_callbacks set = callbacks();
    starfocus_set_callbacks(engine_, &set);
  }

  // The runner does so many jobs well, then one of them wrong in some way or not at all.
  void FailAfter(int32_t jobs) {
    jobs_left_ = jobs;
    failed_ = false;
  }
  // The runner does all jobs well. Whether it failed since the last FailAfter.
  bool Mend() {
    jobs_left_ = -1;
    return failed_;
  }

 private:
  // Runs jobs one after the other in a shuffled order as any of the workers.
  static int Run(void* self, starfocus_job job, void* data, int32_t count);

  starfocus_config config_;
  Variant variant_;
  size_t bytes_ = 0;
  std::unique_ptr<Memory> memory_;
  starfocus_engine* engine_ = nullptr;
  starfocus_status status_ = STARFOCUS_OK;
  test::Random random_;
  int32_t jobs_left_ = -1;
  bool failed_ = false;
};

// Bytes of the picture without row padding. Throws a line when the engine failed or wrote where it
// must not.
std::vector<uint8_t> Refocused(const Setup& setup, const Variant& variant,
                               starfocus_report* report = nullptr);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_STRESS_RIG_H_
