// SPDX-License-Identifier: Apache-2.0
// Runs refocusing through the C API: allocates the engine, selects the functions to call, and
// measures time. Also reads and writes the coefficients of the timing model in JSON files, for
// `starfocus-lab calibrate` and `refocus --timing`.
#ifndef STARFOCUS_EXAMPLES_CLI_ENGINE_RUN_H_
#define STARFOCUS_EXAMPLES_CLI_ENGINE_RUN_H_

#include <cstdint>
#include <memory>
#include <string>

#include "examples/cli/json.h"
#include "lib/plan/renderer.h"
#include "platform/image.h"
#include "platform/light_field.h"
#include "platform/progress.h"
#include "platform/result.h"
#include "platform/row_gate.h"
#include "platform/runner.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

struct TimingTerm {
  const char* name;
  uint32_t starfocus_timing::*coefficient;
  uint64_t BlockWork::*work;  // Amount of work in a block; null if each block is one unit.
  const char* unit;           // Unit of work to which the coefficient refers.
};

inline constexpr TimingTerm kTimingTerms[] = {
    {"block", &starfocus_timing::block, nullptr, "block"},
    {"field", &starfocus_timing::field, &BlockWork::field, "pixel of the extended block"},
    {"a", &starfocus_timing::a, &BlockWork::a, "rendered pixel of type A"},
    {"b", &starfocus_timing::b, &BlockWork::b, "rendered pixel of type B"},
    {"c", &starfocus_timing::c, &BlockWork::c, "rendered pixel of type C"},
    {"upsample", &starfocus_timing::upsample, &BlockWork::upsample, "upsampled pixel"},
    {"span", &starfocus_timing::span, &BlockWork::span, "stretch of a rendered line"},
    {"hole", &starfocus_timing::hole, &BlockWork::hole, "uncovered pixel"},
};
inline constexpr int kTimingTermCount = sizeof(kTimingTerms) / sizeof(kTimingTerms[0]);
static_assert(sizeof(starfocus_timing) == kTimingTermCount * sizeof(uint32_t), "every coefficient");

// Returns the member "timing" of a timing file.
Json TimingJson(const starfocus_timing& timing);

// Reads the member "timing", which must contain all coefficients and nothing else. Members other
// than "timing" are ignored as comments.
Result<starfocus_timing> ReadTiming(const std::string& path);

struct EngineTask {
  const LightField* light_field = nullptr;
  // Complete configuration, including sizes, views, disparity range and max_blur.
  starfocus::Config config;
  Params params;
  starfocus_observer observer = {sizeof(starfocus_observer), nullptr, nullptr, nullptr, nullptr};
  int threads = 1;
  bool stream = false;  // true to push and pull rows instead of whole pictures
  // True: the engine reads light_field->deep. `config` must have STARFOCUS_FEATURE_DEEP.
  bool deep_views = false;
  // True: the picture has the kind of the first deep view, or codes of 16 bits without deep views.
  // False: it has 8 bits.
  bool deep_picture = false;
  // True: the picture has the kind of `planar`, of which only the kind is read.
  bool planar_picture = false;
  PlanarImage planar;
};

struct EngineResult {
  Image picture;       // of 8 bits
  DeepImage deep;      // with EngineTask::deep_picture, from which `picture` is made
  PlanarImage planar;  // with EngineTask::planar_picture, instead of `picture`
  starfocus_report report = starfocus::NewReport();
  starfocus_layer_report layers[STARFOCUS_LAYERS] = {};
  double seconds = 0;  // processing time in the engine, in seconds
  size_t workspace_bytes = 0;
  size_t prepared_bytes = 0;
};

// Refocuses pictures with a common configuration, and shows progress. Error messages start with the
// argument `where` of the call.
class EngineRun {
 public:
  EngineRun(int threads, int pictures);

  // Creates the engine with the configuration of the task, which applies to all pictures.
  Error Start(const std::string& where, const EngineTask& task);

  // Prepares the task's light field for all later calls of Refocus.
  Error Prepare(const std::string& where, const EngineTask& task);

  Result<EngineResult> Refocus(const std::string& where, const EngineTask& task);

  // Makes the pictures of a result, of the size that the task computes.
  static void MakePicture(const EngineTask& task, EngineResult* result);

  // Refocuses into result->picture, which MakePicture has made. Declares finished rows to `rows`,
  // unless task.stream is true.
  Error RefocusRows(const std::string& where, const EngineTask& task, RowGate* rows,
                    EngineResult* result);

  // Refocuses a frame that follows the frame `before`. `picture` must have been computed from
  // `before` with the same params.
  Result<EngineResult> RefocusAfter(const std::string& where, const EngineTask& task,
                                    const LightField& before, const Image& picture);

  // Returns the runner of the engine's threads, which can do other work while no picture is
  // refocused.
  ThreadRunner* runner() { return &runner_; }

 private:
  // Sets the engine's callbacks: the observer of the task, the runner of the threads and, for a
  // picture, the progress line.
  starfocus_status SetCallbacks(const EngineTask& task, bool is_picture);
  starfocus_status RunStream(const EngineTask& task, EngineResult* result);
  Error Run(const std::string& where, const EngineTask& task, const starfocus_previous* previous,
            EngineResult* result);
  // A callback of type starfocus_progress, whose `self` points to an EngineRun.
  static int Tell(void* self, int32_t rows_done, int32_t rows);

  ThreadRunner runner_;
  PictureProgress progress_;
  RowGate* rows_ = nullptr;  // receives the finished rows of the current picture; may be null
  Engine engine_;
  size_t workspace_bytes_ = 0;
  size_t prepared_bytes_ = 0;  // size of the prepared light field; 0 if no light field is prepared
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_ENGINE_RUN_H_
