// SPDX-License-Identifier: Apache-2.0
// Reads and writes one-channel PFM files ("Pf"): 32-bit floats, rows from bottom to top. The sign
// of the scale in the header gives the byte order (negative: little endian).
#ifndef STARFOCUS_PLATFORM_PFM_H_
#define STARFOCUS_PLATFORM_PFM_H_

#include <cstddef>
#include <string>
#include <vector>

#include "platform/decoders/numbers.h"
#include "platform/file.h"
#include "platform/result.h"

namespace starfocus {

struct FloatMap {
  int width = 0;
  int height = 0;
  std::vector<float> values;  // values in rows from top to bottom, without padding

  // Returns the number of bytes from one row to the next row.
  size_t stride() const { return sizeof(float) * size_t(width); }
  float at(int x, int y) const { return values[size_t(y) * size_t(width) + size_t(x)]; }
};

// Reads a map. Values of the map may be NaN or infinite. ReadPfm ignores the magnitude of the scale
// in the header, which states a unit that disparities do not use.
Result<FloatMap> ReadPfm(const std::string& path);
// Decodes a PFM file in memory. `where` appears only in error messages.
Result<FloatMap> DecodePfm(const std::string& where, const Bytes& pfm);
Error WritePfm(const std::string& path, const FloatMap& map, ByteOrder order = ByteOrder::kLittle);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PFM_H_
