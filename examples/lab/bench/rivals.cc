// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/bench/rivals.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "examples/lab/bench/metrics.h"
#include "platform/image_io.h"

// Runs other programs that blur one picture by a map of blur radii. Each program runs without a
// shell and uses one core.
extern char** environ;

namespace starfocus::bench {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct Files {
  std::string centre, map, out;
};

Error Execute(const Words& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {0, 1, 2}) {
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  }
  pid_t child = 0;
  const int failure =
      posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  const bool good = failure == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
                    WEXITSTATUS(status) == 0;
  return good ? Error() : Expected(words[0], "a run without an error", "one");
}

// Half the width of a box with the same variance as a disc of radius 1.
constexpr double kBoxOfDisc = 0.866;

// Returns the command line of ffmpeg. Half the width of a varblur box is 1 + 4 max_r m / 255, where
// m is the value of the map.
Words Ffmpeg(const Files& files, double largest, int pictures, Image* map, double scale) {
  const double reach = std::max(1.0, kBoxOfDisc * scale * largest);
  const int max_r = std::max(1, int(std::ceil((reach - 1) / 4)));
  for (uint8_t& value : map->pixels) {
    const double half = kBoxOfDisc * scale * largest * value / 255;
    value = uint8_t(std::lround(std::clamp((half - 1) * 255 / (4 * max_r), 0.0, 255.0)));
  }
  const std::string graph =
      "[0]format=gbrp,loop=-1:1:0[a];[1]format=gbrp,loop=-1:1:0[b];[a][b]"
      "varblur=max_r=" +
      std::to_string(max_r);
  Words words = {"ffmpeg",
                 "-y",
                 "-v",
                 "error",
                 "-filter_complex_threads",
                 "1",
                 "-i",
                 files.centre,
                 "-i",
                 files.map,
                 "-filter_complex",
                 graph,
                 "-frames:v",
                 std::to_string(pictures)};
  if (files.out.empty()) {
    words.insert(words.end(), {"-f", "null", "-"});
  } else {
    words.insert(words.end(), {"-update", "1", files.out});
  }
  return words;
}

Words Gegl(const Files& files, double largest, int pictures, Image*, double scale) {
  Words words = {"gegl", files.centre, "-o", files.out, "--"};
  if (files.out.empty()) words[3] = (fs::path(files.centre).parent_path() / "timed.ppm").string();
  for (int i = 0; i < pictures; ++i) {
    words.insert(words.end(), {"gegl:lens-blur", "radius=" + std::to_string(scale * largest),
                               "aux=[", "gegl:load", "path=" + files.map, "]"});
  }
  return words;
}

Words Magick(const Files& files, double largest, int pictures, Image*, double scale) {
  const std::string radius = std::to_string(scale * largest);
  Words words = {"convert-im6.q16", files.centre, files.map};
  for (int i = 0; i < pictures; ++i) {
    words.insert(words.end(), {"(", "-clone", "0,1", "-compose", "blur", "-define",
                               "compose:args=" + radius + "x" + radius, "-composite", ")"});
  }
  words.insert(words.end(), {"-delete", "0,1", files.out.empty() ? "null:" : files.out});
  return words;
}

using MakeWords = Words (*)(const Files&, double, int, Image*, double);

struct Known {
  Tool tool;
  MakeWords words;
  int more;  // number m of additional pictures in the second run, see ToolResult::seconds
};

const Known kKnown[] = {
    {{"ffmpeg-varblur", "ffmpeg"}, Ffmpeg, 20},
    {{"gegl-lens-blur", "gegl"}, Gegl, 12},
    {{"imagemagick-blur", "convert-im6.q16"}, Magick, 1},
};

