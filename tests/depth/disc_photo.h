// SPDX-License-Identifier: Apache-2.0
// Pictures of one view and their maps, for tests of repairs by colours.
#ifndef STARFOCUS_TESTS_DEPTH_DISC_PHOTO_H_
#define STARFOCUS_TESTS_DEPTH_DISC_PHOTO_H_

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace test {

// A picture and the disparity map of the picture.
struct Photo {
  int width, height;
  std::vector<uint8_t> rgb;
  std::vector<float> map;

  Photo(int w, int h)
      : width(w), height(h), rgb(3 * size_t(w) * size_t(h), 90), map(size_t(w) * size_t(h)) {}
  size_t At(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
  float& Map(int x, int y) { return map[At(x, y)]; }
  void Paint(int x, int y, int r, int g, int b) {
    uint8_t* pixel = rgb.data() + 3 * At(x, y);
    pixel[0] = uint8_t(r), pixel[1] = uint8_t(g), pixel[2] = uint8_t(b);
  }
};

// Returns a speckled disc in front of a speckled wall of another colour. In the map, the radius of
// the disc is larger by `grown` pixels.
inline Photo MakeDisc(int grown, float near = 6, float far = -4) {
  Photo photo(300, 130);
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const double distance = std::hypot(x - 151.3, y - 66.2);
      const int speckle = (x * 7 + y * 13 + x * y % 11) % 17;
      if (distance < 40) {
        photo.Paint(x, y, 190 + speckle, 80 + speckle, 40);
      } else {
        photo.Paint(x, y, 60, 90 + speckle, 150 + speckle);
      }
      photo.Map(x, y) = distance < 40 + grown ? near : far;
    }
  }
  return photo;
}

// Adds normally distributed noise to the map, with a standard deviation of one pixel.
inline void AddNoise(Photo* photo) {
  uint32_t state = 7;
  for (float& d : photo->map) {
    float sum = -6;  // The sum of twelve uniform random numbers is nearly normally distributed.
    for (int k = 0; k < 12; ++k) {
      state = state * 1664525 + 1013904223;
      sum += float(state >> 8) / float(1 << 24);
    }
    d += sum;
  }
}

}  // namespace test

#endif  // STARFOCUS_TESTS_DEPTH_DISC_PHOTO_H_
