// SPDX-License-Identifier: Apache-2.0
// Declarations shared by the calls of the differential family.
#ifndef STARFOCUS_TESTS_OPERATIONS_DIFFERENTIAL_H_
#define STARFOCUS_TESTS_OPERATIONS_DIFFERENTIAL_H_

#include <functional>
#include <string>
#include <vector>

#include "tests/operations/rig.h"
#include "tests/operations/setup.h"

namespace starfocus::stress {

// Input of one case, and the whole picture from a new engine without a runner.
struct Asked {
  Setup setup;
  std::vector<uint8_t> picture;
};

starfocus_region RandomRegion(const test::Scene& scene, test::Random* random);

// Returns the pixels of a region of asked.picture.
std::vector<uint8_t> Crop(const Asked& asked, const starfocus_region& region);

// Calls `call` and returns the status. In some cases, `call` is first called with a failing runner.
// Returns STARFOCUS_ERROR_RUNNER if the first call does not report the failure.
starfocus_status Retried(Rig* rig, test::Random* random,
                         const std::function<starfocus_status()>& call);

// Returns an empty string if the call succeeded and `out` holds the expected bytes.
std::string Verdict(const Rig& rig, starfocus_status status, const std::vector<uint8_t>& expected,
                    const test::Output& out);

// Declares calls that separate files define. Each function returns a description of the failure, or
// an empty string.
std::string Streamed(const Asked& asked, test::Random* random);
std::string After(const Asked& asked, test::Random* random);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_OPERATIONS_DIFFERENTIAL_H_
