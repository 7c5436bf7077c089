// SPDX-License-Identifier: Apache-2.0
// Hands out pieces of the caller's memory, or only counts them: one routine sizes a workspace and
// carves it.
#ifndef STARFOCUS_LIB_BASE_ARENA_H_
#define STARFOCUS_LIB_BASE_ARENA_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Bytes of what is larger than memory can be.
inline constexpr size_t kTooLarge = SIZE_MAX;

// In builds with AddressSanitizer this many bytes behind each piece and its padding, a multiple of
// STARFOCUS_ALIGNMENT, are a red zone: whatever reads or writes it while jobs run is reported.
// Pieces share no memory there, so that each has neighbours of its own.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define STARFOCUS_RED_ZONES
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define STARFOCUS_RED_ZONES
#endif
#ifdef STARFOCUS_RED_ZONES
inline constexpr size_t kRedZone = 1024;
#else
inline constexpr size_t kRedZone = 0;
#endif

// Is told of each piece, in the order they are taken: the bytes before it, and those up to its end,
// which are more by it, its padding and its red zone.
struct PieceVisitor {
  void (*visit)(void* data, size_t begin, size_t end);
  void* data;
};

// Poisons the red zone that ends `end` bytes behind `base`, or makes it memory again; nothing in
// other builds.
void PoisonZone(void* base, size_t begin, size_t end);
void UnpoisonZone(void* base, size_t begin, size_t end);

// Hands out aligned pieces of a block of memory, each followed by simd::kPadding bytes, as long as
// all of them together take `most` bytes: no object is larger than half of the addresses.
class Arena {
 public:
  explicit Arena(void* base, size_t most = PTRDIFF_MAX, const PieceVisitor* pieces = nullptr)
      : base_(static_cast<uint8_t*>(base)), most_(most), pieces_(pieces) {}

  // Takes `count` times `times` of them.
  template <class T>
  T* Take(size_t count, size_t times = 1) {
    T* piece = base_ == nullptr ? nullptr : reinterpret_cast<T*>(base_ + used_);
    Add(Product(Product(count, times), sizeof(T)));
    return piece;
  }

  // Returns the bytes of all pieces, or kTooLarge; the pieces handed out by then lie anywhere.
  size_t Bytes() const { return too_large_ ? kTooLarge : used_ > largest_ ? used_ : largest_; }

  // What is taken from here on shares memory with what was taken since `mark` was.
  size_t Mark() const { return used_; }
  void Reuse(size_t mark) {
    if (kRedZone > 0) return;
    largest_ = used_ > largest_ ? used_ : largest_;
    used_ = mark;
  }
  // Returns the bytes from here on that a piece may take without more memory, in what it shares.
  size_t Shared() const { return largest_ < used_ + kExtra ? 0 : largest_ - used_ - kExtra; }
  // What is taken from here on lies behind all of that.
  void GoOn() { used_ = used_ > largest_ ? used_ : largest_; }

 private:
  // Returns the product, or SIZE_MAX for all that is larger.
  static constexpr size_t Product(size_t a, size_t b) {
    return a != 0 && b > SIZE_MAX / a ? SIZE_MAX : a * b;
  }

  void Add(size_t bytes) {
    const size_t left = most_ - used_;
    if (left < kExtra || bytes > left - kExtra) {
      too_large_ = true;
    } else {
      const size_t begin = used_;
      used_ += (bytes + kExtra) / STARFOCUS_ALIGNMENT * STARFOCUS_ALIGNMENT;
      if (pieces_ != nullptr) pieces_->visit(pieces_->data, begin, used_);
    }
  }

  // Padding, a red zone, and what rounding up to STARFOCUS_ALIGNMENT adds at most.
  static constexpr size_t kExtra = simd::kPadding + kRedZone + STARFOCUS_ALIGNMENT - 1;

  uint8_t* base_;
  size_t most_;
  const PieceVisitor* pieces_;
  size_t used_ = 0, largest_ = 0;
  bool too_large_ = false;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_ARENA_H_
