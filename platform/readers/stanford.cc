// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/stanford.h"

#include <cstdio>
#include <filesystem>
#include <optional>

namespace starfocus {
namespace {

struct Place {
  double y = 0, x = 0;
};

std::optional<Place> ReadPlace(const std::string& path) {
  Place place;
  int row = 0, column = 0;
  const std::string name = std::filesystem::path(path).filename().string();
  const int parts =
      std::sscanf(name.c_str(), "out_%6d_%6d_%20lf_%20lf", &row, &column, &place.y, &place.x);
  return parts == 4 ? std::optional(place) : std::nullopt;
}

}  // namespace

bool IsStanford(const std::string& name) { return name.rfind("out_", 0) == 0; }

void OrderStanford(ViewArray* array) {
  const auto first = ReadPlace(array->paths.front()), last = ReadPlace(array->paths.back());
  const bool known = first && last;
  const bool rows = !known || last->y < first->y, columns = known && last->x < first->x;
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
