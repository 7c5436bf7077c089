// SPDX-License-Identifier: Apache-2.0
// Finds the big cores of machines that have cores of different speeds, and restricts threads to the
// big cores. Used by the thread pool (pool.cc). On systems other than Linux, BigCores returns an
// empty set.
#ifndef STARFOCUS_PLATFORM_POOL_BIG_CORES_H_
#define STARFOCUS_PLATFORM_POOL_BIG_CORES_H_

#include <cstdint>

namespace starfocus {

inline constexpr int kMaxCores = 1024;  // cores with numbers of kMaxCores or more are ignored

// A set of cores, identified by their numbers in the operating system.
struct CoreSet {
  uint64_t words[kMaxCores / 64] = {};

  bool Has(int core) const { return (words[core / 64] >> (core % 64) & 1) != 0; }
  void Add(int core) { words[core / 64] |= uint64_t{1} << (core % 64); }
  int Count() const;
};

// Returns the big cores among the cores `allowed`. Reads the file `folder`/cpu<N>/cpu_capacity of
// all cores. If a core lacks the file cpu_capacity, reads `folder`/cpu<N>/cpufreq/cpuinfo_max_freq
// of all cores instead. Returns `allowed` if some core lacks cpu_capacity and some core lacks
// cpuinfo_max_freq. `folder` is /sys/devices/system/cpu, except in tests.
CoreSet FindBigCores(const char* folder, const CoreSet& allowed);

// Returns the big cores that this process may run on. Returns an empty set if the system does not
// report which cores the process may run on.
CoreSet BigCores();

// Restricts the calling thread to `cores`. If the system rejects the restriction, the thread may
// still run on any core that was available before.
void RunOn(const CoreSet& cores);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_POOL_BIG_CORES_H_
