// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/stanford.h"

#include <cstdio>
#include <filesystem>

namespace starfocus {
namespace {

struct Place {
  double y = 0, x = 0;
};

bool ReadPlace(const std::string& path, Place* place) {
  int row = 0, column = 0;
  const std::string name = std::filesystem::path(path).filename().string();
  return std::sscanf(name.c_str(), "out_%6d_%6d_%20lf_%20lf", &row, &column, &place->y,
                     &place->x) == 4;
}

}  // namespace

bool IsStanford(const std::string& name) { return name.rfind("out_", 0) == 0; }

void OrderStanford(ViewArray* array) {
  Place first, last;
  bool rows = true, columns = false;
  if (ReadPlace(array->paths.front(), &first) && ReadPlace(array->paths.back(), &last)) {
    rows = last.y < first.y;
    columns = last.x < first.x;
  }
  const size_t width = size_t(array->columns), height = size_t(array->rows);
  ViewArray turned = *array;
  for (size_t k = 0; k < turned.paths.size(); ++k) {
    const size_t y = k / width, x = k % width;
    turned.paths[k] =
        array->paths[(rows ? height - 1 - y : y) * width + (columns ? width - 1 - x : x)];
  }
  *array = std::move(turned);
}

}  // namespace starfocus
