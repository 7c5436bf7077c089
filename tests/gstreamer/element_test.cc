// SPDX-License-Identifier: Apache-2.0
// Pushes frames through the GStreamer element and compares its pictures with those of the engine.
#include <doctest/doctest.h>
#include <gst/check/gstharness.h>
#include <gst/controller/controller.h>
#include <gst/video/video.h>

#include <cstring>
#include <string>
#include <vector>

#include "starfocus/starfocus.hpp"

namespace element_test {
namespace {

constexpr int kMapWidth = 35, kMapHeight = 20;
constexpr GstClockTime kFrame = GST_SECOND / 25;
const std::string kMapSize = ",width=35,height=20";
const std::string kVideo = "video/x-raw,format=NV12,width=71,height=49,framerate=25/1";
const std::string kDepth = "video/x-raw,format=GRAY8,framerate=5/1" + kMapSize;
const std::string kUnevenDepth = "video/x-raw,format=GRAY8,framerate=0/1" + kMapSize;

GstVideoInfo InfoOf(const std::string& caps) {
  GstVideoInfo info;
  GstCaps* const parsed = gst_caps_from_string(caps.c_str());
  REQUIRE(gst_video_info_from_caps(&info, parsed));
  gst_caps_unref(parsed);
  return info;
}

using Bytes = std::vector<uint8_t>;

Bytes Texture(const GstVideoInfo& info) {
  Bytes bytes(info.size);
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = uint8_t(30 + (i * i / 7 + i / 90) % 190);
  return bytes;
}

// Returns a map of two surfaces. The right one has the grey value `right` of 255.
Bytes Surfaces(const GstVideoInfo& info, int right) {
  Bytes bytes(info.size, 60);
  const size_t each = size_t(info.finfo->pixel_stride[0]), stride = size_t(info.stride[0]);
  for (size_t i = 0; i < bytes.size(); ++i) {
    if (i % stride / each > kMapWidth / 2) bytes[i] = uint8_t(right);
  }
  return bytes;
}

// Properties of the element that are fields of the engine's parameters.
struct Lens {
  double focus = 0, aperture = 1;
  int shape = STARFOCUS_SHAPE_FALL_OFF;
};

starfocus_image ImageOf(const GstVideoInfo& info, uint8_t* data) {
  starfocus_image image = {};
  const GstVideoFormat format = GST_VIDEO_INFO_FORMAT(&info);
  if (format == GST_VIDEO_FORMAT_NV12) image.format = STARFOCUS_FORMAT_NV12;
  if (format == GST_VIDEO_FORMAT_I420) image.format = STARFOCUS_FORMAT_I420;
  if (format == GST_VIDEO_FORMAT_P010_10LE) image.format = STARFOCUS_FORMAT_P010;
  if (info.colorimetry.matrix == GST_VIDEO_COLOR_MATRIX_BT709) image.matrix = 1;
  if (info.colorimetry.range == GST_VIDEO_COLOR_RANGE_0_255) image.range = 1;
  for (guint i = 0; i < GST_VIDEO_INFO_N_PLANES(&info); ++i) {
    image.planes[i] = data + info.offset[i];
    image.strides[i] = size_t(info.stride[i]);
  }
  return image;
}

// Returns the rows of all planes without padding.
Bytes Rows(const starfocus_image& image, const GstVideoInfo& info) {
  Bytes rows;
  for (int plane = 0; plane < 3; ++plane) {
    int32_t count = 0;
    size_t bytes = 0;
    starfocus_plane_size(&image, plane, info.width, info.height, &count, &bytes, nullptr);
    for (int32_t y = 0; y < count; ++y) {
      const auto* row =
          static_cast<uint8_t*>(image.planes[plane]) + size_t(y) * image.strides[plane];
      rows.insert(rows.end(), row, row + bytes);
    }
  }
  return rows;
}

// Returns the picture of the engine, with disparities from -8 (black) to 8 (white).
Bytes Expected(const GstVideoInfo& video, Bytes frame, const GstVideoInfo& depth, const Bytes& map,
               const Lens& lens) {
  starfocus::Config config;
  config.width = video.width, config.height = video.height, config.views = 1;
  config.features |= STARFOCUS_FEATURE_IMAGES | STARFOCUS_FEATURE_SHAPES;
  if (GST_VIDEO_INFO_COMP_DEPTH(&video, 0) > 8) config.features |= STARFOCUS_FEATURE_DEEP;
  config.disparity_min = -8, config.disparity_max = 8, config.max_blur = STARFOCUS_MAX_BLUR;
  starfocus::Engine engine;
  REQUIRE(engine.Init(config) == STARFOCUS_OK);
  const bool is_deep = GST_VIDEO_INFO_FORMAT(&depth) != GST_VIDEO_FORMAT_GRAY8;
  starfocus_light_field field = starfocus::NewLightField();
  field.views[0] = ImageOf(video, frame.data());
  field.depth = {map.data(),
                 size_t(depth.stride[0]),
                 kMapWidth,
                 kMapHeight,
                 is_deep ? STARFOCUS_DEPTH_U16 : STARFOCUS_DEPTH_U8,
                 STARFOCUS_DEPTH_LINEAR,
                 16.0 / (is_deep ? 65535 : 255),
                 -8,
                 0,
                 0};
  starfocus::Params params;
  params.focus = lens.focus, params.aperture = lens.aperture, params.shape = lens.shape;
  Bytes out(frame.size());
  const starfocus_image picture = ImageOf(video, out.data());
  REQUIRE(engine.Refocus(params, field, picture) == STARFOCUS_OK);
  return Rows(picture, video);
}

// An element with a harness at each sink pad.
class Pipeline {
 public:
  Pipeline(const std::string& video, const std::string& depth)
      : video_info(InfoOf(video)), depth_info(InfoOf(depth)), frame(Texture(video_info)) {
    element = gst_element_factory_make("starfocus", nullptr);
    REQUIRE(element != nullptr);
    bus_ = gst_bus_new();
    at_video = gst_harness_new_with_element(element, "video", "src");
    at_depth = gst_harness_new_with_element(element, "depth", nullptr);
    gst_element_set_bus(element, bus_);
    gst_harness_set_src_caps_str(at_depth, depth.c_str());
    gst_harness_set_src_caps_str(at_video, video.c_str());
  }
  void ChangeVideo(const std::string& video) {
    video_info = InfoOf(video);
    frame = Texture(video_info);
    gst_harness_set_src_caps_str(at_video, video.c_str());
  }
  ~Pipeline() {
    gst_bus_set_flushing(bus_, TRUE);  // frees messages, which refer to the element
    gst_harness_teardown(at_depth);
    gst_harness_teardown(at_video);
    gst_object_unref(element);
    gst_object_unref(bus_);
  }
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  static void Push(GstHarness* harness, const Bytes& bytes, GstClockTime time,
                   GstClockTime duration = GST_CLOCK_TIME_NONE) {
    GstBuffer* const buffer = gst_buffer_new_memdup(bytes.data(), bytes.size());
    GST_BUFFER_PTS(buffer) = time;
    GST_BUFFER_DURATION(buffer) = duration;
    gst_harness_push(harness, buffer);
  }
  void PushVideo(GstClockTime time) { Push(at_video, frame, time, kFrame); }
  void PushDepth(int right, GstClockTime time) {
    Push(at_depth, Surfaces(depth_info, right), time);
  }

