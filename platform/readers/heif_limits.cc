// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/heif_limits.h"

#include "platform/readers/coded_size.h"
#include "platform/readers/heif_boxes.h"
#include "platform/text.h"

namespace starfocus {
namespace {

// Largest width and height of a HEIF picture. A square picture of 16384 x 16384 pixels has 2^28
// pixels. The library libheif may allocate memory for any declared size up to kMostSide.
constexpr int64_t kMostSide = 16384;
// Limits of the number of pixels: per byte of the file, and for any file. An AVIF picture of one
// colour has 31 000 pixels per byte.
constexpr int64_t kMostPixelsPerByte = 32768, kAnyFilesPixels = int64_t{1} << 20;
// The total area of the tiles of a picture is at most kMostOverlap times the area of the picture,
// plus kAnyFilesPixels.
constexpr int64_t kMostOverlap = 4;

int64_t AreaOf(const HeifItem& item) { return int64_t{item.width} * int64_t{item.height}; }

bool IsMadeOfOthers(const HeifItem& item) {
  return item.type == "grid" || item.type == "iovl" || item.type == "iden";
}

// Returns true if the item is a coded picture, which libheif can decode. Version 1.15 of libheif
// aborts the program if a derived picture contains an item that is not a coded picture.
bool IsCoded(const HeifItem& item) { return item.type == "hvc1" || item.type == "av01"; }

uint32_t WholeOf(const Bytes& bytes, size_t at, size_t size) {
  uint32_t value = 0;
  for (size_t k = 0; k < size; ++k) value = value << 8 | bytes[at + k];
  return value;
}

// Returns true if a grid or overlay has the number of inputs and the size that its data declares
// (23008-12, 6.6.2).
bool FitsItsData(const HeifItem& item) {
  const bool grid = item.type == "grid";
  const size_t number = item.head.size() > 1 && (item.head[1] & 1) != 0 ? 4 : 2;
  // Version, flags, and tile counts or canvas colour precede the picture size in the item's data.
  const size_t sizes = grid ? 4 : 10;
  if (item.head.size() < sizes + 2 * number) return false;
  const size_t tiles = (size_t{item.head[2]} + 1) * (size_t{item.head[3]} + 1);
  if (grid && tiles != item.inputs.size()) return false;
  return WholeOf(item.head, sizes, number) == item.width &&
         WholeOf(item.head, sizes + number, number) == item.height;
}

Error CheckInputs(const std::string& where, const HeifItems& items, const HeifItem& item) {
  const std::string name = "'" + item.type + "'";
  if (item.type != "iden" && !FitsItsData(item)) {
    return Expected(where, "a " + name + " picture with the size and parts that its item declares",
                    "other data");
  }
  int64_t pixels = 0;
  for (const uint32_t input : item.inputs) {
    const auto found = items.find(input);
    const bool whole = found != items.end() && item.type == "iden" && found->second.type == "grid";
    if (found == items.end() || (!IsCoded(found->second) && !whole)) {
      return Expected(
          where, "a " + name + " picture made of coded pictures",
          found == items.end() ? "a missing picture" : "a '" + found->second.type + "' picture");
    }
    pixels += AreaOf(found->second);
  }
  if (pixels <= kAnyFilesPixels + kMostOverlap * AreaOf(item)) return {};
  return Expected(where, "parts that are not much larger than the " + name + " picture",
                  std::to_string(pixels) + " pixels for " + std::to_string(AreaOf(item)));
}

Error CheckCoded(const std::string& where, const HeifItem& item) {
  constexpr int64_t kPadding = 128;  // HEVC and AV1 pad pictures to whole blocks
  if (!IsCoded(item)) return {};
  const CodedSize size = item.type == "hvc1" ? HevcSize(item.configuration, item.head)
                                             : Av1Size(item.configuration, item.head);
  // If the header of a coded picture has no readable size, libheif cannot read a size either.
  if (size.width <= item.width + kPadding && size.height <= item.height + kPadding) return {};
  return Expected(
      where, "a coded picture of " + SizeText(item.width, item.height) + ", as its item declares",
      SizeText(size.width, size.height));
}

}  // namespace

Error CheckHeifSize(const std::string& where, int64_t width, int64_t height, size_t file) {
  const std::string found = SizeText(width, height);
  if (width < 1 || height < 1 || width > kMostSide || height > kMostSide) {
    return Expected(where, "a HEIF picture at most 16384 pixels wide and high", found);
  }
  if (width * height <= kAnyFilesPixels + kMostPixelsPerByte * static_cast<int64_t>(file))
    return {};
  return Expected(where, "a HEIF picture of at most 32768 pixels for each byte of its file", found);
}

Error CheckHeif(const std::string& where, Span file) {
  const std::optional<HeifItems> items = ReadHeifItems(file);
  if (!items) {
    return Expected(where, "a HEIF file with at most 4096 items in complete boxes", "other data");
  }
  for (const auto& [id, item] : *items) {  // check sizes before CheckInputs multiplies them
    if (item.width == 0 || item.height == 0) continue;
    if (Error error = CheckHeifSize(where, item.width, item.height, file.size)) return error;
  }
  for (const auto& [id, item] : *items) {
    if (Error error =
            IsMadeOfOthers(item) ? CheckInputs(where, *items, item) : CheckCoded(where, item))
      return error;
  }
  return {};
}

}  // namespace starfocus
