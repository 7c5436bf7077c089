// SPDX-License-Identifier: Apache-2.0
// Tests the quota of control groups, with files as Linux provides them on hosts and in containers.
#include "platform/pool/quota.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temp_folder.h"

namespace starfocus::quota_test {
namespace {

using Files = std::vector<std::pair<const char*, const char*>>;  // paths and contents

int CoresOf(const std::string& groups, const Files& files) {
  TempFolder folder;
  std::ofstream(folder.file("groups")) << groups;
  for (const auto& [path, text] : files) {
    const std::filesystem::path file = folder.file("mounted") + "/" + path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  return QuotaCores(folder.file("groups").c_str(), folder.file("mounted").c_str());
}

TEST_CASE("quota: the least quota of the group and its parents counts, rounded up") {
  CHECK(CoresOf("0::/\n", {{"cpu.max", "200000 100000\n"}}) == 2);
  CHECK(CoresOf("0::/\n", {{"cpu.max", "150000 100000\n"}}) == 2);
  CHECK(CoresOf("0::/\n", {{"cpu.max", "1000 100000\n"}}) == 1);
  CHECK(CoresOf("0::/\n", {{"cpu.max", "max 100000\n"}}) == 0);
  CHECK(CoresOf("0::/a/b\n", {{"a/b/cpu.max", "max 100000\n"}, {"a/cpu.max", "300000 100000\n"}}) ==
        3);
  CHECK(CoresOf("0::/a/b\n",
                {{"a/b/cpu.max", "100000 50000\n"}, {"a/cpu.max", "300000 100000\n"}}) == 2);
  CHECK(CoresOf("0::/a/b\n", {{"a/b/cpu.max", "900000 100000\n"}, {"cpu.max", "400000 100000"}}) ==
        4);
  // A container sees the names of the host's groups, but not their folders.
  CHECK(CoresOf("0::/docker/c0ffee\n", {{"cpu.max", "500000 100000\n"}}) == 5);
  CHECK(CoresOf("4:cpu,cpuacct:/docker/c0ffee\n1:name=systemd:/a\n",
                {{"cpu/cpu.cfs_quota_us", "600000\n"}, {"cpu/cpu.cfs_period_us", "100000\n"}}) ==
        6);
}

TEST_CASE("quota: without a quota, and without control groups, nothing is limited") {
  CHECK(QuotaCores("/nonexistent/cgroup", "/nonexistent") == 0);
  CHECK(CoresOf("", {}) == 0);
  CHECK(CoresOf("no colons\n", {{"cpu.max", "100000 100000\n"}}) == 0);
  CHECK(CoresOf("0::/\n", {{"cpu.max", "text"}}) == 0);
  CHECK(CoresOf("0::/\n", {{"cpu.max", "100000 0\n"}}) == 0);
  CHECK(CoresOf("4:cpu:/\n",
                {{"cpu/cpu.cfs_quota_us", "-1\n"}, {"cpu/cpu.cfs_period_us", "100000\n"}}) == 0);
  CHECK(CoresOf("0::/" + std::string(5000, 'a') + "\n", {{"cpu.max", "max 100000\n"}}) == 0);
}

}  // namespace
}  // namespace starfocus::quota_test
