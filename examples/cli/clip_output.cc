// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/clip_output.h"

#include <signal.h>
#include <time.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "examples/command_line/program.h"
#include "platform/file.h"
#include "platform/folder.h"
#include "platform/image_io.h"
#include "platform/shell_command.h"
#include "platform/signal_cleanup.h"
#include "platform/writers/webp.h"

namespace starfocus {
namespace {

// True while a frame is written, and after a signal that ends the program.
std::atomic<bool> writes_frame{false}, is_ending{false};

// Waits for the end of the frame that another thread writes, at most two seconds, because the
// reader of a pipe may have stopped. Runs in a signal handler.
void WaitForFrame(const void*) {
  is_ending = true;
  for (int k = 0; k < 2000 && writes_frame; ++k) {
    const timespec millisecond = {0, 1000000};
    nanosleep(&millisecond, nullptr);
  }
}

// Writes a frame to standard output completely, also if a signal ends the program meanwhile.
class WholeFrame {
 public:
  WholeFrame() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);  // another thread waits, or this one afterwards
    writes_frame = true;
  }
  ~WholeFrame() {
    writes_frame = false;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WholeFrame(const WholeFrame&) = delete;
  WholeFrame& operator=(const WholeFrame&) = delete;

  Result<bool> Write(const std::vector<uint8_t>& bytes) const {
    if (is_ending) return false;
    errno = 0;
    const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() &&
                       std::fflush(stdout) == 0;
    if (whole) return true;
    const int reason = errno != 0 ? errno : EIO;
    if (reason == EPIPE) return false;  // RunProgram ends the program
    return Cannot("write to", "standard output", {reason, std::generic_category()});
  }

 private:
  sigset_t before_;
};

class StreamOutput : public ClipOutput {
 public:
  explicit StreamOutput(Y4mHeader header) : header_(std::move(header)) {
    cleanup_.Add(SignalCleanup::Turn(), WaitForFrame, nullptr);
  }
  ~StreamOutput() override { cleanup_.Remove(SignalCleanup::Turn()); }

  Result<bool> Write(const ClipFrame& frame) override {
    std::vector<uint8_t> bytes = EncodeY4mFrame(header_, frame.result->planar);
    if (frame.index == 0) {
      const std::string line = header_.Line();
      bytes.insert(bytes.begin(), line.begin(), line.end());
    }
    return WholeFrame().Write(bytes);
  }

 private:
  const Y4mHeader header_;
  SignalCleanup cleanup_;
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
    if (Error error = WriteImage(path, frame.result->picture, OptionsFor(frame))) return error;
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
