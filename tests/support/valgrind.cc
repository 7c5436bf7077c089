// SPDX-License-Identifier: Apache-2.0
// A library that valgrind.sh preloads under valgrind. The library replaces a measurement of time
// that libhwy makes at startup. For this measurement, libhwy executes an instruction that valgrind
// rejects on processors that do not announce the instruction. The engine does not use the result.
#include <cstdint>

namespace hwy::platform {

uint64_t TimerResolution();

uint64_t TimerResolution() { return 1; }

}  // namespace hwy::platform
