// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/stream_clip.h"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include "examples/cli/frame_pattern.h"
#include "examples/cli/input.h"
#include "platform/readers/matte_file.h"
#include "platform/readers/pair.h"
#include "platform/standard_stream.h"
#include "platform/text.h"

namespace starfocus {
namespace {

// Checks the options that do not fit a stream.
Error CheckStreamOptions(const std::string& path, const InputOptions& options) {
  if (RunsCommand(options)) {
    const bool depth = !options.depth_command.line.empty();
    return Error::Usage(depth ? "--depth-command" : "--matte-command",
                        std::string("a folder or pattern for ") + (depth ? "--depth" : "--matte") +
                            ", because the maps of a stream are measured before its frames",
                        "a command");
  }
  if (options.depth.empty() && options.matte.empty()) {
    return Error::Usage("--depth",
                        "the depth of the frames of " + InputName(path) +
                            ": a folder, a pattern such as 'd/%05d.png' or a Y4M file",
                        "no --depth or --matte");
  }
  for (const auto& [name, file] :
       {std::pair("--depth", options.depth), {"--matte", options.matte}}) {
    if (file == "-") return Error::Usage(name, "a folder, a pattern or a file", "-");
  }
  if (path == "-" && isatty(STDIN_FILENO) == 1) {
    return Expected(InputName(path), "a Y4M stream from a pipe", "a terminal");
  }
  return CheckNear(options.map);
}

}  // namespace

bool IsStream(const std::vector<std::string>& inputs) {
  return inputs.size() == 1 && (inputs[0] == "-" || IsY4mFile(inputs[0]));
}

Error MapTrack::Open(const std::string& path) {
  path_ = path;
  if (path.empty()) return {};
  is_stream_ = IsY4mFile(path);
  if (!is_stream_) return ListPictures(path).MoveTo(&pictures_);
  if (Error error = reader_.Open(path)) return error;
  std::vector<uint8_t> planes;
  for (;;) {
    const Result<bool> has = reader_.Next(&planes);
    if (!has) return has.error();
    if (!*has) break;
  }
  frames_ = reader_.frames();
  return frames_ > 0 ? Error() : Expected(path, "a Y4M stream with frames", "none");
}

const std::string& MapTrack::FileOf(size_t frame) const {
  return is_stream_ ? path_ : pictures_[is_single() ? 0 : frame];
}

Result<Samples> MapTrack::Read(size_t frame, Alpha alpha, const DepthOptions& options) {
  return is_stream_ ? ReadStream(frame) : ReadSamples(FileOf(frame), alpha, options);
}

Result<Samples> MapTrack::ReadStream(size_t frame) {
  if (reader_.frames() > frame) {
    reader_ = Y4mReader();
    if (Error error = reader_.Open(path_)) return error;
  }
  std::vector<uint8_t> planes;
  while (reader_.frames() <= frame) {
    const Result<bool> has = reader_.Next(&planes);
    if (!has) return has.error();
    if (!*has) return Expected(path_, std::to_string(frames_) + " frames", "fewer");
  }
  Samples samples;
  const Y4mHeader& header = reader_.header();
  samples.map = {header.width, header.height, LumaLevels(header, planes, &samples.largest)};
  return samples;
}

Error StreamClip::Open(const std::string& path, const InputOptions& options) {
  path_ = path;
  map_ = options.map;
  map_.is_frame = true;
  if (Error error = CheckStreamOptions(path, options)) return error;
  if (Error error = depths_.Open(options.depth)) return error;
  if (Error error = mattes_.Open(options.matte)) return error;
  if (Error error = reader_.Open(path)) return error;
  where_ = InputName(path);
  if (header().across != 2 || header().down != 2) {
    if (header().across > 0) {
      TellNote(where_, "the chroma of C" + header().chroma + " is averaged to 4:2:0");
    }
  }
  return {};
}

size_t StreamClip::maps() const {
  size_t least = 0;
  for (const MapTrack* track : {&depths_, &mattes_}) {
    if (track->is_empty() || track->is_single()) continue;
    least = least == 0 ? track->frames() : std::min(least, track->frames());
  }
  return least;
}

std::vector<std::string> StreamClip::Files() const {
  std::vector<std::string> files;
  for (const MapTrack* track : {&depths_, &mattes_}) {
    for (size_t k = 0; k < std::max<size_t>(maps(), 1) && !track->is_empty(); ++k) {
      files.push_back(track->FileOf(k));
    }
  }
  files.push_back(path_);
  return files;
}

Result<Capture> StreamClip::OpenMapOf(size_t frame, const MapSurvey* clip) {
  DepthPhoto photo;
  photo.format = "frame of a Y4M stream";
  photo.picture.width = header().width;  // pixels are not needed
  photo.picture.height = header().height;
  CaptureOptions options;
  options.map = map_;
  options.map.clip = clip;
  options.small_map = true;
  Error error;
  if (!depths_.is_empty()) {
    photo.depth_path = depths_.FileOf(frame);
    Result<Samples> samples = depths_.Read(frame, map_.alpha, map_);
    if (!samples) return samples.error();
    error = TakeDepthPicture(photo.depth_path, options.map, std::move(*samples), &photo);
  }
  if (!error && !mattes_.is_empty()) {
    photo.matte_path = mattes_.FileOf(frame);
    Result<Samples> samples = mattes_.Read(frame, Alpha::kTaken, map_);
    if (!samples) return samples.error();
    error = TakeMattePicture(photo.matte_path, options.map, std::move(*samples), &photo);
  }
  if (error) return error;
  const std::string name = !depths_.is_empty() ? photo.depth_path : photo.matte_path;
  Result<Capture> capture = TakePhoto(name, options, std::move(photo));
  if (capture) capture->path = name;
  return capture;
}

Result<bool> StreamClip::Next(const MapSurvey& clip, Capture* capture) {
  std::vector<uint8_t> planes;
  const size_t frame = reader_.frames();
  const Result<bool> has = reader_.Next(&planes);
  if (!has || !*has) return has;
  if (maps() > 0 && frame >= maps()) {
    return Expected(where_, "at most " + std::to_string(maps()) + " frames, as many as maps",
                    "more");
  }
  if (Error error = OpenMapOf(frame, &clip).MoveTo(capture)) return error;
  capture->light_field.planar = ToPlanar(header(), std::move(planes));
  return true;
}

void StreamClip::TellEnd() const {
  const size_t frames = reader_.frames();
  if (maps() <= frames) return;
  TellNote(where_, "the stream has " + std::to_string(frames) + " frames, but " +
                       std::to_string(maps()) + " maps belong to it");
}

}  // namespace starfocus
