// SPDX-License-Identifier: Apache-2.0
// Describes the machine, compiler and version for the output of the bench.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_MACHINE_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_MACHINE_H_

#include <string>

namespace starfocus::bench {

struct Machine {
  std::string cpu, target, compiler, version;
};

// Returns the description of this machine. `revision` is appended to the version, unless it is
// empty.
Machine ThisMachine(const std::string& revision);

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_MACHINE_H_
