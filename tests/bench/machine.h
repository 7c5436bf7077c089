// SPDX-License-Identifier: Apache-2.0
// Where and with what the bench ran.
#ifndef STARFOCUS_TESTS_BENCH_MACHINE_H_
#define STARFOCUS_TESTS_BENCH_MACHINE_H_

#include <string>

namespace starfocus::bench {

struct Machine {
  std::string cpu, target, compiler, version;
};

Machine ThisMachine(const std::string& revision);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_MACHINE_H_
