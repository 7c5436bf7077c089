// One routine sizes the workspace and carves it: run with a null base it only counts.
#ifndef STARFOCUS_LIB_ENGINE_LAYOUT_H_
#define STARFOCUS_LIB_ENGINE_LAYOUT_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Hands out aligned pieces of a block of memory, each followed by simd::kPadding bytes.
class Carver {
 public:
  explicit Carver(void* base) : base_(static_cast<uint8_t*>(base)) {}

  template <class T>
  T* Take(size_t count) {
    T* piece = base_ == nullptr ? nullptr : reinterpret_cast<T*>(base_ + used_);
    const size_t bytes = count * sizeof(T) + simd::kPadding;
    used_ += (bytes + SF_ALIGNMENT - 1) / SF_ALIGNMENT * SF_ALIGNMENT;
    return piece;
  }

  size_t used() const { return used_ > most_ ? used_ : most_; }

  // What is taken from here on shares memory with what was taken since `mark` was.
  size_t Mark() const { return used_; }
  void Reuse(size_t mark) {
    most_ = used();
    used_ = mark;
  }
  // And behind all of it.
  void GoOn() { used_ = used(); }

 private:
  uint8_t* base_;
  size_t used_ = 0, most_ = 0;
};

// Lays out an engine for a valid configuration at `base` (aligned to SF_ALIGNMENT), or counts when
// base is null. Returns the bytes used; *engine is null when counting.
size_t LayOut(const sf_config& config, void* base, EngineState** engine);

// The memory an engine lives in.
Extent Workspace(const EngineState& engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_LAYOUT_H_
