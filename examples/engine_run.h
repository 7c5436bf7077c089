// One refocusing through the C ABI: workspace, entry path, time.
#ifndef STARFOCUS_EXAMPLES_ENGINE_RUN_H_
#define STARFOCUS_EXAMPLES_ENGINE_RUN_H_

#include <memory>
#include <string>

#include "platform/image.h"
#include "platform/light_field.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct FreeAligned {
  void operator()(void* memory) const;
};
using Workspace = std::unique_ptr<void, FreeAligned>;

// An engine in memory of its own, *bytes of it.
sf_status MakeEngine(const sf_config& config, Workspace* workspace, size_t* bytes,
                     sf_engine** engine);

struct EngineTask {
  const LightField* light_field = nullptr;
  sf_config config;  // version, sizes, views, disparity range and max_blur filled in
  sf_params params;
  int threads = 1;
  bool stream = false;  // rows in, rows out instead of whole pictures
};

struct EngineResult {
  Image picture;
  sf_report report = {};
  double seconds = 0;  // inside the engine
  size_t workspace_bytes = 0;
};

// Returns an error line about `where`, empty for success.
std::string RunEngine(const std::string& where, EngineTask task, EngineResult* result);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_ENGINE_RUN_H_
