// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/video/frames.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "examples/cli/input/find_inputs.h"
#include "examples/cli/video/depth_folder.h"

namespace starfocus {
namespace {

// Returns true if the frame can be read again as a light-field folder.
bool IsReady(const MapOptions& options, const Capture& capture) {
  return !capture.photo && !capture.map_path.empty() && capture.map_scale == 1 &&
         capture.care == MapCare::kNone && !options.repair &&
         IsViewFile(std::filesystem::path(capture.files[0].path).filename().string());
}

// Returns the path of the depth picture or matte of each frame. `path` is one file for all frames,
// a folder with a file for each frame, or empty.
Result<std::vector<std::string>> FindPictures(const std::vector<std::string>& frames,
                                              const std::string& path, const std::string& ending) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return PairWithFolder(frames, path, ending);
  return std::vector<std::string>(frames.size(), path);
}

}  // namespace

Result<std::vector<FrameSource>> FindFrames(const std::vector<std::string>& inputs,
                                            const InputOptions& options, const std::string& out) {
  std::vector<std::string> paths = inputs;
  if (std::find(paths.begin(), paths.end(), "-") != paths.end()) {
    return Error::Usage("SRC", "files or folders as frames", "- (standard input)");
  }
  if (inputs.size() == 1) {
    Result<FoundInputs> found = FindInputs(inputs[0], true, out);
    if (!found) return found.error();
    TellSkipped(found->skipped);
    paths = std::move(found->paths);
  }
  std::vector<std::string> depths, mattes;
  Error error = FindPictures(paths, options.depth, "depth").MoveTo(&depths);
  if (!error) error = FindPictures(paths, options.matte, "matte").MoveTo(&mattes);
  if (error) return error;
  std::vector<FrameSource> frames;
  std::set<std::string> names;
  for (size_t i = 0; i < paths.size(); ++i) {
    frames.push_back({paths[i], depths[i], mattes[i], NameOfInput(paths[i]) + ".png"});
    names.insert(frames[i].picture);
  }
  if (names.size() == frames.size()) return frames;
  // Inputs of different folders have equal names, so their pictures are numbered.
  for (size_t i = 0; i < frames.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04zu.png", i);
    frames[i].picture = name;
  }
  return frames;
}

Result<Frame> FrameFolders::Open(const MapOptions& options, const Positions& views, int threads,
                                 Capture* capture) {
  Frame frame;
  frame.files.icc = std::move(capture->metadata.icc);
  frame.files.colours = std::move(capture->metadata.colours);
  frame.files.is_linear = capture->light_field.is_linear;
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
