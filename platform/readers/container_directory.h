// SPDX-License-Identifier: Apache-2.0
// Reads the directories of pictures in the XMP of Google's JPEG files, and finds the pictures that
// the directories list. A file may have two directories: the one of Dynamic Depth 1.0, and the one
// of later files, which also lists gain maps and videos.
#ifndef STARFOCUS_PLATFORM_READERS_CONTAINER_DIRECTORY_H_
#define STARFOCUS_PLATFORM_READERS_CONTAINER_DIRECTORY_H_

#include <string>
#include <vector>

#include "platform/readers/appended_pictures.h"
#include "platform/readers/xmp.h"
#include "platform/result.h"

namespace starfocus {

// An item of a directory, which describes one picture of the file.
struct ContainerItem {
  int directory = 0;  // The directory that lists the item.
  std::string mime, uri, semantic;
  size_t length = 0, padding = 0;      // Bytes; 0: unknown or none.
  AppendedPicture* picture = nullptr;  // Null: the picture was not found.
  bool by_length = false;              // True if `length` determined the picture.
};

// Returns the items of all directories, without videos and the first picture. Items are matched
// with the pictures `appended` of `file` by their lengths, and otherwise by their order. A gain map
// is never the picture of another item: pictures that are listed as gain maps are marked in
// `appended`.
Result<std::vector<ContainerItem>> ReadContainerItems(Span file, const XmpNode& xmp,
                                                      std::vector<AppendedPicture>* appended);

// Returns true if a directory lists an item with the semantic `semantic`.
bool HasContainerSemantic(const XmpNode& xmp, const std::string& semantic);

// Returns the first item whose picture was found and that `is_wanted` accepts, or null.
template <class Predicate>
const ContainerItem* FindContainerItem(const std::vector<ContainerItem>& items,
                                       const Predicate& is_wanted) {
  for (const ContainerItem& item : items) {
    if (item.picture != nullptr && is_wanted(item)) return &item;
  }
  return nullptr;
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CONTAINER_DIRECTORY_H_
