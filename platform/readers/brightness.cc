// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/brightness.h"

namespace starfocus {

FloatMap Brightness(const Image& picture, int factor) {
  FloatMap map = {picture.width / factor, picture.height / factor, {}};
  map.values.reserve(size_t(map.width) * size_t(map.height));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      int sum = 0;
      for (int row = y * factor; row < (y + 1) * factor; ++row) {
        const uint8_t* from = picture.row(row) + 3 * size_t(x) * size_t(factor);
        for (int k = 0; k < 3 * factor; ++k) sum += from[k];
      }
      map.values.push_back(static_cast<float>(double(sum) / (factor * factor)));
    }
  }
  return map;
}

}  // namespace starfocus
