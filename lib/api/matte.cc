// SPDX-License-Identifier: Apache-2.0
// C API: measures mattes, and computes disparity maps and coverage from mattes.
#include "starfocus/matte.h"

#include <cmath>
#include <cstring>

#include "lib/api/validate.h"
#include "lib/engine/lens.h"
#include "lib/io/depth_map.h"
#include "lib/io/matte_rows.h"
#include "lib/matting/coverage.h"

namespace starfocus {
namespace {

constexpr int32_t kSubject = 128;  // least alpha of the subject

size_t StepOf(const starfocus_matte& matte) {
  return static_cast<size_t>(Max(1, matte.pixel_stride));
}

size_t RowBytes(const starfocus_matte& matte) {
  return static_cast<size_t>(matte.width - 1) * StepOf(matte) + 1;
}

void CheckMatte(const starfocus_matte& matte, Checker* check) {
  check->NotNull(matte.data, "matte.data");
  const Allowed size = STARFOCUS_FROM_TO(1, STARFOCUS_MAX_SIZE);
  check->In({"matte.width", double(matte.width)}, size);
  check->In({"matte.height", double(matte.height)}, size);
  check->In({"matte.pixel_stride", double(matte.pixel_stride)},
            STARFOCUS_FROM_TO(0, STARFOCUS_MAX_PIXEL_STRIDE));
  if (!check->passed()) return;
  check->Stride(ValidStride(matte.stride, RowBytes(matte), matte.height), "matte.stride",
                matte.stride);
}

void CheckMatteDepth(const starfocus_matte_depth& depth, Checker* check) {
  const Allowed disparity = STARFOCUS_FROM_TO(-STARFOCUS_MAX_DISPARITY, STARFOCUS_MAX_DISPARITY);
  check->In({"depth.subject", depth.subject}, disparity);
  check->In({"depth.background", depth.background},
            {"at most subject", disparity.low, depth.subject});
  if (depth.horizon == 0 && depth.ground == 0) return;
  check->In({"depth.ground", depth.ground}, {"above horizon and at most 1", 0, 1});
  check->Need(depth.horizon >= 0 && depth.horizon < depth.ground, STARFOCUS_ERROR_RANGE,
              {"depth.horizon", depth.horizon}, {"at least 0 and below ground"});
}

Extent ExtentOfMatte(const starfocus_matte& matte) {
  return ExtentOf(matte.data, matte.stride, matte.height, RowBytes(matte));
}

Extent ExtentOfCoverage(const Rect& area, const starfocus_disparity_output& out) {
  return ExtentOf(out.coverage, out.coverage_stride, area.height, static_cast<size_t>(area.width));
}

// Returns the part of a picture of width x height that `region` selects. A null region selects the
// whole picture.
Rect AreaOf(const starfocus_region* region, int32_t width, int32_t height, Checker* check) {
  CheckSize(width, height, check);
  if (region == nullptr || IsWhole(*region)) return {0, 0, width, height};
  CheckRegion(*region, width, height, check);
  return {region->x, region->y, region->width, region->height};
}

// Starts an API call that reads a matte and a description of its depth.
Checker EnterMatte(const starfocus_matte* matte, const void* depth,
                   const starfocus_disparity_output* out, starfocus_problem* problem) {
  Checker check = Enter(problem);
  check.NotNull(matte, "matte");
  check.NotNull(depth, "depth");
  check.NotNull(out, "out");
  if (check.passed()) CheckMatte(*matte, &check);
  return check;
}

int64_t CountSubject(const starfocus_matte& matte, int32_t y) {
  const uint8_t* sample = matte.data + static_cast<size_t>(y) * matte.stride;
  int64_t count = 0;
  for (int32_t x = 0; x < matte.width; ++x, sample += StepOf(matte)) {
    count += *sample >= kSubject ? 1 : 0;
  }
  return count;
}

// Returns the number of rows, from row `y` in steps of `step`, that contain at most `most` samples
// of the subject together.
int32_t CountRows(const starfocus_matte& matte, int32_t y, int32_t step, int64_t most) {
  int32_t rows = 0;
  for (int64_t samples = 0; rows < matte.height; ++rows, y += step) {
    samples += CountSubject(matte, y);
    if (samples > most) break;
  }
  return rows;
}

int32_t RoundDisparity(double disparity) {
  return static_cast<int32_t>(std::floor(disparity * (1 << kDisparityBits) + 0.5));
}

// Returns the disparity of the background in row y of a picture, in 1/64 pixel.
int32_t BackgroundAt(const starfocus_matte_depth& depth, int32_t y, int32_t height) {
  constexpr int kFractionBits = 24;  // of positions as fractions of the height
  const auto fraction = [](double part) {
    return static_cast<int64_t>(part * (1 << kFractionBits) + 0.5);
  };
  const int32_t far = RoundDisparity(depth.background), near = RoundDisparity(depth.subject);
  if (depth.ground <= 0) return far;  // without a floor
  const int64_t begin = fraction(depth.horizon), length = fraction(depth.ground) - begin;
  const int64_t middle = ((2 * int64_t{y} + 1) << (kFractionBits - 1)) / height;
  if (middle <= begin) return far;
  if (middle >= begin + length) return near;
  return far + static_cast<int32_t>(((near - far) * (middle - begin) + length / 2) / length);
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_measure_matte(const starfocus_matte* matte, starfocus_matte_stats* stats,
                                         starfocus_problem* problem) {
  Checker check = Enter(problem);
  check.NotNull(matte, "matte");
  check.NotNull(stats, "stats");
  if (!check.passed()) return check.status();
  CheckMatte(*matte, &check);
  if (!check.passed()) return check.status();
  const int32_t width = matte->width, height = matte->height;
  int32_t left = width, right = 0, top = height, bottom = 0;
  uint64_t sum = 0;
  int64_t subject = 0;
  for (int32_t y = 0; y < height; ++y) {
    const uint8_t* sample = matte->data + static_cast<size_t>(y) * matte->stride;
    for (int32_t x = 0; x < width; ++x, sample += StepOf(*matte)) {
      sum += *sample;
      if (*sample < kSubject) continue;
      ++subject;
      left = Min(left, x);
      right = Max(right, x + 1);
      top = Min(top, y);
      bottom = y + 1;
    }
  }
  *stats = {};
  stats->covered = static_cast<double>(sum) / (255.0 * width * height);
  if (bottom == 0) return STARFOCUS_OK;
  stats->left = double(left) / width;
  stats->top = double(top) / height;
  stats->right = double(right) / width;
  stats->bottom = double(bottom) / height;
  // Wrong samples of a network, such as a speck in the last row, must not move the floor.
  constexpr int64_t kSpecks = 256;
  const int64_t specks = subject / kSpecks;
  const double head = double(CountRows(*matte, 0, 1, specks)) / height;
  stats->ground = double(height - CountRows(*matte, height - 1, -1, specks)) / height;
  stats->horizon = std::fmin(0.5, (head + stats->ground) / 2);
  return STARFOCUS_OK;
}

starfocus_status starfocus_matte_field(const starfocus_matte* matte,
                                       const starfocus_matte_depth* depth, int32_t width,
                                       int32_t height, const starfocus_region* region,
                                       starfocus_disparity_output* out,
                                       starfocus_problem* problem) {
  Checker check = EnterMatte(matte, depth, out, problem);
  if (!check.passed()) return check.status();
  CheckMatteDepth(*depth, &check);
  const Rect area = AreaOf(region, width, height, &check);
  CheckMap(out->disparity, out->disparity_stride, area.width, area.height, "out.disparity",
           "out.disparity_stride", &check);
  CheckBytes(out->coverage, out->coverage_stride, area.width, area.height, "out.coverage_stride",
             &check);
  if (!check.passed()) return check.status();
  Extents taken;
  taken.Add(ExtentOfMatte(*matte));
  const Extent map_memory = ExtentOf(out->disparity, out->disparity_stride, area.height,
                                     static_cast<size_t>(area.width) * sizeof(float));
  check.Apart(map_memory, taken, "out");
  taken.Add(map_memory);
  if (out->coverage != nullptr) check.Apart(ExtentOfCoverage(area, *out), taken, "out");
  if (!check.passed()) return check.status();
  constexpr float kUnit = 1.0f / (1 << kDisparityBits);
  const auto subject = static_cast<float>(RoundDisparity(depth->subject)) * kUnit;
  for (int32_t x = 0; x < area.width; x += kMattePiece) {
    const int32_t count = Min(kMattePiece, area.width - x);
    MatteRows rows(*matte, width, height, area.x + x, count);
    for (int32_t y = 0; y < area.height; ++y) {
      uint8_t alpha[kMattePiece];
      rows.Read(area.y + y, alpha);
      const auto row = static_cast<size_t>(y);
      const auto behind = static_cast<float>(BackgroundAt(*depth, area.y + y, height)) * kUnit;
      float* const map = out->disparity + row * (out->disparity_stride / sizeof(float)) + x;
      for (int32_t k = 0; k < count; ++k) map[k] = alpha[k] >= kSubject ? subject : behind;
      if (out->coverage == nullptr) continue;
      std::memcpy(out->coverage + row * out->coverage_stride + x, alpha,
                  static_cast<size_t>(count));
    }
  }
  out->has_coverage = out->coverage != nullptr ? 1 : 0;
  return STARFOCUS_OK;
}

starfocus_status starfocus_matte_coverage(const starfocus_matte* matte,
                                          const starfocus_depth_map* depth, int32_t width,
                                          int32_t height, const starfocus_region* region,
                                          starfocus_disparity_output* out,
                                          starfocus_problem* problem) {
  Checker check = EnterMatte(matte, depth, out, problem);
  if (!check.passed()) return check.status();
  CheckLoneMap(*depth, width, height, &check);
  const Rect area = AreaOf(region, width, height, &check);
  check.NotNull(out->coverage, "out.coverage");
  CheckBytes(out->coverage, out->coverage_stride, area.width, area.height, "out.coverage_stride",
             &check);
  if (!check.passed()) return check.status();
  Extents read;
  read.Add(ExtentOfMatte(*matte));
  AddDepthMap(*depth, &read);
  check.Apart(ExtentOfCoverage(area, *out), read, "out");
  if (!check.passed()) return check.status();
  constexpr auto kMost = static_cast<float>(STARFOCUS_MAX_DISPARITY);
  const DepthSource source = {*depth, RuleOf(*depth, -kMost, kMost), width, height, nullptr};
  const simd::ImageKernels& kernels = simd::BestImageKernels();
  const uint32_t flags =
      CheckDepth(kernels, source,
                 {Max(0, area.y - kMatteRadius), Min(height, area.y + area.height + kMatteRadius)});
  check.Need((flags & simd::kUnknownDepth) == 0, STARFOCUS_ERROR_NOT_FINITE, {"depth"}, {"finite"});
  check.Need((flags & simd::kDepthOutside) == 0, STARFOCUS_ERROR_DISPARITY, {"depth"},
             {"disparities within +-STARFOCUS_MAX_DISPARITY"});
  if (!check.passed()) return check.status();
  MatteCoverage(kernels, *matte, source, area, {out->coverage, out->coverage_stride, 0, area.y});
  out->has_coverage = 1;
  return STARFOCUS_OK;
}
