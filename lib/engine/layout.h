// SPDX-License-Identifier: Apache-2.0
// One routine sizes the workspace of an engine and carves it: run with a null base it only counts.
#ifndef STARFOCUS_LIB_ENGINE_LAYOUT_H_
#define STARFOCUS_LIB_ENGINE_LAYOUT_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/geometry.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Lays out an engine for a valid configuration at `base` (aligned to STARFOCUS_ALIGNMENT), or
// counts when base is null. Returns the bytes used, or kTooLarge; *engine is null when counting.
// `pieces` (null: nobody) is told of what is taken.
size_t LayOut(const starfocus_config& config, void* base, EngineState** engine,
              const PieceVisitor* pieces = nullptr);

// Lays an engine out anew for pictures that are no larger than those that its memory was made for:
// `config` differs from that engine's in its size and range of disparities alone, and does not
// stream. Tables stay; nothing of what a refocusing keeps does.
void LayOutAnew(const starfocus_config& config, EngineState* engine);

// Makes the red zones of an engine's memory, if this build has any, ones that nobody may touch, as
// long as the object lives: the memory is the caller's and may become something else afterwards.
class RedZones {
 public:
  explicit RedZones(EngineState* engine);
  ~RedZones();
  RedZones(const RedZones&) = delete;
  RedZones& operator=(const RedZones&) = delete;

 private:
  [[maybe_unused]] EngineState* const engine_;
};

// The memory an engine lives in.
Extent Workspace(const EngineState& engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_LAYOUT_H_
