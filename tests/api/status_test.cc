// SPDX-License-Identifier: Apache-2.0
// Tests the descriptions that starfocus_status_string returns.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "starfocus/starfocus.h"

// If the switch in WordsOf omits a status, the compilation must fail.
#pragma GCC diagnostic error "-Wswitch"

namespace status_test {
namespace {

// Returns words that appear only in the description of `status`, or null if `status` is not a
// defined value.
const char* WordsOf(starfocus_status status) {
  switch (status) {
    case STARFOCUS_OK:
      return "success";
    case STARFOCUS_ERROR_NULL:
      return "pointer is null";
    case STARFOCUS_ERROR_STRUCTURE:
      return "init function";
    case STARFOCUS_ERROR_RANGE:
      return "outside its range";
    case STARFOCUS_ERROR_FEATURE:
      return "needs a feature";
    case STARFOCUS_ERROR_STATE:
      return "starfocus_stream_begin";
    case STARFOCUS_ERROR_WORKSPACE:
      return "STARFOCUS_ALIGNMENT";
    case STARFOCUS_ERROR_TOO_LARGE:
      return "can address";
    case STARFOCUS_ERROR_MEMORY:
      return "out of memory";
    case STARFOCUS_ERROR_STRIDE:
      return "stride is smaller";
    case STARFOCUS_ERROR_OVERLAP:
      return "overlaps";
    case STARFOCUS_ERROR_BLUR:
      return "exceeds max_blur";
    case STARFOCUS_ERROR_DISPARITY:
      return "outside the configured disparity range";
    case STARFOCUS_ERROR_NOT_FINITE:
      return "NaN or infinity";
    case STARFOCUS_ERROR_ALL_INVALID:
      return "no finite value";
    case STARFOCUS_ERROR_PREPARED:
      return "prepared light field";
    case STARFOCUS_ERROR_RUNNER:
      return "runner";
    case STARFOCUS_ERROR_CANCELLED:
      return "cancelled";
  }
  return nullptr;
}

TEST_CASE(
    "statuses: each status has a unique description, and other numbers are unknown statuses") {
  std::set<std::string> sentences;
  int statuses = 0;
  for (int number = -1000; number <= 1000; ++number) {
    CAPTURE(number);
    const auto status = static_cast<starfocus_status>(number);
    const std::string sentence = starfocus_status_string(status);
    if (WordsOf(status) == nullptr) {
      CHECK(sentence == "unknown status");
      continue;
    }
    ++statuses;
    CAPTURE(sentence);
    CHECK(sentence != "unknown status");
    CHECK(sentences.insert(sentence).second);
    // The description must not contain the words of other statuses.
    for (int other = 0; other < 100; ++other) {
      const char* const words = WordsOf(static_cast<starfocus_status>(other));
      if (words == nullptr) continue;
      CAPTURE(words);
      CHECK((sentence.find(words) != std::string::npos) == (other == number));
    }
  }
  CHECK(statuses == 18);
}

}  // namespace
}  // namespace status_test
