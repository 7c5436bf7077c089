// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/sheet/label.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <vector>

namespace starfocus {
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

}  // namespace starfocus
