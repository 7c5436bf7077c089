// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/kept_metadata.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>

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

// Properties of these namespaces that describe the file or its edits.
constexpr const char* kLeftOut[] = {"xmp|ModifyDate",       "xmp|MetadataDate",
                                    "xmp|Thumbnails",       "photoshop|ColorMode",
                                    "photoshop|ICCProfile", "photoshop|DocumentAncestors",
                                    "photoshop|History",    "photoshop|TextLayers"};

bool Find(const std::string& uri, const Namespace** found) {
  for (const Namespace& one : kKept) {
    if (uri == one.uri) *found = &one;
  }
  return *found != nullptr;
}

// Splits "<namespace>|<name>" into "prefix" and the name. False where the name is not kept.
bool Split(const std::string& full, std::string* prefix, std::string* name) {
  const size_t bar = full.rfind('|');
  if (bar == std::string::npos) return false;
  const std::string uri = full.substr(0, bar);
  *name = full.substr(bar + 1);
  const Namespace* found = nullptr;
  if (!Find(uri, &found)) return false;
  *prefix = found->prefix;
  const std::string both = *prefix + "|" + *name;
  return std::find(std::begin(kLeftOut), std::end(kLeftOut), both) == std::end(kLeftOut);
}

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\n':
        escaped += "&#10;";
        break;
      case '\r':
        escaped += "&#13;";
        break;
      case '\t':
        escaped += "&#9;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

// The name as it is written within a kept property: with a prefix of kKept, rdf or xml. Empty for
// other names.
std::string InnerName(const std::string& full) {
  for (const Namespace& one : {kRdf, kXml}) {
    const std::string uri = std::string(one.uri) + "|";
    if (full.compare(0, uri.size(), uri) == 0) {
      return std::string(one.prefix) + ":" + full.substr(uri.size());
    }
  }
  std::string prefix, name;
  return Split(full, &prefix, &name) ? prefix + ":" + name : "";
}

// An element with all that is within it but for names of other namespaces.
std::string Write(const XmpNode& node) {
  const std::string name = InnerName(node.name);
  if (name.empty()) return "";
  std::string text = "<" + name;
  for (const auto& attribute : node.attributes) {
    const std::string inner = InnerName(attribute.first);
    if (!inner.empty()) text += " " + inner + "=\"" + Escaped(attribute.second) + "\"";
  }
  text += ">";
  if (node.children.empty()) text += Escaped(node.text);
  for (const XmpNode& child : node.children) text += Write(child);
  return text + "</" + name + ">";
}

// Appends the properties of all descriptions, of a property the first only: a file may have several
// packets.
void WriteProperties(const XmpNode& node, std::set<std::string>* written, std::string* text) {
  if (node.name != std::string(kRdf.uri) + "|Description") {
    for (const XmpNode& child : node.children) WriteProperties(child, written, text);
    return;
  }
  std::string prefix, name;
  for (const auto& attribute : node.attributes) {
    if (!Split(attribute.first, &prefix, &name) || !written->insert(attribute.first).second) {
      continue;
    }
    name = prefix + ":" + name;
    *text += "<" + name + ">" + Escaped(attribute.second) + "</" + name + ">";
  }
  for (const XmpNode& child : node.children) {
    if (!Split(child.name, &prefix, &name) || !written->insert(child.name).second) continue;
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
