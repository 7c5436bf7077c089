// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "platform/image.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

std::string Quoted(const std::string& text) { return "'" + text.substr(0, 60) + "'"; }

bool ReadWhole(const std::string& text, int* value) {
  if (text.empty() || text.size() > 9) return false;
  *value = 0;
  for (char c : text) {
    if (c < '0' || c > '9') return false;
    *value = *value * 10 + (c - '0');
  }
  return true;
}

bool ReadNumber(const std::string& text, double* value) {
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string::npos) return false;
  char* end = nullptr;
  *value = std::strtod(text.c_str(), &end);
  return *end == '\0' && std::isfinite(*value);
}

// U,V.
bool ReadPosition(const std::string& text, sf_position* position) {
  const size_t comma = text.find(',');
  double u = 0, v = 0;
  if (comma == std::string::npos || !ReadNumber(text.substr(0, comma), &u) ||
      !ReadNumber(text.substr(comma + 1), &v)) {
    return false;
  }
  *position = RoundedPosition(u, v);
  return true;
}

bool IsFar(const sf_position& position) {
  return std::fabs(position.u) > 1 || std::fabs(position.v) > 1;
}

}  // namespace

Error ParseNumber(const std::string& option, const std::string& text, double* value) {
  return ReadNumber(text, value) ? Error() : Error::Usage(option, "a finite number", Quoted(text));
}

Error ParseWhole(const std::string& option, const std::string& text, int low, int high,
                 int* value) {
  if (ReadWhole(text, value) && *value >= low && *value <= high) return {};
  return Error::Usage(option,
                      "a whole number from " + std::to_string(low) + " to " + std::to_string(high),
                      Quoted(text));
}

Error ParsePair(const std::string& option, const std::string& text, char separator, int* first,
                int* second) {
  const size_t at = text.find(separator);
  if (at != std::string::npos && ReadWhole(text.substr(0, at), first) &&
      ReadWhole(text.substr(at + 1), second) && *first <= kMaxPictureSize &&
      *second <= kMaxPictureSize) {
    return {};
  }
  return Error::Usage(
      option, std::string("two whole numbers with '") + separator + "' between them", Quoted(text));
}

Error ParseRegion(const std::string& option, const std::string& text, sf_region* region) {
  int values[4] = {};
  size_t begin = 0;
  for (int i = 0; i < 4; ++i) {
    const size_t end = i == 3 ? text.size() : std::min(text.find(',', begin), text.size());
    const bool size = i >= 2;
    if (begin > end || !ReadWhole(text.substr(begin, end - begin), &values[i]) ||
        values[i] > kMaxPictureSize || (size && values[i] == 0)) {
      return Error::Usage(option, "X,Y,W,H in whole pixels, W and H not 0", Quoted(text));
    }
    begin = end + 1;
  }
  *region = {values[0], values[1], values[2], values[3]};
  return {};
}

Error ParseAperture(const std::string& option, const std::string& text, double* value) {
  if (ReadNumber(text, value) && *value > 0 && *value <= 1) return {};
  return Error::Usage(option, "an aperture above 0 and at most 1", Quoted(text));
}

Error ParsePercentage(const std::string& option, const std::string& text, double* value) {
  if (ReadNumber(text, value) && *value >= 0 && *value <= 100) return {};
  return Error::Usage(option, "a percentage from 0 to 100", Quoted(text));
}

Error ParseScale(const std::string& option, const std::string& text, double* value) {
  if (ReadNumber(text, value) && *value >= SF_MIN_N_SCALE && *value <= SF_MAX_N_SCALE) return {};
  return Error::Usage(option,
                      "a factor from " + Short(SF_MIN_N_SCALE) + " to " + Short(SF_MAX_N_SCALE),
                      Quoted(text));
}

Error ParseHighlights(const std::string& option, const std::string& text, double* value) {
  if (ReadNumber(text, value) && *value >= 1 && *value <= SF_MAX_HIGHLIGHTS) return {};
  return Error::Usage(option, "a factor from 1 to " + Short(SF_MAX_HIGHLIGHTS), Quoted(text));
}

Error ParseViews(const std::string& option, const std::string& text, Positions* positions) {
  int star = 0;
  if (ReadWhole(text, &star) && IsStarSet(star)) {
    *positions = StarPositions(star);
    return {};
  }
  const auto wrong = [&](const std::string& expected) {
    return Error::Usage(option, expected, Quoted(text));
  };
  positions->clear();
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(':', begin), text.size());
    sf_position position = {};
    if (!ReadPosition(text.substr(begin, end - begin), &position)) {
      return wrong("17, 9, 5 or 1, or positions U,V:U,V");
    }
    if (IsFar(position)) return wrong("positions within +-1");
    for (const sf_position& other : *positions) {
      if (SamePosition(other, position)) return wrong("positions that differ");
    }
    positions->push_back(position);
    begin = end + 1;
  }
  if (!SamePosition(positions->front(), {0, 0})) return wrong("the centre view, 0,0, first");
  if (positions->size() <= SF_MAX_VIEWS) return {};
  return wrong("at most " + std::to_string(SF_MAX_VIEWS) + " views");
}

Error ParseTransfer(const std::string& option, const std::string& text, sf_transfer* value) {
  if (text != "srgb" && text != "none") {
    return Error::Usage(option, "srgb or none", "'" + text + "'");
  }
  *value = text == "srgb" ? SF_TRANSFER_SRGB : SF_TRANSFER_NONE;
  return {};
}

void AddTransferOption(Command* command, const char* help, std::string* text) {
  AddOptions(
      {
          {"--transfer", "srgb|none", help, text, Use::kDefault},
      },
      command);
}

std::string Short(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

}  // namespace starfocus
