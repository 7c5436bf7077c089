// SPDX-License-Identifier: Apache-2.0
// Fuzz target: images and depth maps of any format, size, stride and content.
#include <algorithm>
#include <utility>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/fuzz/engine_input.h"
#include "tests/support/config.h"

namespace {

using namespace starfocus::fuzz;

struct Size {
  int32_t width, height;
};

// Owns the memory of image planes.
using Planes = std::vector<Rows<uint8_t>>;

uint8_t* TakePlane(int32_t rows, size_t row_bytes, Input* input, size_t* stride, Planes* planes) {
  Rows<uint8_t> plane(row_bytes, rows, 9, input);
  FillPicture<8>(input, &plane);
  *stride = plane.stride;
  planes->push_back(std::move(plane));
  return planes->back().values.get();
}

starfocus_image MakeImage(const Size& size, Input* input, Planes* planes) {
  starfocus_image image = {};
  image.format = input->Int(STARFOCUS_FORMAT_RGB, STARFOCUS_FORMAT_YUV_420_888);
  image.matrix = input->Int(0, 1);
  image.range = input->Int(0, 1);
  const auto width = static_cast<size_t>(size.width), columns = (width + 1) / 2;
  const int32_t rows = (size.height + 1) / 2;
  if (image.format < STARFOCUS_FORMAT_NV12) {
    const bool alpha =
        image.format == STARFOCUS_FORMAT_RGBX || image.format == STARFOCUS_FORMAT_BGRX;
    image.pixel_stride = input->Int(alpha ? 4 : 3, 7);
    const size_t row_bytes =
        (width - 1) * static_cast<size_t>(image.pixel_stride) + (alpha ? 4 : 3);
    image.planes[0] = TakePlane(size.height, row_bytes, input, &image.strides[0], planes);
    return image;
  }
  image.planes[0] = TakePlane(size.height, width, input, &image.strides[0], planes);
  const bool pairs = image.format == STARFOCUS_FORMAT_NV12 || image.format == STARFOCUS_FORMAT_NV21;
  if (image.format == STARFOCUS_FORMAT_YUV_420_888) image.pixel_stride = input->Int(1, 2);
  const auto step = static_cast<size_t>(std::max(image.pixel_stride, 1));
  const size_t row_bytes = pairs ? 2 * columns : (columns - 1) * step + 1;
  for (int plane = 1; plane <= (pairs ? 1 : 2); ++plane) {
    image.planes[plane] = TakePlane(rows, row_bytes, input, &image.strides[plane], planes);
  }
  return image;
}

// Makes a map of arbitrary bytes. Most maps have unknown values and values outside the range.
starfocus_depth_map MakeDepth(const Size& size, Input* input, Planes* planes) {
  constexpr size_t kBytes[] = {4, 2, 1, 2};
  starfocus_depth_map map = {};
  map.width = input->Int(1, size.width);
  map.height = input->Int(1, size.height);
  map.type = input->Int(0, 3);
  map.meaning = input->Int(0, 1);
  constexpr double kScales[] = {1, 0.0002, 0.05, 1};
  map.scale = input->Rarely() ? input->Value<float>()
                              : static_cast<float>(input->Real(-1, 1) * kScales[map.type]);
  map.offset = input->Rarely() ? input->Value<float>() : static_cast<float>(input->Real(-9, 9));
  map.has_invalid = input->Int(0, 1);
  map.invalid = input->Value<float>();
  const size_t bytes = kBytes[map.type];
  const auto row = static_cast<size_t>(map.width);
  map.stride = bytes * (row + static_cast<size_t>(input->Int(0, 3)));
  size_t unused = 0;
  map.data = TakePlane(1, map.stride * static_cast<size_t>(map.height - 1) + bytes * row, input,
                       &unused, planes);
  return map;
}

starfocus_status StreamAll(starfocus_engine* engine, const starfocus::Params& params,
                           const starfocus_light_field& field, const starfocus_image& out,
                           const Size& size) {
  int32_t consumed = 0, written = 0;
  starfocus_status status = starfocus_stream_begin(engine, &params);
  if (status != STARFOCUS_OK) return status;
  status = starfocus_stream_push(engine, &field, size.height, &consumed);
  if (status != STARFOCUS_OK) return status;
  return starfocus_stream_pull(engine, &out, size.height, &written, nullptr);
}

// Returns true for a status that well-formed images may have.
bool MayBe(starfocus_status status) {
  return status == STARFOCUS_OK || status == STARFOCUS_ERROR_DISPARITY ||
         status == STARFOCUS_ERROR_NOT_FINITE || status == STARFOCUS_ERROR_RANGE ||
         status == STARFOCUS_ERROR_BLUR;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Input input(data, size);
  test::Config config;
  const Size picture = {input.Int(1, 90), input.Int(1, 70)};
  config.width = picture.width, config.height = picture.height;
  config.views = input.Int(0, 1) == 0 ? 1 : 5;
  config.disparity_min = -14, config.disparity_max = 14, config.max_blur = 16;
  config.features |= STARFOCUS_FEATURE_IMAGES, config.superblock = 32;
  test::SetFeature(STARFOCUS_FEATURE_STREAMING, input.Int(0, 1), &config.features);
  test::SetFeature(STARFOCUS_UNKNOWN_FILL, input.Rarely() ? 0 : 1, &config.features);
  config.highlights = input.Rarely() ? 4 : 1;
  starfocus::Params params;
  params.focus = input.Real(-2, 2);
  params.study.mode = input.Rarely() ? STARFOCUS_MODE_BLUR : STARFOCUS_MODE_BLOCK;
  size_t bytes = 0;
  Must(starfocus_workspace_size(&config, &bytes, nullptr) == STARFOCUS_OK);
  const auto workspace = TakeMemory(bytes);
  if (!workspace) return 0;
  starfocus_engine* engine = Started(config, workspace.get(), bytes);
  Planes planes;
  starfocus_light_field field = starfocus::NewLightField();
  for (int view = 0; view < config.views; ++view) {
    field.views[view] = MakeImage(picture, &input, &planes);
  }
  field.depth = MakeDepth(picture, &input, &planes);
  const starfocus_image out = MakeImage(picture, &input, &planes);
  const starfocus_status status = test::Has(config.features, STARFOCUS_FEATURE_STREAMING)
                                      ? StreamAll(engine, params, field, out, picture)
                                      : starfocus_refocus(engine, &params, &field, &out, nullptr);
  Must(MayBe(status));
  return 0;
}
