// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "examples/cli/estimate_run.h"
#include "examples/command_line/options.h"
#include "platform/console.h"
#include "platform/deep_image.h"
#include "platform/file.h"
#include "platform/natural_order.h"
#include "platform/readers/capture.h"
#include "platform/readers/deep_photo.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/pair.h"
#include "platform/readers/stereo_folders.h"
#include "platform/standard_stream.h"

namespace starfocus {

namespace {

namespace fs = std::filesystem;

// Returns the reason why a file is no photo, or an empty string if the file is a photo. Judges a
// file by its name only. `has_depth` states that the file has a depth picture next to it, or that a
// command computes its depth or matte.
std::string ReasonToSkip(const std::string& name, bool has_depth) {
  const std::string extension = LowerExtension(name);
  if (IsDepthPictureName(name)) return "a depth picture that no photo uses";
  if (extension == ".png" || extension == ".webp" || extension == ".ppm") {
    return has_depth ? "" : "a PNG, WebP or PPM picture without a depth picture next to it";
  }
  if (extension == ".tif" || extension == ".tiff" || extension == ".exr") {
    return has_depth ? "" : "a TIFF or OpenEXR picture without a depth picture next to it";
  }
  const bool is_photo = extension == ".jpg" || extension == ".jpeg" || extension == ".mpo" ||
                        extension == ".heic" || extension == ".heif" || extension == ".avif";
  return is_photo ? "" : "a file of another type";
}

std::string Text(const SkippedPath& skipped) { return skipped.path + ": " + skipped.reason; }

// Returns the error for a folder without inputs. A folder with files of a light field is assumed to
// be a damaged light field.
Error NothingFound(const std::string& path, const std::vector<SkippedPath>& skipped) {
  if (!LightFieldFiles(path).empty()) return OpenCapture(path, {}).error();
  return Expected(path, "a light field, or a folder of photos or light fields",
                  skipped.empty() ? "an empty folder" : Text(skipped[0]));
}

// Returns true if the folder is one light field. A row of pictures with numbers in their names is
// not a light field if one of the pictures has depth, or if `has_command` states that a command
// computes the depth or the matte of each picture.
bool IsLightField(const std::string& folder, bool has_command) {
  const Result<Capture> capture = OpenCapture(folder, {});
  if (!capture || capture->row.empty() || !capture->map_path.empty()) return bool(capture);
  const Result<DepthPictures> pictures = ListDepthPictures(folder);
  if (has_command || !pictures) return false;
  return std::none_of(capture->row.begin(), capture->row.end(), [&](const std::string& path) {
    return !pictures->Of(fs::path(path).filename().string()).empty() || StoresDepth(path);
  });
}

}  // namespace

Result<FoundInputs> FindInputs(const std::string& path, bool has_command, const std::string& out) {
  std::error_code ignored;
  const Result<std::vector<StereoFiles>> pairs = FindStereoFolders(path);
  if (!pairs) return pairs.error();
  if (pairs->size() > 1) {
    FoundInputs lefts;
    for (const StereoFiles& pair : *pairs) lefts.paths.push_back(pair.left);
    return lefts;
  }
  if (!fs::is_directory(path, ignored) || IsLightField(path, has_command)) {
    return FoundInputs{{path}, {}};
  }
  const Result<DepthPictures> pictures = ListDepthPictures(path);
  if (!pictures) return pictures.error();
  FoundInputs found;
  std::set<std::string> used;  // depth pictures of the photos that were found
  for (const auto& entry : fs::directory_iterator(path, ignored)) {
    const std::string one = entry.path().string();
    const std::string name = entry.path().filename().string();
    if (name[0] == '.' || fs::equivalent(entry.path(), out, ignored)) continue;
    std::string reason;
    if (entry.is_directory(ignored)) {
      if (!IsLightField(one, has_command)) reason = "a folder that is not a light field";
    } else {
      const std::vector<std::string> depth = pictures->Of(name);
      reason = ReasonToSkip(name, has_command || !depth.empty());
      if (reason.empty() && !depth.empty()) used.insert((fs::path(path) / depth[0]).string());
    }
    if (reason.empty()) {
      found.paths.push_back(one);
    } else {
      found.skipped.push_back({one, reason});
    }
  }
  const auto is_used = [&](const SkippedPath& one) { return used.count(one.path) != 0; };
  found.skipped.erase(std::remove_if(found.skipped.begin(), found.skipped.end(), is_used),
                      found.skipped.end());
  std::sort(found.paths.begin(), found.paths.end(), NaturalLess);
  std::sort(found.skipped.begin(), found.skipped.end(),
            [](const SkippedPath& a, const SkippedPath& b) { return NaturalLess(a.path, b.path); });
  if (found.paths.empty()) return NothingFound(path, found.skipped);
  return found;
}

std::string NameOfInput(const std::string& input) {
  std::error_code ignored;
  fs::path path = fs::absolute(input, ignored).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "folder/"
  return (fs::is_directory(input, ignored) ? path.filename() : path.stem()).string();
}

void TellSkipped(const std::vector<SkippedPath>& skipped) {
  for (const SkippedPath& one : skipped) TellLine("starfocus: skipped " + Text(one));
}

Error CheckNear(const DepthOptions& options) {
  if (options.unit == DepthUnit::kNone) return {};
  const bool disparity = options.unit == DepthUnit::kDisparity;
  if (options.near != (disparity ? Near::kBlack : Near::kWhite)) return {};
  return Error::Usage(
      "--near",
      disparity ? "white for --depth-unit disparity" : "black for the distances of --depth-unit",
      disparity ? "black" : "white");
}

namespace {

// Returns the name of the first option of a depth picture or a matte that is set. Returns null if
// all of these options are unset.
const char* PhotoOption(const InputOptions& options) {
  if (!options.depth.empty()) return "--depth";
  if (options.map.near != Near::kUnknown) return "--near";
  if (options.map.unit != DepthUnit::kNone) return "--depth-unit";
  if (options.map.orientation != DepthOrientation::kUnknown) return "--depth-orientation";
  if (options.map.has_unknown) return "--unknown";
  return options.matte.empty() ? nullptr : "--matte";
}

// Rejects pipes by name, such as the process substitution `<(cat photo.jpg)` of shells.
Error CheckPipes(const InputOptions& options) {
  for (const std::string& path :
       {options.path, options.depth, options.matte, options.right, options.coverage}) {
    std::error_code ignored;
    if (path.empty() || path == "-" || !std::filesystem::is_fifo(path, ignored)) continue;
    return Cannot("read", path,
                  "it is a pipe (the name - reads standard input, as in `cat photo.jpg | starfocus "
                  "info -`)");
  }
  return {};
}

// Checks that the other options fit the right picture of a stereo pair.
Error CheckRight(const InputOptions& options) {
  std::error_code ignored;
  if (options.right.empty()) return {};
  if (options.path == "-") return Error::Usage("--right", "a file as SRC", "standard input");
  if (std::filesystem::is_directory(options.path, ignored)) {
    return Error::Usage("--right", "a photo as SRC", "the folder " + options.path);
  }
  const char* option = PhotoOption(options);
  if (option == nullptr) return {};
  return Error::Usage("--right", std::string("no ") + option + ", because the map is estimated",
                      "both");
}

// Checks the files of the options, apart from --right.
Error CheckFiles(const InputOptions& options) {
  const bool is_stream = options.path == "-";
  const bool covers = !options.coverage.empty() || options.ignores_coverage;
  if (covers && (!options.matte.empty() || !options.matte_command.line.empty())) {
    return Error::Usage("--coverage", "either --coverage or a matte", "both");
  }
  for (const auto& [name, file] :
       {std::pair("--depth", options.depth), {"--matte", options.matte}}) {
    if (is_stream && file == "-") {
      return Error::Usage(name, "a file, because SRC is standard input", "-");
    }
  }
  if (is_stream && isatty(STDIN_FILENO) == 1) {
    return Expected(InputName(options.path), "a photo from a file or pipe", "a terminal");
  }
  const char* option = PhotoOption(options);
  std::error_code ignored;
  if (option == nullptr || is_stream || !std::filesystem::is_directory(options.path, ignored)) {
    return {};
  }
  return Error::Usage(option, "a photo as SRC", "the folder " + options.path);
}

// Runs a command, if it is given, when the reader of the photo needs the picture.
struct CommandRun {
  const InputOptions& options;
  const PictureCommand& command;
  Alpha alpha;
  bool has_run = false;

