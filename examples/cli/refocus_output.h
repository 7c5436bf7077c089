// SPDX-License-Identifier: Apache-2.0
// Writes the output of `refocus`: a picture, a depth photo, the pictures of a sweep, the page of
// --compare, the blocks drawn over the picture, or the measurements as JSON for --report.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_OUTPUT_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_OUTPUT_H_

#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "examples/cli/comparison.h"
#include "examples/cli/engine_run.h"
#include "examples/cli/json.h"
#include "examples/command_line/command.h"
#include "examples/command_line/program.h"
#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"
#include "platform/row_gate.h"
#include "platform/runner.h"
#include "platform/writers/picture.h"
#include "platform/writers/webp.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A starfocus_block_visitor that appends the block to `data`, a std::vector<starfocus_block>.
void CollectBlock(void* data, const starfocus_block* block);

// Draws the picture in grey, with every block tinted by its layer (L = 0 red, 1 green, 2 blue) and
// outlined. `picture` may be a region whose first pixel is (left, top) of the whole picture.
Image DrawPartition(const Image& picture, int left, int top,
                    const std::vector<starfocus_block>& blocks);

// Options of the command line for the output.
struct OutputOptions {
  std::string out, all_in_focus, focus_index, compare;
  int quality = 95;
  bool dither = false, depth_photo = false, small_png = false, show = false;
};

void AddOutputOptions(Command* command, OutputOptions* options);

// Lists the output files of a refocusing, or of a sweep of `pictures` pictures (0: no sweep).
std::vector<OutputPath> ListPictures(const OutputOptions& options, size_t pictures);

// Checks the options before any file is read. Does not check the output files or the terminal.
// `region` is true if only part of the picture is computed.
Error PlanOutput(const OutputOptions& options, bool sweep, bool region);

// Writes the picture of one refocusing. With several threads, a thread encodes finished rows of a
// JPEG picture while the engine computes other rows.
class PictureWriter {
 public:
  // @param picture the picture, whose rows may be computed later; must outlive the PictureWriter
  // @param write writes options.out in another way than as `picture`; may be null
  PictureWriter(const OutputOptions& options, const PictureOptions& how, const Image* picture,
                int threads, std::function<Error()> write);
  ~PictureWriter() { rows_.FinishAll(); }
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  // Receives the rows that are finished before Write is called.
  RowGate* rows() { return &rows_; }

  // Writes the complete picture to the files that the options select. `refocused` describes the
  // picture. If Write is not called, no file is written.
  Error Write(const Refocused& refocused);

 private:
  const OutputOptions& options_;
  const PictureOptions& how_;
  const Image* const picture_;
  const std::function<Error()> write_;
  RowGate rows_;
  std::future<Result<Bytes>> encoded_;  // invalid: Write encodes the picture
};

// Writes the files that the options all_in_focus and focus_index request in place of a sweep. The
// first file is the centre view, which is sharp everywhere. The second file contains the index of
// the nearest focus for each pixel of the centre view.
Error WritePair(const OutputOptions& options, const PictureOptions& how,
                const LightField& light_field, const std::vector<double>& foci);

// Writes the pictures of a sweep to numbered files or to one animation. The workers of `runner`
// encode numbered files in parallel.
class StackWriter {
 public:
  StackWriter(const OutputOptions& options, const PictureOptions& how, ThreadRunner* runner);

  // Adds a picture. Returns the name of the picture's file. A later call of Add or Finish may write
  // the file.
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
  std::unique_ptr<WebpWriter> animation_;  // null: numbered files
};

// Names of the modes, in the order of starfocus_mode.
inline constexpr const char* kModeNames[] = {"frame", "benchmark", "block", "blur"};

// Returns the report. The task must have run with ThreadNanoseconds as its clock.
std::string ReportText(const EngineTask& task, const EngineResult& result, double seconds_total);

// Report on several pictures, each with its name.
class SeriesReport {
 public:
  void Add(const std::string& output, const EngineTask& task, const EngineResult& result);
  std::string Text(double seconds_total) const;

 private:
  Json pictures_ = Json::Array();
  uint64_t reused_blocks_ = 0, superblocks_ = 0;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_OUTPUT_H_
