// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/clip_output.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "examples/cli/deep_output.h"
#include "examples/command_line/program.h"
#include "platform/file.h"
#include "platform/folder.h"
#include "platform/image_io.h"
#include "platform/shell_command.h"
#include "platform/writers/webp.h"

namespace starfocus {
namespace {

class StreamOutput : public ClipOutput {
 public:
  explicit StreamOutput(const Y4mHeader& header) : writer_(header) {}

  Result<bool> Write(const ClipFrame& frame) override {
    return writer_.Write(frame.result->planar);
  }

 private:
  Y4mWriter writer_;
};

PictureOptions OptionsFor(const ClipFrame& frame) {
  PictureOptions how;
  how.metadata.icc = frame.capture.metadata.icc;
  how.metadata.colours = frame.capture.metadata.colours;
  return how;
}

class FolderOutput : public ClipOutput {
 public:
  explicit FolderOutput(std::string folder) : folder_(std::move(folder)) {}

  Result<bool> Write(const ClipFrame& frame) override {
    if (Error error = frame.index == 0 ? made_.Create(folder_) : Error()) return error;
    const std::string path = (std::filesystem::path(folder_) / frame.picture).string();
    const bool is_deep = !frame.result->deep.samples.empty();
    Error error = is_deep ? WriteDeepResult(path, OptionsFor(frame), frame.capture, *frame.result)
                          : WriteImage(path, frame.result->picture, OptionsFor(frame));
    if (error) return error;
    return true;
  }

 private:
  const std::string folder_;
  OutputFolder made_;
};

class AnimationOutput : public ClipOutput {
 public:
  AnimationOutput(std::string path, double milliseconds)
      : path_(std::move(path)), writer_(path_, PictureOptions().quality, milliseconds) {}

  Result<bool> Write(const ClipFrame& frame) override {
    if (frame.index == 0) metadata_.icc = frame.capture.metadata.icc;
    if (Error error = writer_.Add(frame.result->picture)) return error;
    return true;
  }
  Error Finish() override { return WriteFile(path_, writer_.Finish(metadata_)); }

 private:
  const std::string path_;
  Metadata metadata_;
  WebpWriter writer_;
};

}  // namespace

ClipKind KindOfClip(const std::string& out) {
  if (out == "-") return ClipKind::kStream;
  return LowerExtension(out) == ".webp" && out.back() != '/' ? ClipKind::kAnimation
                                                             : ClipKind::kFolder;
}

Error CheckClipName(const std::string& out) {
  if (out.empty()) return Error::Usage("--output", "a folder", "an empty name");
  const bool is_video = IsVideoName(out);
  if (!is_video && LowerExtension(out) != ".y4m") return {};
  std::error_code ignored;
  if (std::filesystem::is_directory(out, ignored)) return {};  // CheckFolderOutput explains this
  return Error::Usage("--output",
                      std::string("a folder, a .webp file, or - for a stream that ") +
                          (is_video ? "ffmpeg encodes: starfocus video ... -o - | ffmpeg -i - " +
                                          std::string(LowerExtension(out) == ".gif"
                                                          ? ""
                                                          : "-vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' ")
                                    : "the shell stores: starfocus video ... -o - > ") +
                          ShellQuoted(out),
                      out);
}

std::unique_ptr<ClipOutput> MakeClipOutput(const std::string& out, const Y4mHeader& header) {
  switch (KindOfClip(out)) {
    case ClipKind::kStream:
      return std::make_unique<StreamOutput>(header);
    case ClipKind::kAnimation:
      return std::make_unique<AnimationOutput>(out, header.milliseconds());
    default:
      return std::make_unique<FolderOutput>(out);
  }
}

}  // namespace starfocus
