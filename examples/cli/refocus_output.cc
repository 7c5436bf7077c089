// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <new>
#include <system_error>

#include "examples/cli/pictures.h"
#include "examples/command_line/options.h"
#include "platform/image_io.h"
#include "platform/standard_stream.h"
#include "platform/writers/depth_photo.h"
#include "platform/writers/png.h"
#include "starfocus/experimental.h"

namespace starfocus {

namespace {

// Colours of the layers follow the paper's Fig. 14: red for L = 0, blue for L = 2.
constexpr uint8_t kLayerColors[STARFOCUS_LAYERS][3] = {
    {230, 60, 50}, {60, 180, 75}, {50, 110, 235}};
constexpr int kTintPercent = 40;

// Tints a block, and draws an outline along the first row and column of the block. The outline
// along the last row and column belongs to the neighbouring blocks. The first pixel of `map` is
// pixel (left, top) of the picture.
void DrawBlock(const starfocus_block& block, int left, int top, Image* map) {
  const uint8_t* color = kLayerColors[block.layer];
  const int begin = std::max(block.x, left);
  const int end = std::min(block.x + block.width, left + map->width);
  const int bottom = std::min(block.y + block.height, top + map->height);
  for (int y = std::max(block.y, top); y < bottom; ++y) {
    for (int x = begin; x < end; ++x) {
      uint8_t* pixel = map->row(y - top) + 3 * (x - left);
      const bool outline = x == block.x || y == block.y;
      Tint(color, outline ? 100 : kTintPercent, pixel);
    }
  }
}

}  // namespace

void CollectBlock(void* data, const starfocus_block* block) {
  static_cast<std::vector<starfocus_block>*>(data)->push_back(*block);
}

Image DrawPartition(const Image& picture, int left, int top,
                    const std::vector<starfocus_block>& blocks) {
  Image map = picture;
  for (const starfocus_block& block : blocks) DrawBlock(block, left, top, &map);
  return map;
}

namespace {

constexpr char kAnimation[] = ".webp";
// Limit of the memory of pictures that wait for parallel encoding, in bytes.
constexpr size_t kMostWaiting = size_t{1} << 28;

// Returns the name of a picture of a sweep: "out_007.png" for "out.png".
std::string NumberedName(const std::string& path, size_t index) {
  const std::filesystem::path name(path);
  char number[16];
  std::snprintf(number, sizeof(number), "_%03d", static_cast<int>(index));
  return (name.parent_path() / (name.stem().string() + number + name.extension().string()))
      .string();
}

bool IsJpeg(const std::string& path) {
  const std::string extension = FormatExtension(path);
  return extension == ".jpg" || extension == ".jpeg";
}

// Returns the index of the focus that is nearest to a disparity.
uint16_t Nearest(const std::vector<double>& foci, float disparity) {
  const auto farther = [disparity](double a, double b) {
    return std::fabs(a - double(disparity)) < std::fabs(b - double(disparity));
  };
  const auto nearest = std::min_element(foci.begin(), foci.end(), farther);
  return static_cast<uint16_t>(nearest - foci.begin());
}

// Checks the options --compare and --show, one of which can replace --output.
Error PlanLooking(const OutputOptions& options, bool sweep, bool region) {
  const bool looks = !options.compare.empty() || options.show;
  if (options.out.empty() && !looks) {
    return Error::Usage("--output", "--output FILE, --compare FILE or --show", "none");
  }
  if (looks && sweep) {
    return Error::Usage(options.show ? "--show" : "--compare", "a single picture", "--sweep");
  }
  if (!options.compare.empty() && region) {
    return Error::Usage("--compare", "a whole picture", "--region");
  }
  return {};
}

Error WriteDepthPhoto(const std::string& path, const PictureOptions& how,
                      const Refocused& refocused) {
  const EngineTask& task = *refocused.task;
  SharpOriginal photo = {};
  photo.before = &task.light_field->views[0];
  photo.disparity = &task.light_field->disparity;
  photo.focus = task.params.focus;
  photo.aperture = task.params.aperture;
  photo.widest = refocused.widest;
  return WriteFile(path,
                   EncodeDepthPhoto(path, *refocused.picture, photo, how.quality, how.metadata));
}

}  // namespace

void AddOutputOptions(Command* command, OutputOptions* options) {
  AddOptions(
      {
          {"-o,--output", "FILE",
           "Picture to write (.png, .ppm, .jpg or .webp), or the folder for the pictures "
           "of several inputs; - or FORMAT:-, such as jpg:-, writes to standard output; required "
           "unless --compare or --show is given",
           &options->out},
          {"--quality", "N", "Quality of JPEG and WebP pictures, 1 to 100",
           Whole(1, 100, &options->quality), Use::kDefault},
          {"--small-png", nullptr,
           "Write PNG files that are about 7 % smaller and take about 17 times as long to "
           "compress",
           &options->small_png},
          {"--depth-photo", nullptr,
           "Store the sharp picture and the disparity map in the JPEG file, as GDepth, so "
           "that other programs can refocus the picture again",
           &options->depth_photo},
          {"--all-in-focus", "FILE",
           "With --sweep, picture to write that is sharp everywhere; default: none",
           &options->all_in_focus},
          {"--focus-index", "FILE",
           "With --sweep, PNG file to write that stores for each pixel which picture "
           "shows it in focus, counted from 0; default: none",
           &options->focus_index},
          {"--compare", "FILE",
           "HTML page to write that shows the picture before and after refocusing with a movable "
           "divider, the depth in colours, and the pixels in focus; default: none",
           &options->compare},
          {"--show", nullptr,
           "Show the picture on the terminal, which must support the kitty graphics protocol or "
           "sixels",
           &options->show},
      },
      command);
}

std::vector<OutputPath> ListPictures(const OutputOptions& options, size_t pictures) {
  std::vector<OutputPath> outputs;
  if (pictures == 0 || FormatExtension(options.out) == kAnimation) {
    if (!options.out.empty()) outputs.push_back({"--output", options.out});
  } else {
    for (size_t i = 0; i < pictures; ++i) {
      outputs.push_back({"--output", NumberedName(options.out, i)});
    }
  }
  if (!options.all_in_focus.empty()) outputs.push_back({"--all-in-focus", options.all_in_focus});
  if (!options.focus_index.empty()) outputs.push_back({"--focus-index", options.focus_index});
  if (!options.compare.empty()) outputs.push_back({"--compare", options.compare});
  return outputs;
}

Error PlanOutput(const OutputOptions& options, bool sweep, bool region) {
  if (Error error = PlanLooking(options, sweep, region)) return error;
  if (sweep && IsStandardStream(options.out) && FormatExtension(options.out) != kAnimation) {
    return Error::Usage("--sweep",
                        "a file for --output, or webp:- for an animation on standard output",
                        options.out);
  }
  if (!sweep && (!options.all_in_focus.empty() || !options.focus_index.empty())) {
    return Error::Usage(options.all_in_focus.empty() ? "--focus-index" : "--all-in-focus",
                        "--sweep as well", "no --sweep");
  }
  if (!options.focus_index.empty() && FormatExtension(options.focus_index) != ".png") {
    return Error::Usage("--focus-index", "a name that ends in .png", options.focus_index);
  }
  if (!options.depth_photo || (IsJpeg(options.out) && !sweep && !region)) return {};
  return Error::Usage("--depth-photo", "a whole picture in a .jpg file",
                      sweep    ? "--sweep"
                      : region ? "--region"
                               : options.out);
}

PictureWriter::PictureWriter(const OutputOptions& options, const PictureOptions& how,
                             const Image* picture, int threads)
    : options_(options), how_(how), picture_(picture) {
  if (threads < 2 || options.depth_photo || !IsJpeg(options.out)) return;
  const auto encode = [this]() -> Result<Bytes> {
    try {
      return EncodePicture(options_.out, *picture_, how_, &rows_);
    } catch (const std::bad_alloc&) {
      return OutOfMemory(options_.out, "write it");
    }
  };
  try {
    encoded_ = std::async(std::launch::async, encode);
  } catch (const std::system_error&) {
    // If the thread cannot be created, Write encodes the picture.
  }
}

Error PictureWriter::Write(const Refocused& refocused) {
  rows_.FinishAll();
  Error error;
  if (encoded_.valid()) {
    error = WriteFile(options_.out, encoded_.get());
  } else if (options_.depth_photo) {
    error = WriteDepthPhoto(options_.out, how_, refocused);
  } else if (!options_.out.empty()) {
    error = WriteImage(options_.out, *picture_, how_);
  }
  if (!error && !options_.compare.empty()) {
    error = WriteComparison(options_.compare, refocused, how_.metadata.icc);
  }
  return error;
}

Error WritePair(const OutputOptions& options, const PictureOptions& how,
                const LightField& light_field, const std::vector<double>& foci) {
  if (!options.focus_index.empty()) {
    GreyImage index = {light_field.width(), light_field.height(), {}};
    const std::vector<float>& map = light_field.disparity.values;
    index.levels.reserve(map.size());
    std::transform(map.begin(), map.end(), std::back_inserter(index.levels),
                   [&](float disparity) { return Nearest(foci, disparity); });
    Error error = WriteFile(options.focus_index, EncodeGreyPng(options.focus_index, index));
    if (error) return error;
  }
  if (options.all_in_focus.empty()) return {};
  return WriteImage(options.all_in_focus, light_field.views[0], how);
}

StackWriter::StackWriter(const OutputOptions& options, const PictureOptions& how,
                         ThreadRunner* runner)
    : out_(options.out), how_(how), runner_(runner) {
  if (FormatExtension(out_) == kAnimation) {
    animation_ = std::make_unique<WebpWriter>(out_, how.quality);
  }
}

Result<std::string> StackWriter::Add(Image picture) {
  if (animation_) {
    if (Error error = animation_->Add(picture)) return error;
    return out_;
  }
  const std::string name = NumberedName(out_, pictures_++);
  const size_t bytes = std::max(size_t{1}, picture.pixels.size());
  const size_t most = std::min(static_cast<size_t>(runner_->workers()), kMostWaiting / bytes);
  waiting_.push_back({name, std::move(picture), {}});
  if (waiting_.size() < most) return name;
  if (Error error = WriteWaiting()) return error;
  return name;
}

void StackWriter::Write(void* self, int32_t index, int32_t) {
  const StackWriter* stack = static_cast<StackWriter*>(self);
  Numbered* one = &static_cast<StackWriter*>(self)->waiting_[static_cast<size_t>(index)];
  one->error = WriteImage(one->name, one->picture, stack->how_);
}

Error StackWriter::WriteWaiting() {
  const std::vector<Numbered>& waiting = waiting_;
  ThreadRunner::Run(runner_, Write, this, static_cast<int32_t>(waiting.size()));
  const auto failed = std::find_if(waiting.begin(), waiting.end(),
                                   [](const Numbered& one) { return bool(one.error); });
  const Error error = failed == waiting.end() ? Error() : failed->error;
  waiting_.clear();
  return error;
}

Error StackWriter::Finish() {
  return animation_ ? WriteFile(out_, animation_->Finish(how_.metadata)) : WriteWaiting();
}

}  // namespace starfocus
