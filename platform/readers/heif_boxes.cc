// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/heif_boxes.h"

#include <algorithm>

namespace starfocus {
namespace {

constexpr size_t kMostItems = 4096, kMostReferences = 65536;
constexpr size_t kHead = 256;  // bytes of an item's data that are kept

// Whole numbers, the highest byte first; 0, and `good` false, beyond the end.
class Cursor {
 public:
  explicit Cursor(Span bytes) : rest_(bytes) {}

  bool good() const { return good_; }
  Span rest() const { return rest_; }
  uint64_t Whole(size_t size) {
    uint64_t value = 0;
    const Span bytes = Take(size);
    for (size_t k = 0; k < bytes.size; ++k) value = value << 8 | bytes.data[k];
    return value;
  }
  uint32_t Whole32(size_t size) { return static_cast<uint32_t>(Whole(size)); }
  std::string Text(size_t size) {
    const Span bytes = Take(size);
    return std::string(bytes.data, bytes.data + bytes.size);
  }
  Span Take(size_t size) {
    if (size > rest_.size) {
      good_ = false;
      rest_ = {};
      return {};
    }
    const Span taken = {rest_.data, size};
    rest_ = {rest_.data + size, rest_.size - size};
    return taken;
  }
  // The next box; false at the end, or if it is malformed.
  bool Next(std::string* type, Span* body) {
    if (rest_.size < 8) return false;
    size_t size = Whole32(4), header = 8;
    *type = Text(4);
    if (size == 1) {
      size = static_cast<size_t>(Whole(8));
      header = 16;
    } else if (size == 0) {
      size = header + rest_.size;
    }
    if (size < header) good_ = false;
    if (good_) *body = Take(size - header);
    return good_;
  }

