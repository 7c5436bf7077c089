// SPDX-License-Identifier: Apache-2.0
#include "tests/kernels/kernel_call.h"

#include <algorithm>
#include <stdexcept>

namespace test {

uint8_t* CallMemory::AddRegion(const char* name, size_t value_size, size_t first, size_t size,
                               Role role) {
  Region region;
  region.name = name;
  region.value_size = value_size;
  region.first = first;
  region.size = size;
  region.bytes.reset(new uint8_t[region.size]);
  std::generate_n(region.bytes.get(), region.size, [&] { return random_.Byte(); });
  region.roles.assign(region.size, role);
  regions_.push_back(std::move(region));
  return regions_.back().bytes.get();
}

void CallMemory::MarkBytes(const uint8_t* first, size_t size, Role role) {
  for (Region& region : regions_) {
    const uint8_t* const begin = region.bytes.get();
    if (first < begin || first + size > begin + region.size) continue;
    std::fill_n(region.roles.begin() + (first - begin), size, role);
    return;
  }
  throw std::logic_error("a case marks memory that its call does not have");
}

size_t CallMemory::Bytes() const {
  size_t bytes = 0;
  for (const Region& region : regions_) {
    bytes += size_t(std::count(region.roles.begin(), region.roles.end(), Role::kInput));
    bytes += size_t(std::count(region.roles.begin(), region.roles.end(), Role::kResult));
  }
  return bytes;
}

// Returns a description of the first wrong byte in the memory of the call, or an empty string.
// Results must equal the results of the reference. All bytes that are neither results nor free must
// not change.
std::string CallMemory::Compare(const std::string& who) const {
  for (const Region& region : regions_) {
    for (size_t i = 0; i < region.size; ++i) {
      const Role role = region.roles[i];
      const uint8_t found = region.bytes[i];
      const uint8_t expected = role == Role::kResult ? region.expected[i] : region.before[i];
      if (role == Role::kFree || found == expected) continue;
      const auto place = ptrdiff_t(i) - ptrdiff_t(region.first);
      const auto size = ptrdiff_t(region.value_size);
      const ptrdiff_t index = (place - (place < 0 ? size - 1 : 0)) / size;
      return who + (role == Role::kResult ? " differs in " : " writes where it may not: ") +
             region.name + "[" + std::to_string(index) + "], byte " +
             std::to_string(place - index * size) + ": expected " + std::to_string(expected) +
             ", found " + std::to_string(found);
    }
  }
  return "";
}

std::string CallMemory::CheckRuns(const NamedRun& reference, const std::vector<NamedRun>& others,
                                  Met* met) {
  for (Region& region : regions_) {
    region.before.assign(region.bytes.get(), region.bytes.get() + region.size);
  }
  const uint64_t returned = reference.run();
  for (Region& region : regions_) {
    region.expected.assign(region.bytes.get(), region.bytes.get() + region.size);
  }
  if (is_right && !is_right(returned, met)) return "the reference breaks the contract";
  std::string wrong = Compare("the reference");
  for (const NamedRun& other : others) {
    if (!wrong.empty()) break;
    for (Region& region : regions_) {
      for (size_t i = 0; i < region.size; ++i) {
        if (region.roles[i] == Role::kIgnored) region.before[i] = random_.Byte();
        region.bytes[i] = region.before[i];
      }
    }
    const uint64_t got = other.run();
    wrong = got == returned ? Compare(other.name)
                            : std::string(other.name) + " returns " + std::to_string(got) +
                                  " instead of " + std::to_string(returned);
  }
  return wrong;
}

}  // namespace test
