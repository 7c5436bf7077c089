// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/dynamic_depth.h"

#include <cmath>
#include <cstdlib>
#include <utility>

#include "platform/levels.h"
#include "platform/readers/container_directory.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/depth_range.h"
#include "platform/readers/orientation.h"
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

// Returns true if the subject of an upright mask is white. The subject is more often in the middle
// and at the lower edge of a picture than at the upper edge and the upper half of the sides.
bool HasWhiteSubject(const FloatMap& mask) {
  double inside = 0, outside = 0, insides = 0, outsides = 0;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const float level = mask.at(x, y);
      const bool upper = 2 * y < mask.height, side = x == 0 || x == mask.width - 1;
      const bool middle = std::abs(2 * x - mask.width) <= mask.width / 3;
      if (std::isnan(level)) continue;
      if (y == 0 || (upper && side)) {
        outside += double(level);
        ++outsides;
      } else if (!upper && middle) {
        inside += double(level);
        ++insides;
      }
    }
  }
  return inside * outsides >= outside * insides;
}

// Takes a mask of the subject as the matte of the photo. Level 0 is the near end of the range that
// cameras state for a mask, so black is the subject.
void TakeMask(const XmpNode* map, Near near, FloatMap mask, DepthPhoto* photo) {
  const bool stated = map != nullptr && OwnProperty(*map, kMap + "Format") != nullptr;
  const bool guessed = near == Near::kUnknown && !stated;
  if (guessed) {
    FloatMap upright = mask;
    TurnMap(photo->orientation, &upright);
    near = HasWhiteSubject(upright) ? Near::kWhite : Near::kBlack;
  }
  const bool white = near == Near::kWhite;
  photo->is_mask = true;
  photo->matte_notes.push_back(
      std::string("the file has a mask of the subject instead of a depth map, in which ") +
      (white ? "white" : "black") + " is the subject" +
      (guessed ? ", because it is nearer to the middle of the lower edge" : "") + " (--near " +
      (white ? "black" : "white") + " overrides this)");
  if (!white) ToRange(1, 0, &mask);
  photo->matte = std::move(mask);
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

// Returns true if the XMP describes a depth map or, if `mask` is true, a mask of the subject. The
// description of a mask overrides the semantics of the directory.
bool Describes(const XmpNode& xmp, bool mask) {
  if (FindMap(xmp, mask) != nullptr) return true;
  return HasContainerSemantic(xmp, SemanticOf(mask)) && (mask || FindMap(xmp, true) == nullptr);
}

// Reads the depth map or, if `mask` is true, the mask of the subject.
Error ReadItem(const XmpNode& xmp, const Items& items, bool mask, Near near, DepthPhoto* photo) {
  const XmpNode* map = FindMap(xmp, mask);
  const std::string name = mask ? "mask of the subject" : "depth map";
  const ContainerItem* item = FindDepth(items, map, mask);
  if (item == nullptr) {
    return Expected("Dynamic Depth",
                    "the " + name + " that the XMP lists, stored behind the picture",
                    "no complete picture there");
  }
  const Span data = item->picture->file;
  Result<FloatMap> levels = DecodeLevels("Dynamic Depth", Bytes(data.data, data.data + data.size));
  if (!levels) return levels.error();
  if (!item->by_length) {
    photo->notes.push_back((item->length > 0 ? "the wrong lengths of the container are ignored"
                                             : "the container states no length of the " + name) +
                           ": the " + name + " was found behind the picture");
  }
  if (mask) {
    TakeMask(map, near, std::move(*levels), photo);
  } else {
    photo->map = std::move(*levels);
    Understand(map, near, photo);
  }
  return {};
}

}  // namespace

bool HasDynamicDepth(const XmpNode& xmp) { return Describes(xmp, false) || HasMask(xmp); }

bool HasMask(const XmpNode& xmp) { return Describes(xmp, true); }

Error ReadDynamicDepth(Span file, const XmpNode& xmp, Near near,
                       std::vector<AppendedPicture>* appended, DepthPhoto* photo) {
  const Result<Items> items = ReadContainerItems(file, xmp, appended);
  if (!items) return items.error();
  Error error;
  if (Describes(xmp, false)) error = ReadItem(xmp, *items, false, near, photo);
  if (Describes(xmp, true)) {
    // The repair of a map finds outlines more accurately than a mask (docs/formats.md).
    if (!photo->map.values.empty()) {
      photo->facts.emplace_back("mattes", "ignored: mask of the subject");
    } else {
      photo->map_problem = error.line();
      error = ReadItem(xmp, *items, true, near, photo);
    }
  }
  if (!error) photo->format = "Dynamic Depth photo (JPEG)";
  return error;
}

void ReadDynamicOriginal(Span file, const XmpNode& xmp, std::vector<AppendedPicture>* appended,
                         DepthPhoto* photo) {
  const Result<Items> items = ReadContainerItems(file, xmp, appended);
  if (!items) return;
  const ContainerItem* original = FindOriginal(*items, xmp);
  if (original != nullptr) TakeOriginal(original->uri, original->picture->file, photo);
}

}  // namespace starfocus
