// SPDX-License-Identifier: Apache-2.0
// starfocus refocus: computes a refocused picture, or a sweep of several.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "examples/cli/batch.h"
#include "examples/cli/commands.h"
#include "examples/cli/deep_output.h"
#include "examples/cli/engine_run.h"
#include "examples/cli/input.h"
#include "examples/cli/pictures.h"
#include "examples/cli/refocus_output.h"
#include "examples/cli/refocus_plan.h"
#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "platform/clock.h"
#include "platform/console.h"
#include "platform/helper/decoder_threads.h"
#include "platform/image_io.h"
#include "platform/standard_stream.h"
#include "platform/terminal_graphics.h"
#include "platform/writers/deep_picture.h"
#include "starfocus/experimental.h"
#include "starfocus/pool.h"

namespace starfocus {
namespace {

// Largest number of pictures of a sweep, because file names have three digits.
constexpr int kMostPictures = 1000;

// Largest memory of an input outside its turn: photos of up to 32 megapixels.
constexpr uint64_t kMostBytesAhead = uint64_t{512} << 20;

struct RefocusOptions {
  std::vector<std::string> inputs;
  InputOptions input;  // the input that is being refocused
  std::string report, map;
  starfocus_region region = {};  // Rectangle to compute; four zeros select the whole picture.
  std::vector<double> sweep;     // Foci of a sweep; empty: no sweep.
  int jobs = 1;
  OutputOptions output;
  LensOptions lens;
  MapOptions disparities;
  bool stream = false;
  Turn* turn = nullptr;  // Turn of the input in a batch; null: a single input.
};

struct Loaded {
  Capture capture;
  starfocus_disparity_stats stats = {};
  double max_blur = 0;
};

std::vector<OutputPath> ListOutputs(const RefocusOptions& options) {
  std::vector<OutputPath> outputs = ListPictures(options.output, options.sweep.size());
  if (!options.map.empty()) outputs.push_back({"--map", options.map});
  if (!options.report.empty()) outputs.push_back({"--report", options.report});
  return outputs;
}

// Returns the error for a picture whose extension no writer supports.
Error UnknownFormat(const std::string& path, const std::string& extension) {
  return Expected(path,
                  "a name ending in .png, .ppm, .jpg, .webp, .tif, .tiff, .exr, .avif or .heic",
                  extension.empty() ? "no extension" : extension);
}

Error CheckOutputs(const RefocusOptions& options) {
  const std::vector<OutputPath> outputs = ListOutputs(options);
  const std::string& out = options.output.out;
  const auto check = [&](const std::string& path) {
    const bool may_be_deep = path == out && options.sweep.empty();
    const std::string extension = FormatExtension(path);
    if (may_be_deep && KeepsBits(path)) return CheckDeepOutput(path);
    if (may_be_deep && !IsPictureExtension(extension)) return UnknownFormat(path, extension);
    return CheckImageOutput(path);
  };
  Error error = out.empty() ? Error() : check(out);
  for (size_t i = 0; i < outputs.size() && !error; ++i) {
    const std::string& option = outputs[i].option;
    error = option == "--report"    ? CheckTextOutput(outputs[i], OutputKind::kJson)
            : option == "--compare" ? CheckTextOutput(outputs[i], OutputKind::kPage)
                                    : check(outputs[i].path);
  }
  if (error) return error;
  return CheckApart(outputs, {{options.input.path},
                              {options.input.path, options.input.depth, options.input.matte,
                               options.input.right, options.input.coverage, options.lens.timing}});
}

// Parses D0:D1:N.
std::string ReadSweep(const std::string& text, std::vector<double>* foci) {
  const std::vector<double> numbers = ReadNumbers(text, ':');
  const double count = numbers.size() == 3 ? numbers[2] : 0;
  if (count < 2 || count > kMostPictures || count != std::floor(count)) {
    return "D0:D1:N with two disparities and 2 to " + std::to_string(kMostPictures) + " pictures";
  }
  for (int i = 0; i < int(count); ++i) {
    foci->push_back(numbers[0] + (numbers[1] - numbers[0]) * i / (count - 1));
  }
  return "";
}

// Replaces the focus by the foci of a sweep.
Error PlanSweep(const RefocusOptions& options, LensPlan* plan) {
  if (!plan->focus_option.empty() || options.stream || !options.map.empty()) {
    return Error::Usage("--sweep", "no --focus, --focus-at, --focus-range, --stream or --map",
                        !plan->focus_option.empty() ? plan->focus_option
                        : options.stream            ? "--stream"
                                                    : "--map");
  }
  plan->focus_option = "--sweep";
  plan->foci = options.sweep;
  return {};
}

// Checks all options that can be checked before a file is read.
Result<LensPlan> MakePlan(const RefocusOptions& options) {
  const bool region = options.region.width > 0, sweep = !options.sweep.empty();
  if (Error error = PlanOutput(options.output, sweep, region)) return error;
  if (Error error = CheckOutputs(options)) return error;
  if (Error error = CheckHighlights(options.output.out, options.lens.highlights)) return error;
  if (options.output.dither && options.lens.highlights > 1) {
    return Error::Usage("--dither", "either --dither or --highlights", "both");
  }
  if (region && options.stream) {
    return Error::Usage("--region", "either --region or --stream", "both");
  }
  Result<LensPlan> plan = PlanLens(options.lens);
  if (!plan) return plan;
  if (Error error = sweep ? PlanSweep(options, &*plan) : Error()) return error;
  plan->region = options.region;
  return plan;
}

Error CheckRegion(const Image& picture, const starfocus_region& region) {
  if (region.x + region.width <= picture.width && region.y + region.height <= picture.height)
    return {};
  return Error::Usage("--region",
                      "a region within the picture of " + std::to_string(picture.width) + "x" +
                          std::to_string(picture.height),
                      std::to_string(region.width) + "x" + std::to_string(region.height) + " at " +
                          std::to_string(region.x) + "," + std::to_string(region.y));
}

Result<Capture> Open(const RefocusOptions& options, LensPlan* plan) {
  InputOptions input = options.input;
  if (options.turn != nullptr) {
    // Commands run in the turn of their input, so that --jobs limits the number of commands.
    if (RunsCommand(input)) options.turn->Begin();
    std::error_code no_size;  // a folder: its pictures are read in its turn
    const uintmax_t size = std::filesystem::file_size(input.path, no_size);
    if (!no_size) options.turn->Take(size);
    input.map.before_decoding = [&](uint64_t bytes) { options.turn->Take(bytes); };
  }
  Result<Capture> capture = ReadInput(input);
  if (options.turn != nullptr) options.turn->Begin();
  if (!capture) return capture;
  TellNotes(*capture);
  Error error = CheckApart(ListOutputs(options),
                           {{}, CaptureFiles(*capture), GridsOf(options.input, *capture)});
  if (!error) error = PlanAperture(options.lens.aperture, *capture).MoveTo(&plan->aperture);
  if (error) return error;
  return capture;
}

// Checks all options that do not depend on the final map. Invalid options are reported
// before the map is resized or repaired, which takes a long time.
Error Foresee(const RefocusOptions& options, const Capture& capture, LensPlan* plan) {
  const LightField& light_field = capture.light_field;
  if (Error error = CheckRenderer(capture.path, *plan, light_field.positions)) return error;
  if (Error error = CheckRegion(light_field.views[0], plan->region)) return error;
  if (plan->focus_option.empty()) {
    const DefaultFocus focus = FindDefaultFocus(capture);
    TellFocus(capture.path, focus);
    UseFocus(focus, plan);
  }
  return ForeseeBlur(light_field, WillRepair(options.disparities, capture), plan);
}

Result<Loaded> Load(const RefocusOptions& options, LensPlan* plan) {
  Loaded loaded;
  Capture* const capture = &loaded.capture;
  const FloatMap& map = capture->light_field.disparity;
  Error error = Open(options, plan).MoveTo(capture);
  if (!error && capture->photo) error = Foresee(options, *capture, plan);
  if (!error) error = LoadInput(plan->options.views, plan->options.threads, capture);
  if (!error && !capture->photo) error = Foresee(options, *capture, plan);
  if (!error) error = CareForMap(options.disparities, plan->options.threads, capture);
  if (!error) error = PrepareDisparity(MapName(*capture), map).MoveTo(&loaded.stats);
  if (!error) error = ChooseFocus(map, plan);
  if (!error) error = ChooseBlur(loaded.stats, plan).MoveTo(&loaded.max_blur);
  if (error) return error;
  TellAperture(capture->path, plan->aperture);
  TellBlurred(capture->path, loaded.stats, SharpRadius(map.width, map.height), *plan);
  return loaded;
}

// Prints one line for each output picture or page, and for a sweep one line.
void TellOutputs(const RefocusOptions& options, const LensPlan& plan) {
  const std::string lens = ": " + LensText(plan);
  const std::vector<OutputPath> outputs = ListPictures(options.output, options.sweep.size());
  if (!options.sweep.empty()) {
    const bool one = outputs[0].path == options.output.out;  // an animation
    const std::string last = one ? "" : " to " + outputs[options.sweep.size() - 1].path;
    return TellLine(OutputName(outputs[0].path) + last + lens);
  }
  for (const OutputPath& output : outputs) TellLine(OutputName(output.path) + lens);
  if (outputs.empty()) TellLine(InputName(options.input.path) + lens);
}

// Returns the bytes of the pictures and maps that an input holds after it has been refocused.
uint64_t BytesOf(const LightField& light_field, const EngineResult& result) {
  uint64_t bytes = result.picture.pixels.size() + light_field.coverage.size() +
                   light_field.disparity.values.size() * sizeof(float);
  for (const Image& view : light_field.views) bytes += view.pixels.size();
  uint64_t samples = result.deep.samples.size();
  for (const DeepImage& view : light_field.deep) samples += view.samples.size();
  bytes += samples * sizeof(uint16_t);
  return bytes;
}

// Computes and writes one picture. Shows the picture on `terminal`, unless this is nullopt.
Error RunOne(const RefocusOptions& options, const PictureOptions& how, const LensPlan& plan,
             const Capture& capture, const EngineTask& one,
             const std::optional<GraphicsTerminal>& terminal, double start) {
  EngineTask task = one;
  std::vector<starfocus_block> blocks;
  if (!options.map.empty()) {
    task.observer.on_block = CollectBlock;
    task.observer.on_block_data = &blocks;
  }
  task.stream = options.stream;
  EngineRun run(task.threads, 1);
  if (Error error = run.Start(InputName(options.input.path), task)) return error;
  EngineResult result;
  EngineRun::MakePicture(task, &result);
  std::function<Error()> write;
  const std::string& out = options.output.out;
  if (task.deep_picture && KeepsBits(out)) {
    write = [&] { return WriteDeepResult(out, how, capture, result); };
  } else if (task.deep_picture && WritesWebpAlpha(options.output, capture)) {
    write = [&] { return WriteWebpAlpha(out, how, result); };
  } else if (task.deep_picture && !out.empty() && !options.output.depth_photo) {
    write = [&] { return WriteImage(out, result.picture, how); };
  } else if (WritesGainMap(options.output, capture)) {
    write = [&] { return WriteUltraHdr(out, how, capture, one, result.picture); };
  }
  PictureWriter writer(options.output, how, &result.picture, task.threads, write);
  Error error = run.RefocusRows(InputName(options.input.path), task, writer.rows(), &result);
  if (options.turn != nullptr) options.turn->End(BytesOf(*task.light_field, result));
  if (!error) {
    Refocused refocused = {options.input.path, &task, &result.picture, plan.aperture.widest};
    if (plan.focus_option == "--focus-at") refocused.at = Pixel{plan.x, plan.y};
    error = writer.Write(refocused);
  }
  if (!error && terminal) {
    error = ShowOnTerminal("--show", *terminal,
                           Shrink(result.picture, terminal->width, terminal->height));
  }
  if (!error && !options.map.empty()) {
    const starfocus_region& region = task.params.region;
    error = WriteImage(options.map, DrawPartition(result.picture, region.x, region.y, blocks));
  }
  if (error || options.report.empty()) return error;
  return WriteText(options.report, ReportText(task, result, Seconds() - start));
}

Error RunSweep(const RefocusOptions& options, const PictureOptions& how,
               const std::vector<double>& foci, EngineTask task, double start) {
  EngineRun run(task.threads, static_cast<int>(foci.size()));
  SeriesReport report;
  StackWriter stack(options.output, how, run.runner());
  Error error = WritePair(options.output, how, *task.light_field, foci);
  if (!error) error = run.Start(InputName(options.input.path), task);
  if (!error) error = run.Prepare(InputName(options.input.path), task);
  for (size_t i = 0; i < foci.size() && !error; ++i) {
    task.params.focus = foci[i];
    std::string out;
    EngineResult result;
    error = run.Refocus(InputName(options.input.path), task).MoveTo(&result);
    if (!error) error = stack.Add(std::move(result.picture)).MoveTo(&out);
    if (!error) report.Add(out, task, result);
  }
  if (!error) error = stack.Finish();
  if (error || options.report.empty()) return error;
  return WriteText(options.report, report.Text(Seconds() - start));
}

Error RunInput(const RefocusOptions& options) {
  const double start = Seconds();
  Result<LensPlan> plan = MakePlan(options);
  if (!plan) return plan.error();
  std::optional<GraphicsTerminal> terminal;
  if (options.output.show) {
    const Result<GraphicsTerminal> found = FindGraphicsTerminal("--show");
    const bool writes = !options.output.out.empty() || !options.output.compare.empty();
    if (!found && !writes) return found.error();
    if (found) {
      terminal = *found;
    } else {
      TellNote(InputName(options.input.path), "the picture is not shown: " + found.error().line());
    }
  }
  Result<Loaded> loaded = Load(options, &*plan);
  if (!loaded) return loaded.error();
  const PictureOptions how = {options.output.quality, loaded->capture.metadata,
                              options.output.small_png ? PngSize::kSmall : PngSize::kQuick};
  EngineTask task = MakeTask(*plan, loaded->capture.light_field, loaded->stats, loaded->max_blur,
                             !options.report.empty());
  const bool single = options.sweep.empty();
  Error error = ChooseBits(options.output, single, &loaded->capture, &task);
  if (error) return error;
  error = single ? RunOne(options, how, *plan, loaded->capture, task, terminal, start)
                 : RunSweep(options, how, plan->foci, task, start);
  if (!error) TellOutputs(options, *plan);
  return error;
}

Error RunInputs(const RefocusOptions& options, const Batch& batch) {
  for (const auto& [name, typed] : {std::pair{"--map", !options.map.empty()},
                                    {"--report", !options.report.empty()},
                                    {"--compare", !options.output.compare.empty()},
                                    {"--show", options.output.show},
                                    {"--coverage", !options.input.coverage.empty()},
                                    {"--matte", !options.input.matte.empty()},
                                    {"--right", !options.input.right.empty()},
                                    {"--sweep", !options.sweep.empty()}}) {
    if (typed)
      return Error::Usage(name, "a single input and a file for --output",
                          "several inputs or a folder");
  }
  OutputFolder made;
  if (Error error = MakeBatchFolder(batch, &made)) return error;
  // One more input than options.jobs is in memory, so that files are read and written during the
  // turns of other inputs.
  const int cores = std::max(1, starfocus_pool_cores() / options.jobs);
  const int threads = options.lens.threads > 0 ? options.lens.threads : cores;
  const int ahead = threads > 1 ? 1 : 0;
  Turns turns(static_cast<size_t>(options.jobs), kMostBytesAhead);
  return RunBatch(batch, options.jobs + ahead, [&](const BatchItem& item) {
    Turn turn(&turns, static_cast<size_t>(&item - batch.items.data()));
    RefocusOptions one = options;
    one.turn = &turn;
    one.lens.threads = threads;
    one.input.path = item.input;
    one.output.out = item.output;
    return RunInput(one);
  });
}

Error Run(const RefocusOptions& options) {
  SetDecoderThreads(options.lens.threads);
  const bool has_8_bits = options.lens.highlights > 1 || options.output.depth_photo;
  const Result<std::optional<Batch>> batch =
      PlanBatch(options.inputs, options.output.out, RunsCommand(options.input), has_8_bits);
  if (!batch) return batch.error();
  if (*batch) return RunInputs(options, **batch);
  RefocusOptions one = options;
  one.input.path = options.inputs[0];
  return RunInput(one);
}

const std::vector<HelpGroup> kBasics = {
    {"Input and output",
     {{"SRC", "Photos with depth, light fields, or folders of them"},
      {"--depth", "Depth picture of the photo, if it is a separate file"},
      {"--matte", "Matte of the subject, for a photo without depth"},
      {"--output", "Picture (.jpg, .png, .webp), or folder for several"},
      {"--compare", "Web page with the picture before and after"},
      {"--show", "Show the picture on the terminal"}}},
    {"Focus (default: the subject or focus of the photo, or a near surface)",
     {{"--focus-at", "Pixel in focus, counted from 0,0 at the top left"},
      {"--focus", "Disparity in focus; `starfocus info` prints the range"},
      {"--focus-range", "Disparities between which everything is sharp"},
      {"--sweep", "N pictures with foci from disparity D0 to D1"}}},
    {"Lens (default: f/1.8 for a photo)",
     {{"--f-stop", "F-stop, such as 2.8; a smaller one blurs more"},
      {"--strength", "Percentage of the blur, 0 to 100"},
      {"--shape", "Opening of the lens, such as disc or polygon:5"}}}};

}  // namespace

Command RefocusCommand() {
  const auto options = std::make_shared<RefocusOptions>();
  Command command = {"refocus",
                     "Compute the picture that another lens or focus would have taken",
                     {},
                     [options] { return Run(*options); },
                     {"starfocus refocus photo.jpg -o near.jpg --focus-at 800,600 --f-stop 2.8",
                      "starfocus refocus lf -o stack.webp --sweep -2:8:20 --strength 50"},
                     "",
                     kBasics};
  AddInputOptions(&command, &options->input, &options->inputs);
  AddRightOption(&command, &options->input);
  AddCoverageOption(&command, &options->input);
  AddOutputOptions(&command, &options->output);
  AddOptions(
      {
          {"--jobs", "N",
           "Number of inputs that are processed at the same time, 1 to 64; each uses --threads "
           "threads, by default an equal part of the cores",
           Threads(&options->jobs), Use::kDefault},
      },
      &command);
  AddLensOptions(&command, &options->lens);
  AddOptions(
      {
          {"--sweep", "D0:D1:N",
           "Write N pictures, 2 to 1000, focused from disparity D0 to D1: -o out.png "
           "writes out_000.png, out_001.png, ..., and -o out.webp writes one animation; "
           "default: one picture",
           Target([foci = &options->sweep](const std::string& text) {
             return ReadSweep(text, foci);
           })},
          {"--region", "X,Y,W,H",
           "Part of the picture to compute, in a proportional share of the time: left "
           "column, top row, width and height in pixels; default: the whole picture",
           Region(&options->region)},
          {"--stream", nullptr,
           "Pass the pictures through the engine row by row instead of as whole pictures",
           &options->stream},
      },
      &command);
  AddMapOptions(&command, &options->disparities);
  AddOptions(
      {
          {"--map", "FILE",
           "Picture to write of the blocks: red for layer 0, green for 1, blue for 2; "
           "default: none",
           &options->map},
          {"--report", "FILE", "JSON file to write with the measurements of the run; default: none",
           &options->report},
      },
      &command);
  return command;
}

}  // namespace starfocus
