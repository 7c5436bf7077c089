// SPDX-License-Identifier: Apache-2.0
#include "platform/pool/big_cores.h"

#include <sched.h>

#include <cstdio>

namespace starfocus {
namespace {

// A file with a performance number of a core. A core is big if its performance number is at least
// numerator / denominator of the largest number. Small cores have about 1/3 of the capacity of big
// cores, but 2/3 of the clock frequency, so cpu_capacity and cpuinfo_max_freq require different
// limits.
struct Measure {
  const char* file;
  int64_t numerator, denominator;
};
constexpr Measure kMeasures[] = {{"cpu_capacity", 1, 2}, {"cpufreq/cpuinfo_max_freq", 3, 4}};

// Returns the number that the file `name` of a core contains, or 0 if the file is missing or
// contains no number.
int64_t ReadNumber(const char* folder, int core, const char* name) {
  char path[512];
  const int length = std::snprintf(path, sizeof path, "%s/cpu%d/%s", folder, core, name);
  if (length < 0 || length >= static_cast<int>(sizeof path)) return 0;
  std::FILE* const file = std::fopen(path, "re");
  if (file == nullptr) return 0;
  long long number = 0;
  if (std::fscanf(file, "%lld", &number) != 1 || number < 0) number = 0;
  std::fclose(file);
  return number;
}

}  // namespace

int CoreSet::Count() const {
  int count = 0;
  for (int core = 0; core < kMaxCores; ++core) count += Has(core);
  return count;
}

CoreSet FindBigCores(const char* folder, const CoreSet& allowed) {
  int64_t numbers[kMaxCores] = {};
  for (const Measure& measure : kMeasures) {
    int64_t most = 0;
    bool all = true;
    for (int core = 0; core < kMaxCores && all; ++core) {
      if (!allowed.Has(core)) continue;
      numbers[core] = ReadNumber(folder, core, measure.file);
      if (numbers[core] > most) most = numbers[core];
      all = numbers[core] > 0;
    }
    if (!all) continue;
    CoreSet big;
    for (int core = 0; core < kMaxCores; ++core) {
      if (allowed.Has(core) && numbers[core] * measure.denominator >= most * measure.numerator) {
        big.Add(core);
      }
    }
    return big;
  }
  return allowed;
}

#ifdef __linux__

CoreSet BigCores() {
  cpu_set_t set;
  CoreSet allowed;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return allowed;
  for (int core = 0; core < CPU_SETSIZE && core < kMaxCores; ++core) {
    if (CPU_ISSET(core, &set)) allowed.Add(core);
  }
  return FindBigCores("/sys/devices/system/cpu", allowed);
}

void RunOn(const CoreSet& cores) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (int core = 0; core < CPU_SETSIZE && core < kMaxCores; ++core) {
    if (cores.Has(core)) CPU_SET(core, &set);
  }
  sched_setaffinity(0, sizeof set, &set);  // if the call fails, the thread may use any core
}

#else

CoreSet BigCores() { return {}; }
void RunOn(const CoreSet&) {}

#endif

}  // namespace starfocus
