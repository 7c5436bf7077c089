// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/view/page.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "examples/cli/pictures/shrink.h"
#include "examples/cli/view/legend.h"
#include "examples/cli/view/slider.h"
#include "examples/command_line/options.h"
#include "platform/base64.h"
#include "platform/standard_stream.h"
#include "platform/text.h"
#include "platform/writers/jpeg.h"

namespace starfocus {
namespace {

constexpr int kQuality = 88;
// Width of a bar and height of the histogram, in units of the viewBox.
constexpr int kBarWidth = 20, kBarsHeight = 200;

// CSS rules of every page. Text has a contrast of at least 7 : 1 on light and on dark backgrounds.
constexpr char kStyle[] =
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
    ".picture { position: relative; } .mark { position: absolute; width: 1.2rem; height: 1.2rem; "
    "transform: translate(-50%, -50%); border: 3px solid #fff; border-radius: 50%; "
    "box-shadow: 0 0 0 2px #000, inset 0 0 0 2px #000; }\n";

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

// Returns an <img> element that contains the picture.
Result<std::string> Embed(const std::string& path, const std::string& says, const Image& picture,
                          const Bytes& icc) {
  const Result<Bytes> jpeg = EncodeJpeg(path, picture, kQuality, {{}, icc}, {});
  if (!jpeg) return jpeg.error();
  return "<img width=\"" + std::to_string(picture.width) + "\" height=\"" +
         std::to_string(picture.height) + "\" alt=\"" + EscapeXml(says) +
         "\" src=\"data:image/jpeg;base64," + EncodeBase64(*jpeg) + "\">";
}

std::string Mark(const std::optional<PagePlace>& place) {
  if (!place) return "";
  return "<span class=\"mark\" style=\"left: " + Decimal(100 * place->x, 3) +
         "%; top: " + Decimal(100 * place->y, 3) + "%\"></span>";
}

}  // namespace

Page::Page(const std::string& path, const Bytes& icc)
    : title_(EscapeXml(
          std::filesystem::path(InputName(path) + "/").parent_path().filename().string())),
      style_(std::string(kStyle) + kLegendStyle),
      body_("<h1>" + title_ + "</h1>\n"),
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
    const Result<std::string> embedded =
        Embed(path, figure.says, small, figure.legend.empty() ? icc_ : Bytes());
    if (!embedded) return embedded.error();
    body_ += "<figure style=\"max-width: " + std::to_string(small.width) +
             "px\"><div class=\"picture\">" + *embedded + Mark(figure.mark) + "</div>" +
             figure.legend + "<figcaption>" + EscapeXml(figure.caption) +
             "</figcaption></figure>\n";
  }
  body_ += "</div>\n</section>\n";
  return {};
}

Error Page::AddSlider(const std::string& path, const PageFigure& before, const PageFigure& after) {
  const Result<std::string> one = Embed(path, before.says, before.picture, icc_);
  if (!one) return one.error();
  const Result<std::string> two = Embed(path, after.says, after.picture, icc_);
  if (!two) return two.error();
  style_ += kSliderStyle;
  script_ = kSliderScript;
  body_ += SliderHtml(*one, *two, before.picture.width, before.picture.height);
  return {};
}

void Page::AddHistogram(const std::string& heading, const std::vector<int64_t>& counts,
                        const starfocus_disparity_stats& stats) {
  const auto bars = static_cast<int>(counts.size());
  const int64_t most = std::max<int64_t>(1, *std::max_element(counts.begin(), counts.end()));
  const auto edge = [&](int bar) {
    return Decimal(stats.min + (double(stats.max) - stats.min) * bar / bars, 2);
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
  // The content security policy blocks all loading, even if a file name contains HTML. Pictures,
  // style and script are embedded in the page.
  const std::string policy =
      std::string("default-src 'none'; img-src data:; style-src 'unsafe-inline'") +
      (script_.empty() ? "" : std::string("; script-src '") + kSliderScriptHash + "'");
  const std::string script = script_.empty() ? "" : "<script>" + script_ + "</script>\n";
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + title_ +
         "</title>\n<meta http-equiv=\"Content-Security-Policy\" content=\"" + policy +
         "\">\n<meta name=\"viewport\" content=\"width=device-width, "
         "initial-scale=1\">\n<style>\n" +
         style_ + "</style>\n</head>\n<body>\n<main>\n" + body_ + "</main>\n" + script +
         "</body>\n</html>\n";
}

}  // namespace starfocus
