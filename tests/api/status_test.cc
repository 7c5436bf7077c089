// SPDX-License-Identifier: Apache-2.0
// The sentence of each status.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "starfocus/starfocus.h"

// A status that is forgotten below does not compile.
#pragma GCC diagnostic error "-Wswitch"

namespace status_test {
namespace {

// What only the sentence of this status says; null when there is no such status.
const char* WordsOf(sf_status status) {
  switch (status) {
    case SF_OK:
      return "success";
    case SF_ERROR_NULL:
      return "pointer is null";
    case SF_ERROR_STRUCTURE:
      return "init function";
    case SF_ERROR_RANGE:
      return "outside its range";
    case SF_ERROR_FEATURE:
      return "needs a feature";
    case SF_ERROR_STATE:
      return "sf_stream_begin";
    case SF_ERROR_WORKSPACE:
      return "SF_ALIGNMENT";
    case SF_ERROR_TOO_LARGE:
      return "can address";
    case SF_ERROR_MEMORY:
      return "there is no memory";
    case SF_ERROR_STRIDE:
      return "stride is smaller";
    case SF_ERROR_OVERLAP:
      return "overlaps";
    case SF_ERROR_BLUR:
      return "exceeds max_blur";
    case SF_ERROR_DISPARITY:
      return "outside the configured disparity range";
    case SF_ERROR_NOT_FINITE:
      return "NaN or infinity";
    case SF_ERROR_ALL_INVALID:
      return "no finite value";
    case SF_ERROR_PREPARED:
      return "prepared light field";
    case SF_ERROR_RUNNER:
      return "runner";
    case SF_ERROR_CANCELLED:
      return "cancelled";
  }
  return nullptr;
}

TEST_CASE("statuses: every one has a sentence of its own, and no other number has") {
  std::set<std::string> sentences;
  int statuses = 0;
  for (int number = -1000; number <= 1000; ++number) {
    CAPTURE(number);
    const auto status = static_cast<sf_status>(number);
    const std::string sentence = sf_status_string(status);
    if (WordsOf(status) == nullptr) {
      CHECK(sentence == "unknown status");
      continue;
    }
    ++statuses;
    CAPTURE(sentence);
    CHECK(sentence != "unknown status");
    CHECK(sentences.insert(sentence).second);
    // What it says is of this status and of no other.
    for (int other = 0; other < 100; ++other) {
      const char* const words = WordsOf(static_cast<sf_status>(other));
      if (words == nullptr) continue;
      CAPTURE(words);
      CHECK((sentence.find(words) != std::string::npos) == (other == number));
    }
  }
  CHECK(statuses == 18);
}

}  // namespace
}  // namespace status_test
