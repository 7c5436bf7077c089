// SPDX-License-Identifier: Apache-2.0
// The configuration, the report and the features of tests.
#ifndef STARFOCUS_TESTS_SUPPORT_CONFIG_H_
#define STARFOCUS_TESTS_SUPPORT_CONFIG_H_

#include <algorithm>
#include <cstdint>

#include "lib/api/validate.h"
#include "starfocus/starfocus.hpp"

namespace test {

// The defaults, with the paper's renderer, so that tests refocus with both renderers.
struct Config : starfocus::Config {
  Config() { tuning.line_scan = starfocus_line_scan_renderer(); }
  // For tests of the inside of the library.
  operator starfocus::FullConfig() const {  // NOLINT: converts
    starfocus::FullConfig full;
    starfocus::Enter(this, nullptr, &full);
    return full;
  }
};

// Statistics with the layers by value.
struct Report : starfocus_report {
  Report() {
    starfocus_report_init(this);
    starfocus_report::layers = layers;
  }
  Report(const Report& other) : Report() { *this = other; }
  Report& operator=(const Report& other) {
    static_cast<starfocus_report&>(*this) = other;
    starfocus_report::layers = layers;
    std::copy(other.layers, other.layers + STARFOCUS_LAYERS, layers);
    return *this;
  }

  // Returns true if all statistics are equal, except for the map: a stream reads each row once, the
  // other functions check it first.
  bool IsLike(Report other) const {
    other.converted_pixels = converted_pixels;
    other.starfocus_report::layers = starfocus_report::layers;
    const auto bytes = [](const auto& part) { return reinterpret_cast<const char*>(&part); };
    const auto equal = [&](const auto& a, const auto& b) {
      return std::equal(bytes(a), bytes(a) + sizeof a, bytes(b));
    };
    return equal(static_cast<const starfocus_report&>(*this),
                 static_cast<const starfocus_report&>(other)) &&
           equal(layers, other.layers);
  }

  starfocus_layer_report layers[STARFOCUS_LAYERS] = {};
};

inline bool Has(uint32_t features, uint32_t feature) { return (features & feature) != 0; }

inline void SetFeature(uint32_t feature, bool on, uint32_t* features) {
  *features = on ? *features | feature : *features & ~feature;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_CONFIG_H_