 private:
  Span rest_;
  bool good_ = true;
};

struct FullBox {
  uint32_t version, flags;
};

FullBox ReadFullBox(Cursor* cursor) {
  const uint32_t word = cursor->Whole32(4);
  return {word >> 24, word & 0xffffff};
}

// The first box of a type; empty if there is none.
Span FindBox(Span boxes, const std::string& wanted) {
  Cursor cursor(boxes);
  std::string type;
  Span body;
  while (cursor.Next(&type, &body)) {
    if (type == wanted) return body;
  }
  return {};
}

bool ReadTypes(Span iinf, HeifItems* items) {
  Cursor cursor(iinf);
  const FullBox box = ReadFullBox(&cursor);
  cursor.Whole(box.version == 0 ? 2 : 4);  // how many
  std::string type;
  Span body;
  while (cursor.Next(&type, &body)) {
    if (type != "infe") continue;
    Cursor entry(body);
    const FullBox own = ReadFullBox(&entry);
    if (own.version < 2) continue;  // of another kind of file
    const uint32_t id = entry.Whole32(own.version == 2 ? 2 : 4);
    entry.Whole(2);  // protection
    (*items)[id].type = entry.Text(4);
    if (!entry.good() || items->size() > kMostItems) return false;
  }
  return cursor.good();
}

bool ReadInputs(Span iref, HeifItems* items) {
  if (iref.empty()) return true;
  Cursor cursor(iref);
  const size_t id_size = ReadFullBox(&cursor).version == 0 ? 2 : 4;
  std::string type;
  Span body;
  size_t references = 0;
  while (cursor.Next(&type, &body)) {
    if (type != "dimg") continue;
    Cursor reference(body);
    const auto from = items->find(reference.Whole32(id_size));
    const uint32_t count = reference.Whole32(2);
    references += count;
    if (references > kMostReferences) return false;
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t to = reference.Whole32(id_size);
      if (from != items->end()) from->second.inputs.push_back(to);
    }
    if (!reference.good()) return false;
  }
  return cursor.good();
}

struct Property {
  std::string type;
  Span body;
};

bool SetProperty(const Property& property, HeifItem* item) {
  if (property.type == "hvcC" || property.type == "av1C") item->configuration = property.body;
  if (property.type != "ispe") return true;
  Cursor cursor(property.body);
  ReadFullBox(&cursor);
  item->width = cursor.Whole32(4);
  item->height = cursor.Whole32(4);
  return cursor.good();
}

bool ReadAssociations(Span ipma, const std::vector<Property>& properties, HeifItems* items) {
  Cursor cursor(ipma);
  const FullBox box = ReadFullBox(&cursor);
  const uint32_t entries = cursor.Whole32(4);
  const bool wide = (box.flags & 1) != 0;
  for (uint32_t k = 0; k < entries && cursor.good(); ++k) {
    const auto item = items->find(cursor.Whole32(box.version < 1 ? 2 : 4));
    const uint32_t count = cursor.Whole32(1);
    for (uint32_t i = 0; i < count && cursor.good(); ++i) {
      const uint32_t index = cursor.Whole32(wide ? 2 : 1) & (wide ? 0x7fff : 0x7f);
      if (index == 0 || index > properties.size() || item == items->end()) continue;
      if (!SetProperty(properties[index - 1], &item->second)) return false;
    }
  }
  return cursor.good();
}

bool ReadProperties(Span iprp, HeifItems* items) {
  Cursor boxes(FindBox(iprp, "ipco"));
  std::vector<Property> properties;
  Property property;
  while (boxes.Next(&property.type, &property.body)) properties.push_back(property);
  Cursor cursor(iprp);
  while (boxes.good() && cursor.Next(&property.type, &property.body)) {
    if (property.type == "ipma" && !ReadAssociations(property.body, properties, items))
      return false;
  }
  return boxes.good() && cursor.good();
}

void AppendHead(Span source, uint64_t offset, uint64_t length, Bytes* head) {
  if (offset > source.size) return;
  uint64_t size = std::min<uint64_t>(source.size - offset, kHead - head->size());
  if (length != 0) size = std::min(size, length);
  head->insert(head->end(), source.data + offset, source.data + offset + size);
}

// The beginning of each item's data, where its extents say (14496-12, 8.11.3).
bool ReadHeads(Span file, Span idat, Span iloc, HeifItems* items) {
  Cursor cursor(iloc);
  const FullBox box = ReadFullBox(&cursor);
  const uint32_t sizes = cursor.Whole32(2);
  const size_t offset_size = sizes >> 12, length_size = sizes >> 8 & 15,
               base_size = sizes >> 4 & 15, index_size = box.version > 0 ? sizes & 15 : 0;
  const uint32_t count = cursor.Whole32(box.version < 2 ? 2 : 4);
  for (uint32_t k = 0; k < count && cursor.good(); ++k) {
    const auto item = items->find(cursor.Whole32(box.version < 2 ? 2 : 4));
    const uint32_t method = box.version > 0 ? cursor.Whole32(2) & 15 : 0;
    cursor.Whole(2);  // where the data lies: in this file
    const uint64_t base = cursor.Whole(base_size);
    const uint32_t extents = cursor.Whole32(2);
    for (uint32_t i = 0; i < extents && cursor.good(); ++i) {
      cursor.Whole(index_size);
      const uint64_t offset = base + cursor.Whole(offset_size), length = cursor.Whole(length_size);
      if (item == items->end() || method > 1) continue;
      AppendHead(method == 1 ? idat : file, offset, length, &item->second.head);
    }
  }
  return cursor.good();
}

}  // namespace

bool ReadHeifItems(Span file, HeifItems* items) {
  Cursor meta(FindBox(file, "meta"));
  ReadFullBox(&meta);
  const Span boxes = meta.rest();
  return meta.good() && ReadTypes(FindBox(boxes, "iinf"), items) &&
         ReadInputs(FindBox(boxes, "iref"), items) &&
         ReadProperties(FindBox(boxes, "iprp"), items) &&
         ReadHeads(file, FindBox(boxes, "idat"), FindBox(boxes, "iloc"), items);
}

std::vector<std::string> HeifBrands(Span file) {
  Cursor cursor(file);
  std::string type;
  Span body;
  if (!cursor.Next(&type, &body) || type != "ftyp") return {};
  Cursor brands(body);
  std::vector<std::string> result = {brands.Text(4)};
  brands.Whole(4);  // the version of the major one
  while (brands.good() && brands.rest().size >= 4) result.push_back(brands.Text(4));
  return result;
}

}  // namespace starfocus
