// SPDX-License-Identifier: Apache-2.0
// Bump allocator over memory of the caller. Without a base address the allocator only counts bytes,
// so the same code computes the size of a workspace and divides it into pieces.
#ifndef STARFOCUS_LIB_BASE_ARENA_H_
#define STARFOCUS_LIB_BASE_ARENA_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "simd/samples.h"
#include "starfocus/starfocus.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define STARFOCUS_RED_ZONES
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define STARFOCUS_RED_ZONES
#endif
#ifdef STARFOCUS_RED_ZONES
#include <sanitizer/asan_interface.h>
#endif

namespace starfocus {

// Reported size of objects that exceed the address space.
inline constexpr size_t kTooLarge = SIZE_MAX;

// In builds with AddressSanitizer, each piece and its padding are followed by a red zone of
// kRedZone bytes, a multiple of STARFOCUS_ALIGNMENT. AddressSanitizer reports accesses to red zones
// while jobs run. In builds with AddressSanitizer, pieces never share memory.
#ifdef STARFOCUS_RED_ZONES
inline constexpr size_t kRedZone = 1024;
#else
inline constexpr size_t kRedZone = 0;
#endif

// Receives each piece in the order of allocation. `begin` is the number of bytes before the piece.
// `end` is `begin` plus the size of the piece, its padding and its red zone.
struct PieceVisitor {
  void (*visit)(void* data, size_t begin, size_t end);
  void* data;
};

// Poisons or unpoisons the red zone that ends `end` bytes after `base`. No-op in builds without red
// zones.
#ifdef STARFOCUS_RED_ZONES
inline void PoisonZone(void* base, size_t, size_t end) {
  ASAN_POISON_MEMORY_REGION(static_cast<uint8_t*>(base) + end - kRedZone, kRedZone);
}
inline void UnpoisonZone(void* base, size_t, size_t end) {
  ASAN_UNPOISON_MEMORY_REGION(static_cast<uint8_t*>(base) + end - kRedZone, kRedZone);
}
#else
inline void PoisonZone(void*, size_t, size_t) {}
inline void UnpoisonZone(void*, size_t, size_t) {}
#endif

// Allocates aligned pieces of a block of memory, each followed by simd::kPadding bytes. All pieces
// together take at most `most` bytes. The default of `most` is half the address space, the largest
// possible size of an object.
class Arena {
 public:
  explicit Arena(void* base, size_t most = PTRDIFF_MAX, const PieceVisitor* pieces = nullptr)
      : base_(static_cast<uint8_t*>(base)), most_(most), pieces_(pieces) {}

  // Allocates count * times elements. Returns null if the arena only counts.
  template <class T>
  T* Take(size_t count, size_t times = 1) {
    return reinterpret_cast<T*>(TakeBytes(count, times, sizeof(T)));
  }

  // Returns the address of the next piece; null if the arena only counts.
  uint8_t* Here() const { return base_ == nullptr ? nullptr : base_ + used_; }

  // Returns the size of all pieces, or kTooLarge. If the result is kTooLarge, the addresses of the
  // pieces are meaningless.
  size_t Bytes() const { return too_large_ ? kTooLarge : used_; }

  // Calls each function of `parts`, all of which allocate from the same address, because only one
  // of them is in use at a time. Later pieces lie after the longest part.
  template <class... Parts>
  void Overlap(const Parts&... parts) {
    const size_t begin = used_, outer = longest_;
    size_t end = begin;
    (TakePart(begin, parts, &end), ...);
    used_ = end;
    longest_ = outer;
  }
  // Within a part of Overlap: returns the largest size of the next piece with which this part is no
  // longer than the longest part before it. Overlaps may be nested.
  size_t Rest() const { return longest_ < used_ + kExtra ? 0 : longest_ - used_ - kExtra; }

 private:
  // Returns a * b, or SIZE_MAX if the product overflows.
  static constexpr size_t Product(size_t a, size_t b) {
    return a != 0 && b > SIZE_MAX / a ? SIZE_MAX : a * b;
  }

  template <class Part>
  void TakePart(size_t begin, const Part& part, size_t* end) {
    if (kRedZone == 0) used_ = begin;
    part();
    *end = used_ > *end ? used_ : *end;
    longest_ = *end > longest_ ? *end : longest_;
  }

  // Allocates count * times elements of `size` bytes. Not inlined, because engines take more than a
  // hundred pieces.
  [[gnu::noinline]] uint8_t* TakeBytes(size_t count, size_t times, size_t size) {
    uint8_t* const piece = Here();
    Add(Product(Product(count, times), size));
    return piece;
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

  // Largest overhead of a piece: padding, red zone, and rounding up to STARFOCUS_ALIGNMENT.
  static constexpr size_t kExtra = simd::kPadding + kRedZone + STARFOCUS_ALIGNMENT - 1;

  uint8_t* base_;
  size_t most_;
  const PieceVisitor* pieces_;
  size_t used_ = 0;
  size_t longest_ = 0;  // End of the longest part so far of the overlaps around it.
  bool too_large_ = false;
};

// Returns a plane of `rows` rows of `stride` elements.
template <class T>
Plane<T> TakePlane(size_t stride, int32_t rows, Arena* arena) {
  return {arena->Take<T>(stride, static_cast<size_t>(rows)), stride, 0, 0};
}

// Returns a ring of `rows` rows of `stride` elements.
template <class T>
Plane<T> TakeRing(size_t stride, int32_t rows, Arena* arena) {
  return {arena->Take<T>(stride, static_cast<size_t>(rows)), stride, rows, 0};
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_ARENA_H_
