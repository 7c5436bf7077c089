// SPDX-License-Identifier: Apache-2.0
// What the ways of asking for a picture share.
#ifndef STARFOCUS_TESTS_STRESS_DIFFERENTIAL_H_
#define STARFOCUS_TESTS_STRESS_DIFFERENTIAL_H_

#include <functional>
#include <string>
#include <vector>

#include "tests/stress/rig.h"
#include "tests/stress/setup.h"

namespace starfocus::stress {

// What one case asks for, and the whole picture that a new engine gives without a runner.
struct Asked {
  Setup setup;
  std::vector<uint8_t> picture;
};

starfocus_region RandomRegion(const test::Scene& scene, test::Random* random);

// The region of the picture.
std::vector<uint8_t> Crop(const Asked& asked, const starfocus_region& region);

// The call's status; now and then its runner has failed once before. A failure that the call does
// not tell is STARFOCUS_ERROR_RUNNER here.
starfocus_status Retried(Rig* rig, test::Random* random,
                         const std::function<starfocus_status()>& call);

// Empty when the call succeeded and `out` holds the expected bytes.
std::string Verdict(const Rig& rig, starfocus_status status, const std::vector<uint8_t>& expected,
                    const test::Output& out);

// Ways with files of their own. Each gives what went wrong, or nothing.
std::string Streamed(const Asked& asked, test::Random* random);
std::string After(const Asked& asked, test::Random* random);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_STRESS_DIFFERENTIAL_H_