  // Waits for the next picture and checks its time.
  Bytes Pull(GstClockTime time) {
    GstBuffer* const buffer = gst_harness_pull(at_video);
    REQUIRE(buffer != nullptr);
    CHECK(GST_BUFFER_PTS(buffer) == time);
    CHECK(GST_BUFFER_DURATION(buffer) == kFrame);
    return RowsOf(buffer);
  }
  // Returns the rows of a picture. Takes ownership of `buffer`.
  Bytes RowsOf(GstBuffer* buffer) {
    GstVideoFrame picture;
    REQUIRE(gst_video_frame_map(&picture, &video_info, buffer, GST_MAP_READ));
    starfocus_image image = ImageOf(video_info, nullptr);
    for (guint i = 0; i < GST_VIDEO_FRAME_N_PLANES(&picture); ++i) {
      image.planes[i] = GST_VIDEO_FRAME_PLANE_DATA(&picture, i);
      image.strides[i] = size_t(GST_VIDEO_FRAME_PLANE_STRIDE(&picture, i));
    }
    const Bytes rows = Rows(image, video_info);
    gst_video_frame_unmap(&picture);
    gst_buffer_unref(buffer);
    return rows;
  }
  Bytes Refocused(int right, const Lens& lens = {}) const {
    return Expected(video_info, frame, depth_info, Surfaces(depth_info, right), lens);
  }

