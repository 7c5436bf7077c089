// SPDX-License-Identifier: Apache-2.0
// Light fields of images in all formats, and their conversion to R, G, B as starfocus/image.h
// defines.
#ifndef STARFOCUS_TESTS_SUPPORT_IMAGE_FIELD_H_
#define STARFOCUS_TESTS_SUPPORT_IMAGE_FIELD_H_

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/image_scene.h"
#include "tests/support/layered_scene.h"

namespace test {

struct ImageField {
  std::vector<ImageMemory> views;
  DepthMemory depth;
  Scene converted;  // the light field, converted to R, G, B

  // Returns the part of the light field that starts at `row`. A depth map with fewer rows than the
  // picture is always passed completely.
  starfocus_light_field Field(int row = 0) const {
    starfocus_light_field field = starfocus::NewLightField();
    for (size_t k = 0; k < views.size(); ++k) field.views[k] = views[k].In(row);
    field.depth = depth.map;
    if (depth.map.height == converted.height) {
      field.depth.data = static_cast<const char*>(depth.map.data) + size_t(row) * depth.map.stride;
    }
    return field;
  }
  uint8_t Alpha(int x, int y) const {
    ImageMemory& centre = const_cast<ImageMemory&>(views[0]);
    return centre.kind().HasAlpha() ? *centre.Colour(x, y, 3) : 255;
  }
  // Converts `out` to an image of kind `kind`. Pixel (0, 0) of `out` is pixel (x, y) of the
  // picture.
  ImageMemory Converted(const Output& out, const ImageKind& kind, int x = 0, int y = 0) const {
    ImageMemory image(out.width, out.height, kind);
    PutPicture(
        out.bytes.data(), out.stride,
        [&](int column, int row) { return Alpha(x + column, y + row); }, &image);
    return image;
  }
};

// Makes a light field of images. The range of disparities is wider than the range of the scene by
// 0.5 on each side, since maps of few bits round disparities.
inline ImageField MakeImageField(const Scene& scene, const std::vector<ImageKind>& kinds,
                                 DepthMemory depth, Random* random) {
  ImageField field;
  field.converted = EmptyScene(scene.width, scene.height, scene.views(), scene.disparity_min - 0.5f,
                               scene.disparity_max + 0.5f);
  for (int view = 0; view < scene.views(); ++view) {
    ImageMemory image(scene.width, scene.height, kinds[size_t(view) % kinds.size()]);
    PutPicture(
        scene.Pixel(view, 0, 0), scene.stride, [&](int, int) { return random->Byte(); }, &image);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        GetPixel(&image, x, y, field.converted.Pixel(view, x, y));
      }
    }
    field.views.push_back(std::move(image));
  }
  field.depth = std::move(depth);
  field.converted.disparity = ConvertDepth(&field.depth, scene.width, scene.height);
  return field;
}

inline test::Config ImageConfig(const ImageField& field, double max_blur = 20) {
  test::Config config = ConfigFor(field.converted, max_blur);
  config.features |= STARFOCUS_FEATURE_IMAGES;
  return config;
}

// Streams a light field of images, with at most `push_rows` rows per push and `pull_rows` rows per
// pull.
inline starfocus_status Stream(Engine* engine, const ImageField& field,
                               const starfocus::Params& params, int push_rows, int pull_rows,
                               ImageMemory* image, starfocus_report* report) {
  starfocus_status status = starfocus_stream_begin(engine->get(), &params);
  const int height = image->height();
  for (int pushed = 0, pulled = 0; status == STARFOCUS_OK && pulled < height;) {
    int32_t consumed = 0, written = 0;
    const int rows = std::min(push_rows, height - pushed);
    if (rows > 0) {
      const starfocus_light_field images = field.Field(pushed);
      status = starfocus_stream_push(engine->get(), &images, rows, &consumed);
      if (status != STARFOCUS_OK) return status;
      CHECK((consumed % 2 == 0 || pushed + consumed == height));
    }
    const starfocus_image out = image->Out(pulled);
    status = starfocus_stream_pull(engine->get(), &out, std::min(pull_rows, height - pulled),
                                   &written, report);
    pushed += consumed;
    pulled += written;
    if (status == STARFOCUS_OK && consumed == 0 && written == 0) return STARFOCUS_ERROR_STATE;
  }
  return status;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_IMAGE_FIELD_H_