  std::function<Result<Samples>(const Image&)> call() {
    if (command.line.empty()) return nullptr;
    return [this](const Image& photo) {
      has_run = true;
      const CommandInput input = {InputName(options.path), photo, alpha, options.seconds};
      return options.kept != nullptr ? options.kept->Of(command, input)
                                     : RunPictureCommand(command, input);
    };
  }
  // Adds a note if the command was given but has not run.
  void NoteUnused(const std::string& present, Capture* capture) const {
    if (command.line.empty() || has_run) return;
    capture->notes.push_back(std::string("--") + command.kind +
                             "-command is not run, because the input has " + present);
  }
};

// Prints a note about pixels whose light or alpha the engine replaces.
void TellUnusable(const Capture& capture) {
  UnusableLight counts;
  for (const DeepImage& view : capture.light_field.deep) CountUnusable(view, &counts);
  std::string text;
  const auto add = [&text](int64_t count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + what;
  };
  add(counts.not_a_number, " pixels that are not a number count as black");
  add(counts.negative, " pixels with negative light count as black there");
  add(counts.too_bright, " pixels brighter than 64 times white are limited to that");
  add(counts.alpha, " pixels with alpha that is not from 0 to 1 are limited to that");
  const size_t views = capture.light_field.deep.size();
  if (text.empty()) return;
  TellNote(capture.path, text + (views > 1 ? " (in " + std::to_string(views) + " views)" : ""));
}

// Returns what makes a matte unnecessary: `of_photo`, or the views of a folder.
std::string Present(const std::string& of_photo, const Capture& capture) {
  return capture.photo ? of_photo : capture.files.size() > 1 ? "several views" : "a map";
}

// Adds a note if --floor is given for an input that has depth or several views, as in a batch.
void NoteUnusedFloor(Capture* capture) {
  if (std::isfinite(capture->subject)) return;
  capture->notes.push_back("--floor is not used, because the input has " +
                           Present("depth", *capture));
}

// Estimates a map from the loaded views.
Error Estimate(int threads, Capture* capture) {
  LightField* light_field = &capture->light_field;
  if (light_field->views.size() == 1) {
    return Expected(MapName(*capture),
                    "a disparity map, because none can be estimated from a single view", "no file");
  }
  const Result<DisparityRange> range = FindRange(capture->path, *light_field, threads);
  if (!range) return range.error();
  TellNote(MapName(*capture), "no map found, so disparities from " + Short(range->min) + " to " +
                                  Short(range->max) + " are estimated from " +
                                  std::to_string(EstimateViews(light_field->positions)) + " views");
  Result<DisparityEstimate> estimate =
      EstimateDisparity(capture->path, *light_field, *range, threads);
  if (estimate) light_field->disparity = std::move(estimate->map);
  return estimate.error();
}

}  // namespace

Result<Capture> ReadInput(const InputOptions& options) {
  if (Error error = CheckPipes(options)) return error;
  if (Error error = CheckRight(options)) return error;
  if (Error error = CheckNear(options.map)) return error;
  if (Error error = CheckFiles(options)) return error;
  CommandRun depth = {options, options.depth_command, options.map.alpha};
  CommandRun matte = {options, options.matte_command, Alpha::kTaken};
  CaptureOptions wanted;
  wanted.depth = options.depth;
  wanted.matte = options.matte;
  wanted.right = options.right;
  wanted.small_map = true;
  wanted.map = options.map;
  wanted.map.estimate = depth.call();
  wanted.map.estimate_matte = matte.call();
  Result<Capture> capture = OpenCapture(options.path, wanted);
  if (!capture) return capture;
  depth.NoteUnused(capture->map_path.empty() ? "several views" : "depth", &*capture);
  matte.NoteUnused(Present("a matte", *capture), &*capture);
  if (options.map.floor) NoteUnusedFloor(&*capture);
  if (!options.coverage.empty() || options.ignores_coverage) {
    capture->coverage_path = options.coverage;
    capture->light_field.coverage.clear();
    capture->covers_by_matte = false;
  }
  return capture;
}

Result<Capture> OpenInput(const InputOptions& options) {
  Result<Capture> capture = ReadInput(options);
  if (capture) TellNotes(*capture);
  if (capture) TellLost(*capture);
  return capture;
}

void TellLost(const Capture& capture) {
  for (const std::string& note : capture.lost) TellNote(capture.path, note);
}

void TellNotes(const Capture& capture) {
  for (const std::string& note : capture.notes) TellNote(capture.path, note);
}

Error CheckViews(const Positions& views, const Capture& capture) {
  for (const starfocus_position& view : views) {
    if (SelectViewFiles(capture.path, capture.files, {view})) continue;
    return Error::Usage(
        "--views",
        "some of the " + std::to_string(capture.files.size()) + " views in " + capture.path,
        std::to_string(views.size()) + " views that include " + ViewName(view));
  }
  return {};
}

Error LoadInput(const Positions& views, int threads, Capture* capture) {
  if (Error error = CheckViews(views, *capture)) return error;
  ThreadRunner runner(threads);
  const Error error = LoadCapture(views, capture, &runner);
  TellUnusable(*capture);
  return !error && capture->map_path.empty() ? Estimate(threads, capture) : error;
}

bool WillRepair(const MapOptions& options, const Capture& capture) {
  if (capture.map_path.empty()) return false;
  return options.repair || (!options.no_repair && capture.care == MapCare::kRepair);
}

Error CareForMap(const MapOptions& options, int threads, Capture* capture) {
  if (capture->map_path.empty()) return {};
  // If the input provides coverage, keep this coverage instead of searching for coverage.
  LightField& light_field = capture->light_field;
  const bool has_coverage = !light_field.coverage.empty();
  const bool has_matte = capture->covers_by_matte && !capture->matte.alpha.empty();
  if (WillRepair(options, *capture)) {
    const bool covers = !has_coverage && !has_matte;
    Result<DisparityEstimate> repaired =
        RepairDisparity(MapName(*capture), light_field, {threads, covers, false});
    if (!repaired) return repaired.error();
    light_field.disparity = std::move(repaired->map);
    if (covers) light_field.coverage = std::move(repaired->coverage);
  } else if (options.fill || capture->care != MapCare::kNone) {
    if (Error error = FillHoles(MapName(*capture), &light_field.disparity)) return error;
  }
  if (has_coverage || !has_matte) return {};
  ThreadRunner runner(threads);
  return CoverByMatte(capture->path, capture->matte, &runner, &light_field);
}

Error FillHoles(const std::string& where, FloatMap* map) {
  const starfocus_status status =
      starfocus_fill_disparity(map->values.data(), map->stride(), map->width, map->height, nullptr);
  return status == STARFOCUS_OK ? Error()
                                : Expected(where, "a map with finite disparities", "none");
}

std::vector<std::string> GridsOf(const InputOptions& options, const Capture& capture) {
  const std::filesystem::path first = capture.files[0].path;
  if (capture.photo || IsViewFile(first.filename().string())) return {};
  return {options.path};
}

std::string MapName(const Capture& capture) {
  if (!capture.map_path.empty()) return InputName(capture.map_path);
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(capture.path, ignored);
  return folder ? DisparityPath(capture.path) : capture.path;
}

Facts FactsOf(const Capture& capture) {
  Facts facts = capture.facts;
  for (auto& fact : FactsOfLight(capture.light_field, capture.metadata, capture.gain_map)) {
    facts.push_back(std::move(fact));
  }
  return facts;
}

Json Describe(const Capture& capture) {
  const LightField& light_field = capture.light_field;
  Json json;
  json.Set("format", capture.format);
  Json facts;
  for (const auto& fact : FactsOf(capture)) facts.Set(fact.first, fact.second);
  json.Set("facts", std::move(facts));
  if (capture.widest > 0) json.Set("widest_f_stop", capture.widest);
  json.Set("width", light_field.views[0].width);
  json.Set("height", light_field.views[0].height);
  json.Set("views", light_field.views.size());
  Json positions;
  for (const starfocus_position& at : light_field.positions) {
    positions.Add(Json::Array({at.u, at.v}));
  }
  json.Set("positions", std::move(positions));
  return json;
}

namespace {

std::mutex mutex;                              // protects the variables below
std::map<std::string, std::string> inputs_of;  // the input of each printed note without numbers
std::set<std::string> told;                    // all printed notes
std::map<std::string, std::set<std::string>> others_of;  // other inputs with a note of an input

}  // namespace

void TellNote(const std::string& input, const std::string& note) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto [printed, is_new] = inputs_of.emplace(ParseNumberedName(note).shape, input);
  if (is_new || (printed->second == input && told.insert(note).second)) {
    told.insert(note);
    TellLine(input + ": " + note);
  } else if (printed->second != input) {
    others_of[printed->second].insert(input);
  }
}

void TellOtherInputs() {
  const std::lock_guard<std::mutex> lock(mutex);
  for (const auto& [input, others] : others_of) {
    TellLine(
        "starfocus: notes like those about " + input + " apply to " +
        (others.size() == 1 ? *others.begin() : std::to_string(others.size()) + " other inputs"));
  }
}

}  // namespace starfocus
