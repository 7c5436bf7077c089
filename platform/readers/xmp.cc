// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/xmp.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

#include "platform/file.h"
#include "platform/text.h"

#ifdef STARFOCUS_HAS_EXPAT
#include <expat.h>
#endif

namespace starfocus {
namespace {

#ifdef STARFOCUS_HAS_EXPAT

constexpr size_t kMostBytes = size_t{1} << 26, kMostDepth = 32, kMostParts = 20000;
constexpr char kBetween = '|';  // separates a namespace from a name

// State of the expat callbacks that build the tree of elements. Exceptions must not leave a
// callback of expat.
struct Builder {
  XML_Parser parser = nullptr;
  std::vector<XmpNode> open;    // Open elements, from the unnamed root to the innermost element.
  size_t parts = 0;             // Number of elements and attributes so far.
  std::string expected, found;  // Reason why parsing was stopped.
  bool out_of_memory = false;

  void Stop(const std::string& what_expected, const std::string& what_found) {
    expected = what_expected;
    found = what_found;
    XML_StopParser(parser, XML_FALSE);
  }

  template <class Function>
  void Guard(const Function& function) {
    try {
      function();
    } catch (const std::bad_alloc&) {
      out_of_memory = true;
      XML_StopParser(parser, XML_FALSE);
    }
  }

  static void Start(void* data, const char* name, const char** attributes) {
    Builder* self = static_cast<Builder*>(data);
    self->Guard([&] {
      if (self->open.size() > kMostDepth) {
        return self->Stop("XMP nested at most " + std::to_string(kMostDepth) + " levels deep",
                          "more levels");
      }
      self->open.emplace_back();
      XmpNode& node = self->open.back();
      node.name = name;
      for (; *attributes != nullptr; attributes += 2) {
        if (++self->parts > kMostParts) break;
        node.attributes[attributes[0]] = attributes[1];
      }
      if (++self->parts > kMostParts) {
        self->Stop("XMP of at most " + std::to_string(kMostParts) + " elements and attributes",
                   "more");
      }
    });
  }

  static void Text(void* data, const char* text, int size) {
    Builder* self = static_cast<Builder*>(data);
    self->Guard([&] { self->open.back().text.append(text, static_cast<size_t>(size)); });
  }

  static void End(void* data, const char*) {
    Builder* self = static_cast<Builder*>(data);
    self->Guard([&] {
      XmpNode node = std::move(self->open.back());
      self->open.pop_back();
      self->open.back().children.push_back(std::move(node));
    });
  }

  // Rejects document type declarations, because declared entities may expand a few bytes to
  // millions of bytes.
  static void Doctype(void* data, const char*, const char*, const char*, int) {
    Builder* self = static_cast<Builder*>(data);
    self->Guard([&] { self->Stop("XMP without a document type", "a document type"); });
  }
};

#endif

void Trim(std::string* text) {
  constexpr char kSpace[] = " \t\r\n";
  text->erase(0, std::min(text->find_first_not_of(kSpace), text->size()));
  text->erase(text->find_last_not_of(kSpace) + 1);
}

void TrimAll(XmpNode* node) {
  Trim(&node->text);
  for (auto& attribute : node->attributes) Trim(&attribute.second);
  for (XmpNode& child : node->children) TrimAll(&child);
}

}  // namespace

#ifdef STARFOCUS_HAS_EXPAT

bool CanReadXmp() { return true; }

Result<XmpNode> ParseXmp(const std::string& where, const char* text, size_t size) {
  if (size > kMostBytes) {
    return Expected(where, "XMP of at most " + std::to_string(kMostBytes) + " bytes",
                    std::to_string(size));
  }
  // Some programs pad XMP packets with zero bytes.
  while (size > 0 && text[size - 1] == '\0') --size;
  Builder builder;
  builder.open.emplace_back();
  builder.parser = XML_ParserCreateNS(nullptr, kBetween);
  if (builder.parser == nullptr) return OutOfMemory(where, "read its XMP");
  XML_SetUserData(builder.parser, &builder);
  XML_SetElementHandler(builder.parser, Builder::Start, Builder::End);
  XML_SetCharacterDataHandler(builder.parser, Builder::Text);
  XML_SetStartDoctypeDeclHandler(builder.parser, Builder::Doctype);
  const bool whole =
      XML_Parse(builder.parser, text, static_cast<int>(size), XML_TRUE) == XML_STATUS_OK;
  const XML_Error code = XML_GetErrorCode(builder.parser);
  XML_ParserFree(builder.parser);
  if (builder.out_of_memory || code == XML_ERROR_NO_MEMORY)
    return OutOfMemory(where, "read its XMP");
  if (!builder.expected.empty()) return Expected(where, builder.expected, builder.found);
  if (!whole) return Expected(where, "well-formed XMP", XML_ErrorString(code));
  XmpNode& root = builder.open[0];
  TrimAll(&root);
  return std::move(root);
}

#else

bool CanReadXmp() { return false; }

Result<XmpNode> ParseXmp(const std::string& where, const char*, size_t) {
  return Unsupported(where, "XMP", "expat");
}

#endif

const std::string* OwnProperty(const XmpNode& node, const std::string& name) {
  const auto attribute = node.attributes.find(name);
  if (attribute != node.attributes.end()) return &attribute->second;
  for (const XmpNode& child : node.children) {
    if (child.name == name && child.children.empty()) return &child.text;
  }
  return nullptr;
}

const std::string* FindProperty(const XmpNode& node, const std::string& name) {
  const std::string* value = OwnProperty(node, name);
  for (size_t k = 0; k < node.children.size() && value == nullptr; ++k) {
    value = FindProperty(node.children[k], name);
  }
  return value;
}

void FindOwners(const XmpNode& node, const std::string& name, std::vector<const XmpNode*>* owners) {
  if (OwnProperty(node, name) != nullptr) owners->push_back(&node);
  for (const XmpNode& child : node.children) FindOwners(child, name, owners);
}

std::optional<double> XmpNumber(const std::string* text) {
  return text == nullptr ? std::nullopt : ParseNumber(*text);
}

}  // namespace starfocus
