// SPDX-License-Identifier: Apache-2.0
// Refocusing through the C ABI: workspace, entry path, time.
#ifndef STARFOCUS_EXAMPLES_CLI_ENGINE_ENGINE_RUN_H_
#define STARFOCUS_EXAMPLES_CLI_ENGINE_ENGINE_RUN_H_

#include <cstdint>
#include <memory>
#include <string>

#include "platform/image.h"
#include "platform/light_field.h"
#include "platform/progress.h"
#include "platform/result.h"
#include "platform/runner.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

struct EngineTask {
  const LightField* light_field = nullptr;
  starfocus_config config;  // version, sizes, views, disparity range and max_blur filled in
  Params params;
  starfocus_callbacks callbacks = {};  // clock and on_block; EngineRun sets the others
  int threads = 1;
  bool stream = false;  // rows in, rows out instead of whole pictures
};

struct EngineResult {
  Image picture;
  starfocus_report report = {};
  double seconds = 0;  // inside the engine
  size_t workspace_bytes = 0;
  size_t prepared_bytes = 0;
};

// Refocuses one picture or several of one configuration, with a progress line. Errors are about the
// `where` of the call.
class EngineRun {
 public:
  EngineRun(int threads, int pictures);

  // Makes the engine; the task's config is that of all pictures.
  Error Start(const std::string& where, const EngineTask& task);

  // Prepares the task's light field for all further calls of Refocus.
  Error Prepare(const std::string& where, const EngineTask& task);

  Result<EngineResult> Refocus(const std::string& where, const EngineTask& task);

  // As Refocus, after `before`, of which `picture` was made with the same params.
  Result<EngineResult> RefocusAfter(const std::string& where, const EngineTask& task,
                                    const LightField& before, const Image& picture);

  // The threads of the engine, for other work between its pictures.
  ThreadRunner* runner() { return &runner_; }

 private:
  // The task's callbacks, with the threads and, for a picture, the progress line.
  starfocus_status SetCallbacks(const EngineTask& task, bool is_picture);
  starfocus_status RunStream(const EngineTask& task, EngineResult* result);
  Result<EngineResult> Run(const std::string& where, const EngineTask& task,
                           const starfocus_previous* previous);

  ThreadRunner runner_;
  PictureProgress progress_;
  Engine engine_;
  size_t prepared_bytes_ = 0;  // 0: nothing is prepared
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_ENGINE_ENGINE_RUN_H_
