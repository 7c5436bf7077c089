// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/deep_output.h"

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include "examples/cli/input.h"
#include "platform/decoders/deep.h"
#include "platform/deep_image.h"
#include "platform/image_io.h"
#include "platform/readers/sample_bits.h"
#include "platform/standard_stream.h"
#include "platform/writers/deep_picture.h"
#include "platform/writers/ultra_hdr.h"

namespace starfocus {
namespace {

// Returns true if a picture may have light beyond white.
bool MayExceedWhite(const DeepImage& deep) { return deep.is_half || IsHdr(deep.transfer); }

bool IsJpeg(const std::string& path) {
  const std::string extension = FormatExtension(path);
  return extension == ".jpg" || extension == ".jpeg";
}

// Returns true if a file with this name always has more than 8 bits.
bool IsAlwaysDeep(const std::string& path) {
  return KeepsBits(path) && FormatExtension(path) != ".png";
}

bool IsTiff(const std::string& path) {
  const std::string extension = FormatExtension(path);
  return extension == ".tif" || extension == ".tiff";
}

// Makes deep views of views of 8 bits if the output has more bits. The views of TIFF files, which
// have no light beyond white, are without that of the gain map.
void Deepen(const std::string& path, Capture* capture) {
  LightField& light_field = capture->light_field;
  if (!IsAlwaysDeep(path) || !light_field.deep.empty()) return;
  light_field.deep_colours = ColoursOf(capture->metadata);
  if (!capture->gain_map.levels.empty() && !IsTiff(path)) {
    light_field.deep.push_back(ApplyGainMap(light_field.views[0], capture->gain_map));
    capture->gain_map = {};
    return;
  }
  for (const Image& view : light_field.views) {
    light_field.deep.push_back(Widen(view, {}));
    if (light_field.is_linear) light_field.deep.back().transfer = STARFOCUS_TRANSFER_NONE;
  }
}

// Removes the light of the file, because --highlights guesses light.
void ReplaceLight(Capture* capture) {
  std::vector<DeepImage>& deep = capture->light_field.deep;
  if (!capture->gain_map.levels.empty() || std::any_of(deep.begin(), deep.end(), MayExceedWhite)) {
    TellNote(capture->path, "--highlights replaces the light of the file by a guess");
  }
  deep.clear();
  capture->gain_map = {};
}

// Prints a note if a WebP picture has fewer bits than the input.
void TellBits(const Capture& capture) {
  std::vector<std::string> notes;
  NoteSampleBits(capture.light_field.deep[0].bits, &notes);
  for (const std::string& note : notes) TellNote(capture.path, note);
}

// Prints a note if the light has more than 16 bits.
void TellRounding(const Capture& capture) {
  const std::vector<DeepImage>& deep = capture.light_field.deep;
  if (deep.empty() || !deep[0].is_half || deep[0].bits <= 16) return;
  TellNote(capture.path, "floats of 32 bits are rounded to half floats");
}

// Prints a note if the capture has a gain map that the output does not keep.
void TellLostGainMap(const OutputOptions& output, bool single, const Capture& capture) {
  if (capture.gain_map.levels.empty()) return;
  if (single && WritesGainMap(output, capture)) return;
  const char* reason = output.depth_photo ? "depth photos have none"
                       : !single          ? "sweeps, animations and streams have none"
                       : IsAlwaysDeep(output.out) && !IsTiff(output.out)
                           ? ".jpg files keep that of a picture of more than 8 bits"
                           : ".jpg, .exr, .avif and .heic files keep its light";
  TellNote(capture.path, std::string("the gain map is left out; ") + reason);
}

// Returns an error if the format of `path` does not describe the light of a picture. Encodes one
// pixel, so that this error is reported before the picture is computed.
Error CheckLight(const std::string& path, const DeepImage& picture) {
  if (!IsTiff(path)) return {};
  DeepImage pixel(1, 1, picture.channels);
  pixel.is_half = picture.is_half;
  pixel.transfer = picture.transfer;
  std::vector<std::string> notes;
  return EncodeDeepPicture(path, pixel, {}, &notes).error();
}

}  // namespace

void TellLostBits(const Capture& capture) {
  TellLost(capture);
  const std::vector<DeepImage>& deep = capture.light_field.deep;
  if (capture.photo || !std::any_of(deep.begin(), deep.end(), MayExceedWhite)) return;
  if (std::any_of(deep.begin(), deep.end(),
                  [](const DeepImage& view) { return LargestLight(view) > 1; })) {
    TellNote(capture.path, "light brighter than white is clipped in pictures of 8 bits");
  }
}

bool KeepsBits(const std::string& path) { return IsDeepExtension(FormatExtension(path)); }

Error CheckHighlights(const std::string& path, double highlights) {
  if (highlights <= 1 || !IsAlwaysDeep(path)) return {};
  return Error::Usage("--highlights", "a picture of 8 bits, because highlights are a guess",
                      FormatExtension(path));
}

Error ChooseBits(const OutputOptions& output, bool single, Capture* capture, EngineTask* task) {
  LightField& light_field = capture->light_field;
  const std::string& path = output.out;
  const bool brightens = task->config.highlights > 1;
  const bool replaces = brightens && !light_field.deep.empty();
  if (brightens) ReplaceLight(capture);
  if (single) Deepen(path, capture);
  TellLostGainMap(output, single, *capture);
  const bool is_hdr = std::any_of(light_field.deep.begin(), light_field.deep.end(), MayExceedWhite);
  const bool has_alpha = std::any_of(light_field.deep.begin(), light_field.deep.end(),
                                     [](const DeepImage& deep) { return deep.channels == 4; });
  const bool keeps_alpha = single && WritesWebpAlpha(output, *capture);
  const bool keeps = keeps_alpha || (single && KeepsBits(path));
  if (keeps_alpha) TellBits(*capture);
  if (!keeps || replaces) TellLostBits(*capture);
  if (keeps) TellRounding(*capture);
  // Pictures without alpha show the colours of transparent pixels, and those of a sweep no light
  // beyond white.
  if (!keeps && (has_alpha || (is_hdr && !single))) light_field.deep.clear();
  // Engines that may have more than 8 bits dither pictures of 8 bits.
  if (output.dither || !light_field.deep.empty()) task->config.features |= STARFOCUS_FEATURE_DEEP;
  if (light_field.deep.empty()) return {};
  if (Error error = keeps ? CheckLight(path, light_field.deep[0]) : Error()) return error;
  task->deep_views = true;
  task->deep_picture = keeps || is_hdr;
  for (const DeepImage& deep : light_field.deep) {
    const bool chosen = task->config.transfer == STARFOCUS_TRANSFER_NONE;
    if (!deep.is_half && !(chosen && deep.transfer == STARFOCUS_TRANSFER_SRGB)) {
      task->config.transfer = deep.transfer;
    }
  }
  return {};
}

bool WritesWebpAlpha(const OutputOptions& output, const Capture& capture) {
  const std::vector<DeepImage>& deep = capture.light_field.deep;
  return FormatExtension(output.out) == ".webp" && !deep.empty() &&
         std::all_of(deep.begin(), deep.end(), [](const DeepImage& view) {
           return view.channels == 4 && !MayExceedWhite(view);
         });
}

Error WriteWebpAlpha(const std::string& path, const PictureOptions& how,
                     const EngineResult& result) {
  PictureOptions options = how;
  for (size_t at = 3; at < result.deep.samples.size(); at += 4) {
    options.alphas.push_back(static_cast<uint8_t>((result.deep.samples[at] + 128) / 257));
  }
  return WriteImage(path, result.picture, options);
}

Error WriteDeepResult(const std::string& path, const PictureOptions& how, const Capture& capture,
                      const EngineResult& result) {
  DeepOptions options = {how};
  options.picture.metadata.colours = capture.light_field.deep_colours;
  const std::string extension = FormatExtension(path);
  const bool shows_hdr = extension == ".avif" || extension == ".heic";
  if (shows_hdr) options.transfer = STARFOCUS_TRANSFER_PQ;
  if (shows_hdr && result.deep.is_half && options.picture.metadata.colours.form.empty() &&
      !how.metadata.icc.empty()) {
    TellNote(path, "PQ replaces the ICC profile, so that the colours count as BT.709");
  }
  std::vector<std::string> notes;
  const Error error = WriteDeepImage(path, result.deep, options, &notes);
  for (const std::string& note : notes) TellNote(path, note);
  return error;
}

bool WritesGainMap(const OutputOptions& output, const Capture& capture) {
  return IsJpeg(output.out) && !output.depth_photo && !capture.gain_map.levels.empty();
}

Error WriteUltraHdr(const std::string& path, const PictureOptions& how, const Capture& capture,
                    const EngineTask& task, const Image& picture) {
  const GainMap& given = capture.gain_map;
  try {
    LightField light_field = capture.light_field;
    light_field.deep = {ApplyGainMap(light_field.views[0], given)};
    EngineTask hdr = task;
    hdr.light_field = &light_field;
    hdr.deep_views = hdr.deep_picture = true;
    hdr.config.features |= STARFOCUS_FEATURE_DEEP;
    EngineRun run(hdr.threads, 1);
    if (Error error = run.Start(InputName(capture.path), hdr)) return error;
    Result<EngineResult> result = run.Refocus(InputName(capture.path), hdr);
    if (!result) return result.error();
    const int step = std::max(1, (light_field.width() + given.width / 2) / given.width);
    const GainMap map = ComputeGainMap(picture, result->deep, step, given);
    return WriteFile(path, EncodeUltraHdr(path, picture, map, how.quality, how.metadata));
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "write it");
  }
}

}  // namespace starfocus
