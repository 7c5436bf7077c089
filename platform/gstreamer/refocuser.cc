// SPDX-License-Identifier: Apache-2.0
#include "platform/gstreamer/refocuser.h"

#include <algorithm>

namespace starfocus {
namespace {

// Smallest max_blur of an engine in pixels. Larger values are powers of two, so that few changes of
// the focus and the aperture require another engine.
constexpr double kLeastBlur = 8;

template <class... Values>
bool Fail(ProblemText* problem, const char* format, Values... values) {
  g_snprintf(problem->text, sizeof problem->text, format, values...);
  return false;
}

bool Check(starfocus_status status, const starfocus_problem* cause, ProblemText* problem) {
  if (status == STARFOCUS_OK) return true;
  *problem = Describe(status, cause);
  return false;
}

bool ReadColour(const GstVideoColorimetry& colour, starfocus_image* image, ProblemText* problem) {
  const bool is_709 = colour.matrix == GST_VIDEO_COLOR_MATRIX_BT709;
  if (!is_709 && colour.matrix != GST_VIDEO_COLOR_MATRIX_BT601) {
    return Fail(problem,
                "the video has the YUV matrix %d, but only BT.601 and BT.709 are supported",
                gst_video_color_matrix_to_iso(colour.matrix));
  }
  image->matrix = is_709 ? STARFOCUS_MATRIX_BT709 : STARFOCUS_MATRIX_BT601;
  const bool is_full = colour.range == GST_VIDEO_COLOR_RANGE_0_255;
  image->range = is_full ? STARFOCUS_RANGE_FULL : STARFOCUS_RANGE_LIMITED;
  return true;
}

bool ReadImage(const GstVideoFrame& frame, starfocus_image* image, ProblemText* problem) {
  *image = {};
  switch (GST_VIDEO_FRAME_FORMAT(&frame)) {
    case GST_VIDEO_FORMAT_NV12:
      image->format = STARFOCUS_FORMAT_NV12;
      break;
    case GST_VIDEO_FORMAT_I420:
      image->format = STARFOCUS_FORMAT_I420;
      break;
    case GST_VIDEO_FORMAT_RGB:
      image->format = STARFOCUS_FORMAT_RGB;
      break;
    default:
      image->format = STARFOCUS_FORMAT_P010;
  }
  for (guint i = 0; i < GST_VIDEO_FRAME_N_PLANES(&frame); ++i) {
    image->planes[i] = GST_VIDEO_FRAME_PLANE_DATA(&frame, i);
    image->strides[i] = static_cast<size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&frame, i));
  }
  return image->format == STARFOCUS_FORMAT_RGB ||
         ReadColour(frame.info.colorimetry, image, problem);
}

bool ReadDepth(const RefocusSettings& settings, const GstVideoFrame& frame,
               starfocus_depth_map* depth, ProblemText* problem) {
  if (settings.black == settings.white) {
    return Fail(problem, "disparity-black and disparity-white are both %g, but must differ",
                settings.black);
  }
  const bool has_8_bits = GST_VIDEO_FRAME_FORMAT(&frame) == GST_VIDEO_FORMAT_GRAY8;
  *depth = {};
  depth->data = GST_VIDEO_FRAME_PLANE_DATA(&frame, 0);
  depth->stride = static_cast<size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0));
  depth->width = GST_VIDEO_FRAME_WIDTH(&frame);
  depth->height = GST_VIDEO_FRAME_HEIGHT(&frame);
  depth->type = has_8_bits ? STARFOCUS_DEPTH_U8 : STARFOCUS_DEPTH_U16;
  depth->meaning = STARFOCUS_DEPTH_LINEAR;
  depth->scale = (settings.white - settings.black) / (has_8_bits ? 255 : 65535);
  depth->offset = settings.black;
  return true;
}

bool AreAlike(const starfocus_config& a, const starfocus_config& b) {
  return a.width == b.width && a.height == b.height && a.disparity_min == b.disparity_min &&
         a.disparity_max == b.disparity_max && a.max_workers == b.max_workers &&
         a.features == b.features;
}

// Sets the largest blur of the lens and the disparities. Returns false if it exceeds the limit.
bool SetBlur(const RefocusSettings& settings, starfocus_config* config, ProblemText* problem) {
  const double distance =
      std::max(config->disparity_max - settings.focus, settings.focus - config->disparity_min);
  const double blur = settings.aperture * distance;
  if (blur > STARFOCUS_MAX_BLUR) {
    return Fail(problem,
                "aperture %g with focus %g blurs disparities from %g to %g by %g pixels, "
                "but at most %g pixels are supported",
                settings.aperture, settings.focus, config->disparity_min, config->disparity_max,
                blur, STARFOCUS_MAX_BLUR);
  }
  config->max_blur = kLeastBlur;
  while (config->max_blur < blur) config->max_blur *= 2;
  return true;
}

}  // namespace

void Refocuser::Close() {
  FreeStabiliser();
  starfocus_destroy(engine_);
  engine_ = nullptr;
  starfocus_pool_destroy(pool_);
  pool_ = nullptr;
}

void Refocuser::FreeStabiliser() {
  g_aligned_free(stabiliser_);
  stabiliser_ = nullptr;
  g_free(map_);
  map_ = nullptr;
}