// Returns a picture with the blur radius of every pixel. The largest radius is white.
Image BlurMap(const Field& field, double focus, double largest) {
  Image map(field.data.width(), field.data.height());
  const std::vector<float>& values = field.data.disparity.values;
  for (size_t i = 0; i < values.size(); ++i) {
    const double radius = std::fabs(values[i] - focus);
    std::fill_n(map.pixels.begin() + std::ptrdiff_t(3 * i), 3,
                uint8_t(std::lround(255 * radius / largest)));
  }
  return map;
}

// Returns the processor time of all child processes that have ended, in seconds.
double ChildSeconds() {
  rusage usage = {};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Job {
  const Known* known;
  Files files;
  Image map;
  double largest;

  Error Make(double scale, int pictures, bool keep, double* seconds) const {
    Files used = files;
    if (!keep) used.out.clear();
    Image changed = map;
    const Words words = known->words(used, largest, pictures, &changed, scale);
    Error error = WriteImage(files.map, changed);
    const double start = ChildSeconds();
    if (!error) error = Execute(words);
    *seconds = ChildSeconds() - start;
    return error;
  }
};

// Tries several ratios of the tool's unit of blur to a blur radius of one pixel, and keeps the
// ratio and the picture with the highest PSNR.
Error Tune(const Job& job, const Image& truth, double* scale, ToolResult* result) {
  double best = -1;
  for (const double tried : {0.35, 0.5, 0.7, 1.0}) {
    double ignored = 0;
    if (Error error = job.Make(tried, 1, true, &ignored)) return error;
    Result<Image> picture = ReadImage(job.files.out);
    if (!picture) return picture.error();
    if (picture->pixels.size() != truth.pixels.size()) {
      return Expected(job.known->tool.name, "a picture as large as the view", "another");
    }
    const double psnr = Psnr(*picture, truth);
    if (psnr <= best) continue;
    best = psnr;
    *scale = tried;
    result->picture = std::move(*picture);
  }
  return {};
}

}  // namespace

const std::vector<Tool>& Tools() {
  static const std::vector<Tool> tools = [] {
    std::vector<Tool> all;
    for (const Known& known : kKnown) all.push_back(known.tool);
    return all;
  }();
  return tools;
}

bool IsInstalled(const Tool& tool) {
  const char* path = std::getenv("PATH");
  std::string rest = path == nullptr ? "" : path;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(':'), rest.size());
    std::error_code failure;
    if (fs::exists(fs::path(rest.substr(0, end)) / tool.program, failure)) return true;
    rest.erase(0, std::min(end + 1, rest.size()));
  }
  return false;
}

Error RunTool(const Tool& tool, const Field& field, double focus, const Image& truth,
              const std::string& folder, int repetitions, ToolResult* result) {
  for (const char* name : {"MAGICK_THREAD_LIMIT", "OMP_NUM_THREADS", "GEGL_THREADS"}) {
    setenv(name, "1", 1);
  }
  setenv("GEGL_USE_OPENCL", "no", 1);
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  Job job;
  job.known = std::find_if(std::begin(kKnown), std::end(kKnown), [&](const Known& known) {
    return std::string(known.tool.name) == tool.name;
  });
  job.files = {path("rival_centre.png"), path("rival_map.png"), path("rival_out.png")};
  job.largest = std::max(1e-3, field.LargestBlur(focus, 1));
  job.map = BlurMap(field, focus, job.largest);
  double scale = 1;
  Error error = WriteImage(job.files.centre, field.data.views[0]);
  if (!error) error = Tune(job, truth, &scale, result);
  const int more = job.known->more;
  for (int i = 0; i < std::min(repetitions, 3) && !error; ++i) {
    double one = 0, many = 0;
    error = job.Make(scale, 1, false, &one);
    if (!error) error = job.Make(scale, 1 + more, false, &many);
    result->each.push_back(std::max(0.0, many - one) / more);
  }
  if (error) return error;
  result->seconds = Median(result->each);
  if (result->seconds > 0) return {};
  return Expected(tool.name, "a time per picture above the noise of the start-up time", "none");
}

}  // namespace starfocus::bench
