// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/dynamic_depth.h"

#include <cmath>

#include "platform/levels.h"
#include "platform/readers/container_directory.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/depth_range.h"
#include "platform/readers/original_picture.h"

namespace starfocus {
namespace {

const std::string kMap = "http://ns.google.com/photos/dd/1.0/depthmap/|";
const std::string kPicture = "http://ns.google.com/photos/dd/1.0/image/|";

using Items = std::vector<ContainerItem>;

// Returns the semantic of a depth map or, if `mask` is true, of a mask of the subject.
std::string SemanticOf(bool mask) { return mask ? "Segmentation" : "Depth"; }

// Returns the XMP node that describes a depth map or, if `mask` is true, a mask of the subject.
const XmpNode* FindMap(const XmpNode& xmp, bool mask) {
  std::vector<const XmpNode*> nodes;
  for (const char* name : {"DepthURI", "Format", "Near"}) FindOwners(xmp, kMap + name, &nodes);
  for (const XmpNode* node : nodes) {
    const std::string* semantic = OwnProperty(*node, kMap + "ItemSemantic");
    if ((semantic != nullptr && *semantic == SemanticOf(true)) == mask) return node;
  }
  return nullptr;
}

// Finds the item with the name `uri`, which may be null, and otherwise the first item with the
// semantic `semantic`. Returns null if no item is found.
const ContainerItem* Find(const Items& items, const std::string* uri, const std::string& semantic) {
  const ContainerItem* named = FindContainerItem(
      items, [&](const ContainerItem& item) { return uri != nullptr && item.uri == *uri; });
  if (named != nullptr) return named;
  return FindContainerItem(items,
                           [&](const ContainerItem& item) { return item.semantic == semantic; });
}

const ContainerItem* FindDepth(const Items& items, const XmpNode* map, bool mask) {
  return Find(items, map == nullptr ? nullptr : OwnProperty(*map, kMap + "DepthURI"),
              SemanticOf(mask));
}

// Finds the original of a portrait, whose background is not blurred.
const ContainerItem* FindOriginal(const Items& items, const XmpNode& xmp) {
  std::vector<const XmpNode*> nodes;
  FindOwners(xmp, kPicture + "ItemURI", &nodes);
  const std::string* named = nullptr;
  for (const XmpNode* node : nodes) {
    const std::string* semantic = OwnProperty(*node, kPicture + "ItemSemantic");
    if (semantic == nullptr || *semantic != "Original") continue;
    named = OwnProperty(*node, kPicture + "ItemURI");
  }
  const std::string usual = "android/original_image";
  return Find(items, named == nullptr ? &usual : named, "Original");
}

// Interprets a mask as two depths. Level 0 is the near end of the range that cameras state for a
// mask, so black is the subject. Without a range, the lower part of the picture is near.
void UnderstandMask(const XmpNode* map, Near near, DepthPhoto* photo) {
  const bool stated = map != nullptr && OwnProperty(*map, kMap + "Format") != nullptr;
  if (stated && near == Near::kUnknown) near = Near::kBlack;
  photo->notes.push_back(
      std::string("the file has a mask of the subject instead of a depth map, which divides the "
                  "photo into two depths") +
      (near == Near::kBlack ? ": black is near (--near white overrides this)" : ""));
  TellMap("mask of the subject, used as two depths", photo);
  for (float& level : photo->map.values) {
    if (!std::isnan(level)) level = level < 0.5f ? 0.0f : 1.0f;
  }
  ToOrder(near, photo);
}

void Understand(const XmpNode* map, Near near, DepthPhoto* photo) {
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
  for (const bool mask : {false, true}) {
    if (FindMap(xmp, mask) != nullptr || HasContainerSemantic(xmp, SemanticOf(mask))) return true;
  }
  return false;
}

Error ReadDynamicDepth(Span file, const XmpNode& xmp, Near near,
                       std::vector<AppendedPicture>* appended, DepthPhoto* photo) {
  const Result<Items> items = ReadContainerItems(file, xmp, appended);
  if (!items) return items.error();
  const XmpNode* map = FindMap(xmp, false);
  bool mask = false;
  if (map == nullptr) {
    map = FindMap(xmp, true);
    // The description of a mask overrides the semantics of the directory.
    mask = map != nullptr || !HasContainerSemantic(xmp, SemanticOf(false));
  }
  const ContainerItem* item = FindDepth(*items, map, mask);
  if (item == nullptr) {
    return Expected("Dynamic Depth", "the depth map that the XMP lists, stored behind the picture",
                    "no complete picture there");
  }
  const Span data = item->picture->file;
  const Bytes bytes(data.data, data.data + data.size);
  if (Error error = DecodeLevels("Dynamic Depth", bytes).MoveTo(&photo->map)) return error;
  if (!item->by_length) {
    photo->notes.push_back(std::string(item->length > 0
                                           ? "the wrong lengths of the container are ignored"
                                           : "the container states no length of the depth map") +
                           ": the depth map was found behind the picture");
  }
  photo->format = "Dynamic Depth photo (JPEG)";
  if (mask) {
    UnderstandMask(map, near, photo);
  } else {
    Understand(map, near, photo);
  }
  const ContainerItem* original = FindOriginal(*items, xmp);
  if (original != nullptr) TakeOriginal(original->uri, original->picture->file, photo);
  return {};
}

}  // namespace starfocus
