// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/batch.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "examples/cli/input.h"
#include "examples/command_line/program.h"
#include "platform/console.h"
#include "platform/container.h"
#include "platform/file.h"
#include "platform/progress.h"
#include "platform/readers/sample_bits.h"
#include "platform/standard_stream.h"
#include "platform/text.h"
#include "platform/view_files.h"
#include "platform/writers/deep_picture.h"
#include "platform/writers/exr.h"
#include "platform/writers/picture.h"

namespace starfocus {

namespace {

namespace fs = std::filesystem;

// Returns the extension for a file, or an empty string if its samples have 8 bits.
std::string ExtensionOfFile(const std::string& input) {
  const std::string extension = LowerExtension(input);
  if (extension == ".jpg" || extension == ".jpeg" || extension == ".png") return "";
  const Result<Bytes> file = ReadFileIf(input, MayBePicture);
  const StatedSamples samples = file ? StatedSamplesOf(*file) : StatedSamples();
  if (samples.is_float) return CheckExrEncoder(input) ? ".png" : ".exr";
  if (samples.bits <= 8) return "";
  const std::string output = "a" + extension;
  return IsDeepExtension(extension) && !CheckDeepEncoder(output) ? extension : ".png";
}

std::string OutputOf(const std::string& input, const std::string& folder, bool has_8_bits) {
  std::error_code ignored;
  std::string extension = has_8_bits ? "" : DeepExtensionOf(input);
  if (extension.empty() && fs::is_directory(input, ignored)) extension = ".png";
  if (extension.empty()) {
    const bool kept = IsPictureExtension(LowerExtension(input));
    extension = kept ? fs::path(input).extension().string() : ".jpg";
  }
  return (fs::path(folder) / (NameOfInput(input) + extension)).string();
}

// State that the threads of a batch share.
struct Work {
  const std::vector<BatchItem>& items;
  const std::function<Error(const BatchItem&)>& run;
  Progress progress;
  std::atomic<size_t> next;
  std::mutex mutex;  // protects `failed`
  std::vector<std::string> failed;

  Error RunOne(const BatchItem& item) const {
    try {
      return run(item);
    } catch (const std::bad_alloc&) {
      return OutOfMemory(item.input, "finish");
    } catch (const std::exception& exception) {
      return Error::Internal(item.input, "no internal error", exception.what());
    }
  }

  void Go() {
    for (size_t i = next++; i < items.size(); i = next++) {
      const Error error = RunOne(items[i]);
      progress.Step();
      if (!error) continue;
      // Errors of an option do not contain the name of the input.
      const bool named = error.line().find(Printable(items[i].input)) != std::string::npos;
      const std::lock_guard<std::mutex> lock(mutex);
      TellLine("starfocus: " + (named ? "" : items[i].input + ": ") + error.line());
      failed.push_back(items[i].input);
    }
  }
};

// Runs all items. Returns the inputs that failed.
std::vector<std::string> RunItems(const std::vector<BatchItem>& items, int jobs,
                                  const std::function<Error(const BatchItem&)>& run) {
  Work work = {items,
               run,
               {"refocusing " + std::to_string(items.size()) + " inputs",
                static_cast<int64_t>(items.size())},
               {},
               {},
               {}};
  std::vector<std::thread> threads;
  try {
    for (int i = 1; i < jobs; ++i) threads.emplace_back([&work] { work.Go(); });
  } catch (const std::system_error&) {
    // If a thread cannot be created, the existing threads process all items.
  }
  work.Go();
  for (std::thread& thread : threads) thread.join();
  return work.failed;
}

}  // namespace

std::string DeepExtensionOf(const std::string& input) {
  std::error_code ignored;
  if (!fs::is_directory(input, ignored)) return ExtensionOfFile(input);
  const Result<std::vector<ViewFile>> views = FindViewFiles(input);
  return views && LowerExtension(views->front().path) == ".exr" ? ".exr" : "";
}

Result<std::optional<Batch>> PlanBatch(const std::vector<std::string>& inputs,
                                       const std::string& out, bool has_command, bool has_8_bits) {
  std::error_code ignored;
  const bool to_folder =
      inputs.size() > 1 || (!out.empty() && out.back() == '/') || fs::is_directory(out, ignored);
  // A folder of photographs counts as several inputs.
  const bool may_be_photos =
      !out.empty() && FormatExtension(out).empty() && fs::is_directory(inputs[0], ignored);
  if (!to_folder && !may_be_photos) return std::optional<Batch>();
  if (out.empty()) {
    return Error::Usage("--output", "a folder for the pictures of several inputs", "none");
  }
  if (Error error = CheckKind({"--output", out}, OutputKind::kFolder)) return error;
  Batch batch;
  batch.folder = out;
  for (const std::string& input : inputs) {
    if (input == "-") {
      return Error::Usage("SRC", "files as inputs, or a file for --output", "- (standard input)");
    }
    Result<FoundInputs> found = FindInputs(input, has_command, out);
    if (!found) return found.error();
    if (!to_folder && found->paths == inputs) return std::optional<Batch>();
    for (const std::string& part : found->paths) {
      batch.items.push_back({part, OutputOf(part, out, has_8_bits)});
    }
    std::move(found->skipped.begin(), found->skipped.end(), std::back_inserter(batch.skipped));
  }
  return std::optional<Batch>(std::move(batch));
}

Error MakeBatchFolder(const Batch& batch, OutputFolder* folder) {
  std::vector<OutputPath> outputs;
  Inputs read;
  for (const BatchItem& item : batch.items) {
    std::error_code ignored;
    outputs.push_back({"--output", item.output});
    (fs::is_directory(item.input, ignored) ? read.folders : read.files).push_back(item.input);
  }
  if (Error error = CheckFolderApart({"--output", batch.folder}, read.folders)) return error;
  if (Error error = CheckApart(outputs, read)) return error;
  return folder->Create(batch.folder);
}

Error RunBatch(const Batch& batch, int jobs, const std::function<Error(const BatchItem&)>& run) {
  TellSkipped(batch.skipped);
  std::vector<std::string> failed = RunItems(batch.items, jobs, run);
  const size_t finished = batch.items.size() - failed.size();
  TellOtherInputs();
  TellLine("starfocus: " + std::to_string(finished) + " finished, " +
           std::to_string(batch.skipped.size()) + " skipped, " + std::to_string(failed.size()) +
           " failed");
  if (failed.empty()) return {};
  std::sort(failed.begin(), failed.end());
  std::string names;
  for (const std::string& name : failed) names += (names.empty() ? "" : ", ") + name;
  return Expected("refocus", std::to_string(batch.items.size()) + " pictures",
                  std::to_string(finished) + " (failed: " + names + ")");
}

}  // namespace starfocus
