// SPDX-License-Identifier: Apache-2.0
#include "platform/pool/quota.h"

#include <cstdio>
#include <cstring>

#include "platform/pool/big_cores.h"

namespace starfocus {
namespace {

constexpr int kLongestPath = 4096;

// Processor time in microseconds that a group may use in each period.
struct Quota {
  long long time = 0, period = 0;
};

// Reads up to two numbers from the file `folder`/`name`. Returns the number of values that were
// read, which is 0 for the text "max".
int ReadNumbers(const char* folder, const char* name, long long* first, long long* second) {
  char path[kLongestPath];
  const int length = std::snprintf(path, sizeof path, "%s/%s", folder, name);
  if (length < 0 || length >= kLongestPath) return 0;
  std::FILE* const file = std::fopen(path, "re");
  if (file == nullptr) return 0;
  const int count = std::fscanf(file, "%lld %lld", first, second);
  std::fclose(file);
  return count < 0 ? 0 : count;
}

Quota ReadQuota(const char* folder) {
  Quota quota;
  long long unused = 0;
  if (ReadNumbers(folder, "cpu.max", &quota.time, &quota.period) == 2) return quota;
  const bool has_both = ReadNumbers(folder, "cpu.cfs_quota_us", &quota.time, &unused) > 0 &&
                        ReadNumbers(folder, "cpu.cfs_period_us", &quota.period, &unused) > 0;
  return has_both ? quota : Quota();
}

// Reduces `cores` to the least quota of the group `folder` and its parents up to the first `root`
// characters of the path. Removes these parts of the path.
void Limit(char* folder, size_t root, int* cores) {
  for (;;) {
    const Quota quota = ReadQuota(folder);
    if (quota.time > 0 && quota.period > 0) {
      const long long whole = (quota.time - 1) / quota.period + 1;
      if (whole < kMaxCores && (*cores == 0 || whole < *cores)) *cores = static_cast<int>(whole);
    }
    char* const last = std::strrchr(folder, '/');
    if (last == nullptr || static_cast<size_t>(last - folder) < root) return;
    *last = '\0';
  }
}

}  // namespace

int QuotaCores(const char* groups, const char* mounted) {
  std::FILE* const file = std::fopen(groups, "re");
  if (file == nullptr) return 0;
  int cores = 0;
  char line[kLongestPath], folder[kLongestPath];
  // A line is "0::/group" for version 2, and "4:cpu,cpuacct:/group" for version 1, whose groups are
  // in the folder "cpu".
  while (std::fgets(line, sizeof line, file) != nullptr) {
    line[std::strcspn(line, "\n")] = '\0';
    char* const controllers = std::strchr(line, ':');
    char* const group = controllers == nullptr ? nullptr : std::strchr(controllers + 1, ':');
    if (group == nullptr) continue;
    *group = '\0';
    const bool version_2 = controllers[1] == '\0';
    if (!version_2 && std::strncmp(controllers + 1, "cpu,", 4) != 0 &&
        std::strcmp(controllers + 1, "cpu") != 0) {
      continue;
    }
    const char* const part = version_2 ? "" : "/cpu";
    const int length = std::snprintf(folder, sizeof folder, "%s%s%s", mounted, part, group + 1);
    if (length < 0 || length >= kLongestPath) continue;
    Limit(folder, std::strlen(mounted) + std::strlen(part), &cores);
  }
  std::fclose(file);
  return cores;
}

}  // namespace starfocus
