// SPDX-License-Identifier: Apache-2.0
// starfocus-lab flicker: refocuses the frames of a moving scene with exact, unstable, repaired and
// stabilised maps, and measures how much the pictures flicker.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "examples/cli/engine_run.h"
#include "examples/cli/estimate_run.h"
#include "examples/cli/map_stabiliser.h"
#include "examples/cli/pictures.h"
#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "examples/lab/commands.h"
#include "examples/lab/lab_config.h"
#include "platform/folder.h"
#include "platform/image_io.h"
#include "platform/text.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

// A jump is a change of a sample from frame to frame that differs by more than this from the change
// of the true picture, in grey levels.
constexpr int kJump = 8;
// First frame of the second half of the table. Maps that are computed from previous frames are
// stable from here on.
constexpr size_t kSettled = 2;

struct FlickerOptions {
  std::string clip;
  int threads = 1;
};

// A moving scene that starfocus-lab scene has rendered.
struct Clip {
  std::vector<std::string> folders;
  std::string truth;  // name of the ray-traced picture in each folder
  double focus = 0, aperture = 0;
};

struct Frame {
  std::string folder;
  LightField light_field;  // with the unstable map
  FloatMap exact;
  Image truth;
};

// Error of the pictures of some frames, as sums of the errors of each frame.
struct Errors {
  double psnr = 0, change = 0, jumps = 0;
  int pictures = 0, changes = 0;
};

// A row of the table: a way to make maps. `make` replaces the unstable map of the light field,
// which is that of the frame with the views of the row. `make` is called once for each frame, in
// order, so that it may keep data of the previous frame.
struct Row {
  const char* map;
  int views;
  std::function<Error(const Frame& frame, LightField* light_field)> make;
  Image before = {};  // picture of the previous frame
  Errors all = {}, settled = {};
};

std::vector<Row> MakeRows(const FlickerOptions& options, int views) {
  const auto exact = [](const Frame& frame, LightField* light_field) {
    light_field->disparity = frame.exact;
    return Error();
  };
  const auto unstable = [](const Frame&, LightField*) { return Error(); };
  const auto repaired = [&options](const Frame& frame, LightField* light_field) {
    Result<DisparityEstimate> estimate =
        RepairDisparity(frame.folder, *light_field, {options.threads, true, false});
    if (!estimate) return estimate.error();
    light_field->disparity = std::move(estimate->map);
    light_field->coverage = std::move(estimate->coverage);
    return Error();
  };
  std::vector<int> counts = {views, 1};
  if (views == 1) counts.pop_back();
  std::vector<Row> rows;
  for (const int count : counts) rows.push_back({"exact", count, exact});
  for (const int count : counts) rows.push_back({"unstable", count, unstable});
  for (const int count : counts) rows.push_back({"repaired", count, repaired});
  for (const int count : counts) {
    const auto stabiliser = std::make_shared<MapStabiliser>(options.threads);
    rows.push_back({"stable", count, [=](const Frame& frame, LightField* light_field) {
                      Error error = stabiliser->Stabilise(frame.folder, light_field, nullptr);
                      return error ? error : repaired(frame, light_field);
                    }});
  }
  return rows;
}

// Reads the lens of a ray-traced picture from the name of its file. Returns false if the file is no
// picture of a lens with the default opening and one disparity in focus.
bool ReadTruthName(const std::string& name, Clip* clip) {
  if (std::sscanf(name.c_str(), "truth_dt%lf_ut%lf", &clip->focus, &clip->aperture) != 2) {
    return false;
  }
  return name == "truth_dt" + Short(clip->focus) + "_ut" + Short(clip->aperture) + ".png" &&
         std::fabs(clip->focus) <= STARFOCUS_MAX_DISPARITY && clip->aperture > 0 &&
         clip->aperture <= 1;
}

Result<Clip> FindClip(const std::string& path) {
  Clip clip;
  const Result<std::vector<std::string>> names = ListFolder(path);
  if (!names) return names.error();
  for (const std::string& name : *names) {
    if (name.rfind("frame_", 0) == 0) clip.folders.push_back((fs::path(path) / name).string());
  }
  if (clip.folders.size() < 2) {
    return Expected(path, "at least two frames of `starfocus-lab scene --frames`",
                    std::to_string(clip.folders.size()));
  }
  const Result<std::vector<std::string>> files = ListFolder(clip.folders[0]);
  if (!files) return files.error();
  int count = 0;
  for (const std::string& name : *files) {
    Clip found;
    if (!ReadTruthName(name, &found)) continue;
    ++count;
    clip.truth = name;
    clip.focus = found.focus;
    clip.aperture = found.aperture;
  }
  if (count == 1) return clip;
  return Expected(clip.folders[0], "one picture truth_dt<D>_ut<U>.png, as --truth D,U renders",
                  std::to_string(count));
}

Result<Frame> LoadFrame(const Clip& clip, const std::string& folder) {
  Frame frame;
  frame.folder = folder;
  Error error = LoadLightField(folder, {}).MoveTo(&frame.light_field);
  const std::string exact = (fs::path(folder) / "exact.pfm").string();
  const std::string truth = (fs::path(folder) / clip.truth).string();
  if (!error) error = ReadPfm(exact).MoveTo(&frame.exact);
  if (!error) error = ReadImage(truth).MoveTo(&frame.truth);
  if (error) return error;
  const int width = frame.light_field.width(), height = frame.light_field.height();
  const auto check = [&](const std::string& path, int w, int h) {
    if (w == width && h == height) return Error();
    return Expected(path, SizeText(width, height) + " pixels, the size of the views",
                    SizeText(w, h));
  };
  error = check(exact, frame.exact.width, frame.exact.height);
  if (!error) error = check(truth, frame.truth.width, frame.truth.height);
  if (error) return error;
  return frame;
}

