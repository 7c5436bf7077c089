// SPDX-License-Identifier: Apache-2.0
// Tests which cores count as big, and how many cores the quota of control groups allows, with files
// as Linux provides them on phones, laptops, hosts and virtual machines, and in containers.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "platform/pool/big_cores.h"
#include "platform/pool/quota.h"
#include "tests/support/temp_folder.h"

namespace starfocus::cores_test {
namespace {

using Numbers = std::vector<int>;  // A value of Linux for each core, or indices of cores.

void Write(const std::string& folder, const std::string& file, const Numbers& numbers) {
  for (size_t core = 0; core < numbers.size(); ++core) {
    const std::filesystem::path path = folder + "/cpu" + std::to_string(core) + "/" + file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << numbers[core] << "\n";
  }
}

CoreSet First(int count) {
  CoreSet set;
  for (int core = 0; core < count; ++core) set.Add(core);
  return set;
}

Numbers Found(const std::string& folder, const CoreSet& allowed) {
  const CoreSet big = FindBigCores(folder.c_str(), allowed);
  Numbers cores;
  for (int core = 0; core < kMaxCores; ++core) {
    if (big.Has(core)) cores.push_back(core);
  }
  CHECK(int(cores.size()) == big.Count());
  return cores;
}

TEST_CASE("big cores: capacity takes precedence over clock frequency") {
  const TempFolder folder;
  Write(folder.path(), "cpu_capacity", {160, 160, 160, 160, 512, 700, 1024, 1024});
  Write(folder.path(), "cpufreq/cpuinfo_max_freq", Numbers(8, 1800000));
  CHECK(Found(folder.path(), First(8)) == Numbers{4, 5, 6, 7});
  // Cores count as big relative to the strongest core that the process may use.
  CHECK(Found(folder.path(), First(4)) == Numbers{0, 1, 2, 3});
  CHECK(Found(folder.path(), First(5)) == Numbers{4});
  CoreSet some;
  for (const int core : {1, 3, 7}) some.Add(core);
  CHECK(Found(folder.path(), some) == Numbers{7});
}

TEST_CASE("big cores: if the capacity of any core is unknown, clock frequencies decide") {
  const TempFolder folder;
  Write(folder.path(), "cpu_capacity", {1024, 300});
  Write(folder.path(), "cpufreq/cpuinfo_max_freq", {5100000, 5000000, 3800000, 3900000, 2100000});
  CHECK(Found(folder.path(), First(5)) == Numbers{0, 1, 3});
}

TEST_CASE("big cores: if files are absent or invalid, all allowed cores count as big") {
  const TempFolder folder;
  CHECK(Found(folder.path(), First(3)) == Numbers{0, 1, 2});
  CHECK(Found(folder.path() + "/none", First(2)) == Numbers{0, 1});
  CHECK(Found(std::string(600, 'x'), First(2)) == Numbers{0, 1});
  CHECK(Found(folder.path(), CoreSet()).empty());
  Write(folder.path(), "cpu_capacity", {0, -5});
  std::filesystem::create_directories(folder.path() + "/cpu2");
  std::ofstream(folder.path() + "/cpu2/cpu_capacity") << "much\n";
  CHECK(Found(folder.path(), First(3)) == Numbers{0, 1, 2});
  CoreSet last;
  last.Add(kMaxCores - 1);
  CHECK(Found(folder.path(), last) == Numbers{kMaxCores - 1});
}

#ifdef __linux__
TEST_CASE("big cores: this machine has big cores, and a thread can run on them") {
  const CoreSet big = BigCores();
  CHECK(big.Count() >= 1);
  RunOn(big);
  CHECK(BigCores().Count() == big.Count());
}
#endif

// Returns the cores of a quota. `files` has lines "PATH: CONTENT" of files of control groups.
int QuotaOf(const std::string& groups, const std::string& files) {
  TempFolder folder;
  std::ofstream(folder.file("groups")) << groups;
  std::istringstream lines(files);
  for (std::string line; std::getline(lines, line);) {
    const size_t colon = line.find(": ");
    const std::filesystem::path file = folder.file("mounted") + "/" + line.substr(0, colon);
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << line.substr(colon + 2) << "\n";
  }
  return QuotaCores(folder.file("groups").c_str(), folder.file("mounted").c_str());
}

TEST_CASE("quota: the least quota of the group and its parents counts, rounded up") {
  const struct {
    std::string groups, files;
    int cores;
  } rows[] = {{"0::/\n", "cpu.max: 200000 100000", 2},
              {"0::/\n", "cpu.max: 150000 100000", 2},
              {"0::/\n", "cpu.max: 1000 100000", 1},
              {"0::/\n", "cpu.max: max 100000", 0},
              {"0::/a/b\n", "a/b/cpu.max: max 100000\na/cpu.max: 300000 100000", 3},
              {"0::/a/b\n", "a/b/cpu.max: 100000 50000\na/cpu.max: 300000 100000", 2},
              {"0::/a/b\n", "a/b/cpu.max: 900000 100000\ncpu.max: 400000 100000", 4},
              // A container sees the names of the host's groups, but not their folders.
              {"0::/docker/c0ffee\n", "cpu.max: 500000 100000", 5},
              {"4:cpu,cpuacct:/docker/c0ffee\n1:name=systemd:/a\n",
               "cpu/cpu.cfs_quota_us: 600000\ncpu/cpu.cfs_period_us: 100000", 6},
              // Without a quota, and without control groups, nothing is limited.
              {"", "", 0},
              {"no colons\n", "cpu.max: 100000 100000", 0},
              {"0::/\n", "cpu.max: text", 0},
              {"0::/\n", "cpu.max: 100000 0", 0},
              {"4:cpu:/\n", "cpu/cpu.cfs_quota_us: -1\ncpu/cpu.cfs_period_us: 100000", 0},
              {"0::/" + std::string(5000, 'a') + "\n", "cpu.max: max 100000", 0}};
  for (const auto& row : rows) {
    CAPTURE(row.groups);
    CHECK(QuotaOf(row.groups, row.files) == row.cores);
  }
  CHECK(QuotaCores("/nonexistent/cgroup", "/nonexistent") == 0);
}

}  // namespace
}  // namespace starfocus::cores_test
