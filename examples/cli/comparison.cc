// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>

#include "examples/cli/estimate_run.h"
#include "examples/cli/lens_options.h"
#include "examples/cli/pictures.h"
#include "examples/cli/refocus_output.h"
#include "examples/cli/refocus_plan.h"
#include "examples/command_line/options.h"
#include "platform/base64.h"
#include "platform/file.h"
#include "platform/standard_stream.h"
#include "platform/text.h"
#include "platform/writers/jpeg.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.hpp"

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

// The range input is invisible and covers the pictures, so that mouse, touch and keyboard work as
// for every range input. The input extends by half the width of its thumb, 22 pixels, beyond both
// sides of the pictures. The centre of the thumb is therefore exactly at the divider.
const char kSliderStyle[] =
    ".slider { --at: 50%; position: relative; margin-bottom: 1rem; }\n"
    ".slider img { width: 100%; } .after { position: absolute; inset: 0; "
    "clip-path: inset(0 0 0 var(--at)); }\n"
    ".tag { position: absolute; top: .5rem; left: .5rem; padding: .1rem .6rem; "
    "border-radius: 1rem; background: #000c; color: #fff; } .after .tag { left: auto; "
    "right: .5rem; }\n"
    ".slider input { position: absolute; top: 0; left: -22px; width: calc(100% + 44px); "
    "height: 100%; margin: 0; opacity: 0; cursor: ew-resize; touch-action: pan-y; "
    "appearance: none; -webkit-appearance: none; }\n"
    ".slider input::-webkit-slider-thumb { -webkit-appearance: none; width: 44px; height: 100vh; "
    "}\n"
    ".slider input::-moz-range-thumb { width: 44px; height: 100%; border: 0; }\n"
    ".divider { position: absolute; top: 0; bottom: 0; left: var(--at); width: 4px; "
    "margin-left: -2px; background: #fff; box-shadow: 0 0 0 1px #0008; pointer-events: none; }\n"
    ".divider::after { content: '\\2194'; position: absolute; top: 50%; left: 50%; width: 44px; "
    "height: 44px; transform: translate(-50%, -50%); border-radius: 50%; background: #fff; "
    "color: #111; font: 24px/44px system-ui, sans-serif; text-align: center; "
    "box-shadow: 0 0 0 1px #0008; }\n"
    ".slider input:focus-visible + .divider::after { outline: 4px solid #1d6fe0; "
    "outline-offset: 2px; box-shadow: 0 0 0 2px #fff, 0 0 0 7px #fff; }\n";

const char kSliderScript[] =
    "for (const input of document.querySelectorAll('.slider input')) {\n"
    "  const move = () => input.parentElement.style.setProperty('--at', input.value + '%');\n"
    "  input.addEventListener('input', move);\n"
    "  move();\n"
    "}\n";

const char kSliderScriptHash[] = "sha256-zIS2m6OEF+AKdy0refatAylTp/9YswseUnOo2HqNM/Y=";

std::string SliderHtml(const std::string& before, const std::string& after, int width, int height) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  // The slider is at most as high as the window, so that all of the pictures are visible.
  return "<div class=\"slider\" style=\"max-width: min(" + w + "px, 92vh * " + w + " / " + h +
         ")\">\n" + before + "<span class=\"tag\">Before</span>\n<div class=\"after\">" + after +
         "<span class=\"tag\">After</span></div>\n<input type=\"range\" min=\"0\" max=\"100\" "
         "step=\"any\" "
         "value=\"50\" aria-label=\"Divider: the picture before is left of it, and the picture "
         "after is right of it\">\n<div class=\"divider\"></div>\n</div>\n";
}

