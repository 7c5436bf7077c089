// SPDX-License-Identifier: Apache-2.0
// starfocus view: writes a page that shows a light field and its refocused pictures.
#include <cmath>
#include <memory>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/comparison.h"
#include "examples/cli/estimate_run.h"
#include "examples/cli/input.h"
#include "examples/cli/pictures.h"
#include "examples/cli/refocus_output.h"
#include "examples/cli/refocus_plan.h"
#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "platform/console.h"
#include "platform/helper/decoder_threads.h"
#include "platform/image_io.h"
#include "platform/standard_stream.h"
#include "starfocus/experimental.h"

namespace starfocus {
namespace {

constexpr int kFoci = 6, kBins = 32;
constexpr int kLarge = 1200, kSmall = 380;  // Widths of pictures in pixels.
constexpr int kWhite = 32;                  // Difference that an error map shows as white.

struct ViewOptions {
  InputOptions input;
  ApertureOptions aperture;
  std::string out;
  int threads = 1;
};

// Contents of the page, in the order of their computation.
struct Contents {
  // Lenses of the strip of pictures, followed by the lenses of the ground truths.
  std::vector<LensAt> lenses;
  std::vector<TruthFile> truths;
  std::vector<PageFigure> strip, blocks, errors;
};

Error ShowTruth(const TruthFile& truth, const Image& picture, Contents* contents) {
  const Result<Image> read = ReadImage(truth.path);
  if (!read) return read.error();
  const Image& real = *read;
  if (real.width != picture.width || real.height != picture.height) return {};  // other input
  const Difference difference = MeasureDifference(picture, real);
  const std::string lens =
      "focus " + Short(truth.lens.focus) + ", aperture " + Short(truth.lens.aperture);
  const std::string psnr =
      std::isinf(difference.psnr) ? "equal" : Decimal(difference.psnr, 2) + " dB";
  contents->errors.push_back(
      {"Ground truth of a thin lens, " + lens, "Ground truth, " + lens, Shrink(real, kLarge)});
  contents->errors.push_back(
      {"Error map: black where the refocused picture equals the ground truth, " + lens,
       "Error, " + lens + ": " + psnr + ", largest " + std::to_string(difference.largest) +
           "; white is " + std::to_string(kWhite) + " or more of 255",
       Shrink(DrawDifference(picture, real, kWhite), kLarge)});
  return {};
}

Error ShowPicture(size_t index, const Image& picture, const std::vector<starfocus_block>& blocks,
                  Contents* contents) {
  const size_t foci = contents->lenses.size() - contents->truths.size();
  if (index >= foci) return ShowTruth(contents->truths[index - foci], picture, contents);
  const std::string focus = Decimal(contents->lenses[index].focus, 2);
  contents->strip.push_back({"The photograph focused at disparity " + focus,
                             "Focus " + focus + (index == 0 ? ", far" : "") +
                                 (index > 0 && index + 1 == foci ? ", near" : ""),
                             Shrink(picture, kSmall)});
  // Show the blocks of the last picture only, because the last picture has the largest blur.
  if (index + 1 != foci) return {};
  contents->blocks.push_back(
      {"The blocks of the picture focused at disparity " + focus + ", coloured by resolution",
       "Blocks at focus " + focus + ": red at full resolution, green at half, blue at a quarter",
       Shrink(DrawPartition(picture, 0, 0, blocks), kLarge)});
  return {};
}

Error WritePage(const ViewOptions& options, const Capture& capture,
                const starfocus_disparity_stats& stats, const Contents& contents) {
  const LightField& light_field = capture.light_field;
  const std::string size =
      std::to_string(light_field.width()) + " × " + std::to_string(light_field.height());
  Page page(capture.path, capture.metadata.icc);
  page.AddTable({{"Format", capture.format},
                 {"Size", size + " pixels"},
                 {"Views", std::to_string(light_field.views.size())},
                 {"Disparity", Decimal(stats.min, 2) + " to " + Decimal(stats.max, 2) +
                                   " pixels; larger is nearer"},
                 {"Unknown disparities", std::to_string(stats.invalid)}});
  const std::string& out = options.out;
  const Image centre = Shrink(light_field.views[0], kLarge / 2);
  const FloatMap map = SampleMap(light_field.disparity, centre.width, centre.height);
  Error error = page.AddFigures(out, "Photograph and disparity map",
                                {{"The photograph, sharp everywhere", "Centre view", centre},
                                 {"The disparity map in colours",
                                  "Disparity in pixels",
                                  DrawDepth(map, stats),
                                  {},
                                  LegendHtml(stats, {})}},
                                kLarge / 2);
  if (!error) error = page.AddFigures(out, "Refocused", contents.strip, kSmall);
  page.AddHistogram("Histogram of disparity", Histogram(light_field.disparity, stats, kBins),
                    stats);
  if (!error) error = page.AddFigures(out, "Blocks", contents.blocks, kLarge);
  if (!error && !contents.errors.empty()) {
    error = page.AddFigures(out, "Comparison with the ground truth", contents.errors, kLarge / 2);
  }
  return error ? error : WriteText(out, page.Html());
}

// Chooses the lenses of the strip of pictures, and the lenses of all ground truths within the blur
// limit.
Error ChooseLenses(const Capture& capture, const starfocus_disparity_stats& stats,
                   ApertureChoice* aperture, Contents* contents) {
  const std::vector<double> foci = StripFoci(capture.light_field.disparity, kFoci);
  if (Error error = FitAperture(FarthestFromFocus(stats, foci), aperture)) return error;
  TellAperture(capture.path, *aperture);
  for (const double focus : foci) contents->lenses.push_back({focus, aperture->radius});
  for (const TruthFile& truth : FindTruths(capture.path)) {
    const double blur = BlurOf(truth.lens, stats);
    if (blur > STARFOCUS_MAX_BLUR) {
      TellLine(truth.path + ": not shown, because its lens blurs by " + Short(blur) +
               " pixels and the limit is " + Short(STARFOCUS_MAX_BLUR) + " pixels");
      continue;
    }
    contents->truths.push_back(truth);
    contents->lenses.push_back(truth.lens);
  }
  return {};
}

// Checks the aperture before the map is resized and processed, which takes a long time.
Error ForeseeAperture(const Capture& capture, ApertureChoice* aperture) {
  LensPlan plan;
  plan.foci = StripFoci(capture.light_field.disparity, kFoci);
  plan.aperture = *aperture;
  const Error error = ForeseeBlur(capture.light_field, WillRepair({}, capture), &plan);
  *aperture = plan.aperture;
  return error;
}

// The opened light field or photo, and its aperture.
struct Opened {
  Capture capture;
  ApertureChoice aperture;
};

Result<Opened> Open(const ViewOptions& options) {
  const std::vector<OutputPath> outputs = {{"--output", options.out}};
  std::vector<std::string> files = {options.input.path, options.input.depth, options.input.matte};
  for (const TruthFile& truth : FindTruths(options.input.path)) files.push_back(truth.path);
  Opened opened;
  Capture* const capture = &opened.capture;
  Error error = CheckTextOutput(outputs[0], OutputKind::kPage);
  if (!error) error = CheckApart(outputs, {{options.input.path}, files, {}});
  if (!error) error = OpenInput(options.input).MoveTo(capture);
  if (!error) error = CheckApart(outputs, {{}, CaptureFiles(*capture)});
  if (!error) error = PlanAperture(options.aperture, *capture).MoveTo(&opened.aperture);
  if (!error && capture->photo) error = ForeseeAperture(*capture, &opened.aperture);
  if (!error) error = LoadInput({}, options.threads, capture);
  if (!error && !capture->photo) error = ForeseeAperture(*capture, &opened.aperture);
  if (error) return error;
  return opened;
}

Error Run(const ViewOptions& options) {
  SetDecoderThreads(options.threads);
  Result<Opened> opened = Open(options);
  if (!opened) return opened.error();
  Capture& capture = opened->capture;
  const LightField& light_field = capture.light_field;
  const int64_t invalid = MeasureDisparity(light_field.disparity).invalid;
  MapOptions care;
  care.fill = invalid > 0;
  starfocus_disparity_stats stats = {};
  Contents contents;
  Error error = CareForMap(care, options.threads, &capture);
  if (!error) {
    error = PrepareDisparity(MapName(capture), light_field.disparity).MoveTo(&stats);
  }
  if (!error) error = ChooseLenses(capture, stats, &opened->aperture, &contents);
  if (error) return error;
  stats.invalid = invalid;  // number of unknown values before the holes were filled
  error =
      RefocusEach(options.input.path, light_field, stats, options.threads, contents.lenses,
                  [&](size_t i, const Image& picture, const std::vector<starfocus_block>& blocks) {
                    return ShowPicture(i, picture, blocks, &contents);
                  });
  if (!error) error = WritePage(options, capture, stats, contents);
  if (error) return error;
  LensPlan plan;
  plan.foci = StripFoci(light_field.disparity, kFoci);
  plan.aperture = opened->aperture;
  TellLine(OutputName(options.out) + ": " + LensText(plan));
  return {};
}

}  // namespace

Command ViewCommand() {
  const auto options = std::make_shared<ViewOptions>();
  Command command = {
      "view",
      "Write a web page about a light field or depth photo",
      {},
      [options] { return Run(*options); },
      {"starfocus view lf -o page.html", "starfocus view photo.jpg -o page.html --f-stop 2.8"},
      "The page shows the photo, its map, refocused pictures, blocks, and errors if a ground "
      "truth\n"
      "exists.",
      {{"Input and output",
        {{"SRC", "Photo with depth, or light-field folder"},
         {"--depth", "Depth picture of the photo, if it is a separate file"},
         {"--matte", "Matte of the subject, for a photo without depth"},
         {"--output", "Web page to write"}}},
       {"Lens (default: f/1.8 for a photo)",
        {{"--f-stop", "F-stop, such as 2.8; a smaller one blurs more"},
         {"--strength", "Percentage of the blur, 0 to 100"}}}}};
  AddInputOptions(&command, &options->input);
  AddRightOption(&command, &options->input);
  AddCoverageOption(&command, &options->input);
  AddOptions(
      {
          {"-o,--output", "FILE", "HTML file to write; - writes to standard output", &options->out,
           Use::kRequired},
      },
      &command);
  AddApertureOptions(&command, &options->aperture);
  AddOptions(
      {
          ThreadsOption(&options->threads),
      },
      &command);
  return command;
}

}  // namespace starfocus
