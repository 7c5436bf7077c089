// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/report_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace starfocus::bench {

std::string Escape(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '<') {
      escaped += "&lt;";
    } else if (c == '&') {
      escaped += "&amp;";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string Fixed(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

std::vector<std::string> FieldNames(const Rows& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    if (row.study != "main") continue;
    if (std::find(names.begin(), names.end(), row.field) == names.end()) {
      names.push_back(row.field);
    }
  }
  return names;
}

std::string Method(const Row& row) {
  const Task& task = row.task;
  std::string name = task.mode;
  if (row.study == "views" || task.mode == "shift-and-add") {
    name += ", " + std::to_string(task.views) + " views";
  }
  if (row.study == "options" && task.max_layer != STARFOCUS_LAYERS - 1) {
    name += ", layers to " + std::to_string(task.max_layer);
  }
  if (row.study == "options" && task.superblock != 0) {
    name += ", blocks to " + std::to_string(task.superblock);
  }
  if (task.n_scale != 1) name += ", N × " + Fixed(task.n_scale, 2);
  if (task.renderer == STARFOCUS_RENDERER_LINE_SCAN) name += ", N by (9)";
  if (task.renderer == STARFOCUS_RENDERER_SLICES) name += ", N by subapertures";
  return name;
}

Rows Filter(const Rows& rows, const Keep& keep) {
  Rows kept;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(kept), keep);
  return kept;
}

double Ms(const Row& row) { return row.ms; }

double Mean(const Rows& rows, const Value& value) {
  double sum = 0;
  int count = 0;
  for (const Row& row : rows) {
    const double one = value(row);
    if (!std::isfinite(one)) continue;
    sum += one;
    ++count;
  }
  return count == 0 ? kNone : sum / count;
}

Rows AtQuantiles(const Rows& rows, const std::string& field, const std::string& mode,
                 double aperture, int views) {
  return Filter(rows, [&](const Row& row) {
    const bool studied =
        views == 0 ? row.study == "main" : row.study == "views" && row.task.views == views;
    return studied && row.field == field && row.task.mode == mode && row.aperture == aperture &&
           std::isfinite(row.quantile);
  });
}

}  // namespace starfocus::bench
