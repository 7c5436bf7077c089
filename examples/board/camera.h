// SPDX-License-Identifier: Apache-2.0
// A light field in memory that can be refocused repeatedly without allocating memory.
#ifndef STARFOCUS_EXAMPLES_BOARD_CAMERA_H_
#define STARFOCUS_EXAMPLES_BOARD_CAMERA_H_

#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/light_field.h"
#include "platform/result.h"
#include "platform/runner.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

class Camera {
 public:
  explicit Camera(int threads) : runner_(threads) {}

  // Loads the light field and creates an engine that supports every focus within the disparity
  // range of the light field.
  Error Load(const std::string& folder, starfocus_mode mode);

  double nearest() const { return stats_.max; }
  double farthest() const { return stats_.min; }
  // Returns the selectable apertures, the widest first. STARFOCUS_MAX_BLUR limits the widest
  // aperture.
  const std::vector<double>& apertures() const { return apertures_; }
  size_t workspace_bytes() const { return workspace_bytes_; }

  // Refocuses into picture().
  starfocus_status Take(double focus, double aperture);
  const Image& picture() const { return picture_; }

 private:
  ThreadRunner runner_;
  LightField light_field_;
  starfocus_disparity_stats stats_ = {};
  std::vector<double> apertures_;
  Engine engine_;
  size_t workspace_bytes_ = 0;
  starfocus_mode mode_ = STARFOCUS_MODE_FRAME;
  Image picture_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_BOARD_CAMERA_H_
