// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/dynamic_depth.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "platform/levels.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/depth_range.h"
#include "platform/readers/multi_picture.h"

namespace starfocus {
namespace {

constexpr size_t kMostItems = 64;
constexpr uint8_t kPng[] = {0x89, 'P', 'N', 'G'};
const std::string kMap = "http://ns.google.com/photos/dd/1.0/depthmap/|";
// XMP namespaces of directory items: the namespace of the Dynamic Depth specification, and the
// namespace of later files from Google.
const std::string kItems[] = {"http://ns.google.com/photos/dd/1.0/item/|",
                              "http://ns.google.com/photos/1.0/container/item/|"};

// An item of the Dynamic Depth directory, which describes one picture in the file.
struct Item {
  std::string mime, uri, semantic;
  size_t length = 0, padding = 0;
};

std::string TextOf(const XmpNode& node, const std::string& name) {
  const std::string* text = OwnProperty(node, name);
  return text == nullptr ? "" : *text;
}

// Returns a size in bytes from a property of `node`. Returns 0 if the property is missing or is not
// a whole number up to `file`.
size_t LengthOf(const XmpNode& node, const std::string& name, size_t file) {
  const double value = XmpNumber(OwnProperty(node, name)).value_or(0);
  const bool fits = value >= 0 && value <= static_cast<double>(file) && value == std::floor(value);
  return fits ? static_cast<size_t>(value) : 0;
}

Result<std::vector<Item>> ReadItems(Span file, const XmpNode& xmp) {
  std::vector<Item> items;
  for (const std::string& space : kItems) {
    std::vector<const XmpNode*> nodes;
    FindOwners(xmp, space + "Mime", &nodes);
    if (nodes.size() > kMostItems) {
      return Expected("Dynamic Depth", "at most " + std::to_string(kMostItems) + " items",
                      std::to_string(nodes.size()));
    }
    for (const XmpNode* node : nodes) {
      items.push_back({TextOf(*node, space + "Mime"), TextOf(*node, space + "DataURI"),
                       TextOf(*node, space + "Semantic"),
                       LengthOf(*node, space + "Length", file.size),
                       LengthOf(*node, space + "Padding", file.size)});
    }
    if (!items.empty()) break;
  }
  return items;
}

bool BeginsPicture(Span file) {
  return IsJpeg(file) || (file.size > 4 && std::memcmp(file.data, kPng, sizeof(kPng)) == 0);
}

Span From(Span file, size_t at) {
  return at < file.size ? Span{file.data + at, file.size - at} : Span{};
}

// Finds item `index` by the lengths in the directory. The lengths of all earlier items give the
// first candidate position. If a program inserted other data, the lengths are counted back from the
// end of the file. The result extends to the end of the file, because decoders ignore data after
// the item. Returns an empty span if neither candidate position contains the start of a picture.
Span FindByLengths(Span file, const JpegParts& parts, const std::vector<Item>& items,
                   size_t index) {
  size_t begin = parts.end + items[0].padding, behind = 0;
  for (size_t k = 1; k < items.size(); ++k) {
    const size_t size = items[k].length + items[k].padding;
    if (k < index) begin += size;
    if (k >= index) behind += size;
  }
  for (const size_t at : {begin, file.size - std::min(behind, file.size)}) {
    const Span found = From(file, at);
    if (BeginsPicture(found)) return found;
  }
  return {};
}

// Finds item `index` of the directory without using the lengths in the directory. A PNG item is the
// first PNG file after the primary picture. A JPEG item is found by its position among the JPEG
// items of the directory. Returns an empty span if no picture with the type of the item is found.
Span FindByBeginning(Span file, const JpegParts& parts, const std::vector<Item>& items,
                     size_t index) {
  if (items[index].mime == "image/png") {
    const uint8_t* end = file.data + file.size;
    const uint8_t* png = std::search(file.data + parts.end, end, std::begin(kPng), std::end(kPng));
    return From(file, static_cast<size_t>(png - file.data));
  }
  size_t jpeg = 0;
  for (size_t k = 1; k < index; ++k) jpeg += items[k].mime == "image/jpeg" ? 1 : 0;
  const std::vector<MultiPicture> pictures = ListMultiPictures(file, parts).pictures;
  return jpeg < pictures.size() ? pictures[jpeg].file : Span{};
}

// Returns the index of the depth map in the directory. Searches for an item with the name `uri`,
// then for an item with the semantic "Depth". Returns 0, the index of the primary picture, if no
// depth map is found.
size_t FindDepth(const std::vector<Item>& items, const std::string* uri) {
  for (size_t k = 1; k < items.size() && uri != nullptr; ++k) {
    if (items[k].uri == *uri) return k;
  }
  for (size_t k = 1; k < items.size(); ++k) {
    if (items[k].semantic == "Depth") return k;
  }
  return 0;
}

// Returns the XMP node that describes the depth map. Skips nodes that describe segmentation maps.
const XmpNode* FindMap(const XmpNode& xmp) {
  std::vector<const XmpNode*> nodes;
  for (const char* name : {"DepthURI", "Format", "Near"}) FindOwners(xmp, kMap + name, &nodes);
  for (const XmpNode* node : nodes) {
    if (TextOf(*node, kMap + "ItemSemantic") != "Segmentation") return node;
  }
  return nullptr;
}

void Understand(const XmpNode* map, Near near, DepthPhoto* photo) {
  photo->format = "Dynamic Depth photo (JPEG)";
  if (map == nullptr) {
    TellMap("without a range", photo);
    ToOrder(near, photo);
    return;
  }
  ApplyRange({OwnProperty(*map, kMap + "Format"), OwnProperty(*map, kMap + "Near"),
              OwnProperty(*map, kMap + "Far"), OwnProperty(*map, kMap + "Units")},
             near, photo);
}

}  // namespace

bool HasDynamicDepth(const XmpNode& xmp) {
  if (FindMap(xmp) != nullptr) return true;
  for (const std::string& space : kItems) {
    std::vector<const XmpNode*> nodes;
    FindOwners(xmp, space + "Semantic", &nodes);
    for (const XmpNode* node : nodes) {
      if (TextOf(*node, space + "Semantic") == "Depth") return true;
    }
  }
  return false;
}

Error ReadDynamicDepth(Span file, const JpegParts& parts, const XmpNode& xmp, Near near,
                       DepthPhoto* photo) {
  const XmpNode* map = FindMap(xmp);
  const Result<std::vector<Item>> listed = ReadItems(file, xmp);
  if (!listed) return listed.error();
  const std::vector<Item>& items = *listed;
  const size_t index =
      FindDepth(items, map == nullptr ? nullptr : OwnProperty(*map, kMap + "DepthURI"));
  Span data = index > 0 ? FindByLengths(file, parts, items, index) : Span{};
  const bool by_lengths = !data.empty();
  if (!by_lengths && index > 0) data = FindByBeginning(file, parts, items, index);
  if (data.empty()) {
    return Expected("Dynamic Depth", "the depth map that the XMP lists, stored behind the picture",
                    index == 0 ? "no such item" : "no picture there");
  }
  const Bytes bytes(data.data, data.data + data.size);
  if (Error error = DecodeLevels("Dynamic Depth", bytes).MoveTo(&photo->map)) return error;
  if (!by_lengths) {
    photo->notes.push_back(
        "the wrong lengths of the container are ignored: the depth map was found behind the "
        "picture");
  }
  Understand(map, near, photo);
  return {};
}

}  // namespace starfocus
