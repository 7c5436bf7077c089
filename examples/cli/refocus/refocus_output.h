// SPDX-License-Identifier: Apache-2.0
// What `refocus` writes: a picture, one that others can refocus again, or the stack of a sweep.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_REFOCUS_OUTPUT_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_REFOCUS_OUTPUT_H_

#include <memory>
#include <string>
#include <vector>

#include "examples/cli/engine/engine_run.h"
#include "examples/command_line/command.h"
#include "examples/command_line/outputs.h"
#include "platform/result.h"
#include "platform/runner.h"
#include "platform/writers/picture.h"
#include "platform/writers/webp.h"

namespace starfocus {

// As typed.
struct OutputOptions {
  std::string out, all_in_focus, focus_index;
  int quality = 95;
  bool depth_photo = false, small_png = false;
};

void AddOutputOptions(Command* command, OutputOptions* options);

// The picture files of a refocusing, or of a sweep of `pictures` ones (0: no sweep).
std::vector<Output> ListPictures(const OutputOptions& options, size_t pictures);

// What can be refused before a file is read, but for the files themselves. `region`: whether only a
// part of the picture is made.
Error PlanOutput(const OutputOptions& options, bool sweep, bool region);

// Writes the picture of a task as its options have it. `widest`: the f-stop of aperture radius 1.
Error WriteRefocused(const OutputOptions& options, const PictureOptions& how, double widest,
                     const EngineTask& task, const Image& picture);

// Writes the pair that stands for a sweep, where asked for: the centre view, which is sharp
// everywhere, and for each of its pixels the number, from 0 on, of the focus nearest to it.
Error WritePair(const OutputOptions& options, const PictureOptions& how,
                const LightField& light_field, const std::vector<double>& foci);

// The pictures of a sweep as they come: numbered files, or one that shows them. Numbered files are
// encoded as many at a time as `runner` has workers.
class StackWriter {
 public:
  StackWriter(const OutputOptions& options, const PictureOptions& how, ThreadRunner* runner);

  // Takes the picture. Returns the name of its file, which may be written by a later call.
  Result<std::string> Add(Image picture);
  Error Finish();

 private:
  struct Numbered {
    std::string name;
    Image picture;
    Error error;
  };

  static void Write(void* self, int32_t index, int32_t worker);
  Error WriteWaiting();

  const std::string out_;
  const PictureOptions how_;
  ThreadRunner* const runner_;
  size_t pictures_ = 0;
  std::vector<Numbered> waiting_;
  std::unique_ptr<WebpWriter> animation_;  // none: numbered files
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_REFOCUS_OUTPUT_H_
