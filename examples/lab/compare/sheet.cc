// SPDX-License-Identifier: Apache-2.0
// starfocus-lab sheet: arranges pictures with labels on a sheet.
#include <stb/stb_easy_font.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "examples/cli/pictures.h"
#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "examples/lab/commands.h"
#include "platform/image.h"
#include "platform/image_io.h"
#include "platform/text.h"

namespace starfocus {

// Height of a line of text in pixels, including its margins.
inline constexpr int kLabelHeight = 28;

// Draws `text` (ASCII) in light grey, clipped to the picture. The upper left corner of the text's
// margin is at (x, y).
void DrawLabel(const std::string& text, int x, int y, Image* image);

namespace {

constexpr int kScale = 2;  // scale of the font, whose letters are about 7 pixels high
constexpr int kMargin = 5;
constexpr uint8_t kGrey = 225;

struct Vertex {  // format of stb_easy_font
  float x, y, z;
  unsigned char color[4];
};

void Fill(int x0, int y0, int x1, int y1, Image* image) {
  x0 = std::clamp(x0, 0, image->width);
  x1 = std::clamp(x1, x0, image->width);
  for (int y = std::max(y0, 0); y < std::min(y1, image->height); ++y) {
    std::fill(image->row(y) + 3 * x0, image->row(y) + 3 * x1, kGrey);
  }
}

}  // namespace

void DrawLabel(const std::string& text, int x, int y, Image* image) {
  std::string ascii = text.substr(0, 200);
  for (char& c : ascii) c = c >= 32 && c < 127 ? c : '?';
  std::vector<Vertex> quads(4 * 40 * (ascii.size() + 1));
  const int count = stb_easy_font_print(0, 0, ascii.data(), nullptr, quads.data(),
                                        static_cast<int>(quads.size() * sizeof(Vertex)));
  for (int i = 0; i < count; ++i) {
    const Vertex& low = quads[size_t(4 * i)];
    const Vertex& high = quads[size_t(4 * i + 2)];
    Fill(x + kMargin + static_cast<int>(low.x * kScale),
         y + kMargin + static_cast<int>(low.y * kScale),
         x + kMargin + static_cast<int>(high.x * kScale),
         y + kMargin + static_cast<int>(high.y * kScale), image);
  }
}

namespace {

// starfocus-lab sheet: arranges pictures side by side.

constexpr int kGap = 8;

struct SheetOptions {
  std::string out;
  int width = 1600, zoom = 1;
  starfocus_region crop = {};
  std::vector<std::string> pictures, labels;
};

// Returns the part `crop` of a picture, with each pixel enlarged to a square of side `zoom`.
Image Cut(const Image& picture, const starfocus_region& crop, int zoom) {
  Image part(crop.width * zoom, crop.height * zoom);
  for (int y = 0; y < part.height; ++y) {
    const uint8_t* const from = picture.row(crop.y + y / zoom);
    for (int x = 0; x < part.width; ++x) {
      std::copy_n(from + 3 * (crop.x + x / zoom), 3, part.row(y) + 3 * x);
    }
  }
  return part;
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
    starfocus_region crop = options.crop;
    if (crop.width == 0) crop = {0, 0, picture->width, picture->height};
    if (crop.x + int64_t{crop.width} > picture->width ||
        crop.y + int64_t{crop.height} > picture->height) {
      return Error::Usage("--crop", "a rectangle within the picture " + path,
                          "a picture of " + SizeText(picture->width, picture->height));
    }
    cells.push_back(Shrink(Cut(*picture, crop, options.zoom), cell_width));
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
              {"--crop", "X,Y,W,H", "Rectangle to show of each picture; default: the whole picture",
               Region(&options->crop)},
              {"--zoom", "N", "Width and height of a pixel of the pictures on the sheet, 1 to 16",
               Whole(1, 16, &options->zoom), Use::kDefault},
              {"--width", "N", "Largest width of the sheet in pixels, 16 to 16384",
               Whole(16, 16384, &options->width), Use::kDefault},
          },
          [options] { return Run(*options); },
          {"starfocus-lab sheet a.png b.png -o sheet.png",
           "starfocus-lab sheet a.png b.png -o sheet.jpg --labels before,after --width 1200"}};
}

}  // namespace starfocus