// Refocuses a frame with the map of a row.
Result<Image> Refocus(const FlickerOptions& options, const Clip& clip, const Frame& frame,
                      const Row& row) {
  const auto views = static_cast<size_t>(row.views);
  LightField light_field;
  light_field.views.assign(frame.light_field.views.begin(),
                           frame.light_field.views.begin() + row.views);
  light_field.positions = frame.light_field.positions;
  light_field.positions.resize(views);
  light_field.disparity = frame.light_field.disparity;
  if (Error error = row.make(frame, &light_field)) return error;
  EngineTask task;
  task.light_field = &light_field;
  task.config = ConfigOf(light_field);
  task.params.focus = clip.focus;
  task.params.aperture = clip.aperture;
  task.threads = options.threads;
  EngineRun run(options.threads, 1);
  if (Error error = run.Start(frame.folder, task)) return error;
  Result<EngineResult> result = run.Refocus(frame.folder, task);
  if (!result) return result.error();
  return std::move(result->picture);
}

// Adds the difference between the change of a picture from frame to frame and the change of the
// true picture.
void AddChange(const Image& picture, const Image& before, const Image& truth,
               const Image& truth_before, Errors* errors) {
  int64_t sum = 0, jumps = 0;
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    const int change = picture.pixels[i] - before.pixels[i];
    const int error = std::abs(change - (truth.pixels[i] - truth_before.pixels[i]));
    sum += error;
    jumps += error > kJump ? 1 : 0;
  }
  const auto samples = static_cast<double>(picture.pixels.size());
  errors->change += static_cast<double>(sum) / samples;
  errors->jumps += static_cast<double>(jumps) / samples;
  ++errors->changes;
}

// Measures a frame in all rows. `truth_before` is empty at the first frame.
Error MeasureFrame(const FlickerOptions& options, const Clip& clip, size_t index,
                   const Frame& frame, const Image& truth_before, std::vector<Row>* rows) {
  for (Row& row : *rows) {
    Result<Image> picture = Refocus(options, clip, frame, row);
    if (!picture) return picture.error();
    for (Errors* errors : {&row.all, &row.settled}) {
      if (errors == &row.settled && index < kSettled) continue;
      errors->psnr += MeasureDifference(*picture, frame.truth).psnr;
      ++errors->pictures;
      if (index > 0) AddChange(*picture, row.before, frame.truth, truth_before, errors);
    }
    row.before = std::move(*picture);
  }
  return {};
}

void PrintErrors(const Errors& errors) {
  if (errors.pictures == 0) return;
  std::printf("  %6.2f  %6.3f  %5.2f %%", errors.psnr / errors.pictures,
              errors.change / errors.changes, 100 * errors.jumps / errors.changes);
}

void PrintTable(const Clip& clip, const Image& truth, const std::vector<Row>& rows) {
  std::printf("%zu frames of %s pixels, focus at disparity %s, aperture %s\n", clip.folders.size(),
              SizeText(truth.width, truth.height).c_str(), Short(clip.focus).c_str(),
              Short(clip.aperture).c_str());
  std::printf("                 all frames                from frame 3 on\n");
  std::printf("map       views    PSNR  change    jumps    PSNR  change    jumps\n");
  for (const Row& row : rows) {
    std::printf("%-8s  %5d", row.map, row.views);
    PrintErrors(row.all);
    PrintErrors(row.settled);
    std::printf("\n");
  }
}

Error Run(const FlickerOptions& options) {
  const Result<Clip> clip = FindClip(options.clip);
  if (!clip) return clip.error();
  std::vector<Row> rows;
  Image truth;
  for (size_t i = 0; i < clip->folders.size(); ++i) {
    Result<Frame> frame = LoadFrame(*clip, clip->folders[i]);
    if (!frame) return frame.error();
    const int views = StarWithin(frame->light_field.positions);
    if (i == 0) rows = MakeRows(options, views);
    if (i > 0 && (frame->truth.width != truth.width || frame->truth.height != truth.height ||
                  views != rows[0].views)) {
      return Expected(clip->folders[i], "the size and the views of the first frame", "others");
    }
    if (Error error = MeasureFrame(options, *clip, i, *frame, truth, &rows)) return error;
    truth = std::move(frame->truth);
  }
  PrintTable(*clip, truth, rows);
  return {};
}

}  // namespace

Command FlickerCommand() {
  const auto options = std::make_shared<FlickerOptions>();
  return {"flicker",
          "Measure how much the pictures of a moving scene flicker with exact, unstable, "
          "repaired and stabilised maps: the mean PSNR, the mean error of the change from frame to "
          "frame in grey "
          "levels, and the share of samples where this error is above 8",
          {
              {"DIR", "DIR",
               "Clip that `starfocus-lab scene --frames N --unstable SEED --truth D,U` has written",
               &options->clip, Use::kRequired},
              ThreadsOption(&options->threads),
          },
          [options] { return Run(*options); },
          {"starfocus-lab flicker clip", "starfocus-lab flicker clip --threads 2"}};
}

}  // namespace starfocus
