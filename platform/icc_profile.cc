// SPDX-License-Identifier: Apache-2.0
#include "platform/icc_profile.h"

#include <algorithm>
#include <cstddef>

#include "platform/container.h"

namespace starfocus {
namespace {

constexpr size_t kHeader = 128, kTag = 12;
constexpr size_t kColourSpace = 16, kSignature = 36;  // offsets in bytes in the profile header

bool HasText(const Bytes& icc, size_t at, const char* text) {
  return std::equal(text, text + 4, icc.begin() + static_cast<ptrdiff_t>(at));
}

}  // namespace

bool IsRgbProfile(const Bytes& icc) {
  if (icc.size() < kHeader + 4 || ReadBigEndian32(icc.data()) != icc.size()) return false;
  if (!HasText(icc, kSignature, "acsp") || !HasText(icc, kColourSpace, "RGB ")) return false;
  const size_t tags = ReadBigEndian32(&icc[kHeader]), first = kHeader + 4;
  if (tags > (icc.size() - first) / kTag) return false;
  for (size_t at = first; at < first + tags * kTag; at += kTag) {
    const size_t offset = ReadBigEndian32(&icc[at + 4]), size = ReadBigEndian32(&icc[at + 8]);
    if (offset > icc.size() || size > icc.size() - offset) return false;
  }
  return true;
}

}  // namespace starfocus
