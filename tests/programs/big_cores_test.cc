// SPDX-License-Identifier: Apache-2.0
// Tests which cores count as big, with files as Linux provides them on phones, laptops and virtual
// machines.
#include "platform/pool/big_cores.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace big_cores_test {
namespace {

using starfocus::CoreSet;

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
  const CoreSet big = starfocus::FindBigCores(folder.c_str(), allowed);
  Numbers cores;
  for (int core = 0; core < starfocus::kMaxCores; ++core) {
    if (big.Has(core)) cores.push_back(core);
  }
  CHECK(int(cores.size()) == big.Count());
  return cores;
}

TEST_CASE("big cores: capacity takes precedence over clock frequency") {
  const starfocus::TempFolder folder;
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
  const starfocus::TempFolder folder;
  Write(folder.path(), "cpu_capacity", {1024, 300});
  Write(folder.path(), "cpufreq/cpuinfo_max_freq", {5100000, 5000000, 3800000, 3900000, 2100000});
  CHECK(Found(folder.path(), First(5)) == Numbers{0, 1, 3});
}

TEST_CASE("big cores: if files are absent or invalid, all allowed cores count as big") {
  const starfocus::TempFolder folder;
  CHECK(Found(folder.path(), First(3)) == Numbers{0, 1, 2});
  CHECK(Found(folder.path() + "/none", First(2)) == Numbers{0, 1});
  CHECK(Found(std::string(600, 'x'), First(2)) == Numbers{0, 1});
  CHECK(Found(folder.path(), CoreSet()).empty());
  Write(folder.path(), "cpu_capacity", {0, -5});
  std::filesystem::create_directories(folder.path() + "/cpu2");
  std::ofstream(folder.path() + "/cpu2/cpu_capacity") << "much\n";
  CHECK(Found(folder.path(), First(3)) == Numbers{0, 1, 2});
  CoreSet last;
  last.Add(starfocus::kMaxCores - 1);
  CHECK(Found(folder.path(), last) == Numbers{starfocus::kMaxCores - 1});
}

#ifdef __linux__
TEST_CASE("big cores: this machine has big cores, and a thread can run on them") {
  const CoreSet big = starfocus::BigCores();
  CHECK(big.Count() >= 1);
  starfocus::RunOn(big);
  CHECK(starfocus::BigCores().Count() == big.Count());
}
#endif

}  // namespace
}  // namespace big_cores_test
