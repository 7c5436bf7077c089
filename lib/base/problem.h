// SPDX-License-Identifier: Apache-2.0
// Argument checks that report the rejected field and its allowed values.
#ifndef STARFOCUS_LIB_BASE_PROBLEM_H_
#define STARFOCUS_LIB_BASE_PROBLEM_H_

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "lib/base/geometry.h"
#include "starfocus/starfocus.h"

namespace starfocus {

constexpr double kNoNumber = __builtin_nan("");

// Allowed values, in words and as a range.
struct Allowed {
  const char* words;
  double low = kNoNumber, high = kNoNumber;
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

// Checks the arguments of an API call one after another. After the first error, which *problem
// describes, all further checks have no effect.
class Checker {
 public:
  // `problem` may be null.
  explicit Checker(starfocus_problem* problem, starfocus_status status = STARFOCUS_OK)
      : problem_(problem), status_(status) {}

  // Rejects the field if `good` is false.
  void Need(bool good, starfocus_status status, const FieldValue& field, const Allowed& allowed);
  // Rejects numbers outside the allowed range.
  void In(const FieldValue& field, const Allowed& allowed);
  void Stride(bool good, const char* name, size_t stride, int32_t index = 0);
  void NotNull(const void* pointer, const char* name, int32_t index = 0);
  // Copies the caller's structure over the defaults in *full. The structure may lack the last
  // fields, because the caller's header may be older than the library. Rejects structures that were
  // not initialised, or were initialised by a newer header. `name` names their field `size`.
  template <class Structure>
  void Read(const Structure& given, const char* name, Structure* full) {
    const uint32_t size = given.size;
    constexpr size_t kLeast = 2 * sizeof size;
    Need(size >= kLeast && size <= sizeof(Structure) && size % alignof(Structure) == 0,
         STARFOCUS_ERROR_STRUCTURE, {name, double(size)},
         {"the value set by the init function", double(kLeast), double(sizeof(Structure))});
    if (passed()) std::memcpy(static_cast<void*>(full), &given, size);
  }
  // Checks that an output does not overlap the address ranges in `read`.
  void Apart(const Extent& out, const Extents& read, const char* name);
  // Adds the result of another function: a check, the runner, the progress function or the
  // allocator. Fills *problem if that function has not filled it. Returns status().
  starfocus_status Add(starfocus_status status);

  starfocus_status status() const { return status_; }
  bool passed() const { return status_ == STARFOCUS_OK; }

 private:
  starfocus_problem* const problem_;
  starfocus_status status_;
};

// Starts an API call: clears *problem, unless `problem` is null.
Checker Enter(starfocus_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_PROBLEM_H_
