// SPDX-License-Identifier: Apache-2.0
// Runs a command on many inputs, and continues after errors. The inputs overlap: while one input is
// refocused, the next input is decoded and the previous picture is encoded.
#ifndef STARFOCUS_EXAMPLES_CLI_BATCH_H_
#define STARFOCUS_EXAMPLES_CLI_BATCH_H_

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "examples/cli/input.h"
#include "platform/folder.h"
#include "platform/result.h"

namespace starfocus {

// Turns of the inputs of a batch. At most `most` inputs have their turn at the same time, and turns
// begin in the order of the inputs. Outside its turn, an input may hold at most `most_bytes`.
class Turns {
 public:
  Turns(size_t most, uint64_t most_bytes) : most_(most), most_bytes_(most_bytes) {}

 private:
  friend class Turn;

  const size_t most_;
  const uint64_t most_bytes_;
  std::mutex mutex_;
  std::condition_variable changed_;
  size_t ended_ = 0;  // number of turns that have ended
};

// The turn of input `index`. Every input of the batch must have a Turn, also an input that fails,
// because later inputs wait for the end of this turn.
class Turn {
 public:
  Turn(Turns* turns, size_t index) : turns_(*turns), index_(index) {}
  ~Turn() { Finish(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  // Waits until the turn begins. Does nothing if the turn has begun.
  void Begin() {
    std::unique_lock<std::mutex> lock(turns_.mutex_);
    turns_.changed_.wait(lock, [&] { return index_ < turns_.ended_ + turns_.most_; });
  }

  // Declares that the input is about to take `bytes` more of memory. If it then exceeds the limit
  // outside turns, waits until its turn begins.
  void Take(uint64_t bytes) {
    taken_ = bytes < UINT64_MAX - taken_ ? taken_ + bytes : UINT64_MAX;
    if (taken_ > turns_.most_bytes_) Begin();
  }

  // Ends the turn, which begins first if necessary. The input still holds `bytes` of memory. If
  // this exceeds the limit outside turns, the turn lasts until the input is destroyed instead. Does
  // nothing if the turn has ended.
  void End(uint64_t bytes) {
    if (bytes <= turns_.most_bytes_) Finish();
  }

 private:
  void Finish() {
    if (ended_) return;
    Begin();
    ended_ = true;
    {
      const std::lock_guard<std::mutex> lock(turns_.mutex_);
      ++turns_.ended_;
    }
    turns_.changed_.notify_all();
  }

  Turns& turns_;
  const size_t index_;
  uint64_t taken_ = 0;  // bytes
  bool ended_ = false;
};

struct BatchItem {
  std::string input, output;
};

struct Batch {
  std::string folder;  // of the outputs
  std::vector<BatchItem> items;
  std::vector<SkippedPath> skipped;
};

// Returns the extension of a picture that keeps the bits of an input, a file or a light field. The
// result is empty if the samples of a file have 8 bits, or if the picture of a light field is PNG.
std::string DeepExtensionOf(const std::string& input);

// Chooses the inputs and the output file of each input if the command writes pictures to the folder
// `out`. This is the case if there are several inputs, if `out` is an existing folder or ends with
// "/", or if the input is a folder of photographs and `out` has no extension. Otherwise returns
// nullopt. An output file has the name of its input. Inputs of the formats .jpg, .png, .ppm and
// .webp keep their format. Inputs of other file formats get the output format .jpg, and light
// fields get the output format .png. Unless `has_8_bits` is true, pictures keep the bits of their
// input: TIFF, HEIC and AVIF of more than 8 bits keep their format if this build can write it, PPM
// becomes .png, and OpenEXR and other floats become .exr. A folder that is not a light field is
// replaced by the photographs and light fields in it. `has_command` is true if a command computes
// the depth or the matte of photos (find_inputs.h).
Result<std::optional<Batch>> PlanBatch(const std::vector<std::string>& inputs,
                                       const std::string& out, bool has_command, bool has_8_bits);

// Creates the output folder. Returns an error if outputs coincide with each other or with inputs.
Error MakeBatchFolder(const Batch& batch, OutputFolder* folder);

// Runs all items, `jobs` at a time, and shows progress. Prints the skipped paths, each error
// immediately, and finally the numbers of finished, skipped and failed inputs to stderr. The
// returned error lists the inputs that failed.
Error RunBatch(const Batch& batch, int jobs, const std::function<Error(const BatchItem&)>& run);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_BATCH_H_
