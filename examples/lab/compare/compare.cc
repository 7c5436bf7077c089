// SPDX-License-Identifier: Apache-2.0
// starfocus-lab compare: measures the difference between two pictures.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "examples/cli/json.h"
#include "examples/cli/pictures.h"
#include "examples/command_line/program.h"
#include "examples/lab/commands.h"
#include "platform/image_io.h"
#include "platform/standard_stream.h"
#include "platform/text.h"

namespace starfocus {
namespace {

struct CompareOptions {
  std::string first, second, map;
  bool json = false;
};

Error CheckMap(const CompareOptions& options) {
  if (options.map.empty()) return {};
  if (Error error = CheckImageOutput(options.map)) return error;
  if (IsStandardStream(options.map)) {
    return Error::Usage("--map",
                        "a file, because the measured differences are written to standard output",
                        options.map);
  }
  return CheckApart({{"--map", options.map}}, {{}, {options.first, options.second}});
}

Error Run(const CompareOptions& options) {
  if (Error error = CheckMap(options)) return error;
  const Result<Image> first = ReadImage(options.first), second = ReadImage(options.second);
  if (!first) return first.error();
  if (!second) return second.error();
  const Image &a = *first, &b = *second;
  if (a.width != b.width || a.height != b.height) {
    return Expected(options.second,
                    SizeText(a.width, a.height) + " pixels, the size of " + options.first,
                    SizeText(b.width, b.height));
  }
  const Difference difference = MeasureDifference(a, b);
  if (!options.map.empty()) {
    if (Error error =
            WriteImage(options.map, DrawDifference(a, b, std::max(1, difference.largest))))
      return error;
  }
  const bool equal = difference.largest == 0;
  if (options.json) {
    Json json;
    json.Set("psnr", equal ? Json() : Json(difference.psnr));
    json.Set("largest_difference", difference.largest);
    std::printf("%s\n", json.Text().c_str());
  } else if (equal) {
    std::printf("PSNR inf, largest difference 0\n");
  } else {
    std::printf("PSNR %.2f dB, largest difference %d\n", difference.psnr, difference.largest);
  }
  return {};
}

}  // namespace

Command CompareCommand() {
  const auto options = std::make_shared<CompareOptions>();
  return {"compare",
          "Print the PSNR over all RGB samples and the largest difference of two pictures",
          {
              {"A", "FILE", "First picture", &options->first, Use::kRequired},
              {"B", "FILE", "Second picture, of the same size", &options->second, Use::kRequired},
              {"--map", "FILE",
               "Picture of the differences to write, from black (equal) through red to white "
               "(largest difference); default: none",
               &options->map},
              {"--json", nullptr, "Print JSON instead of text; the PSNR of equal pictures is null",
               &options->json},
          },
          [options] { return Run(*options); },
          {"starfocus-lab compare a.png b.png",
           "starfocus-lab compare a.png b.png --map difference.png --json"}};
}

}  // namespace starfocus
