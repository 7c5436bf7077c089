// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/input.h"

#include <cstdio>
#include <filesystem>

#include "examples/cli/disparity/estimate_run.h"
#include "examples/command_line/options.h"

namespace starfocus {
namespace {

Error ParseNear(const std::string& text, Near* near) {
  if (text.empty()) return "";
  if (text != "white" && text != "black") {
    return Error::Usage("--near", "white or black", "'" + text + "'");
  }
  *near = text == "white" ? Near::kWhite : Near::kBlack;
  return "";
}

// A map from the views that are loaded.
Error Estimate(int threads, Capture* capture) {
  LightField* light_field = &capture->light_field;
  const int star = StarWithin(light_field->positions);
  if (star == 1) {
    return Expected(MapName(*capture),
                    light_field->views.size() == 1
                        ? "a disparity map, as one view alone shows none"
                        : "a disparity map: it is estimated from 5, 9 or 17 views of a star only",
                    "no file");
  }
  DisparityRange range;
  Error error = FindRange(capture->path, *light_field, threads, &range);
  if (!error.empty()) return error;
  std::fprintf(stderr, "%s: no map: disparities from %s to %s are estimated from %d views\n",
               MapName(*capture).c_str(), Short(range.min).c_str(), Short(range.max).c_str(), star);
  DisparityEstimate estimate;
  error = EstimateDisparity(capture->path, *light_field, range, threads, &estimate);
  if (error.empty()) light_field->disparity = std::move(estimate.map);
  return error;
}

}  // namespace

void AddInputOptions(CLI::App* command, InputOptions* options, std::vector<std::string>* several) {
  const std::string what = "Light-field folder, folder of views as others have it, or depth photo";
  CLI::Option* source = several == nullptr
                            ? command->add_option("SRC", options->path, what)
                            : command->add_option("SRC", *several, what + "; or several");
  source->type_name("DIR|PHOTO")->required();
  command
      ->add_option("--depth", options->depth,
                   "Depth picture of a photo: .png, .jpg, .ppm or .pfm; default: the map in the "
                   "photo, or NAME-depth.png or .jpg beside it")
      ->type_name("FILE");
  command
      ->add_option("--near", options->near,
                   "What is near in a depth picture; default: guessed from what is low in it")
      ->type_name("white|black");
}

void AddMapOptions(CLI::App* command, MapOptions* options) {
  command->add_flag("--fill-invalid", options->fill,
                    "Replace non-finite disparities by their nearest valid neighbour");
  CLI::Option* repair = command->add_flag(
      "--repair", options->repair,
      "Repair the disparity map first, by the side views or, of one view, its colours: wrong or "
      "blurred edges, noise, unknown values; depth photos have it done");
  command->add_flag("--no-repair", options->no_repair, "Leave the map of a depth photo as it is")
      ->excludes(repair);
}

Error OpenInput(const InputOptions& options, Capture* capture) {
  CaptureOptions wanted;
  wanted.depth = options.depth;
  Error error = ParseNear(options.near, &wanted.near);
  std::error_code ignored;
  const char* option = !options.depth.empty() ? "--depth" : "--near";
  if (error.empty() && !(options.depth.empty() && options.near.empty()) &&
      std::filesystem::is_directory(options.path, ignored)) {
    error = Error::Usage(option, "a photo, not a folder", options.path);
  }
  if (error.empty()) error = OpenCapture(options.path, wanted, capture);
  if (!error.empty()) return error;
  for (const std::string& note : capture->notes) {
    std::fprintf(stderr, "%s: %s\n", options.path.c_str(), note.c_str());
  }
  return "";
}

Error LoadInput(const Positions& views, int threads, Capture* capture) {
  std::vector<ViewFile> chosen;
  for (const sf_position& view : views) {
    // A view that is not there is the option's fault.
    if (SelectViewFiles(capture->path, capture->files, {view}, &chosen).empty()) continue;
    return Error::Usage(
        "--views", "some of the " + std::to_string(capture->files.size()) + " in " + capture->path,
        std::to_string(views.size()) + " with " + ViewName(view));
  }
  ThreadRunner runner(threads);
  const Error error = LoadCapture(views, capture, &runner);
  return error.empty() && capture->map_path.empty() ? Estimate(threads, capture) : error;
}

Error CareForMap(const MapOptions& options, int threads, Capture* capture) {
  if (capture->map_path.empty()) return "";
  const bool repair = options.repair || (!options.no_repair && capture->care == MapCare::kRepair);
  if (repair) {
    return RepairDisparity(MapName(*capture), threads, &capture->light_field, nullptr);
  }
  if (!options.fill && capture->care == MapCare::kNone) return "";
  return FillHoles(MapName(*capture), &capture->light_field.disparity);
}

Error FillHoles(const std::string& where, FloatMap* map) {
  const sf_status status = sf_fill_disparity(map->values.data(), sizeof(float) * size_t(map->width),
                                             map->width, map->height);
  return status == SF_OK ? "" : Expected(where, "a disparity map", sf_status_string(status));
}

std::string MapName(const Capture& capture) {
  return capture.map_path.empty() ? DisparityPath(capture.path) : capture.map_path;
}

}  // namespace starfocus
