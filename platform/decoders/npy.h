// SPDX-License-Identifier: Apache-2.0
// Decodes depth maps in NumPy's format NPY, versions 1 to 3: a header in text form and the values
// of one array.
#ifndef STARFOCUS_PLATFORM_DECODERS_NPY_H_
#define STARFOCUS_PLATFORM_DECODERS_NPY_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "platform/decoders/numbers.h"
#include "platform/file.h"
#include "platform/levels.h"
#include "platform/result.h"

namespace starfocus {

// Header of an array.
struct NpyHeader {
  std::string type, shape;            // As the file states them, for example "<f4" and "480, 640".
  std::optional<NumberType> numbers;  // Type of the values; nullopt: a type that is not supported.
  std::vector<int64_t> sizes;         // Dimensions without dimensions of 1 before and after others.
  bool is_fortran_order = false;      // True: columns follow each other, not rows.
  size_t end = 0;                     // Position of the values in the file.

  bool is_map() const { return sizes.size() == 2; }
};

// Returns true if the bytes start with the signature of NPY files.
bool IsNpy(const Bytes& bytes);

// Parses the header of a file as NumPy writes it. Returns nullopt for any other header.
std::optional<NpyHeader> ParseNpyHeader(const Bytes& npy);

// Decodes an array with two dimensions, rows and columns, in C or Fortran order. Further dimensions
// before or after these two must be 1. The values are floats of 16, 32 or 64 bits, integers, or
// booleans. `where` and `is_matte` affect only error messages.
Result<Samples> DecodeNpy(const std::string& where, bool is_matte, const Bytes& npy);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_NPY_H_