starfocus_config Refocuser::NewConfig(const RefocusSettings& settings, int width, int height,
                                      const starfocus_depth_map& depth) const {
  starfocus_config config;
  starfocus_config_init(&config);
  config.width = width;
  config.height = height;
  config.views = 1;
  config.features |= STARFOCUS_FEATURE_IMAGES | STARFOCUS_FEATURE_SHAPES;
  config.max_workers = starfocus_pool_workers(pool_);
  // The engine computes disparities in single precision, which may round the disparity of white.
  const float most = depth.type == STARFOCUS_DEPTH_U8 ? 255 : 65535;
  const double black = static_cast<float>(settings.black);
  const double white = static_cast<float>(depth.scale) * most + static_cast<float>(depth.offset);
  config.disparity_min = std::min(black, white);
  config.disparity_max = std::max(black, white);
  return config;
}

bool Refocuser::SetThreads(int threads, ProblemText* problem) {
  if (pool_ != nullptr && threads == threads_) return true;
  Close();
  pool_ = starfocus_pool_create(threads);
  threads_ = threads;
  return pool_ != nullptr || Fail(problem, "not enough memory for %d threads", threads);
}

bool Refocuser::SetEngine(const starfocus_config& config, ProblemText* problem) {
  const bool fits = engine_ != nullptr && AreAlike(config, config_);
  if (fits && config.max_blur <= config_.max_blur) return true;
  starfocus_destroy(engine_);
  engine_ = nullptr;
  starfocus_problem cause = {};
  if (!Check(starfocus_create(&config, nullptr, &engine_, &cause), &cause, problem)) return false;
  config_ = config;
  const starfocus_callbacks callbacks = {starfocus_pool_run, pool_, nullptr, nullptr, nullptr};
  return Check(starfocus_set_callbacks(engine_, &callbacks), nullptr, problem);
}

bool Refocuser::StartStabiliser(const starfocus_config& config, ProblemText* problem) {
  if (stabiliser_ != nullptr && AreAlike(config, stabilised_)) return true;
  FreeStabiliser();
  starfocus_problem cause = {};
  size_t bytes = 0;
  if (!Check(starfocus_stabiliser_size(&config, &bytes, &cause), &cause, problem)) return false;
  void* const memory = g_aligned_alloc(1, bytes, STARFOCUS_ALIGNMENT);
  map_ = g_new(float, static_cast<size_t>(config.width) * static_cast<size_t>(config.height));
  stabilised_ = config;
  // The stabiliser is at the beginning of its memory.
  stabiliser_ = static_cast<starfocus_stabiliser*>(memory);
  return Check(starfocus_stabiliser_init(&config, memory, bytes, &stabiliser_, &cause), &cause,
               problem);
}

bool Refocuser::Stabilise(const starfocus_config& config, starfocus_light_field* field,
                          ProblemText* problem) {
  if (!StartStabiliser(config, problem)) return false;
  if (field->depth.scale != scale_) Restart();
  scale_ = field->depth.scale;
  const auto width = static_cast<size_t>(config.width);
  starfocus_disparity_output to = {};
  to.disparity = map_;
  to.disparity_stride = sizeof(float) * width;
  const starfocus_callbacks callbacks = {starfocus_pool_run, pool_, nullptr, nullptr, nullptr};
  const starfocus_status status =
      starfocus_stabilise_disparity(stabiliser_, &callbacks, field, &to, nullptr);
  if (!Check(status, starfocus_stabiliser_problem(stabiliser_), problem)) return false;
  field->depth = starfocus_depth_float(map_, to.disparity_stride, config.width, config.height);
  return true;
}

bool Refocuser::Refocus(const RefocusSettings& settings, const GstVideoFrame& video,
                        const GstVideoFrame& depth, GstVideoFrame* out, ProblemText* problem) {
  const int width = GST_VIDEO_FRAME_WIDTH(&video), height = GST_VIDEO_FRAME_HEIGHT(&video);
  starfocus_light_field field;
  starfocus_light_field_init(&field);
  starfocus_image picture;
  if (!ReadImage(video, &field.views[0], problem) || !ReadImage(*out, &picture, problem) ||
      !ReadDepth(settings, depth, &field.depth, problem)) {
    return false;
  }
  if (field.depth.width > width || field.depth.height > height) {
    return Fail(problem, "the depth has %dx%d pixels, more than the %dx%d pixels of the video",
                field.depth.width, field.depth.height, width, height);
  }
  if (!SetThreads(settings.threads, problem)) return false;
  starfocus_config config = NewConfig(settings, width, height, field.depth);
  const bool is_deep = picture.format == STARFOCUS_FORMAT_P010;
  if (is_deep) config.features |= STARFOCUS_FEATURE_DEEP;
  if (is_deep && settings.stabilise) {
    return Fail(problem, "stabilise supports video of 8 bits, but not of %d",
                GST_VIDEO_FRAME_COMP_DEPTH(&video, 0));
  }
  if (!SetBlur(settings, &config, problem) || !SetEngine(config, problem)) return false;
  if (!settings.stabilise) FreeStabiliser();
  if (settings.stabilise && !Stabilise(config, &field, problem)) return false;
  starfocus_params params;
  starfocus_params_init(&params);
  params.focus = settings.focus;
  params.aperture = settings.aperture;
  params.shape = settings.shape;
  return Check(starfocus_refocus(engine_, &params, &field, &picture, nullptr),
               starfocus_engine_problem(engine_), problem);
}

}  // namespace starfocus
