// SPDX-License-Identifier: Apache-2.0
// Preloaded under valgrind (tests/support/valgrind.sh): takes the place of what libhwy measures
// when it is loaded, by an instruction that valgrind refuses on processors that do not announce it.
// The engine asks Highway for no time.
#include <cstdint>

namespace hwy::platform {

uint64_t TimerResolution();

uint64_t TimerResolution() { return 1; }

}  // namespace hwy::platform
