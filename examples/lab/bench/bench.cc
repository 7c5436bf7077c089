// SPDX-License-Identifier: Apache-2.0
// starfocus-bench measures the run time and the error of the engine. studies.h lists the
// measurements.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "examples/lab/bench/measure.h"
#include "examples/lab/bench/output.h"
#include "examples/lab/bench/rivals.h"
#include "examples/lab/bench/timed_engine.h"
#include "platform/file.h"

namespace starfocus::bench {
namespace {

struct Options {
  std::string transfer = "srgb";
  std::vector<std::string> folders;
  std::string csv, json, revision, sweep;
  Choice choice;
  Settings settings;
};

Error Save(const std::string& path, const std::string& text) {
  return path.empty() ? Error() : WriteFile(path, Bytes(text.begin(), text.end()));
}

Error Check(const Options& options) {
  for (const std::string& mode : options.choice.modes) {
    if (ModeOf(mode) < 0) {
      return Expected("--modes", "block, frame, benchmark or blur", "'" + mode + "'");
    }
  }
  for (const std::string& path : {options.csv, options.json}) {
    if (Error error = path.empty() ? Error() : CheckOutputPath(path)) return error;
  }
  for (const double scale : options.choice.n_scales) {
    if (scale >= STARFOCUS_MIN_N_SCALE && scale <= STARFOCUS_MAX_N_SCALE) continue;
    return Expected("--n-scales", "factors from 0.5 to 2", std::to_string(scale));
  }
  if (options.choice.quantiles.empty()) return Expected("--quantiles", "at least one", "none");
  return {};
}

Error MeasureSweeps(const Options& options, std::vector<Row>* rows) {
  if (options.sweep.empty()) return {};
  Field field;
  if (Error error = LoadField(options.sweep, &field)) return error;
  if (Error error = MeasureRadii(field, options.choice, options.settings, rows)) return error;
  return MeasureSizes(field, options.choice, options.settings, rows);
}

Error Run(Options options) {
  Error error = Check(options);
  options.settings.folder = std::filesystem::temp_directory_path().string();
  if (!options.json.empty()) {
    options.settings.folder = std::filesystem::absolute(options.json).parent_path().string();
  }
  std::vector<Row> rows;
  for (size_t i = 0; i < options.folders.size() && !error; ++i) {
    Field field;
    error = LoadField(options.folders[i], &field);
    field.transfer = options.transfer == "none" ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
    if (!error) error = MeasureField(field, options.choice, options.settings, &rows);
  }
  if (!error) error = MeasureSweeps(options, &rows);
  if (error) return error;
  const Machine machine = ThisMachine(options.revision);
  error = Save(options.csv, ToCsv(machine, rows));
  return error ? error : Save(options.json, ToJson(machine, rows));
}

void AddOptions(CLI::App* app, Options* options) {
  Choice& choice = options->choice;
  Settings& settings = options->settings;
  app->add_option("DIRS", options->folders, "Light-field folders")->required();
  app->add_option("--transfer", options->transfer, "Transfer function of the ground truth")
      ->check(CLI::IsMember({"srgb", "none"}));
  app->add_option("--csv", options->csv, "Table to write");
  app->add_option("--json", options->json, "JSON file with the results, for report.py");
  app->add_option("--modes", choice.modes, "block, frame, benchmark, blur")->delimiter(',');
  app->add_option("--apertures", choice.apertures, "Radii")->delimiter(',');
  app->add_option("--quantiles", choice.quantiles, "Focus at these quantiles of the disparity map")
      ->delimiter(',');
  app->add_option("--views", choice.views, "Sizes of smaller star sets to measure in block mode")
      ->delimiter(',');
  app->add_option("--max-layers", choice.max_layers, "0, 1, 2")->delimiter(',');
  app->add_option("--superblocks", choice.superblocks, "32, 64, 128, 256")->delimiter(',');
  app->add_option("--n-scales", choice.n_scales, "Factors of N to measure in block and frame mode")
      ->delimiter(',');
  app->add_flag("--rules", choice.rules, "Measure both rules for N in block and frame mode");
  app->add_option("--targets", choice.targets, "SIMD targets, reference (plain C++), or all")
      ->delimiter(',');
  app->add_option("--workers", choice.workers,
                  "Numbers of threads to compare with one thread, at the middle quantile")
      ->delimiter(',')
      ->check(CLI::Range(2, STARFOCUS_MAX_WORKERS));
  app->add_option("--repetitions", settings.repetitions, "Largest number of measurements per task")
      ->check(CLI::Range(1, 1000));
  app->add_option("--patience", settings.patience,
                  "Time limit per task in seconds; later repetitions are omitted");
  app->add_flag("!--no-rivals", settings.rivals, "Do not measure rivals");
  app->add_option("--sweep", options->sweep,
                  "Light field for the sweeps of blur radius and picture size");
  app->add_option("--largest-radius", choice.largest_radius,
                  "Largest blur radius of the sweep in pixels; 0: no sweep");
  app->add_option("--largest-size", choice.largest_megapixels,
                  "Largest picture of the sweep in megapixels; 0: no sweep");
  app->add_option("--revision", options->revision, "Text to append to the version in the output");
}

}  // namespace
}  // namespace starfocus::bench

int main(int argc, char** argv) {
  CLI::App app("Measures the run time and the error of starfocus.", "starfocus-bench");
  starfocus::bench::Options options;
  starfocus::bench::AddOptions(&app, &options);
  CLI11_PARSE(app, argc, argv);
  const starfocus::Error error = starfocus::bench::Run(options);
  if (!error) return 0;
  std::fprintf(stderr, "%s\n", error.line().c_str());
  return 1;
}
