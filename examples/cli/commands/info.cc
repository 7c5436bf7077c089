// SPDX-License-Identifier: Apache-2.0
// starfocus info: prints the contents of a light field or depth photo, and how the program
// interprets these contents.
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/estimate_run.h"
#include "examples/cli/input.h"
#include "examples/cli/json.h"
#include "examples/command_line/options.h"
#include "platform/console.h"
#include "platform/light_field.h"
#include "platform/text.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

constexpr int kBins = 16;
constexpr int kBarLength = 50;

struct InfoOptions {
  InputOptions input;
  bool json = false;
};

double BinEdge(const starfocus_disparity_stats& stats, int bin) {
  return stats.min + (double(stats.max) - stats.min) * bin / kBins;
}

void PrintRow(const std::string& name, const std::string& value) {
  constexpr size_t kNameColumns = 10;
  const std::string space(kNameColumns - std::min(kNameColumns, name.size()), ' ');
  PrintLine("  " + name + space + " " + value);
}

void PrintText(const Capture& capture, const starfocus_disparity_stats& stats,
               const std::vector<int64_t>& counts) {
  const LightField& light_field = capture.light_field;
  std::string views = std::to_string(light_field.views.size()) + " views";
  if (!AreStar(light_field.positions)) {
    views += " at";
    for (const starfocus_position& at : light_field.positions) {
      views += " (" + Short(at.u) + ", " + Short(at.v) + ")";
    }
  }
  PrintLine(capture.path);
  PrintRow("format", capture.format);
  for (const auto& fact : FactsOf(capture)) PrintRow(fact.first, fact.second);
  const Image& view = light_field.views[0];
  PrintRow("size", SizeText(view.width, view.height) + " pixels");
  PrintRow("views", views);
  if (light_field.disparity.values.empty()) {
    return PrintRow("disparity", "no map, and none can be estimated from these views");
  }
  PrintRow("disparity", Short(stats.min) + " to " + Short(stats.max) + " pixels per unit u, " +
                            std::to_string(stats.invalid) + " invalid");
  const int64_t most = std::max<int64_t>(1, *std::max_element(counts.begin(), counts.end()));
  for (int bin = kBins - 1; bin >= 0; --bin) {
    const int64_t count = counts[size_t(bin)];
    const int length = static_cast<int>((count * kBarLength + most - 1) / most);
    char bounds[80];
    std::snprintf(bounds, sizeof(bounds), "%9.3f to %9.3f %9lld ", BinEdge(stats, bin),
                  BinEdge(stats, bin + 1), static_cast<long long>(count));
    PrintLine(bounds + std::string(size_t(length), '#'));
  }
}

void PrintJson(const Capture& capture, const starfocus_disparity_stats& stats,
               const std::vector<int64_t>& counts) {
  Json json = Describe(capture);
  if (!capture.light_field.disparity.values.empty()) {
    json.Set("disparity_min", stats.min);
    json.Set("disparity_max", stats.max);
    json.Set("invalid", stats.invalid);
    Json histogram;
    for (const int64_t count : counts) histogram.Add(count);
    json.Set("histogram", std::move(histogram));
  }
  PrintLine(json.Text());
}

// Returns true if the input has a map, or several views from which a map can be estimated.
bool HasMap(const Capture& capture) {
  return !capture.map_path.empty() || capture.files.size() > 1;
}

Error Run(const InfoOptions& options) {
  Result<Capture> opened = ReadInput(options.input);
  if (!opened) return opened.error();
  Capture& capture = *opened;
  TellNotes(capture);
  if (Error error = HasMap(capture) ? LoadInput({}, 1, &capture) : LoadCapture({}, &capture))
    return error;
  const FloatMap& map = capture.light_field.disparity;
  const starfocus_disparity_stats stats = MeasureDisparity(map);
  const std::vector<int64_t> counts = Histogram(map, stats, kBins);
  if (options.json) {
    PrintJson(capture, stats, counts);
  } else {
    PrintText(capture, stats, counts);
  }
  return {};
}

}  // namespace

Command InfoCommand() {
  const auto options = std::make_shared<InfoOptions>();
  Command command = {"info",
                     "Describe a light field or photo: format, size and disparities",
                     {},
                     [options] { return Run(*options); },
                     {"starfocus info photo.jpg", "starfocus info lf --json"},
                     "",
                     {{"Input and output",
                       {{"SRC", "Photo with depth, or light-field folder"},
                        {"--depth", "Depth picture of the photo, if it is a separate file"},
                        {"--matte", "Matte of the subject, for a photo without depth"},
                        {"--json", "Print JSON instead of text"}}}}};
  AddInputOptions(&command, &options->input);
  AddRightOption(&command, &options->input);
  AddCoverageOption(&command, &options->input);
  AddOptions(
      {
          {"--json", nullptr,
           "Print JSON instead of text; the bins of the histogram run from the smallest "
           "to the largest disparity",
           &options->json},
      },
      &command);
  return command;
}

}  // namespace starfocus
