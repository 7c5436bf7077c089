// SPDX-License-Identifier: Apache-2.0
// starfocus-lab sheet: arranges pictures side by side.
#include <algorithm>
#include <memory>
#include <vector>

#include "examples/cli/pictures/shrink.h"
#include "examples/command_line/options.h"
#include "examples/command_line/outputs.h"
#include "examples/lab/commands.h"
#include "examples/lab/sheet/label.h"
#include "platform/image_io.h"

namespace starfocus {
namespace {

constexpr int kGap = 8;

struct SheetOptions {
  std::string out;
  int width = 1600;
  std::vector<std::string> pictures, labels;
};

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

Error Run(const SheetOptions& options) {
  if (Error error = CheckImageOutput(options.out)) return error;
  if (Error error = CheckApart({{"--output", options.out}}, {{}, options.pictures})) return error;
  const int count = static_cast<int>(options.pictures.size());
  const int cell_width = (options.width - kGap) / count - kGap;
  if (cell_width < 1) {
    return Error::Usage("--width",
                        "at least " + std::to_string(count * (kGap + 1) + kGap) + " pixels",
                        std::to_string(options.width));
  }
  if (!options.labels.empty() && options.labels.size() != options.pictures.size()) {
    return Error::Usage("--labels", std::to_string(count) + " labels, one for each picture",
                        std::to_string(options.labels.size()));
  }
  std::vector<Image> cells;
  for (const std::string& path : options.pictures) {
    const Result<Image> picture = ReadImage(path);
    if (!picture) return picture.error();
    cells.push_back(Shrink(*picture, cell_width));
  }
  return WriteImage(options.out, Arrange(cells, options.labels));
}

}  // namespace

Command SheetCommand() {
  const auto options = std::make_shared<SheetOptions>();
  return {"sheet",
          "Arrange pictures side by side on a sheet",
          {
              {"-o,--output", "FILE", "Sheet to write: .png, .ppm, .jpg or .webp", &options->out,
               Use::kRequired},
              {"IMG", "FILE", "Pictures, from left to right", &options->pictures, Use::kRequired},
              {"--labels", "A,B,...", "Text below each picture, separated by commas; default: none",
               &options->labels, Use::kCommaSeparated},
              {"--width", "N", "Largest width of the sheet in pixels, 16 to 16384",
               Whole(16, 16384, &options->width), Use::kDefault},
          },
          [options] { return Run(*options); },
          {"starfocus-lab sheet a.png b.png -o sheet.png",
           "starfocus-lab sheet a.png b.png -o sheet.jpg --labels before,after --width 1200"}};
}

}  // namespace starfocus
