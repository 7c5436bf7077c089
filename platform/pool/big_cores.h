// SPDX-License-Identifier: Apache-2.0
// Which cores of a machine are its big ones.
#ifndef STARFOCUS_PLATFORM_POOL_BIG_CORES_H_
#define STARFOCUS_PLATFORM_POOL_BIG_CORES_H_

#include <cstdint>

namespace starfocus {

inline constexpr int kMaxCores = 1024;  // those beyond are not asked about

// A core is named by its number in the system.
struct CoreSet {
  uint64_t words[kMaxCores / 64] = {};

  bool Has(int core) const { return (words[core / 64] >> (core % 64) & 1) != 0; }
  void Add(int core) { words[core / 64] |= uint64_t{1} << (core % 64); }
  int Count() const;
};

// The cores of `allowed` that the files below `folder` (/sys/devices/system/cpu) tell are big: by
// cpu<N>/cpu_capacity of all of them or, where that is missing, cpu<N>/cpufreq/cpuinfo_max_freq.
// All of `allowed` when neither is there of each.
CoreSet FindBigCores(const char* folder, const CoreSet& allowed);

// Those of this process; empty where the system does not say what it may run on.
CoreSet BigCores();

// Lets the calling thread run on `cores` alone, if it may.
void RunOn(const CoreSet& cores);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_POOL_BIG_CORES_H_
