// SPDX-License-Identifier: Apache-2.0
// Runs an engine in different variants, such as SIMD targets, orders of jobs, and streams. The
// bytes of a picture must not depend on the variant.
#ifndef STARFOCUS_TESTS_OPERATIONS_RIG_H_
#define STARFOCUS_TESTS_OPERATIONS_RIG_H_

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "starfocus/starfocus.h"
#include "tests/operations/setup.h"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace starfocus::stress {

struct Variant {
  const simd::Kernels* kernels = nullptr;  // SIMD kernels; null: the best for this machine
  int workers = 1;
  bool stream = false;
  int push_rows = 1, pull_rows = 1;
  uint64_t order = 0;  // Seed of the order of jobs; 0: no runner.
  double room = 1;     // Factor of test::Config.max_blur.
  int poison = -1;     // Initial bytes of the workspace, see Memory.

  std::string Text() const;
};

// Returns the kernels of every SIMD target of this machine, and the reference.
const std::vector<const simd::Kernels*>& AllKernels();

Variant RandomVariant(test::Random* random);

// Aligned memory of exactly the given size. All bytes have the value `poison`. If `poison` is above
// 255, the bytes are random. If `poison` is negative, the bytes are not initialised.
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

// An engine in a workspace of exactly the required size, and the runner of its jobs.
class Rig {
 public:
  Rig(const test::Config& config, const Variant& variant);

  // Creates the engine again in the same memory.
  void Restart();

  starfocus_status status() const { return status_; }
  starfocus_engine* get() const { return engine_; }
  const test::Config& config() const { return config_; }
  const Variant& variant() const { return variant_; }

  // Returns callbacks with a runner, or without a runner if the engine runs the jobs itself.
  starfocus_callbacks callbacks() {
    return test::RunBy(variant_.order == 0 && jobs_left_ < 0 ? nullptr : Run, this);
  }
  // Sets the callbacks for the next call.
  void SetCallbacks() {
    const starfocus_callbacks set = callbacks();
    starfocus_set_callbacks(engine_, &set);
  }

  // Makes the runner execute `jobs` jobs correctly, and then one job incorrectly or not at all.
  void FailAfter(int32_t jobs) {
    jobs_left_ = jobs;
    failed_ = false;
  }
  // Makes the runner execute all jobs correctly. Returns true if the runner has failed since the
  // last FailAfter.
  bool Mend() {
    jobs_left_ = -1;
    return failed_;
  }

 private:
  // Runs the jobs sequentially in a shuffled order, each with a random worker.
  static int Run(void* self, starfocus_job job, void* data, int32_t count);

  test::Config config_;
  Variant variant_;
  size_t bytes_ = 0;
  std::unique_ptr<Memory> memory_;
  starfocus_engine* engine_ = nullptr;
  starfocus_status status_ = STARFOCUS_OK;
  test::Random random_;
  int32_t jobs_left_ = -1;
  bool failed_ = false;
};

// Returns the bytes of the picture without row padding. Throws a std::runtime_error if the engine
// fails or writes outside the picture.
std::vector<uint8_t> Refocused(const Setup& setup, const Variant& variant,
                               starfocus_report* report = nullptr);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_OPERATIONS_RIG_H_
