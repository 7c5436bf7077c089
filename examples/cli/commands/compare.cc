// SPDX-License-Identifier: Apache-2.0
// starfocus compare: how much two pictures differ.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>

#include "examples/cli/commands.h"
#include "platform/image_io.h"

namespace starfocus {
namespace {

struct Options {
  std::string first, second;
  bool json = false;
};

struct Difference {
  uint64_t squares = 0;  // sum over all samples
  int largest = 0;
};

Difference Measure(const Image& a, const Image& b) {
  Difference difference;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const int d = std::abs(int{a.pixels[i]} - int{b.pixels[i]});
    difference.squares += uint64_t(d) * uint64_t(d);
    if (d > difference.largest) difference.largest = d;
  }
  return difference;
}

std::string SizeText(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

Error Run(const Options& options) {
  Image a, b;
  Error error = ReadImage(options.first, &a);
  if (error.empty()) error = ReadImage(options.second, &b);
  if (!error.empty()) return error;
  if (a.width != b.width || a.height != b.height) {
    return Expected(options.second, SizeText(a) + " as " + options.first, SizeText(b));
  }
  const Difference difference = Measure(a, b);
  const bool equal = difference.squares == 0;
  const double mean = double(difference.squares) / double(a.pixels.size());
  const double psnr = equal ? INFINITY : 10 * std::log10(255.0 * 255.0 / mean);
  if (options.json) {
    nlohmann::ordered_json json;
    json["psnr"] = equal ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(psnr);
    json["largest_difference"] = difference.largest;
    std::printf("%s\n", json.dump().c_str());
  } else if (equal) {
    std::printf("PSNR inf, largest difference 0\n");
  } else {
    std::printf("PSNR %.2f dB, largest difference %d\n", psnr, difference.largest);
  }
  return "";
}

}  // namespace

void AddCompareCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "compare", "PSNR over all RGB samples and largest difference of two pictures");
  command->add_option("A", options->first, "Picture")->type_name("FILE")->required();
  command->add_option("B", options->second, "Picture of the same size")
      ->type_name("FILE")
      ->required();
  command->add_flag("--json", options->json, "Print JSON; an infinite PSNR is null");
  command->callback([options, action] { *action = [options] { return Run(*options); }; });
}

}  // namespace starfocus
