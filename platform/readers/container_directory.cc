// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/container_directory.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace starfocus {
namespace {

constexpr size_t kMostItems = 64;
// XMP namespaces of items. The directory of later files comes first, because it lists gain maps.
const std::string kSpaces[] = {"http://ns.google.com/photos/1.0/container/item/|",
                               "http://ns.google.com/photos/dd/1.0/item/|"};

using Items = std::vector<ContainerItem>;
using Pictures = std::vector<AppendedPicture>;

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

// Appends the items of the subtree `node` whose properties are in the namespace of a directory.
void ListItems(const XmpNode& node, int directory, size_t file, Items* items) {
  const std::string& space = kSpaces[directory];
  ContainerItem item = {directory,
                        TextOf(node, space + "Mime"),
                        TextOf(node, space + "DataURI"),
                        TextOf(node, space + "Semantic"),
                        LengthOf(node, space + "Length", file),
                        LengthOf(node, space + "Padding", file)};
  if (!item.mime.empty() || !item.uri.empty() || !item.semantic.empty()) {
    items->push_back(std::move(item));
  }
  for (const XmpNode& child : node.children) ListItems(child, directory, file, items);
}

bool IsGainMap(const ContainerItem& item) { return item.semantic == "GainMap"; }

bool IsPrimary(const ContainerItem& item) {
  return item.semantic == "Primary" || item.uri == "primary_image";
}

// Removes videos and the first picture of the file, which is the first item unless another item is
// marked as the first picture.
void RemoveOthers(Items* items) {
  if (items->empty()) return;
  if (std::none_of(items->begin(), items->end(), IsPrimary)) items->erase(items->begin());
  const auto is_other = [](const ContainerItem& item) {
    return IsPrimary(item) || item.semantic == "MotionPhoto" || item.mime.rfind("video/", 0) == 0;
  };
  items->erase(std::remove_if(items->begin(), items->end(), is_other), items->end());
}

// Returns true if `item` may describe `picture`, which no other item of its directory describes.
bool MayBe(const Items& items, const ContainerItem& item, const AppendedPicture& picture) {
  if (item.mime == (picture.is_png ? "image/jpeg" : "image/png")) return false;
  if (picture.is_gain_map && !IsGainMap(item)) return false;
  const bool is_shared = picture.is_gain_map || !IsGainMap(item);
  return std::none_of(items.begin(), items.end(), [&](const ContainerItem& other) {
    return other.picture == &picture && (other.directory == item.directory || !is_shared);
  });
}

// Returns true if the length of `item` is the size of `picture`, or if the item ends where a later
// picture begins or the file ends. An item that is a file of several pictures ends behind its first
// picture.
bool HasLengthOf(Span file, const ContainerItem& item, const AppendedPicture& picture,
                 const Pictures& pictures) {
  if (item.length == 0) return false;
  if (item.length == picture.file.size) return true;
  const auto position = [&](const AppendedPicture& one) {
    return static_cast<size_t>(one.file.data - file.data);
  };
  const size_t end = position(picture) + item.length + item.padding;
  return end == file.size ||
         std::any_of(pictures.begin(), pictures.end(), [&](const AppendedPicture& other) {
           return position(other) == end && other.file.data > picture.file.data;
         });
}

void Match(const Items& items, AppendedPicture* picture, ContainerItem* item) {
  if (item->picture != nullptr || !MayBe(items, *item, *picture)) return;
  item->picture = picture;
  picture->is_gain_map = picture->is_gain_map || IsGainMap(*item);
}

// Matches the items that are gain maps, or the other items, by their lengths.
void MatchByLength(Span file, bool gain_maps, Pictures* pictures, Items* items) {
  for (ContainerItem& item : *items) {
    if (IsGainMap(item) != gain_maps) continue;
    for (AppendedPicture& picture : *pictures) {
      if (HasLengthOf(file, item, picture, *pictures)) Match(*items, &picture, &item);
    }
    item.by_length = item.picture != nullptr;
  }
}

// Matches the items without a picture by their order. Pictures that state to be gain maps come
// first, since only items that are gain maps match them.
void MatchByOrder(Pictures* pictures, Items* items) {
  for (ContainerItem& item : *items) {
    for (const bool gain_map : {true, false}) {
      for (AppendedPicture& picture : *pictures) {
        if (picture.is_gain_map == gain_map) Match(*items, &picture, &item);
      }
    }
  }
}

}  // namespace

bool HasContainerSemantic(const XmpNode& xmp, const std::string& semantic) {
  std::vector<const XmpNode*> nodes;
  for (const std::string& space : kSpaces) FindOwners(xmp, space + "Semantic", &nodes);
  return std::any_of(nodes.begin(), nodes.end(), [&](const XmpNode* node) {
    return std::any_of(std::begin(kSpaces), std::end(kSpaces), [&](const std::string& space) {
      return TextOf(*node, space + "Semantic") == semantic;
    });
  });
}

Result<std::vector<ContainerItem>> ReadContainerItems(Span file, const XmpNode& xmp,
                                                      std::vector<AppendedPicture>* appended) {
  Items items;
  for (const int directory : {0, 1}) {
    Items own;
    ListItems(xmp, directory, file.size, &own);
    if (own.size() > kMostItems) {
      return Expected("Dynamic Depth", "at most " + std::to_string(kMostItems) + " items",
                      std::to_string(own.size()));
    }
    RemoveOthers(&own);
    items.insert(items.end(), own.begin(), own.end());
  }
  for (const bool gain_maps : {true, false}) MatchByLength(file, gain_maps, appended, &items);
  MatchByOrder(appended, &items);
  return items;
}

}  // namespace starfocus
