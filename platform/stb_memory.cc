// SPDX-License-Identifier: Apache-2.0
#include "platform/stb_memory.h"

#include <cstdint>
#include <cstdlib>
#include <new>
#include <vector>

namespace starfocus {
namespace {

// Header of every allocation, with pointers to the neighbours in the list of all allocations of the
// thread.
struct alignas(std::max_align_t) Piece {
  Piece *next, *previous;
};
thread_local Piece* pieces = nullptr;

void Enter(Piece* piece) {
  piece->next = pieces;
  piece->previous = nullptr;
  if (pieces != nullptr) pieces->previous = piece;
  pieces = piece;
}

void Leave(const Piece* piece) {
  (piece->previous != nullptr ? piece->previous->next : pieces) = piece->next;
  if (piece->next != nullptr) piece->next->previous = piece->previous;
}

// Resizes the allocation `old`, or creates an allocation if `old` is null. Does not add the result
// to the list of allocations. Returns null on failure.
Piece* Resize(Piece* old, size_t size) {
  if (size > SIZE_MAX - sizeof(Piece)) return nullptr;
  return static_cast<Piece*>(std::realloc(old, sizeof(Piece) + size));
}

}  // namespace

void AppendStb(void* bytes, void* data, int size) {
  auto* const to = static_cast<std::vector<uint8_t>*>(bytes);
  const auto* first = static_cast<const uint8_t*>(data);
  to->insert(to->end(), first, first + size);
}

StbMemory::~StbMemory() {
  while (pieces != nullptr) Free(pieces + 1);
}

void* StbMemory::Allocate(size_t size) { return Reallocate(nullptr, size); }

void* StbMemory::Reallocate(void* memory, size_t size) {
  Piece* old = memory != nullptr ? static_cast<Piece*>(memory) - 1 : nullptr;
  if (old != nullptr) Leave(old);
  Piece* piece = Resize(old, size);
  if (piece == nullptr) {
    if (old != nullptr) Enter(old);
    throw std::bad_alloc();
  }
  Enter(piece);
  return piece + 1;
}

void StbMemory::Free(void* memory) {
  if (memory == nullptr) return;
  Piece* piece = static_cast<Piece*>(memory) - 1;
  Leave(piece);
  std::free(piece);
}

}  // namespace starfocus
