// SPDX-License-Identifier: Apache-2.0
// Fields of public structures by name, and values beyond their ranges.
#ifndef STARFOCUS_TESTS_API_FIELD_VALUES_H_
#define STARFOCUS_TESTS_API_FIELD_VALUES_H_

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"

namespace field_values {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// A field of a structure in memory.
struct Field {
  void* at;
  int32_t type;  // one of STARFOCUS_FIELD_

  template <class Value>
  void Put(Value value) {
    std::memcpy(at, &value, sizeof value);
  }
  template <class Value>
  double As() const {
    Value value;
    std::memcpy(&value, at, sizeof value);
    return double(value);
  }
  // Returns the number, or 0 if the field is a null pointer.
  double Get() const {
    if (type == STARFOCUS_FIELD_DOUBLE) return As<double>();
    if (type == STARFOCUS_FIELD_POINTER) return As<uintptr_t>();
    return type == STARFOCUS_FIELD_INT32 ? As<int32_t>() : As<uint32_t>();
  }
  // Writes a number, or a null pointer if the field is a pointer. The number -1 in a field without
  // a sign is the largest value of its type.
  void Set(double value) {
    const bool is_real = type == STARFOCUS_FIELD_DOUBLE;
    const int64_t whole = is_real ? 0 : static_cast<int64_t>(value);
    if (is_real) return Put(value);
    if (type == STARFOCUS_FIELD_POINTER) return Put(static_cast<void*>(nullptr));
    if (type == STARFOCUS_FIELD_UINT64) return Put(static_cast<uint64_t>(whole));
    if (type == STARFOCUS_FIELD_UINT32) return Put(static_cast<uint32_t>(whole));
    REQUIRE(type == STARFOCUS_FIELD_INT32);
    Put(static_cast<int32_t>(whole));
  }
};

// Returns the field with a path such as "views[1].planes[0]" in `structure`, which lies at `at`.
// The path may lead through pointers to structures.
inline Field FieldAt(std::string structure, void* at, const std::string& path) {
  const size_t dot = path.find('.');
  const std::string part = path.substr(0, dot);
  const size_t bracket = part.find('[');
  const starfocus_field* fields = nullptr;
  int32_t count = 0;
  starfocus_fields(structure.c_str(), &fields, &count);
  for (const starfocus_field* field = fields; field != fields + count; ++field) {
    if (field->name != part.substr(0, bracket)) continue;
    char* address = static_cast<char*>(at) + field->offset;
    size_t index = 0;
    if (bracket != std::string::npos) index = size_t(std::atoi(part.c_str() + bracket + 1));
    if (dot == std::string::npos) {
      const bool is_short = field->type == STARFOCUS_FIELD_INT32;
      return {address + index * (is_short ? sizeof(int32_t) : sizeof(size_t)), field->type};
    }
    if (field->type == STARFOCUS_FIELD_POINTER) std::memcpy(&address, address, sizeof address);
    address += index * starfocus_fields(field->structure, nullptr, nullptr);
    return FieldAt(field->structure, address, path.substr(dot + 1));
  }
  FAIL("expected a field of ", structure, ", found ", path);
  return {};
}

// Returns values just outside a range, values far outside it, and values that are no numbers.
inline std::vector<double> Outside(int32_t type, double low, double high) {
  if (type == STARFOCUS_FIELD_DOUBLE) {
    return {std::nextafter(low, -kInf), std::nextafter(high, kInf), kNan, kInf, -kInf};
  }
  if (type == STARFOCUS_FIELD_UINT32) return {high + 1, double(1u << 31), double(UINT32_MAX)};
  return {low - 1, high + 1, INT32_MIN, INT32_MAX};
}

// Checks a problem. If the field has a range, the value of the problem must lie outside.
inline void CheckProblem(const starfocus_problem* problem, starfocus_status status,
                         const std::string& field) {
  REQUIRE(problem != nullptr);
  CHECK(problem->status == status);
  CHECK(std::string(problem->field) == field);
  CHECK((problem->expected[0] != 0 || status == STARFOCUS_OK));
  if (status != STARFOCUS_ERROR_RANGE) return;
  CHECK(!(problem->value >= problem->low && problem->value <= problem->high));
}

// Checks that a problem names a field with a value and its range.
inline void CheckRange(const starfocus_problem* problem, const std::string& field, double value,
                       double low, double high) {
  CheckProblem(problem, STARFOCUS_ERROR_RANGE, field);
  CHECK((problem->value == value || (std::isnan(problem->value) && std::isnan(value))));
  CHECK(problem->low == low);
  CHECK(problem->high == high);
}

}  // namespace field_values

#endif  // STARFOCUS_TESTS_API_FIELD_VALUES_H_
