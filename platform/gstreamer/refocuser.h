// SPDX-License-Identifier: Apache-2.0
// Refocuses mapped frames of GStreamer by the engine. Owns the engine, the stabiliser and the
// thread pool, and replaces them when the size of the video or a setting requires it. Used by the
// element (element.cc).
#ifndef STARFOCUS_PLATFORM_GSTREAMER_REFOCUSER_H_
#define STARFOCUS_PLATFORM_GSTREAMER_REFOCUSER_H_

#include <gst/video/video.h>

#include "platform/gstreamer/settings.h"
#include "platform/problem.h"
#include "starfocus/pool.h"
#include "starfocus/starfocus.h"
#include "starfocus/video.h"

namespace starfocus {

class Refocuser {
 public:
  Refocuser() = default;
  ~Refocuser() { Close(); }
  Refocuser(const Refocuser&) = delete;
  Refocuser& operator=(const Refocuser&) = delete;

  // Refocuses a frame. `video` and `out` have the same format and size: NV12, I420, RGB or P010.
  // `depth` is GRAY8 or GRAY16, and at most as large as the video. Words have the byte order of the
  // machine. Returns false and writes the cause if the frame cannot be refocused.
  bool Refocus(const RefocusSettings& settings, const GstVideoFrame& video,
               const GstVideoFrame& depth, GstVideoFrame* out, ProblemText* problem);

  // Makes the next frame the first frame of another video.
  void Restart() { starfocus_stabiliser_restart(stabiliser_); }

  // Frees all memory and ends all threads.
  void Close();

 private:
  // Returns the configuration of the settings without max_blur.
  starfocus_config NewConfig(const RefocusSettings& settings, int width, int height,
                             const starfocus_depth_map& depth) const;
  bool SetThreads(int threads, ProblemText* problem);
  bool SetEngine(const starfocus_config& config, ProblemText* problem);
  bool Stabilise(const starfocus_config& config, starfocus_light_field* field,
                 ProblemText* problem);
  bool StartStabiliser(const starfocus_config& config, ProblemText* problem);
  void FreeStabiliser();

  starfocus_pool* pool_ = nullptr;
  int threads_ = 0;  // Setting that `pool_` was created with.
  starfocus_engine* engine_ = nullptr;
  starfocus_config config_ = {};  // Configuration of `engine_`.
  starfocus_stabiliser* stabiliser_ = nullptr;
  starfocus_config stabilised_ = {};  // Configuration of `stabiliser_`.
  double scale_ = 0;                  // Scale of the last depth map that was stabilised.
  float* map_ = nullptr;              // Stabilised disparities of the frame.
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_GSTREAMER_REFOCUSER_H_
