// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus/batch.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "examples/command_line/outputs.h"
#include "platform/file.h"
#include "platform/folder.h"
#include "platform/progress.h"
#include "platform/readers/capture.h"
#include "platform/readers/pair.h"
#include "platform/standard_stream.h"
#include "platform/writers/picture.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

bool IsLightField(const fs::path& folder) { return bool(OpenCapture(folder.string(), {})); }

bool HasDepthPicture(const fs::path& path) {
  DepthPhoto unused;
  return !FindDepthPicture(path.string(), &unused)->empty();
}

// Returns true for a photograph. Depth pictures are not photographs, and PNG and WebP pictures are
// photographs only if they have a depth picture next to them.
bool IsPhoto(const fs::path& path) {
  const std::string extension = LowerExtension(path.string());
  if (IsDepthPictureName(path.filename().string())) return false;
  if (extension == ".png" || extension == ".webp") return HasDepthPicture(path);
  return extension == ".jpg" || extension == ".jpeg" || extension == ".heic" ||
         extension == ".heif" || extension == ".avif";
}

// If `input` is a folder but not a light field, returns the inputs in the folder. Otherwise returns
// only `input`.
std::vector<std::string> Expand(const std::string& input) {
  std::error_code ignored;
  if (!fs::is_directory(input, ignored) || IsLightField(input)) return {input};
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(input, ignored)) {
    const bool folder = entry.is_directory(ignored);
    if (folder ? IsLightField(entry.path()) : IsPhoto(entry.path())) {
      found.push_back(entry.path().string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string OutputOf(const std::string& input, const std::string& folder) {
  std::error_code ignored;
  fs::path path = fs::absolute(input, ignored).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "folder/"
  if (fs::is_directory(input, ignored)) {
    return (fs::path(folder) / (path.filename().string() + ".png")).string();
  }
  const bool kept = IsPictureExtension(LowerExtension(input));
  return (fs::path(folder) / (path.stem().string() + (kept ? path.extension().string() : ".jpg")))
      .string();
}

// State that the threads of a batch share.
struct Work {
  const std::vector<BatchItem>& items;
  const std::function<Error(const BatchItem&)>& run;
  Progress progress;
  std::atomic<size_t> next;
  std::mutex mutex;  // protects `failed` and stderr
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
      const bool named = error.line().find(items[i].input) != std::string::npos;
      const std::lock_guard<std::mutex> lock(mutex);
      progress.Tell("starfocus: " + (named ? "" : items[i].input + ": ") + error.line());
      failed.push_back(items[i].input);
    }
  }
};

}  // namespace

bool IsBatch(const std::vector<std::string>& inputs, const std::string& out) {
  std::error_code ignored;
  if (inputs.size() > 1 || fs::is_directory(out, ignored)) return true;
  if (out.empty() || out.back() == '/') return !out.empty();
  // A folder of photographs counts as several inputs.
  return inputs.size() == 1 && fs::is_directory(inputs[0], ignored) &&
         FormatExtension(out).empty() && !IsLightField(inputs[0]);
}

Result<std::vector<BatchItem>> PlanBatch(const std::vector<std::string>& inputs,
                                         const std::string& folder) {
  if (IsPictureExtension(FormatExtension(folder))) {
    return Error::Usage("--output", "a folder for the pictures of several inputs", folder);
  }
  std::vector<BatchItem> items;
  std::vector<Output> outputs;
  Inputs read;
  for (const std::string& input : inputs) {
    if (input == "-") {
      return Error::Usage("SRC", "files as inputs, or a file for --output", "- (standard input)");
    }
    const std::vector<std::string> parts = Expand(input);
    if (parts.empty())
      return Expected(input, "a light field, or a folder of photos or light fields", "neither");
    for (const std::string& part : parts) {
      std::error_code ignored;
      items.push_back({part, OutputOf(part, folder)});
      outputs.push_back({"--output", items.back().output});
      (fs::is_directory(part, ignored) ? read.folders : read.files).push_back(part);
    }
  }
  if (Error error = CheckFolderApart({"--output", folder}, read.folders)) return error;
  if (Error error = CheckApart(outputs, read)) return error;
  if (Error error = MakeFolder(folder)) return error;
  return items;
}

Error RunBatch(const std::vector<BatchItem>& items, int jobs,
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
  if (work.failed.empty()) return {};
  std::sort(work.failed.begin(), work.failed.end());
  std::string names;
  for (const std::string& name : work.failed) names += (names.empty() ? "" : ", ") + name;
  return Expected("refocus", std::to_string(items.size()) + " pictures",
                  std::to_string(items.size() - work.failed.size()) + " (failed: " + names + ")");
}

}  // namespace starfocus