namespace {

constexpr int kSliderSide = 1600, kFigureSide = 600;  // Largest sides of pictures in pixels.
constexpr uint8_t kFocusColor[3] = {255, 140, 0};
constexpr int kFocusPercent = 60;  // Share of kFocusColor in the tint of pixels in focus.

// Returns the disparities that a lens does not blur.
FocusBand BandOf(const starfocus::Params& lens) {
  return {lens.focus - lens.focus_farther, lens.focus + lens.focus_nearer};
}

// Returns true if a lens blurs a disparity by at most `radius` pixels.
bool IsSharp(const starfocus::Params& lens, double disparity, double radius) {
  const FocusBand band = BandOf(lens);
  return lens.aperture * std::max(band.far - disparity, disparity - band.near) <= radius;
}

// Draws the picture in grey, with the pixels in focus tinted. `map` has the size of the picture.
Image DrawFocus(const Image& picture, const FloatMap& map, const starfocus::Params& lens,
                double radius) {
  Image drawn = picture;
  for (size_t i = 0; i < map.values.size(); ++i) {
    const bool sharp = IsSharp(lens, double(map.values[i]), radius);
    Tint(kFocusColor, sharp ? kFocusPercent : 0, &drawn.pixels[3 * i]);
  }
  return drawn;
}

void AddLens(const Refocused& refocused, double radius, Page* page) {
  const starfocus::Params& lens = refocused.task->params;
  const FloatMap& map = refocused.task->light_field->disparity;
  const auto sharp = std::count_if(map.values.begin(), map.values.end(), [&](float disparity) {
    return IsSharp(lens, double(disparity), radius);
  });
  const FocusBand band = BandOf(lens);
  std::string focus = "disparity " + Decimal(band.far, 2);
  if (band.near > band.far) focus += " to " + Decimal(band.near, 2);
  if (refocused.at) {
    focus +=
        ", at pixel " + std::to_string(refocused.at->x) + "," + std::to_string(refocused.at->y);
  }
  const std::string f_stop =
      lens.aperture > 0 ? "f/" + Decimal(refocused.widest / lens.aperture, 1) + ", " : "";
  page->AddTable(
      {{"Focus", focus},
       {"Aperture", f_stop + "radius " + Decimal(lens.aperture, 3)},
       {"In focus", Decimal(100.0 * double(sharp) / double(map.values.size()), 1) +
                        " % of the pixels, blurred by at most " + Decimal(radius, 1) + " pixels"}});
}

}  // namespace

Error WriteComparison(const std::string& path, const Refocused& refocused, const Bytes& icc) {
  const LightField& light_field = *refocused.task->light_field;
  const starfocus::Params& lens = refocused.task->params;
  const Image& before = light_field.views[0];
  const starfocus_disparity_stats stats = MeasureDisparity(light_field.disparity);
  const double radius = SharpRadius(before.width, before.height);
  const Image small = Shrink(before, kFigureSide, kFigureSide);
  const FloatMap map = SampleMap(light_field.disparity, small.width, small.height);
  std::optional<PagePlace> mark;
  if (refocused.at) {
    mark =
        PagePlace{(refocused.at->x + 0.5) / before.width, (refocused.at->y + 0.5) / before.height};
  }
  const std::string ring = mark ? "; the ring marks the focused pixel" : "";
  Page page(refocused.input, icc);
  Error error = page.AddSlider(
      path, {"The picture before, sharp everywhere", "", Shrink(before, kSliderSide, kSliderSide)},
      {"The refocused picture", "", Shrink(*refocused.picture, kSliderSide, kSliderSide)});
  if (error) return error;
  AddLens(refocused, radius, &page);
  error = page.AddFigures(path, "Depth and focus",
                          {{"The disparity map in colours", "Disparity in pixels" + ring,
                            DrawDepth(map, stats), mark, LegendHtml(stats, BandOf(lens))},
                           {"The picture in grey, with the pixels in focus in orange",
                            "In focus: orange" + ring, DrawFocus(small, map, lens, radius), mark}},
                          kFigureSide);
  return error ? error : WriteText(path, page.Html());
}

namespace {

std::string Gradient() {
  std::string colors;
  for (const uint8_t* color : kDepthColors) {
    colors += ", rgb(" + std::to_string(color[0]) + " " + std::to_string(color[1]) + " " +
              std::to_string(color[2]) + ")";
  }
  return "linear-gradient(to right" + colors + ")";
}

}  // namespace

const char kLegendStyle[] =
    ".legend { margin-top: .6rem; } .bar { position: relative; height: 1rem; }\n"
    ".plane { position: absolute; top: -.3rem; bottom: -.3rem; margin-left: -2.5px; "
    "box-sizing: border-box; border: 2.5px solid var(--text); outline: 2px solid var(--ground); }\n"
    ".ends { display: flex; justify-content: space-between; gap: 1rem; padding-top: .4rem; "
    "font-variant-numeric: tabular-nums; }\n";

std::string LegendHtml(const starfocus_disparity_stats& stats, std::optional<FocusBand> focus) {
  const std::string far = "far " + Decimal(stats.min, 2), near = "near " + Decimal(stats.max, 2);
  std::string says = "Colours of disparity: " + far + ", " + near, plane, label;
  if (focus) {
    const double range = double(stats.max) - stats.min;
    const auto place = [&](double disparity) {
      return range > 0 ? 100 * std::clamp((disparity - stats.min) / range, 0.0, 1.0) : 50.0;
    };
    label = "focus " + Decimal(focus->far, 2);
    if (focus->near > focus->far) label += " to " + Decimal(focus->near, 2);
    says += ", " + label;
    const double begin = place(focus->far), width = place(focus->near) - begin;
    plane = "<span class=\"plane\" style=\"left: " + Decimal(begin, 2) + "%; width: calc(" +
            Decimal(width, 2) + "% + 5px)\"></span>";
    label = "<span>" + label + "</span>";
  }
  return "<div class=\"legend\" role=\"img\" aria-label=\"" + EscapeXml(says) +
         "\"><div class=\"bar\" style=\"background: " + Gradient() + "\">" + plane +
         "</div><div class=\"ends\"><span>" + far + "</span>" + label + "<span>" + near +
         "</span></div></div>";
}