  // Waits for a message, and returns the text of an error or the number of dropped frames.
  std::string Message(GstMessageType type) {
    GstMessage* const message = gst_bus_timed_pop_filtered(bus_, 20 * GST_SECOND, type);
    if (message == nullptr) return "no message";
    std::string text;
    if (type == GST_MESSAGE_ERROR || type == GST_MESSAGE_WARNING) {
      GError* error = nullptr;
      const auto parse =
          type == GST_MESSAGE_ERROR ? gst_message_parse_error : gst_message_parse_warning;
      parse(message, &error, nullptr);
      text = error->message;
      g_error_free(error);
    } else {
      GstFormat format = GST_FORMAT_UNDEFINED;
      guint64 processed = 0, dropped = 0;
      gst_message_parse_qos_stats(message, &format, &processed, &dropped);
      text = std::to_string(processed) + " processed, " + std::to_string(dropped) + " dropped";
    }
    gst_message_unref(message);
    return text;
  }

  GstVideoInfo video_info, depth_info;
  Bytes frame;
  GstElement* element = nullptr;
  GstHarness *at_video = nullptr, *at_depth = nullptr;

 private:
  GstBus* bus_ = nullptr;
};

void Set(GstElement* element, const Lens& lens) {
  g_object_set(element, "focus", lens.focus, "aperture", lens.aperture, "shape", lens.shape,
               nullptr);
}

const bool kIsLoaded = [] {
  g_setenv("GST_REGISTRY_DISABLE", "yes", TRUE);  // only the plugin of this build
  gst_init(nullptr, nullptr);
  return gst_plugin_load_file(STARFOCUS_PLUGIN, nullptr) != nullptr;
}();

TEST_CASE("element: pictures of all formats are those of the engine") {
  REQUIRE(kIsLoaded);
  const std::string size = ",width=71,height=49,framerate=25/1";
  const Lens lens = {3, 0.5, STARFOCUS_SHAPE_POLYGON};
  for (const std::string format :
       {"NV12,colorimetry=bt601", "NV12,colorimetry=bt709", "I420,colorimetry=1:4:0:0", "RGB",
        "P010_10LE,colorimetry=bt709"}) {
    for (const std::string depth : {"GRAY8", "GRAY16_LE"}) {
      CAPTURE(format + " " + depth);
      Pipeline pipeline("video/x-raw,format=" + format + size,
                        "video/x-raw,framerate=25/1,format=" + depth + kMapSize);
      Set(pipeline.element, lens);
      pipeline.PushDepth(200, 0);
      pipeline.PushVideo(0);
      CHECK(pipeline.Pull(0) == pipeline.Refocused(200, lens));
    }
  }
}

TEST_CASE("element: properties change the next picture, also to a larger blur") {
  Pipeline pipeline(kVideo, kDepth);
  pipeline.PushDepth(200, 0);
  GstClockTime time = 0;
  for (const Lens& lens : {Lens{0, 0.5, STARFOCUS_SHAPE_DISC}, Lens{60, 1, STARFOCUS_SHAPE_RING},
                           Lens{-60, 1, STARFOCUS_SHAPE_DISC}, Lens{4.5, 0, 0}}) {
    CAPTURE(lens.focus);
    Set(pipeline.element, lens);
    g_object_set(pipeline.element, "threads", lens.focus > 0 ? 2 : 1, nullptr);
    pipeline.PushVideo(time);
    CHECK(pipeline.Pull(time) == pipeline.Refocused(200, lens));
    time += kFrame;
  }
}

TEST_CASE("element: a control source moves the focus with the time of the frames") {
  Pipeline pipeline(kVideo, kDepth);
  GstControlSource* const pull = gst_interpolation_control_source_new();
  g_object_set(pull, "mode", GST_INTERPOLATION_MODE_LINEAR, nullptr);
  auto* const keys = GST_TIMED_VALUE_CONTROL_SOURCE(pull);
  gst_timed_value_control_source_set(keys, 0, -8);
  gst_timed_value_control_source_set(keys, 4 * kFrame, 8);
  gst_object_add_control_binding(
      GST_OBJECT(pipeline.element),
      gst_direct_control_binding_new_absolute(GST_OBJECT(pipeline.element), "focus", pull));
  gst_object_unref(pull);
  pipeline.PushDepth(160, 0);
  for (const int frame : {0, 1, 3}) {
    pipeline.PushVideo(GstClockTime(frame) * kFrame);
    const Bytes picture = pipeline.Pull(GstClockTime(frame) * kFrame);
    CHECK(picture == pipeline.Refocused(160, {-8.0 + 4 * frame}));
  }
}

TEST_CASE("element: each frame has the last depth that starts before it") {
  for (const std::string& caps : {kDepth, kUnevenDepth}) {
    CAPTURE(caps);
    Pipeline pipeline(kVideo, caps);
    pipeline.PushDepth(160, kFrame);  // the first depth also serves earlier frames
    pipeline.PushVideo(0);
    CHECK(pipeline.Pull(0) == pipeline.Refocused(160));
    pipeline.PushVideo(5 * kFrame);
    if (caps == kUnevenDepth) pipeline.PushDepth(220, 6 * kFrame);
    CHECK(pipeline.Pull(5 * kFrame) == pipeline.Refocused(160));
    pipeline.PushVideo(6 * kFrame);
    if (caps == kDepth) pipeline.PushDepth(220, 6 * kFrame);
    gst_harness_push_event(pipeline.at_depth, gst_event_new_eos());
    CHECK(pipeline.Pull(6 * kFrame) == pipeline.Refocused(220));
    pipeline.PushVideo(99 * kFrame);  // after the end of the depth
    CHECK(pipeline.Pull(99 * kFrame) == pipeline.Refocused(220));
    gst_harness_push_event(pipeline.at_video, gst_event_new_eos());
    while (GstEvent* const event = gst_harness_pull_event(pipeline.at_video)) {
      const bool is_end = GST_EVENT_TYPE(event) == GST_EVENT_EOS;
      gst_event_unref(event);
      if (is_end) return;
    }
    FAIL("the end of the stream did not pass");
  }
}

TEST_CASE("element: gaps contain no depth and no frame") {
  Pipeline pipeline(kVideo, kDepth);
  gst_harness_push_event(pipeline.at_depth, gst_event_new_gap(2 * kFrame, kFrame));
  gst_harness_push_event(pipeline.at_video, gst_event_new_gap(0, kFrame));
  pipeline.PushVideo(kFrame);
  pipeline.PushDepth(160, 3 * kFrame);
  CHECK(pipeline.Pull(kFrame) == pipeline.Refocused(160));
}

TEST_CASE("element: live video does not wait for late depth") {
  Pipeline pipeline(kVideo, kUnevenDepth);
  gst_harness_use_testclock(pipeline.at_video);
  pipeline.PushDepth(160, 0);
  GstTestClock* const clock = gst_harness_get_testclock(pipeline.at_video);
  for (const GstClockTime time : {kFrame, 3 * kFrame}) {
    pipeline.PushVideo(time);
    gst_harness_crank_single_clock_wait(pipeline.at_video);
    CHECK(pipeline.Pull(time) == pipeline.Refocused(160));
    // The latency of the element is one frame, and all of it is left for refocusing.
    const GstClockTime base = gst_element_get_base_time(pipeline.element);
    CHECK(gst_clock_get_time(GST_CLOCK(clock)) - base == time);
  }
  gst_object_unref(clock);
}

TEST_CASE("element: after a flush, earlier depth is not used") {
  Pipeline pipeline(kVideo, kDepth);
  g_object_set(pipeline.element, "stabilise", TRUE, nullptr);  // which depends on earlier depth
  pipeline.PushDepth(160, 0);
  pipeline.PushVideo(0);
  pipeline.Pull(0);
  pipeline.PushVideo(99 * kFrame);  // waits for depth
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  GstHarness* const both[] = {pipeline.at_video, pipeline.at_depth};
  for (GstHarness* at : both) gst_harness_push_event(at, gst_event_new_flush_start());
  for (GstHarness* at : both) gst_harness_push_event(at, gst_event_new_flush_stop(TRUE));
  for (GstHarness* at : both) gst_harness_push_event(at, gst_event_new_segment(&segment));
  pipeline.PushVideo(0);
  pipeline.PushDepth(220, kFrame);
  CHECK(pipeline.Pull(0) == pipeline.Refocused(220));
}

TEST_CASE("element: late frames are dropped and reported") {
  Pipeline pipeline(kVideo, kDepth);
  pipeline.PushDepth(160, 0);
  pipeline.PushVideo(0);
  pipeline.Pull(0);
  // The sink got the frame 0 one frame late: the element skips the time of two frames.
  gst_harness_push_upstream_event(
      pipeline.at_video,
      gst_event_new_qos(GST_QOS_TYPE_UNDERFLOW, 1.5, GstClockTimeDiff(kFrame), 0));
  pipeline.PushVideo(kFrame);
  CHECK(pipeline.Message(GST_MESSAGE_QOS) == "1 processed, 1 dropped");
  pipeline.PushVideo(2 * kFrame);
  CHECK(pipeline.Pull(2 * kFrame) == pipeline.Refocused(160));
  guint64 dropped = 0;
  g_object_get(pipeline.element, "dropped", &dropped, nullptr);
  CHECK(dropped == 1);
}

TEST_CASE("element: stabilised depth depends on the frames before") {
  Pipeline pipeline(kVideo, "video/x-raw,format=GRAY8,framerate=25/1" + kMapSize);
  g_object_set(pipeline.element, "stabilise", TRUE, nullptr);
  const auto next = [&](int right, GstClockTime time) {
    pipeline.PushVideo(time);
    pipeline.PushDepth(right, time);
    return pipeline.Pull(time);
  };
  CHECK(next(160, 0) == pipeline.Refocused(160));
  CHECK(next(168, kFrame) != pipeline.Refocused(168));
  // Another scale of the disparities starts again.
  g_object_set(pipeline.element, "disparity-black", 8.0, "disparity-white", -8.0, nullptr);
  Bytes inverted = Surfaces(pipeline.depth_info, 220);
  for (uint8_t& value : inverted) value = uint8_t(255 - value);
  CHECK(next(220, 2 * kFrame) ==
        Expected(pipeline.video_info, pipeline.frame, pipeline.depth_info, inverted, {}));
  g_object_set(pipeline.element, "stabilise", FALSE, "disparity-black", -8.0, "disparity-white",
               8.0, nullptr);
  CHECK(next(220, 3 * kFrame) == pipeline.Refocused(220));
}

TEST_CASE("element: the size and the format of the video and the depth may change") {
  Pipeline pipeline(kVideo, kDepth);
  pipeline.PushDepth(160, 0);
  pipeline.PushVideo(0);
  CHECK(pipeline.Pull(0) == pipeline.Refocused(160));
  pipeline.ChangeVideo("video/x-raw,format=P010_10LE,width=71,height=49,framerate=25/1");
  pipeline.PushVideo(kFrame);
  CHECK(pipeline.Pull(kFrame) == pipeline.Refocused(160));
  pipeline.ChangeVideo("video/x-raw,format=I420,width=90,height=40,framerate=25/1");
  pipeline.PushVideo(2 * kFrame);
  CHECK(pipeline.Pull(2 * kFrame) == pipeline.Refocused(160));
  const std::string deep = "video/x-raw,format=GRAY16_LE,framerate=5/1" + kMapSize;
  gst_harness_set_src_caps_str(pipeline.at_depth, deep.c_str());
  pipeline.PushVideo(3 * kFrame);
  CHECK(pipeline.Pull(3 * kFrame) == pipeline.Refocused(160));  // still the depth of 8 bits
  pipeline.depth_info = InfoOf(deep);
  pipeline.PushDepth(220, 5 * kFrame);
  pipeline.PushVideo(5 * kFrame);
  CHECK(pipeline.Pull(5 * kFrame) == pipeline.Refocused(220));
}

// Offers `pool` to the element. Sinks with memory of their own do so.
GstPadProbeReturn OfferPool(GstPad*, GstPadProbeInfo* info, gpointer pool) {
  GstQuery* const query = GST_PAD_PROBE_INFO_QUERY(info);
  if (GST_QUERY_TYPE(query) != GST_QUERY_ALLOCATION) return GST_PAD_PROBE_OK;
  gst_query_add_allocation_pool(query, GST_BUFFER_POOL(pool), 0, 0, 0);
  gst_query_add_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr);
  return GST_PAD_PROBE_HANDLED;
}

TEST_CASE("element: pictures are written to the buffers of downstream") {
  Pipeline pipeline(kVideo, kDepth);
  GstBufferPool* const pool = gst_video_buffer_pool_new();
  GstStructure* const config = gst_buffer_pool_get_config(pool);
  GstVideoAlignment padding;
  gst_video_alignment_reset(&padding);
  padding.padding_right = 30, padding.padding_top = 6;
  gst_buffer_pool_config_add_option(config, GST_BUFFER_POOL_OPTION_VIDEO_META);
  gst_buffer_pool_config_add_option(config, GST_BUFFER_POOL_OPTION_VIDEO_ALIGNMENT);
  gst_buffer_pool_config_set_video_alignment(config, &padding);
  GstCaps* const caps = gst_pad_get_current_caps(pipeline.at_video->srcpad);
  gst_buffer_pool_config_set_params(config, caps, guint(pipeline.video_info.size), 0, 0);
  gst_caps_unref(caps);
  REQUIRE(gst_buffer_pool_set_config(pool, config));
  gst_pad_add_probe(pipeline.at_video->sinkpad, GST_PAD_PROBE_TYPE_QUERY_DOWNSTREAM, OfferPool,
                    pool, nullptr);
  pipeline.PushDepth(160, 0);
  pipeline.PushVideo(0);
  GstBuffer* const picture = gst_harness_pull(pipeline.at_video);
  REQUIRE(picture != nullptr);
  CHECK(picture->pool == pool);
  CHECK(pipeline.RowsOf(picture) == pipeline.Refocused(160));
  gst_object_unref(pool);
}

TEST_CASE("element: upstream may send only what downstream accepts") {
  Pipeline pipeline(kVideo, kDepth);
  gst_harness_set_sink_caps_str(pipeline.at_video, "video/x-raw,format=RGB,width=71");
  GstCaps* const caps = gst_pad_peer_query_caps(pipeline.at_video->srcpad, nullptr);
  GstCaps* const expected = gst_caps_from_string(
      "video/x-raw,format=RGB,width=71,height=[1,2147483647],framerate=[0/1,2147483647/1]");
  CHECK(gst_caps_is_equal(caps, expected));
  gst_caps_unref(caps);
  gst_caps_unref(expected);
}

// Pushes a frame with depth, and returns the error.
std::string ErrorOf(Pipeline* pipeline, GstClockTime time = 0, GstClockTime depth_time = 0) {
  pipeline->PushDepth(160, depth_time);
  pipeline->PushVideo(time);
  return pipeline->Message(GST_MESSAGE_ERROR);
}

TEST_CASE("element: errors name their cause") {
  const std::string wide = "video/x-raw,format=GRAY8,framerate=5/1,width=72,height=20";
  Pipeline large(kVideo, wide);
  CHECK(ErrorOf(&large) == "the depth has 72x20 pixels, more than the 71x49 pixels of the video");
  Pipeline wrong_matrix(kVideo + ",colorimetry=bt2020", kDepth);
  CHECK(ErrorOf(&wrong_matrix) ==
        "the video has the YUV matrix 9, but only BT.601 and BT.709 are supported");
  Pipeline deep("video/x-raw,format=P010_10LE,width=71,height=49,framerate=25/1", kDepth);
  g_object_set(deep.element, "stabilise", TRUE, nullptr);
  CHECK(ErrorOf(&deep) == "stabilise supports video of 8 bits, but not of 10");
  Pipeline interlaced(kVideo + ",interlace-mode=interleaved", kDepth);
  CHECK(ErrorOf(&interlaced) == "interlaced video is not supported; deinterlace it first");
  Pipeline untimed(kVideo, kDepth);
  CHECK(ErrorOf(&untimed, GST_CLOCK_TIME_NONE) == "the video has no timestamps");
  Pipeline untimed_depth(kVideo, kDepth);
  CHECK(ErrorOf(&untimed_depth, 0, GST_CLOCK_TIME_NONE) == "the depth has no timestamps");
  Pipeline flat(kVideo, kDepth);
  g_object_set(flat.element, "disparity-black", 8.0, nullptr);
  CHECK(ErrorOf(&flat) == "disparity-black and disparity-white are both 8, but must differ");
  Pipeline blurred(kVideo, kDepth);
  g_object_set(blurred.element, "focus", 200.0, nullptr);
  CHECK(ErrorOf(&blurred) ==
        "aperture 1 with focus 200 blurs disparities from -8 to 8 by 208 pixels, "
        "but at most 128 pixels are supported");
  Pipeline alone(kVideo, kDepth);
  gst_harness_push_event(alone.at_depth, gst_event_new_eos());
  alone.PushVideo(0);
  CHECK(alone.Message(GST_MESSAGE_ERROR) == "the pad depth received no frame");
  Pipeline unlinked(kVideo, kDepth);
  GstPad* const depth = gst_element_get_static_pad(unlinked.element, "depth");
  gst_pad_unlink(unlinked.at_depth->srcpad, depth);
  gst_object_unref(depth);
  gst_harness_set_src_caps_str(unlinked.at_video, kVideo.c_str());
  CHECK(unlinked.Message(GST_MESSAGE_WARNING) == "waiting until the pad depth is linked");
}

}  // namespace
}  // namespace element_test
