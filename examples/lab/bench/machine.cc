// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/bench/machine.h"

#include <fstream>

#include "starfocus/starfocus.h"
#include "starfocus/version.h"

namespace starfocus::bench {
namespace {

// Returns the name of the processor from /proc/cpuinfo, or "unknown".
std::string CpuName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    if (line.rfind("model name", 0) == 0 || line.rfind("Model", 0) == 0) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

}  // namespace

Machine ThisMachine(const std::string& revision) {
  Machine machine;
  machine.cpu = CpuName();
  machine.target = starfocus_simd_target();
#if defined(__clang__)
  machine.compiler = "clang " __clang_version__;
#else
  machine.compiler = "gcc " __VERSION__;
#endif
  machine.version = STARFOCUS_VERSION_STRING;
  if (!revision.empty()) machine.version += " " + revision;
  return machine;
}

}  // namespace starfocus::bench
