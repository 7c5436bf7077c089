// SPDX-License-Identifier: Apache-2.0
// Checks that say which field or argument they refuse, and what was expected of it.
#ifndef STARFOCUS_LIB_BASE_PROBLEM_H_
#define STARFOCUS_LIB_BASE_PROBLEM_H_

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "starfocus/starfocus.h"

namespace starfocus {

constexpr double kNoNumber = __builtin_nan("");

// What is allowed, in words and in numbers.
struct Allowed {
  const char* words;
  double low = kNoNumber, high = kNoNumber;

  // The comparison is written so that NaN fails.
  bool Has(double value) const { return value >= low && value <= high; }
};

#define STARFOCUS_TEXT(text) #text
#define STARFOCUS_TEXT_OF(macro) STARFOCUS_TEXT(macro)
// From `least` to `most`, two numbers or macros of numbers.
#define STARFOCUS_FROM_TO(least, most)                                                    \
  ::starfocus::Allowed {                                                                  \
    STARFOCUS_TEXT_OF(least)                                                              \
    " to " STARFOCUS_TEXT_OF(most), static_cast<double>(least), static_cast<double>(most) \
  }

// A field or an argument: its name, its value, and its index if the name has [].
struct FieldValue {
  const char* name;
  double value = kNoNumber;
  int32_t index = 0;
};

// Fills *problem in, unless it is null. Returns the status.
starfocus_status Refuse(starfocus_status status, const FieldValue& field, const Allowed& allowed,
                        starfocus_problem* problem);

// Fills *problem in for a status that no check has told of: runner, progress or memory. Returns it.
starfocus_status TellStatus(starfocus_status status, starfocus_problem* problem);

// Checks values one after the other. The first one that it refuses is the problem.
class Checker {
 public:
  explicit Checker(starfocus_problem* problem) : problem_(problem) {}

  // Refuses the field unless `good`.
  void Need(bool good, starfocus_status status, const FieldValue& field, const Allowed& allowed) {
    if (!good && status_ == STARFOCUS_OK) status_ = Refuse(status, field, allowed, problem_);
  }
  // A number between two others.
  void In(const FieldValue& field, const Allowed& allowed) {
    Need(allowed.Has(field.value), STARFOCUS_ERROR_RANGE, field, allowed);
  }
  void Stride(bool good, const char* name, size_t stride, int32_t index = 0);
  void NotNull(const void* pointer, const char* name, int32_t index = 0) {
    Need(pointer != nullptr, STARFOCUS_ERROR_NULL, {name, kNoNumber, index}, {"not null"});
  }

  starfocus_status status() const { return status_; }

 private:
  starfocus_problem* const problem_;
  starfocus_status status_ = STARFOCUS_OK;
};

// An argument that must not be null.
struct Pointer {
  const char* name;
  const void* pointer;
};

// Begins a call: forgets the problem of the call before, unless it is null, and checks arguments.
starfocus_status CheckPointers(std::initializer_list<Pointer> pointers, starfocus_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_PROBLEM_H_
