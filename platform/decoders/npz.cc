// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/npz.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "platform/decoders/npy.h"
#include "platform/decoders/zip.h"
#include "platform/text.h"

namespace starfocus {
namespace {

constexpr char kExtension[] = ".npy";

// An array of an archive that may be the map.
struct Array {
  std::string name;  // without extension
  const ZipEntry* entry;
  bool is_secondary;  // True for a mask or a camera matrix.
};

// Returns the name of an array, or an empty string if the entry is no array.
std::string ArrayName(const ZipEntry& entry) {
  const size_t length = sizeof(kExtension) - 1;
  if (entry.name.size() <= length) return "";
  const size_t at = entry.name.size() - length;
  return entry.name.compare(at, length, kExtension) == 0 ? entry.name.substr(0, at) : "";
}

// A mask of booleans or a matrix is the map only if no other array has rows and columns. For a
// matte, booleans are as likely as other values.
bool IsSecondary(const NpyHeader& header, bool is_matte) {
  constexpr int64_t kMostMatrix = 4;
  return (header.type == "|b1" && !is_matte) ||
         std::max(header.sizes[0], header.sizes[1]) <= kMostMatrix;
}

std::string NamesOf(const std::vector<Array>& arrays) {
  std::string names;
  for (const Array& array : arrays) names += (names.empty() ? "" : ", ") + array.name;
  return names;
}

Error RejectArrays(const std::string& where, bool is_matte, const std::string& found) {
  const std::string names = is_matte ? "matte or alpha" : "depth";
  return Expected(where, "an array named " + names + ", or a single array of rows and columns",
                  found + " (numpy.save('" + (is_matte ? "matte" : "depth") +
                      ".npy', numpy.load(FILE)['NAME']) writes one array)");
}

// Returns the array whose name states that it is the map or the matte, or null.
const ZipEntry* FindNamed(const std::vector<Array>& arrays, bool is_matte) {
  const std::vector<std::string> names =
      is_matte ? std::vector<std::string>{"matte", "alpha"} : std::vector<std::string>{"depth"};
  for (const std::string& name : names) {
    for (const Array& array : arrays) {
      if (Lower(array.name) == name) return array.entry;
    }
  }
  return nullptr;
}

// Finds the map among the arrays with rows and columns. Decompresses all arrays to read their
// headers.
Result<const ZipEntry*> ChooseArray(const std::string& where, bool is_matte, const Bytes& npz,
                                    const std::vector<Array>& arrays) {
  std::vector<Array> maps;
  for (const Array& array : arrays) {
    const Result<Bytes> npy = ReadZipEntry(where + ": " + array.name, npz, *array.entry);
    if (!npy) return npy.error();
    const std::optional<NpyHeader> header = ParseNpyHeader(*npy);
    if (!header || !header->is_map()) continue;
    maps.push_back({array.name, array.entry, IsSecondary(*header, is_matte)});
  }
  std::vector<Array> primary;
  std::copy_if(maps.begin(), maps.end(), std::back_inserter(primary),
               [](const Array& array) { return !array.is_secondary; });
  if (!primary.empty()) maps = primary;
  if (maps.size() == 1) return maps[0].entry;
  return RejectArrays(where, is_matte,
                      maps.empty() ? "other arrays: " + NamesOf(arrays)
                                   : std::to_string(maps.size()) + ": " + NamesOf(maps));
}

}  // namespace

Result<Samples> DecodeNpz(const std::string& where, bool is_matte, const Bytes& npz) {
  const Result<std::vector<ZipEntry>> entries = ListZip(where, npz);
  if (!entries) return entries.error();
  std::vector<Array> arrays;
  for (const ZipEntry& entry : *entries) {
    std::string name = ArrayName(entry);
    if (!name.empty()) arrays.push_back({std::move(name), &entry, false});
  }
  if (arrays.empty()) return RejectArrays(where, is_matte, "a ZIP archive without arrays");
  const ZipEntry* entry = FindNamed(arrays, is_matte);
  if (entry == nullptr) {
    if (Error error = ChooseArray(where, is_matte, npz, arrays).MoveTo(&entry)) return error;
  }
  const std::string name = where + ": " + ArrayName(*entry);
  const Result<Bytes> npy = ReadZipEntry(name, npz, *entry);
  return npy ? DecodeNpy(name, is_matte, *npy) : npy.error();
}

}  // namespace starfocus
