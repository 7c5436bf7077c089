// SPDX-License-Identifier: Apache-2.0
// XMP packets as trees of elements, whatever prefixes they give to names.
#ifndef STARFOCUS_PLATFORM_READERS_XMP_H_
#define STARFOCUS_PLATFORM_READERS_XMP_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// Names are "<namespace>|<name>". A property is an attribute, or an element with text in it.
struct XmpNode {
  std::string name, text;
  std::map<std::string, std::string> attributes;
  std::vector<XmpNode> children;
};

// Whether this build reads XMP at all.
bool CanReadXmp();

// Parses a packet with no document type, at most 64 MiB, nested at most 32 deep and of at most
// 20000 elements and attributes.
Result<XmpNode> ParseXmp(const std::string& where, const char* text, size_t size);

// The value of the node's own property without white space around it; null if it has none.
const std::string* OwnProperty(const XmpNode& node, const std::string& name);

// The same of the first node at or below this one that has it.
const std::string* FindProperty(const XmpNode& node, const std::string& name);

// Every node at or below this one that has the property itself, in order.
void FindOwners(const XmpNode& node, const std::string& name, std::vector<const XmpNode*>* owners);

// The finite number that is all of `text`; none for null.
std::optional<double> XmpNumber(const std::string* text);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_XMP_H_
