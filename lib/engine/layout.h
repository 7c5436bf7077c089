// SPDX-License-Identifier: Apache-2.0
// Memory layout of an engine. LayOut both computes the size of the workspace and divides the
// workspace into pieces.
#ifndef STARFOCUS_LIB_ENGINE_LAYOUT_H_
#define STARFOCUS_LIB_ENGINE_LAYOUT_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/geometry.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Makes an engine for a valid configuration at `base`, aligned to STARFOCUS_ALIGNMENT. If `base` is
// null, only counts the bytes and sets *engine to null. Returns the number of bytes, or kTooLarge.
// `pieces` receives each piece and may be null.
size_t LayOut(const starfocus_config& config, void* base, EngineState** engine,
              const PieceVisitor* pieces = nullptr);

// Returns an engine for pictures of `config`, which may differ from the configuration of *engine
// only in a smaller or equal picture and range of disparities, and must not enable streaming. Both
// engines share all memory, so *engine must not be used while the result is; afterwards *engine
// keeps its tables, but no state of a stream.
EngineState PreviewEngine(const starfocus_config& config, EngineState* engine);

// Poisons the red zones of an engine's memory during the lifetime of this object; no-op in builds
// without red zones. After the lifetime of this object, the caller, which owns the memory, may use
// the memory for another purpose.
class RedZones {
 public:
  explicit RedZones(const EngineState& engine);
  ~RedZones();
  RedZones(const RedZones&) = delete;
  RedZones& operator=(const RedZones&) = delete;

 private:
  [[maybe_unused]] const EngineState& engine_;
};

// Returns the address range of the memory that an engine occupies.
Extent Workspace(const EngineState& engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_LAYOUT_H_
