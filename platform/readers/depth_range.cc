// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/depth_range.h"

#include <cmath>
#include <cstdlib>

#include "platform/readers/depth_levels.h"
#include "platform/text.h"

namespace starfocus {
namespace {

std::string Lower(const std::string* text) {
  return text == nullptr ? "" : starfocus::Lower(*text);
}

std::string Quoted(const std::string* text) {
  return text == nullptr ? "absent" : "'" + text->substr(0, 40) + "'";
}

// Returns the number of metres per unit of distance, or 0 for an unknown name of a unit.
double MetresOf(const std::string& units) {
  if (units == "m" || units == "meters") return 1;
  return units == "mm" || units == "millimeters" ? 0.001 : 0;
}

// Parses a number, which may be infinite. Returns NaN if the text is not a number.
double NumberOf(const std::string* text) {
  if (text == nullptr || text->empty()) return NAN;
  char* end = nullptr;
  const double value = std::strtod(text->c_str(), &end);
  return *end == '\0' ? value : NAN;
}

bool IsUsable(const std::string& format, const DepthRange& range) {
  if (format != "rangeinverse" && format != "rangelinear") return false;
  if (!(range.near > 0) || !(range.far > range.near)) return false;
  return range.inverse || std::isfinite(range.far);
}

void IgnoreRange(const RangeProperties& range, Near near, DepthPhoto* photo) {
  const bool black = near != Near::kWhite;
  photo->notes.push_back("the range of the depth map is ignored (Format " + Quoted(range.format) +
                         ", Near " + Quoted(range.near) + ", Far " + Quoted(range.far) +
                         "): levels of the map define only an order of depth, in which " +
                         (black ? "black is near (--near white overrides this)" : "white is near"));
  TellMap("relative depth without distances", photo);
  ToOrder(black ? Near::kBlack : Near::kWhite, photo);
}

}  // namespace

double ApplyRange(const RangeProperties& properties, Near near, DepthPhoto* photo) {
  const std::string format = Lower(properties.format), units = Lower(properties.units);
  DepthRange range = {format == "rangeinverse", NumberOf(properties.near),
                      NumberOf(properties.far)};
  if (!IsUsable(format, range)) {
    IgnoreRange(properties, near, photo);
    return 0;
  }
  if (std::isinf(range.far)) {
    photo->notes.push_back(
        "the far end of the depth map is infinite: white is infinitely far away");
  }
  // Some cameras write "diopters" but store values that decrease towards the lens, as distances do.
  // Values in diopters would increase towards the lens.
  if (units == "diopters") {
    photo->notes.push_back(
        "the unit of the depth map, diopters, is ignored: near and far are distances in an unknown "
        "unit");
  }
  const double metres = MetresOf(units), unit = metres > 0 ? metres : 1;
  range.near *= unit;
  range.far *= unit;
  ToInverse(range, &photo->map);
  photo->meaning = metres > 0 ? MapMeaning::kInverseMetres : MapMeaning::kInverse;
  TellMap(*properties.format + " from " + *properties.near + " to " + *properties.far +
              (metres > 0 ? " " + *properties.units : " of unknown units"),
          photo);
  return unit;
}

}  // namespace starfocus
