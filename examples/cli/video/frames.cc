// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/video/frames.h"

#include <filesystem>
#include <utility>

#include "examples/cli/input/find_inputs.h"

namespace starfocus {
namespace {

// Largest number of frames, because file names have four digits.
constexpr size_t kMostFrames = 10000;

// Returns true if the frame can be read again as a light-field folder.
bool IsReady(const MapOptions& options, const Capture& capture) {
  return !capture.photo && !capture.map_path.empty() && capture.map_scale == 1 &&
         capture.care == MapCare::kNone && !options.repair &&
         IsViewFile(std::filesystem::path(capture.files[0].path).filename().string());
}

}  // namespace

Result<std::vector<std::string>> FindFrames(const std::vector<std::string>& inputs,
                                            const InputOptions& options, const std::string& out) {
  std::vector<std::string> frames = inputs;
  if (inputs.size() == 1) {
    Result<FoundInputs> found = FindInputs(inputs[0], EstimatesDepth(options), out);
    if (!found) return found.error();
    TellSkipped(found->skipped);
    frames = std::move(found->paths);
  }
  if (frames.size() <= kMostFrames) return frames;
  return Error::Usage("SRC", "at most " + std::to_string(kMostFrames) + " frames",
                      std::to_string(frames.size()));
}

Result<Frame> FrameFolders::Open(const MapOptions& options, const Positions& views, int threads,
                                 Capture* capture) {
  Frame frame;
  if (!IsReady(options, *capture)) {
    if (Error error = Convert(options, views, threads, capture, &frame)) return error;
    return frame;
  }
  frame.files.folder = capture->path;
  frame.files.where = capture->map_path;
  if (Error error = ReadDisparity(frame.files.folder).MoveTo(&frame.map)) return error;
  frame.focus = FindSurface(frame.map);
  return frame;
}

Error FrameFolders::Convert(const MapOptions& options, const Positions& views, int threads,
                            Capture* capture, Frame* frame) {
  Error error = folder_.path().empty() ? folder_.Create() : Error();
  frame->files.folder = folder_.path() + "/" + std::to_string(count_++);
  frame->files.where = MapName(*capture);
  // The default focus must not depend on the repair of a photo's map, as in the command refocus.
  if (!error && capture->photo) frame->focus = FindDefaultFocus(*capture);
  if (!error) error = LoadInput(views, threads, capture);
  if (!error && !capture->photo) frame->focus = FindDefaultFocus(*capture);
  if (!error) error = CareForMap(options, threads, capture);
  if (error) return error;
  ThreadRunner runner(threads);
  error = SaveLightField(frame->files.folder, capture->light_field, &runner);
  frame->map = std::move(capture->light_field.disparity);
  return error;
}

}  // namespace starfocus
