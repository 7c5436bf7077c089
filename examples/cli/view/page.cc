// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/view/page.h"

#include <algorithm>
#include <cstdio>

#include "examples/cli/pictures/shrink.h"
#include "examples/command_line/options.h"
#include "platform/base64.h"
#include "platform/text.h"
#include "platform/writers/jpeg.h"

namespace starfocus {
namespace {

constexpr int kQuality = 88;
// Width of a bar and height of the histogram, in units of the viewBox.
constexpr int kBarWidth = 20, kBarsHeight = 200;

// Start of the HTML page. The content security policy blocks all loading, even if a file name
// contains HTML. Pictures and style are embedded in the page. Text has a contrast of at least 7 : 1
// on light and on dark backgrounds.
constexpr char kHead[] =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
    "style-src 'unsafe-inline'\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<style>\n"
    ":root { color-scheme: light dark; --ground: #fff; --text: #1b1b1b; --soft: #4a4a4a; "
    "--bar: #1d4f91; --line: #c8c8c8; }\n"
    "@media (prefers-color-scheme: dark) { :root { --ground: #16181b; --text: #f0f0f0; "
    "--soft: #c0c4c8; --bar: #8ab8ff; --line: #45494e; } }\n"
    "body { margin: 0 auto; max-width: 80rem; padding: 1rem 1.5rem 3rem; "
    "font: 1rem/1.5 system-ui, sans-serif; background: var(--ground); color: var(--text); }\n"
    "h1 { font-size: 1.5rem; overflow-wrap: anywhere; } h2 { font-size: 1.15rem; "
    "margin-top: 2rem; }\n"
    ".figures { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; }\n"
    "figure { margin: 0; } img { display: block; max-width: 100%; height: auto; }\n"
    "figcaption { color: var(--soft); padding-top: .3rem; }\n"
    "table { border-collapse: collapse; } th, td { padding: .2rem 1rem .2rem 0; "
    "text-align: left; font-weight: normal; border-bottom: 1px solid var(--line); }\n"
    "td { font-variant-numeric: tabular-nums; } th { color: var(--soft); }\n"
    "svg { width: 100%; max-width: 48rem; height: auto; } rect { fill: var(--bar); }\n"
    "svg text { fill: var(--text); font-size: 14px; } svg line { stroke: var(--soft); }\n"
    "</style>\n";

std::string Row(const std::string& name, const std::string& value) {
  return "<tr><th scope=\"row\">" + EscapeXml(name) + "</th><td>" + EscapeXml(value) +
         "</td></tr>\n";
}

std::string Bar(int bar, int64_t count, int64_t most) {
  const auto height = static_cast<int>((count * kBarsHeight + most - 1) / most);
  char text[120];
  std::snprintf(text, sizeof(text), "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"/>\n",
                bar * kBarWidth + 1, kBarsHeight - height, kBarWidth - 2, height);
  return text;
}

}  // namespace

Page::Page(const std::string& title, const Bytes& icc)
    : head_("<meta charset=\"utf-8\">\n<title>" + EscapeXml(title) + "</title>\n" + kHead),
      body_("<h1>" + EscapeXml(title) + "</h1>\n"),
      icc_(icc) {}

void Page::AddTable(const std::vector<std::pair<std::string, std::string>>& rows) {
  body_ += "<table>\n";
  for (const auto& [name, value] : rows) body_ += Row(name, value);
  body_ += "</table>\n";
}

Error Page::AddFigures(const std::string& path, const std::string& heading,
                       const std::vector<PageFigure>& figures, int width) {
  body_ += "<section>\n<h2>" + EscapeXml(heading) + "</h2>\n<div class=\"figures\">\n";
  for (const PageFigure& figure : figures) {
    const Image small = Shrink(figure.picture, width);
    const Result<Bytes> jpeg = EncodeJpeg(path, small, kQuality, {{}, icc_}, {});
    if (!jpeg) return jpeg.error();
    body_ += "<figure style=\"max-width: " + std::to_string(small.width) + "px\"><img width=\"" +
             std::to_string(small.width) + "\" height=\"" + std::to_string(small.height) +
             "\" alt=\"" + EscapeXml(figure.says) + "\" src=\"data:image/jpeg;base64," +
             EncodeBase64(*jpeg) + "\"><figcaption>" + EscapeXml(figure.caption) +
             "</figcaption></figure>\n";
  }
  body_ += "</div>\n</section>\n";
  return {};
}

void Page::AddHistogram(const std::string& heading, const std::vector<int64_t>& counts,
                        const starfocus_disparity_stats& stats) {
  const auto bars = static_cast<int>(counts.size());
  const int64_t most = std::max<int64_t>(1, *std::max_element(counts.begin(), counts.end()));
  const auto edge = [&](int bar) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.2f",
                  stats.min + (double(stats.max) - stats.min) * bar / bars);
    return std::string(text);
  };
  const std::string width = std::to_string(bars * kBarWidth), axis = std::to_string(kBarsHeight);
  body_ += "<section>\n<h2>" + EscapeXml(heading) + "</h2>\n<svg viewBox=\"0 0 " + width + " " +
           std::to_string(kBarsHeight + 24) +
           "\" role=\"img\" aria-label=\"Pixels by disparity, from " + edge(0) +
           ", the farthest, to " + edge(bars) + ", the nearest; the numbers are in the table\">\n";
  std::string rows;
  for (int bar = 0; bar < bars; ++bar) {
    const int64_t count = counts[size_t(bar)];
    body_ += Bar(bar, count, most);
    rows += Row(edge(bar) + " to " + edge(bar + 1), std::to_string(count));
  }
  const std::string text_y = "\" y=\"" + std::to_string(kBarsHeight + 18) + "\"";
  body_ += "<line x1=\"0\" y1=\"" + axis + "\" x2=\"" + width + "\" y2=\"" + axis +
           "\"/>\n<text x=\"0" + text_y + ">" + edge(0) + " (far)</text>\n<text x=\"" + width +
           text_y + " text-anchor=\"end\">" + edge(bars) +
           " (near)</text>\n</svg>\n<details><summary>The numbers</summary>\n<table>\n<tr><th "
           "scope=\"col\">Disparity</th><th scope=\"col\">Pixels</th></tr>\n" +
           rows + "</table>\n</details>\n</section>\n";
}

std::string Page::Html() const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n" + head_ + "</head>\n<body>\n<main>\n" +
         body_ + "</main>\n</body>\n</html>\n";
}

}  // namespace starfocus
