// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/heif_boxes.h"

#include <algorithm>
#include <utility>

namespace starfocus {
namespace {

constexpr size_t kMostItems = 4096, kMostReferences = 65536;
constexpr size_t kHead = 256;  // number of bytes that HeifItem::head keeps of an item's data

struct Box {
  std::string type;
  Span body;
};

// Reads big-endian integers. If a read extends past the end of the data, the result is 0 and good()
// returns false.
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
  // Returns the next box, or nullopt if the data ends or the box is malformed.
  std::optional<Box> Next() {
    if (rest_.size < 8) return {};
    size_t size = Whole32(4), header = 8;
    Box box = {Text(4), {}};
    if (size == 1) {
      size = static_cast<size_t>(Whole(8));
      header = 16;
    } else if (size == 0) {
      size = header + rest_.size;
    }
    if (size < header) good_ = false;
    if (good_) box.body = Take(size - header);
    return good_ ? std::optional(box) : std::nullopt;
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

// Returns the content of the first box of a type, or an empty span if no box has this type.
Span FindBox(Span boxes, const std::string& wanted) {
  Cursor cursor(boxes);
  while (const std::optional<Box> box = cursor.Next()) {
    if (box->type == wanted) return box->body;
  }
  return {};
}

bool ReadTypes(Span iinf, HeifItems* items) {
  Cursor cursor(iinf);
  const FullBox box = ReadFullBox(&cursor);
  cursor.Whole(box.version == 0 ? 2 : 4);  // number of entries
  while (const std::optional<Box> infe = cursor.Next()) {
    if (infe->type != "infe") continue;
    Cursor entry(infe->body);
    const FullBox own = ReadFullBox(&entry);
    if (own.version < 2) continue;  // infe boxes of versions 0 and 1 do not describe pictures
    const uint32_t id = entry.Whole32(own.version == 2 ? 2 : 4);
    entry.Whole(2);  // protection index
    (*items)[id].type = entry.Text(4);
    if (!entry.good() || items->size() > kMostItems) return false;
  }
  return cursor.good();
}

bool ReadInputs(Span iref, HeifItems* items) {
  if (iref.empty()) return true;
  Cursor cursor(iref);
  const size_t id_size = ReadFullBox(&cursor).version == 0 ? 2 : 4;
  size_t references = 0;
  while (const std::optional<Box> dimg = cursor.Next()) {
    if (dimg->type != "dimg") continue;
    Cursor reference(dimg->body);
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

bool SetProperty(const Box& property, HeifItem* item) {
  if (property.type == "hvcC" || property.type == "av1C") item->configuration = property.body;
  if (property.type != "ispe") return true;
  Cursor cursor(property.body);
  ReadFullBox(&cursor);
  item->width = cursor.Whole32(4);
  item->height = cursor.Whole32(4);
  return cursor.good();
}

bool ReadAssociations(Span ipma, const std::vector<Box>& properties, HeifItems* items) {
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
  std::vector<Box> properties;
  while (const std::optional<Box> property = boxes.Next()) properties.push_back(*property);
  if (!boxes.good()) return false;
  Cursor cursor(iprp);
  while (const std::optional<Box> box = cursor.Next()) {
    if (box->type == "ipma" && !ReadAssociations(box->body, properties, items)) return false;
  }
  return cursor.good();
}

void AppendHead(Span source, uint64_t offset, uint64_t length, Bytes* head) {
  if (offset > source.size) return;
  uint64_t size = std::min<uint64_t>(source.size - offset, kHead - head->size());
  if (length != 0) size = std::min(size, length);
  head->insert(head->end(), source.data + offset, source.data + offset + size);
}

// Copies the first bytes of the data of each item. The box iloc locates the data (14496-12,
// 8.11.3).
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
    cursor.Whole(2);  // skips the data reference, which is this file
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

std::optional<HeifItems> ReadHeifItems(Span file) {
  HeifItems items;
  Cursor meta(FindBox(file, "meta"));
  ReadFullBox(&meta);
  const Span boxes = meta.rest();
  const bool good = meta.good() && ReadTypes(FindBox(boxes, "iinf"), &items) &&
                    ReadInputs(FindBox(boxes, "iref"), &items) &&
                    ReadProperties(FindBox(boxes, "iprp"), &items) &&
                    ReadHeads(file, FindBox(boxes, "idat"), FindBox(boxes, "iloc"), &items);
  return good ? std::optional(std::move(items)) : std::nullopt;
}

std::vector<uint32_t> HeifStereoPair(Span file) {
  Cursor meta(FindBox(file, "meta"));
  ReadFullBox(&meta);
  Cursor group(FindBox(FindBox(meta.rest(), "grpl"), "ster"));
  ReadFullBox(&group);
  group.Whole(4);  // identifier of the group
  if (group.Whole32(4) != 2) return {};
  const uint32_t left = group.Whole32(4), right = group.Whole32(4);
  if (!group.good() || left == right) return {};
  return {left, right};
}

std::vector<std::string> HeifBrands(Span file) {
  const std::optional<Box> first = Cursor(file).Next();
  if (!first || first->type != "ftyp") return {};
  Cursor brands(first->body);
  std::vector<std::string> result = {brands.Text(4)};
  brands.Whole(4);  // skips the version of the major brand
  while (brands.good() && brands.rest().size >= 4) result.push_back(brands.Text(4));
  return result;
}

}  // namespace starfocus
