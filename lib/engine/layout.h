// SPDX-License-Identifier: Apache-2.0
// Memory layout of an engine. One function computes the size of the workspace and divides it.
#ifndef STARFOCUS_LIB_ENGINE_LAYOUT_H_
#define STARFOCUS_LIB_ENGINE_LAYOUT_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/geometry.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Lays out an engine for a valid configuration at `base`, aligned to STARFOCUS_ALIGNMENT. If `base`
// is null, it only counts and sets *engine to null. Returns the number of bytes, or kTooLarge.
// `pieces` receives each piece unless it is null.
size_t LayOut(const starfocus_config& config, void* base, EngineState** engine,
              const PieceVisitor* pieces = nullptr);

// Lays out an engine again for pictures that are not larger than before. `config` may differ from
// the engine's configuration only in the size and the range of disparities, and must not stream.
// Tables remain valid; all state of a refocusing is lost.
void LayOutAnew(const starfocus_config& config, EngineState* engine);

// Poisons the red zones of an engine's memory, if this build has them, during the lifetime of the
// object. The memory belongs to the caller, who may use it for another purpose afterwards.
class RedZones {
 public:
  explicit RedZones(EngineState* engine);
  ~RedZones();
  RedZones(const RedZones&) = delete;
  RedZones& operator=(const RedZones&) = delete;

 private:
  [[maybe_unused]] EngineState* const engine_;
};

// Returns the address range of the memory that an engine occupies.
Extent Workspace(const EngineState& engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_LAYOUT_H_
