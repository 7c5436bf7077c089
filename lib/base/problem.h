// SPDX-License-Identifier: Apache-2.0
// Argument checks that report the rejected field and its allowed values.
#ifndef STARFOCUS_LIB_BASE_PROBLEM_H_
#define STARFOCUS_LIB_BASE_PROBLEM_H_

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "lib/base/geometry.h"
#include "starfocus/starfocus.h"

namespace starfocus {

constexpr double kNoNumber = __builtin_nan("");

// Allowed values, in words and as a range.
struct Allowed {
  const char* words;
  double low = kNoNumber, high = kNoNumber;

  // Returns false for NaN, because every comparison with NaN is false.
  bool Has(double value) const { return value >= low && value <= high; }
};

#define STARFOCUS_TEXT(text) #text
#define STARFOCUS_TEXT_OF(macro) STARFOCUS_TEXT(macro)
// Range from `least` to `most`, two numbers or macros that expand to numbers.
#define STARFOCUS_FROM_TO(least, most)                                                    \
  ::starfocus::Allowed {                                                                  \
    STARFOCUS_TEXT_OF(least)                                                              \
    " to " STARFOCUS_TEXT_OF(most), static_cast<double>(least), static_cast<double>(most) \
  }

// Name and value of a field or argument, and its index if the name contains [].
struct FieldValue {
  const char* name;
  double value = kNoNumber;
  int32_t index = 0;
};

// Fills *problem, unless `problem` is null. Returns `status`.
starfocus_status Refuse(starfocus_status status, const FieldValue& field, const Allowed& allowed,
                        starfocus_problem* problem);

// Fills *problem if no check has filled it before. Callers use this function for errors of the
// runner, the progress function or memory. Returns `status`.
starfocus_status TellStatus(starfocus_status status, starfocus_problem* problem);

// Checks that an output does not overlap the address ranges in `read`. `name` is the name of the
// output argument.
inline starfocus_status CheckApart(const Extent& out, const Extents& read, const char* name,
                                   starfocus_problem* problem) {
  if (!Overlaps(out, read)) return STARFOCUS_OK;
  return Refuse(STARFOCUS_ERROR_OVERLAP, {name},
                {"memory that overlaps neither the inputs nor the workspace"}, problem);
}

// Checks a sequence of values. *problem describes the first rejected value.
class Checker {
 public:
  explicit Checker(starfocus_problem* problem) : problem_(problem) {}

  // Rejects the field if `good` is false.
  void Need(bool good, starfocus_status status, const FieldValue& field, const Allowed& allowed) {
    if (!good && status_ == STARFOCUS_OK) status_ = Refuse(status, field, allowed, problem_);
  }
  // Rejects numbers outside the allowed range.
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

// Starts a call: clears *problem, unless `problem` is null, and checks that all arguments are not
// null.
starfocus_status CheckPointers(std::initializer_list<Pointer> pointers, starfocus_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_PROBLEM_H_
