// SPDX-License-Identifier: Apache-2.0
// Runs the sessions of the options for photographers, whose results are pictures, and of the
// subcommand analyze.
#include "tests/programs/session.h"

namespace starfocus::options_slow_test {
namespace {

TEST_CASE("options: every session of lens_sessions.txt succeeds") {
  RunSessions("programs/lens_sessions.txt", {{"hair", PrepareHair}});
}

}  // namespace
}  // namespace starfocus::options_slow_test
