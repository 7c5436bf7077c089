// SPDX-License-Identifier: Apache-2.0
// Preloaded under valgrind (tests/support/valgrind.sh). It replaces a measurement of time that
// libhwy makes when it is loaded. This measurement uses an instruction that valgrind rejects on
// processors that do not announce it. The engine does not use the result.
#include <cstdint>

namespace hwy::platform {

uint64_t TimerResolution();

uint64_t TimerResolution() { return 1; }

}  // namespace hwy::platform
