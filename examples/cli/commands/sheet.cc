// SPDX-License-Identifier: Apache-2.0
// starfocus sheet: pictures side by side.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/sheet/label.h"
#include "examples/command_line/options.h"
#include "examples/command_line/outputs.h"
#include "platform/image_io.h"

namespace starfocus {
namespace {

constexpr int kGap = 8;

struct Options {
  std::string out, width = "1600";
  std::vector<std::string> pictures, labels;
};

// How much of source sample `source` lies in target sample `target`, in units of 1/targets.
int64_t Overlap(int64_t source, int64_t target, int64_t sources, int64_t targets) {
  const int64_t low = std::max(source * targets, target * sources);
  const int64_t high = std::min((source + 1) * targets, (target + 1) * sources);
  return std::max<int64_t>(0, high - low);
}

// Averages the box of the source that (x, y) of the target covers.
void BoxPixel(const Image& source, int x, int y, Image* target) {
  const int64_t sw = source.width, sh = source.height, tw = target->width, th = target->height;
  int64_t sum[3] = {0, 0, 0};
  for (int64_t j = y * sh / th; j < sh && j * th < (y + 1) * sh; ++j) {
    for (int64_t i = x * sw / tw; i < sw && i * tw < (x + 1) * sw; ++i) {
      const int64_t weight = Overlap(i, x, sw, tw) * Overlap(j, y, sh, th);
      const uint8_t* pixel = source.row(static_cast<int>(j)) + 3 * i;
      for (int c = 0; c < 3; ++c) sum[c] += weight * pixel[c];
    }
  }
  for (int c = 0; c < 3; ++c) {
    target->row(y)[3 * x + c] = static_cast<uint8_t>((sum[c] + sw * sh / 2) / (sw * sh));
  }
}

// Scales a picture that is wider than `width` down to it.
Image Shrink(const Image& source, int width) {
  if (source.width <= width) return source;
  const int64_t height = int64_t(source.height) * width / source.width;
  Image target(width, static_cast<int>(std::max<int64_t>(1, height)));
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; ++x) BoxPixel(source, x, y, &target);
  }
  return target;
}

Image Arrange(const std::vector<Image>& cells, const std::vector<std::string>& labels) {
  int width = kGap, height = 0;
  for (const Image& cell : cells) {
    width += cell.width + kGap;
    height = std::max(height, cell.height);
  }
  const int below = labels.empty() ? 0 : kLabelHeight;
  Image sheet(width, height + 2 * kGap + below);
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), uint8_t{24});
  int x = kGap;
  for (size_t i = 0; i < cells.size(); ++i) {
    for (int y = 0; y < cells[i].height; ++y) {
      std::copy_n(cells[i].row(y), cells[i].stride(), sheet.row(y + kGap) + 3 * x);
    }
    if (!labels.empty()) DrawLabel(labels[i], x, height + kGap, &sheet);
    x += cells[i].width + kGap;
  }
  return sheet;
}

Error Run(const Options& options) {
  Error error = CheckImageOutput(options.out);
  if (error.empty()) error = CheckApart({{"--output", options.out}}, {{}, options.pictures});
  if (!error.empty()) return error;
  const int count = static_cast<int>(options.pictures.size());
  int width = 0;
  error = ParseWhole("--width", options.width, 16, 16384, &width);
  if (!error.empty()) return error;
  const int cell_width = (width - kGap) / count - kGap;
  if (cell_width < 1) {
    return Error::Usage("--width", "at least " + std::to_string(count * (kGap + 1) + kGap),
                        options.width);
  }
  if (!options.labels.empty() && options.labels.size() != options.pictures.size()) {
    return Error::Usage("--labels", std::to_string(count) + " labels, one for each picture",
                        std::to_string(options.labels.size()));
  }
  std::vector<Image> cells;
  for (const std::string& path : options.pictures) {
    Image picture;
    error = ReadImage(path, &picture);
    if (!error.empty()) return error;
    cells.push_back(Shrink(picture, cell_width));
  }
  return WriteImage(options.out, Arrange(cells, options.labels));
}

}  // namespace

void AddSheetCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("sheet", "A contact sheet of pictures side by side");
  command->add_option("-o,--output", options->out, "Picture to write: .png, .ppm or .jpg")
      ->type_name("FILE")
      ->required();
  command->add_option("IMG", options->pictures, "Pictures, from left to right")
      ->type_name("FILE")
      ->required();
  command->add_option("--labels", options->labels, "A,B,...: text below each picture")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--width", options->width, "Largest width of the sheet")
      ->capture_default_str();
  command->callback([options, action] { *action = [options] { return Run(*options); }; });
}

}  // namespace starfocus
