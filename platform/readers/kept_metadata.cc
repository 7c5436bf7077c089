// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/kept_metadata.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>

#include "platform/text.h"

namespace starfocus {
namespace {

struct Namespace {
  const char *prefix, *uri;
};

constexpr Namespace kRdf = {"rdf", "http://www.w3.org/1999/02/22-rdf-syntax-ns#"};
constexpr Namespace kXml = {"xml", "http://www.w3.org/XML/1998/namespace"};

// Namespaces whose properties describe the photograph.
constexpr Namespace kKept[] = {
    {"dc", "http://purl.org/dc/elements/1.1/"},
    {"xmp", "http://ns.adobe.com/xap/1.0/"},
    {"xmpRights", "http://ns.adobe.com/xap/1.0/rights/"},
    {"photoshop", "http://ns.adobe.com/photoshop/1.0/"},
    {"Iptc4xmpCore", "http://iptc.org/std/Iptc4xmpCore/1.0/xmlns/"},
    {"Iptc4xmpExt", "http://iptc.org/std/Iptc4xmpExt/2008-02-29/"},
    {"plus", "http://ns.useplus.org/ldf/xmp/1.0/"},
    {"cc", "http://creativecommons.org/ns#"},
    {"lr", "http://ns.adobe.com/lightroom/1.0/"},
    {"digiKam", "http://www.digikam.org/ns/1.0/"},
    {"MicrosoftPhoto", "http://ns.microsoft.com/photo/1.0/"},
    {"acdsee", "http://ns.acdsee.com/iptc/1.0/"},
};

// Properties of the namespaces in kKept that describe the file or its edits, and are therefore
// omitted.
constexpr const char* kLeftOut[] = {"xmp:ModifyDate",       "xmp:MetadataDate",
                                    "xmp:Thumbnails",       "photoshop:ColorMode",
                                    "photoshop:ICCProfile", "photoshop:DocumentAncestors",
                                    "photoshop:History",    "photoshop:TextLayers"};

// Converts "<namespace>|<name>" to "prefix:name". Returns an empty string for properties that
// KeptXmp omits.
std::string KeptName(const std::string& full) {
  const size_t bar = full.rfind('|');
  if (bar == std::string::npos) return "";
  const std::string uri = full.substr(0, bar), name = full.substr(bar + 1);
  for (const Namespace& one : kKept) {
    if (uri != one.uri) continue;
    const std::string kept = std::string(one.prefix) + ":" + name;
    const auto* end = std::end(kLeftOut);
    return std::find(std::begin(kLeftOut), end, kept) == end ? kept : "";
  }
  return "";
}

// Returns the name of a node inside a kept property, with the prefix of its namespace: rdf, xml, or
// a namespace in kKept. Returns an empty string for names in other namespaces.
std::string InnerName(const std::string& full) {
  for (const Namespace& one : {kRdf, kXml}) {
    const std::string uri = std::string(one.uri) + "|";
    if (full.compare(0, uri.size(), uri) == 0) {
      return std::string(one.prefix) + ":" + full.substr(uri.size());
    }
  }
  return KeptName(full);
}

// Returns an XML element with its content. Omits elements and attributes for which InnerName
// returns an empty string.
std::string Write(const XmpNode& node) {
  const std::string name = InnerName(node.name);
  if (name.empty()) return "";
  std::string text = "<" + name;
  for (const auto& attribute : node.attributes) {
    const std::string inner = InnerName(attribute.first);
    if (!inner.empty()) text += " " + inner + "=\"" + EscapeXml(attribute.second) + "\"";
  }
  text += ">";
  if (node.children.empty()) text += EscapeXml(node.text);
  for (const XmpNode& child : node.children) text += Write(child);
  return text + "</" + name + ">";
}

// Appends the kept properties of all rdf:Descriptions. A file may have several XMP packets, so only
// the first occurrence of each property is written.
void WriteProperties(const XmpNode& node, std::set<std::string>* written, std::string* text) {
  if (node.name != std::string(kRdf.uri) + "|Description") {
    for (const XmpNode& child : node.children) WriteProperties(child, written, text);
    return;
  }
  for (const auto& attribute : node.attributes) {
    const std::string name = KeptName(attribute.first);
    if (name.empty() || !written->insert(attribute.first).second) continue;
    *text += "<" + name + ">" + EscapeXml(attribute.second) + "</" + name + ">";
  }
  for (const XmpNode& child : node.children) {
    if (KeptName(child.name).empty() || !written->insert(child.name).second) continue;
    *text += Write(child);
  }
}

}  // namespace

std::string KeptXmp(const XmpNode& root) {
  std::string properties;
  std::set<std::string> written;
  WriteProperties(root, &written, &properties);
  if (properties.empty()) return "";
  std::string text = "<rdf:Description rdf:about=\"\"";
  for (const Namespace& one : kKept) {
    if (properties.find(std::string("<") + one.prefix + ":") == std::string::npos &&
        properties.find(std::string(" ") + one.prefix + ":") == std::string::npos) {
      continue;
    }
    text += std::string(" xmlns:") + one.prefix + "=\"" + one.uri + "\"";
  }
  return text + ">" + properties + "</rdf:Description>";
}

}  // namespace starfocus
