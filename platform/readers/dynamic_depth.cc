// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/dynamic_depth.h"

#include <cmath>

#include "platform/levels.h"
#include "platform/readers/depth_levels.h"

namespace starfocus {
namespace {

constexpr size_t kMostItems = 64;
const std::string kMap = "http://ns.google.com/photos/dd/1.0/depthmap/|";
// Items by the specification, and as later files of the same maker have them.
const std::string kItems[] = {"http://ns.google.com/photos/dd/1.0/item/|",
                              "http://ns.google.com/photos/1.0/container/item/|"};

// A file behind the first picture, in the order of the directory.
struct Item {
  std::string uri, semantic;
  size_t length = 0, padding = 0;
};

std::string TextOf(const XmpNode& node, const std::string& name) {
  const std::string* text = OwnProperty(node, name);
  return text == nullptr ? "" : *text;
}

// A whole number of bytes that a file can have; 0 if it is not there.
bool ReadLength(const XmpNode& node, const std::string& name, size_t file, size_t* length) {
  const std::string* text = OwnProperty(node, name);
  double value = 0;
  if (text == nullptr) return true;
  if (!ReadXmpNumber(text, &value) || value < 0 || value > static_cast<double>(file) ||
      value != std::floor(value)) {
    return false;
  }
  *length = static_cast<size_t>(value);
  return true;
}

std::string ReadItems(const std::string& where, Span file, const XmpNode& xmp,
                      std::vector<Item>* items) {
  for (const std::string& space : kItems) {
    std::vector<const XmpNode*> nodes;
    FindOwners(xmp, space + "Mime", &nodes);
    if (nodes.size() > kMostItems) {
      return Expected(where, "at most " + std::to_string(kMostItems) + " items",
                      std::to_string(nodes.size()));
    }
    for (const XmpNode* node : nodes) {
      Item item;
      item.uri = TextOf(*node, space + "DataURI");
      item.semantic = TextOf(*node, space + "Semantic");
      if (!ReadLength(*node, space + "Length", file.size, &item.length) ||
          !ReadLength(*node, space + "Padding", file.size, &item.padding)) {
        return Expected(where, "items with a length and padding within the file", "another");
      }
      items->push_back(item);
    }
    if (!items->empty()) return "";
  }
  return "";
}

bool BeginsPicture(Span file) {
  return IsJpeg(file) || (file.size > 4 && file.data[0] == 0x89 && file.data[1] == 'P');
}

// Where item `index` lies: behind the first picture, or, where something else was put between, as
// far from the end of the file as what follows it.
bool FindItem(Span file, const JpegParts& parts, const std::vector<Item>& items, size_t index,
              Span* found) {
  size_t begin = parts.end + items[0].padding, behind = 0;
  for (size_t k = 1; k < items.size(); ++k) {
    const size_t size = items[k].length + items[k].padding;
    if (k < index) begin += size;
    if (k >= index) behind += size;
  }
  const size_t length = items[index].length;
  for (const size_t at : {begin, file.size - std::min(behind, file.size)}) {
    if (at > file.size || length > file.size - at) continue;
    *found = {file.data + at, length};
    if (BeginsPicture(*found)) return true;
  }
  return false;
}

// The item that is the depth map; 0, the picture itself, if there is none.
size_t FindDepth(const std::vector<Item>& items, const std::string* uri) {
  for (size_t k = 1; k < items.size(); ++k) {
    if (uri != nullptr ? items[k].uri == *uri : items[k].semantic == "Depth") return k;
  }
  return 0;
}

// The description of the map of depths; others are of segments.
const XmpNode* FindMap(const XmpNode& xmp) {
  std::vector<const XmpNode*> nodes;
  FindOwners(xmp, kMap + "DepthURI", &nodes);
  for (const XmpNode* node : nodes) {
    if (TextOf(*node, kMap + "ItemSemantic") != "Segmentation") return node;
  }
  return nullptr;
}

std::string Understand(const std::string& where, const XmpNode* map, Near near, DepthPhoto* photo) {
  if (map == nullptr) {
    TellMap("without a range", photo);
    ToOrder(near, photo);
    return "";
  }
  const std::string* format = OwnProperty(*map, kMap + "Format");
  const std::string units = TextOf(*map, kMap + "Units");
  if (units == "Diopters") {
    return Expected(where, "a depth map in metres or in no units", "one in diopters");
  }
  DepthRange range;
  const std::string* low = OwnProperty(*map, kMap + "Near");
  const std::string* high = OwnProperty(*map, kMap + "Far");
  const std::string error = ReadDepthRange(where, format, low, high, &range);
  if (!error.empty()) return error;
  const bool metres = units == "Meters";
  ToInverse(range, &photo->map);
  photo->meaning = metres ? MapMeaning::kInverseMetres : MapMeaning::kInverse;
  TellMap(*format + " from " + *low + " to " + *high + (metres ? " metres" : " of no units"),
          photo);
  return "";
}

}  // namespace

bool HasDynamicDepth(const XmpNode& xmp) {
  if (FindMap(xmp) != nullptr) return true;
  std::vector<const XmpNode*> nodes;
  FindOwners(xmp, kItems[1] + "Semantic", &nodes);
  for (const XmpNode* node : nodes) {
    if (TextOf(*node, kItems[1] + "Semantic") == "Depth") return true;
  }
  return false;
}

std::string ReadDynamicDepth(const std::string& where, Span file, const JpegParts& parts,
                             const XmpNode& xmp, Near near, DepthPhoto* photo) {
  photo->format = "Dynamic Depth photo (JPEG)";
  const XmpNode* map = FindMap(xmp);
  std::vector<Item> items;
  std::string error = ReadItems(where, file, xmp, &items);
  if (!error.empty()) return error;
  const size_t index =
      FindDepth(items, map == nullptr ? nullptr : OwnProperty(*map, kMap + "DepthURI"));
  Span data;
  if (index == 0 || !FindItem(file, parts, items, index, &data)) {
    return Expected(where, "the depth map that its XMP names, behind the picture",
                    index == 0 ? "no such item" : "no picture there");
  }
  error = ReadJpegPicture(where, file, parts, photo);
  if (!error.empty()) return error;
  Bytes bytes(data.data, data.data + data.size);
  error = DecodeLevels(where + " (depth map)", &bytes, &photo->map);
  return error.empty() ? Understand(where, map, near, photo) : error;
}

}  // namespace starfocus
