// SPDX-License-Identifier: Apache-2.0
// usage: starfocus-bench-count MODE [FOLDER VIEWS]
//
// Refocuses one light field once, so that callgrind can count the instructions of
// starfocus_refocus. The light field is small and synthetic, or has the first VIEWS views of
// FOLDER. The focus is the smallest disparity. Prints the number of pixels and the SIMD target.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "examples/lab/bench/timed_engine.h"
#include "platform/file.h"
#include "starfocus/starfocus.h"

namespace {

using starfocus::Image;
using starfocus::bench::Field;

constexpr int kWidth = 256, kHeight = 192, kViews = 5;

// Returns the texture at (x, y), from 96 to 222. Integer arithmetic makes the texture equal on
// every machine.
uint8_t Texture(int x, int y, int channel) {
  const uint32_t mixed = uint32_t(x / 3 * 73 + y / 2 * 151 + channel * 57) * 2654435761u;
  return uint8_t(96 + (mixed >> 26) + ((x + 2 * y) & 63));
}

// Returns the disparity in 1/64 pixel: a slanted wall, a disc in front of the wall, and a bar
// behind the focus.
int Disparity64(int x, int y) {
  const int dx = x - 90, dy = y - 100;
  if (dx * dx + dy * dy < 50 * 50) return 64 * 6;
  if (x > 180 && x < 200) return -64 * 3;
  return (x + y) / 4 - 64;
}

Field MakeField() {
  Field field;
  field.name = "count";
  field.data.disparity.width = kWidth;
  field.data.disparity.height = kHeight;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      field.data.disparity.values.push_back(float(Disparity64(x, y)) / 64);
    }
  }
  for (int i = 0; i < kViews; ++i) {
    double u = 0, v = 0;
    starfocus_view_position(i, &u, &v, nullptr);
    Image view(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        for (int c = 0; c < 3; ++c) {
          const int shift = Disparity64(x, y) / 64;
          view.row(y)[3 * x + c] = Texture(x + int(u) * shift, y + int(v) * shift, c);
        }
      }
    }
    field.data.views.push_back(view);
  }
  field.low = -3;
  field.high = 6;
  return field;
}

starfocus::Error Load(const std::string& folder, int views, Field* field) {
  const starfocus::Error error = starfocus::bench::LoadField(folder, field);
  if (error || (views >= 1 && views <= field->views())) return error;
  return starfocus::Expected(folder, std::to_string(views) + " views",
                             std::to_string(field->views()));
}

starfocus::Error RefocusOnce(const Field& field, const starfocus::bench::Task& task, double focus) {
  starfocus::bench::TimedEngine timed;
  const starfocus::Error error = Prepare(field, task, focus, 1, &timed);
  starfocus::bench::Elapsed ignored;
  return error ? error : RunOnce(field, task, &timed, &ignored);
}

}  // namespace

int main(int argc, char** argv) {
  starfocus::bench::Task task;
  task.timed = false;
  task.views = argc == 4 ? std::atoi(argv[3]) : kViews;
  if (argc > 1) task.mode = argv[1];
  if ((argc != 2 && argc != 4) || starfocus::bench::ModeOf(task.mode) < 0) {
    std::fprintf(stderr,
                 "usage: starfocus-bench-count block|frame|benchmark|blur [FOLDER VIEWS]\n");
    return 1;
  }
  Field field;
  starfocus::Error error;
  if (argc == 4) {
    error = Load(argv[2], task.views, &field);
  } else {
    field = MakeField();
  }
  if (!error) error = RefocusOnce(field, task, argc == 4 ? field.low : 0);
  if (error) {
    std::fprintf(stderr, "%s\n", error.line().c_str());
    return 1;
  }
  std::printf("%.0f %s\n", field.pixels(), starfocus_simd_target());
  return 0;
}
