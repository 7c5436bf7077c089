// SPDX-License-Identifier: Apache-2.0
// Parses XMP packets to trees of elements. Names of elements and attributes contain namespaces
// instead of prefixes.
#ifndef STARFOCUS_PLATFORM_READERS_XMP_H_
#define STARFOCUS_PLATFORM_READERS_XMP_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// An element of XMP. Names are "<namespace>|<name>". A property of XMP is an attribute, or an
// element that contains text.
struct XmpNode {
  std::string name, text;
  std::map<std::string, std::string> attributes;
  std::vector<XmpNode> children;
};

// Returns true if this build can read XMP.
bool CanReadXmp();

// Parses a packet. An XMP packet must not have a document type declaration. ParseXmp accepts
// packets of at most 64 MiB, a depth of 32, and 20000 elements and attributes.
Result<XmpNode> ParseXmp(const std::string& where, const char* text, size_t size);

// Returns the value of a property of the node, without surrounding white space, or null if the node
// does not have the property.
const std::string* OwnProperty(const XmpNode& node, const std::string& name);

// Returns the value of the property `name` in the first node of the subtree `node` that has the
// property. Returns null if no node has the property.
const std::string* FindProperty(const XmpNode& node, const std::string& name);

// Appends all nodes of the subtree `node` that have the property `name`, in document order.
void FindOwners(const XmpNode& node, const std::string& name, std::vector<const XmpNode*>* owners);

// Parses a finite number. Returns nullopt if `text` is null or the whole text is not a finite
// number.
std::optional<double> XmpNumber(const std::string* text);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_XMP_H_
