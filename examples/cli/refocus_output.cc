// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <new>
#include <system_error>
#include <utility>

#include "examples/cli/pictures.h"
#include "examples/command_line/options.h"
#include "platform/image_io.h"
#include "platform/standard_stream.h"
#include "platform/writers/depth_photo.h"
#include "platform/writers/png.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.hpp"

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
           "Picture to write (.png, .ppm, .jpg or .webp; with all bits .png, .tif, .exr, .avif or "
           ".heic), or the folder for the pictures "
           "of several inputs; - or FORMAT:-, such as jpg:-, writes to standard output; required "
           "unless --compare or --show is given",
           &options->out},
          {"--quality", "N", "Quality of JPEG and WebP pictures, 1 to 100",
           Whole(1, 100, &options->quality), Use::kDefault},
          {"--dither", nullptr,
           "Dither smooth areas of pictures of 8 bits, so that blurred skies have no bands",
           &options->dither},
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
                             const Image* picture, int threads, std::function<Error()> write)
    : options_(options), how_(how), picture_(picture), write_(std::move(write)) {
  if (threads < 2 || options.depth_photo || write_ || !IsJpeg(options.out)) return;
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
  } else if (write_) {
    error = write_();
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

namespace {

double Share(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

// Returns the statistics of each layer as JSON. The shares of area and time are fractions of the
// totals over all layers. Times in seconds are CPU times, summed over the threads. The timing model
// applies only to blocks that are rendered with views after an analysis of the block's content.
Json LayersJson(const EngineResult& result, bool predicted) {
  uint64_t pixels = 0, time = 0;
  for (const starfocus_layer_report& layer : result.layers) {
    pixels += layer.pixels;
    time += layer.measured_ns;
  }
  Json layers = Json::Array();
  for (int l = 0; l < STARFOCUS_LAYERS; ++l) {
    const starfocus_layer_report& layer = result.layers[l];
    Json json;
    json.Set("layer", l);
    json.Set("blocks", layer.blocks);
    json.Set("area_share", Share(layer.pixels, pixels));
    json.Set("time_share", Share(layer.measured_ns, time));
    json.Set("views", layer.views);
    json.Set("rendered_samples", layer.rendered_samples);
    json.Set("seconds", 1e-9 * static_cast<double>(layer.measured_ns));
    json.Set("seconds_predicted", nullptr);
    if (predicted) json.Set("seconds_predicted", 1e-12 * static_cast<double>(layer.predicted_ps));
    layers.Add(std::move(json));
  }
  return layers;
}

// Returns the number of pixels that each stage touched, as shares of the picture or region. Pixels
// of layers 1 and 2 count like other pixels, because they cost as much.
Json TouchedJson(const EngineTask& task, const EngineResult& result) {
  const starfocus::Config& config = task.config;
  const starfocus_region& region = task.params.region;
  const uint64_t pixels = region.width == 0 ? uint64_t(config.width) * uint64_t(config.height)
                                            : uint64_t(region.width) * uint64_t(region.height);
  const starfocus_report& report = result.report;
  Json json;
  const auto set = [&](const char* stage, uint64_t touched) {
    json.Set(stage, Share(touched, pixels));
  };
  set("converted", report.converted_pixels);
  set("measured", report.measured_pixels);
  set("copied", report.copied_pixels);
  set("gathered", report.gathered_pixels);
  const auto sum = [&](const char* stage, uint64_t starfocus_layer_report::*member) {
    uint64_t touched = 0;
    for (const starfocus_layer_report& layer : result.layers) touched += layer.*member;
    set(stage, touched);
  };
  sum("surfaces", &starfocus_layer_report::surface_pixels);
  sum("hidden", &starfocus_layer_report::hidden_pixels);
  sum("filled", &starfocus_layer_report::filled_pixels);
  sum("selected", &starfocus_layer_report::selected_pixels);
  sum("shifted", &starfocus_layer_report::shifted_pixels);
  sum("composited", &starfocus_layer_report::composited_pixels);
  set("rendered", report.rendered_samples / 3);
  return json;
}

// Returns the number of superblocks of the picture or region.
uint64_t Superblocks(const EngineTask& task, int side) {
  const starfocus::Config& config = task.config;
  const starfocus_region& region = task.params.region;
  const auto count = [&](int first, int size) {
    return static_cast<uint64_t>((first + size - 1) / side - first / side + 1);
  };
  if (region.width == 0) return count(0, config.width) * count(0, config.height);
  return count(region.x, region.width) * count(region.y, region.height);
}

Json ShapeJson(const starfocus::Params& lens) {
  constexpr const char* kNames[] = {"fall-off", "disc", "polygon", "ring"};
  Json json;
  json.Set("name", kNames[lens.shape]);
  if (lens.shape == STARFOCUS_SHAPE_FALL_OFF) json.Set("theta", lens.theta);
  if (lens.shape == STARFOCUS_SHAPE_POLYGON) {
    json.Set("blades", lens.blades);
    json.Set("rotation", lens.rotation);
    json.Set("curvature", lens.curvature);
  }
  if (lens.shape == STARFOCUS_SHAPE_RING) json.Set("inner", lens.ring_inner);
  json.Set("cats_eye", lens.cats_eye);
  return json;
}

void AddFigures(const EngineTask& task, const EngineResult& result, Json* json) {
  json->Set("mode", kModeNames[task.params.study.mode]);
  json->Set("width", task.config.width);
  json->Set("height", task.config.height);
  const starfocus_region& region = task.params.region;
  if (region.width > 0) {
    json->Set("region", Json::Array({region.x, region.y, region.width, region.height}));
  }
  json->Set("views", task.config.views);
  const starfocus::Params& lens = task.params;
  json->Set("focus", lens.focus);
  if (lens.focus_nearer > 0 || lens.focus_farther > 0) {
    json->Set("focus_range",
              Json::Array({lens.focus + lens.focus_nearer, lens.focus - lens.focus_farther}));
  }
  json->Set("aperture", lens.aperture);
  json->Set("highlights", task.config.highlights);
  constexpr const char* kTransfers[] = {"srgb", "none", "pq", "hlg"};
  json->Set("transfer", kTransfers[task.config.transfer]);
  json->Set("shape", ShapeJson(lens));
  json->Set("n_scale", task.config.tuning.n_scale);
  json->Set("r_max", result.report.r_max);
  json->Set("N", result.report.n);
  json->Set("rendered_views", result.report.rendered_views);
  json->Set("rendered_samples", result.report.rendered_samples);
  json->Set("superblock", result.report.superblock);
  json->Set("max_layer", task.config.tuning.max_layer);
  json->Set("deblocking", task.config.tuning.deblocking);
  json->Set("layers", LayersJson(result, task.params.study.mode == STARFOCUS_MODE_BLOCK));
  json->Set("copied_pixels", result.report.copied_pixels);
  json->Set("gathered_pixels", result.report.gathered_pixels);
  json->Set("touched", TouchedJson(task, result));
  json->Set("seconds_refocus", result.seconds);
  json->Set("workspace_bytes", result.workspace_bytes);
  json->Set("simd_target", starfocus_simd_target());
  json->Set("threads", task.threads);
}

}  // namespace

std::string ReportText(const EngineTask& task, const EngineResult& result, double seconds_total) {
  Json json;
  AddFigures(task, result, &json);
  json.Set("seconds_total", seconds_total);
  return json.Text(2) + "\n";
}

void SeriesReport::Add(const std::string& output, const EngineTask& task,
                       const EngineResult& result) {
  Json json;
  json.Set("output", output);
  AddFigures(task, result, &json);
  json.Set("prepared_bytes", result.prepared_bytes);
  const uint64_t blocks = Superblocks(task, result.report.superblock);
  json.Set("superblocks", blocks);
  json.Set("reused_blocks", result.report.reused_blocks);
  superblocks_ += blocks;
  reused_blocks_ += result.report.reused_blocks;
  pictures_.Add(std::move(json));
}

std::string SeriesReport::Text(double seconds_total) const {
  Json json;
  json.Set("pictures", pictures_);
  json.Set("superblocks", superblocks_);
  json.Set("reused_blocks", reused_blocks_);
  json.Set("seconds_total", seconds_total);
  return json.Text(2) + "\n";
}

}  // namespace starfocus