namespace {

namespace fs = std::filesystem;

// Parses truth_dt<D>_ut<U>.png. Returns nullopt for a name with a suffix, which denotes an aperture
// shape other than the default.
std::optional<LensAt> ParseTruthName(const fs::path& name) {
  const std::string stem = name.stem().string();
  LensAt lens;
  int end = 0;
  const int parts =
      std::sscanf(stem.c_str(), "truth_dt%lf_ut%lf%n", &lens.focus, &lens.aperture, &end);
  const bool whole = parts == 2 && size_t(end) == stem.size() && name.extension() == ".png";
  if (!whole || std::fabs(lens.focus) > STARFOCUS_MAX_FOCUS) return {};
  return lens.aperture > 0 && lens.aperture <= 1 ? std::optional(lens) : std::nullopt;
}

// Returns the transfer of the folder's pictures. If the file meta.txt contains "transfer: none",
// the pictures are averages of encoded values instead of linear light.
starfocus_transfer TransferOf(const std::string& folder) {
  const Result<Bytes> bytes = ReadSmallFile((fs::path(folder) / "meta.txt").string());
  const std::string text(bytes->begin(), bytes->end());
  return text.find("transfer: none\n") != std::string::npos ? STARFOCUS_TRANSFER_NONE
                                                            : STARFOCUS_TRANSFER_SRGB;
}

}  // namespace

std::vector<double> StripFoci(const FloatMap& map, int count) {
  std::vector<float> values;
  std::copy_if(map.values.begin(), map.values.end(), std::back_inserter(values),
               [](float value) { return std::isfinite(value); });
  if (values.empty()) return {0};
  const auto at = [&values](size_t place) {
    const auto middle = values.begin() + static_cast<ptrdiff_t>(place);
    std::nth_element(values.begin(), middle, values.end());
    return double(*middle);
  };
  const size_t outermost = values.size() / 100;
  const double far = at(outermost), near = at(values.size() - 1 - outermost);
  if (near - far < 1e-3) return {far};
  std::vector<double> foci;
  for (int i = 0; i < count; ++i) foci.push_back(far + (near - far) * i / (count - 1));
  return foci;
}

double BlurOf(const LensAt& lens, const starfocus_disparity_stats& stats) {
  return lens.aperture * FarthestFromFocus(stats, {lens.focus});
}

std::vector<TruthFile> FindTruths(const std::string& folder) {
  std::vector<TruthFile> truths;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::optional<LensAt> lens = ParseTruthName(entry.path().filename());
    if (lens) truths.push_back({entry.path().string(), *lens});
  }
  std::sort(truths.begin(), truths.end(),
            [](const TruthFile& a, const TruthFile& b) { return a.path < b.path; });
  return truths;
}

Error RefocusEach(
    const std::string& where, const LightField& light_field, const starfocus_disparity_stats& stats,
    int threads, const std::vector<LensAt>& lenses,
    const std::function<Error(size_t, const Image&, const std::vector<starfocus_block>&)>& show) {
  LensOptions options;
  options.transfer = TransferOf(where);
  Result<LensPlan> plan = PlanLens(options);
  if (!plan) return plan.error();
  double max_blur = 1;
  for (const LensAt& lens : lenses) {
    max_blur = std::max(max_blur, std::ceil(BlurOf(lens, stats)));
    plan->foci.push_back(lens.focus);
  }
  EngineTask task = MakeTask(*plan, light_field, stats, max_blur, false);
  std::vector<starfocus_block> blocks;
  task.threads = threads;
  task.observer.on_block = CollectBlock;
  task.observer.on_block_data = &blocks;
  EngineRun run(threads, static_cast<int>(lenses.size()));
  Error error = run.Start(where, task);
  if (!error) error = run.Prepare(where, task);
  for (size_t i = 0; i < lenses.size() && !error; ++i) {
    task.params.focus = lenses[i].focus;
    task.params.aperture = lenses[i].aperture;
    blocks.clear();
    EngineResult result;
    error = run.Refocus(where, task).MoveTo(&result);
    if (!error) error = show(i, result.picture, blocks);
  }
  return error;
}

}  // namespace starfocus
