// SPDX-License-Identifier: Apache-2.0
// The GStreamer element starfocus: refocuses each frame of the pad video with the frame of the pad
// depth that is shown at the same time. Properties are read at each frame. Frames that would be
// late are dropped, which QoS messages and the property dropped report.
#include <gst/base/gstaggregator.h>
#include <gst/video/gstvideopool.h>

#include <algorithm>
#include <initializer_list>
#include <new>

#include "platform/gstreamer/refocuser.h"

GST_DEBUG_CATEGORY_STATIC(starfocus_debug);
#define GST_CAT_DEFAULT starfocus_debug

namespace starfocus {
namespace {

#if G_BYTE_ORDER == G_LITTLE_ENDIAN
#define VIDEO_CAPS GST_VIDEO_CAPS_MAKE("{ NV12, I420, RGB, P010_10LE }")
#else
#define VIDEO_CAPS GST_VIDEO_CAPS_MAKE("{ NV12, I420, RGB, P010_10BE }")
#endif
GstStaticPadTemplate video_template =
    GST_STATIC_PAD_TEMPLATE("video", GST_PAD_SINK, GST_PAD_ALWAYS, GST_STATIC_CAPS(VIDEO_CAPS));
GstStaticPadTemplate depth_template = GST_STATIC_PAD_TEMPLATE(
    "depth", GST_PAD_SINK, GST_PAD_ALWAYS,
    GST_STATIC_CAPS(GST_VIDEO_CAPS_MAKE("{ GRAY8, " GST_VIDEO_NE(GRAY16) " }")));
GstStaticPadTemplate picture_template =
    GST_STATIC_PAD_TEMPLATE("src", GST_PAD_SRC, GST_PAD_ALWAYS, GST_STATIC_CAPS(VIDEO_CAPS));

struct GstStarfocus {
  GstAggregator parent;
  GstAggregatorPad *video, *depth;

  // Protected by the lock of the object.
  RefocusSettings settings;
  GstClockTime earliest;  // Running time of the first frame that would not be late.
  gdouble proportion;     // Of the last QoS event.
  guint64 dropped;        // Frames dropped since the start.

  // Used only by the thread that pushes frames, or while this thread is stopped.
  guint64 processed;
  GstVideoInfo video_info, depth_info;
  GstCaps* video_caps;    // Null before the first caps.
  GstBuffer* map;         // Depth of the current frame; null before the first depth.
  GstVideoInfo map_info;  // Format of `map`.
  Refocuser refocuser;
};

struct GstStarfocusClass {
  GstAggregatorClass parent_class;
};

G_DEFINE_TYPE(GstStarfocus, element, GST_TYPE_AGGREGATOR)

constexpr guint kDropped = kSettings + 1;  // identifier of the property after the settings

GstStarfocus* Self(gpointer object) { return static_cast<GstStarfocus*>(object); }
GstAggregatorClass* Parent() { return GST_AGGREGATOR_CLASS(element_parent_class); }

// Returns the running time of a buffer, which is negative before the segment, or
// GST_CLOCK_STIME_NONE if the buffer has no timestamp.
GstClockTimeDiff RunningTime(GstAggregatorPad* pad, GstBuffer* buffer) {
  GstClockTime time = 0;
  const int sign = gst_segment_to_running_time_full(&pad->segment, GST_FORMAT_TIME,
                                                    GST_BUFFER_PTS(buffer), &time);
  if (sign == 0) return GST_CLOCK_STIME_NONE;
  return sign * static_cast<GstClockTimeDiff>(time);
}

GstClockTime FrameDuration(const GstVideoInfo& info) {
  if (info.fps_n <= 0) return GST_CLOCK_TIME_NONE;
  return gst_util_uint64_scale_int(GST_SECOND, info.fps_d, info.fps_n);
}

GstFlowReturn Fail(GstStarfocus* self, const char* problem) {
  GST_ELEMENT_ERROR(self, STREAM, FAILED, ("%s", problem), (nullptr));
  return GST_FLOW_ERROR;
}

void Warn(GstStarfocus* self, const char* problem) {
  GST_ELEMENT_WARNING(self, STREAM, FAILED, ("%s", problem), (nullptr));
}

// Prepares for frames that do not continue the earlier frames.
void Restart(GstStarfocus* self) {
  self->refocuser.Restart();
  GST_OBJECT_LOCK(self);
  self->earliest = GST_CLOCK_TIME_NONE;
  self->proportion = 1;
  GST_OBJECT_UNLOCK(self);
}

// Sets `map` to the depth that is shown at the running time `time`: the last frame that starts at
// or before `time`, or the first frame. A depth frame without duration lasts until the next. Such a
// frame requires waiting for the next one, but not beyond the deadline of live video (`is_late`).
GstFlowReturn FindDepth(GstStarfocus* self, GstClockTimeDiff time, bool is_late) {
  while (GstBuffer* next = gst_aggregator_pad_peek_buffer(self->depth)) {
    const bool is_gap = gst_buffer_get_size(next) == 0;
    const GstClockTimeDiff start = RunningTime(self->depth, next);
    GstClockTime duration = GST_BUFFER_DURATION(next);
    if (!GST_CLOCK_TIME_IS_VALID(duration)) duration = FrameDuration(self->depth_info);
    const bool is_later = start > time;
    if (!is_gap && (!is_later || self->map == nullptr)) {
      gst_buffer_replace(&self->map, next);
      self->map_info = self->depth_info;
    }
    gst_buffer_unref(next);
    if (start == GST_CLOCK_STIME_NONE) return Fail(self, "the depth has no timestamps");
    const bool lasts = GST_CLOCK_TIME_IS_VALID(duration) && !is_gap &&
                       time < start + static_cast<GstClockTimeDiff>(duration);
    if (self->map != nullptr && (is_later || lasts)) return GST_FLOW_OK;
    gst_aggregator_pad_drop_buffer(self->depth);
  }
  const bool is_last = gst_aggregator_pad_is_eos(self->depth);
  if (self->map != nullptr && (is_last || is_late)) return GST_FLOW_OK;
  return is_last ? Fail(self, "the pad depth received no frame") : GST_AGGREGATOR_FLOW_NEED_DATA;
}

// Returns true if downstream is so late that the frame must be dropped, and reports the drop.
bool Drop(GstStarfocus* self, GstBuffer* video, GstClockTimeDiff time) {
  GST_OBJECT_LOCK(self);
  const GstClockTime earliest = self->earliest;
  const bool is_late =
      GST_CLOCK_TIME_IS_VALID(earliest) && time >= 0 && static_cast<GstClockTime>(time) < earliest;
  if (is_late) ++self->dropped;
  const guint64 dropped = self->dropped;
  const gdouble proportion = self->proportion;
  GST_OBJECT_UNLOCK(self);
  if (!is_late) return false;
  const gboolean is_live = GST_CLOCK_TIME_IS_VALID(gst_aggregator_get_latency(&self->parent));
  const GstClockTime stream_time =
      gst_segment_to_stream_time(&self->video->segment, GST_FORMAT_TIME, GST_BUFFER_PTS(video));
  GstMessage* const message =
      gst_message_new_qos(GST_OBJECT(self), is_live, static_cast<guint64>(time), stream_time,
                          GST_BUFFER_PTS(video), GST_BUFFER_DURATION(video));
  gst_message_set_qos_values(message, static_cast<gint64>(earliest) - time, proportion, 1000000);
  gst_message_set_qos_stats(message, GST_FORMAT_BUFFERS, self->processed, dropped);
  gst_element_post_message(GST_ELEMENT(self), message);
  return true;
}

GstFlowReturn RefocusInto(GstStarfocus* self, GstBuffer* video, GstBuffer* picture) {
  GST_OBJECT_LOCK(self);
  const RefocusSettings settings = self->settings;
  GST_OBJECT_UNLOCK(self);
  GstVideoFrame frame, depth, out;
  if (!gst_video_frame_map(&frame, &self->video_info, video, GST_MAP_READ)) {
    return Fail(self, "cannot map a frame of the video");
  }
  ProblemText problem = {"cannot map a frame of the depth"};
  bool is_done = gst_video_frame_map(&depth, &self->map_info, self->map, GST_MAP_READ);
  if (is_done) {
    is_done = gst_video_frame_map(&out, &self->video_info, picture, GST_MAP_WRITE);
    if (is_done) {
      const GstClockTime start = gst_util_get_timestamp();
      is_done = self->refocuser.Refocus(settings, frame, depth, &out, &problem);
      const GstClockTime microseconds = (gst_util_get_timestamp() - start) / 1000;
      GST_LOG_OBJECT(self, "refocused a frame in %" G_GUINT64_FORMAT " us", microseconds);
      gst_video_frame_unmap(&out);
    }
    gst_video_frame_unmap(&depth);
  }
  gst_video_frame_unmap(&frame);
  return is_done ? GST_FLOW_OK : Fail(self, problem.text);
}

// Refocuses the frame and pushes it. Takes ownership of `video`.
GstFlowReturn Push(GstStarfocus* self, GstBuffer* video) {
  GstBufferPool* pool = gst_aggregator_get_buffer_pool(&self->parent);
  GstBuffer* picture = nullptr;
  GstFlowReturn flow = GST_FLOW_OK;
  if (pool == nullptr || !gst_buffer_pool_set_active(pool, TRUE)) {
    flow = Fail(self, "cannot allocate pictures");
  } else {
    flow = gst_buffer_pool_acquire_buffer(pool, &picture, nullptr);
  }
  gst_clear_object(&pool);
  if (flow == GST_FLOW_OK) {
    const auto copied =
        static_cast<GstBufferCopyFlags>(GST_BUFFER_COPY_FLAGS | GST_BUFFER_COPY_TIMESTAMPS);
    gst_buffer_copy_into(picture, video, copied, 0, static_cast<gsize>(-1));
    flow = RefocusInto(self, video, picture);
  }
  gst_buffer_unref(video);
  if (flow != GST_FLOW_OK) {
    gst_clear_buffer(&picture);
    return flow;
  }
  ++self->processed;
  return gst_aggregator_finish_buffer(&self->parent, picture);
}

GstFlowReturn Aggregate(GstAggregator* aggregator, gboolean timeout) {
  GstStarfocus* const self = Self(aggregator);
  GstBuffer* const video = gst_aggregator_pad_peek_buffer(self->video);
  if (video == nullptr) {
    return gst_aggregator_pad_is_eos(self->video) ? GST_FLOW_EOS : GST_AGGREGATOR_FLOW_NEED_DATA;
  }
  const GstClockTimeDiff time = RunningTime(self->video, video);
  GstFlowReturn flow = GST_AGGREGATOR_FLOW_NEED_DATA;
  const bool is_gap = gst_buffer_get_size(video) == 0;
  if (!is_gap) {
    flow = time == GST_CLOCK_STIME_NONE ? Fail(self, "the video has no timestamps")
                                        : FindDepth(self, time, timeout);
  }
  if (is_gap || flow == GST_FLOW_OK) gst_aggregator_pad_drop_buffer(self->video);
  if (flow == GST_FLOW_OK && Drop(self, video, time)) flow = GST_AGGREGATOR_FLOW_NEED_DATA;
  if (flow != GST_FLOW_OK) {
    gst_buffer_unref(video);
    return flow;
  }
  const GstClockTime stream_time =
      gst_segment_to_stream_time(&self->video->segment, GST_FORMAT_TIME, GST_BUFFER_PTS(video));
  if (GST_CLOCK_TIME_IS_VALID(stream_time)) gst_object_sync_values(GST_OBJECT(self), stream_time);
  gst_aggregator_selected_samples(aggregator, GST_BUFFER_PTS(video), GST_BUFFER_DTS(video),
                                  GST_BUFFER_DURATION(video), nullptr);
  return Push(self, video);
}

// Returns the running time at which live video no longer waits for depth, one frame before the
// picture is due. The first frame waits for depth as long as necessary.
GstClockTime NextTime(GstAggregator* aggregator) {
  GstStarfocus* const self = Self(aggregator);
  GstBuffer* const video = gst_aggregator_pad_peek_buffer(self->video);
  if (video == nullptr) return GST_CLOCK_TIME_NONE;
  const GstClockTimeDiff time = RunningTime(self->video, video);
  gst_buffer_unref(video);
  if (self->map == nullptr || time < 0) return GST_CLOCK_TIME_NONE;
  const GstClockTime due = static_cast<GstClockTime>(time), frame = FrameDuration(self->video_info);
  if (!GST_CLOCK_TIME_IS_VALID(frame)) return due;
  return due > frame ? due - frame : 0;
}

bool SetCaps(GstStarfocus* self, GstAggregatorPad* pad, GstCaps* caps) {
  GstVideoInfo* const info = pad == self->depth ? &self->depth_info : &self->video_info;
  if (!gst_video_info_from_caps(info, caps)) return false;
  if (GST_VIDEO_INFO_IS_INTERLACED(info)) {
    Fail(self, "interlaced video is not supported; deinterlace it first");
    return false;
  }
  if (pad == self->depth) return true;
  gst_caps_replace(&self->video_caps, caps);
  const GstClockTime frame = FrameDuration(self->video_info);
  const GstClockTime latency = GST_CLOCK_TIME_IS_VALID(frame) ? frame : 0;
  gst_aggregator_set_latency(&self->parent, latency, latency);
  gst_pad_mark_reconfigure(self->parent.srcpad);
  return true;
}

gboolean SinkEvent(GstAggregator* aggregator, GstAggregatorPad* pad, GstEvent* event) {
  GstStarfocus* const self = Self(aggregator);
  if (GST_EVENT_TYPE(event) == GST_EVENT_CAPS) {
    GstCaps* caps = nullptr;
    gst_event_parse_caps(event, &caps);
    const bool is_set = SetCaps(self, pad, caps);
    gst_event_unref(event);
    if (!gst_pad_is_linked(GST_PAD(self->depth))) {
      Warn(self, "waiting until the pad depth is linked");
    }
    return is_set ? TRUE : FALSE;
  }
  // A segment also follows each flush.
  if (GST_EVENT_TYPE(event) == GST_EVENT_SEGMENT && pad == self->depth) {
    gst_clear_buffer(&self->map);
  }
  if (GST_EVENT_TYPE(event) == GST_EVENT_SEGMENT && pad == self->video) {
    const GstSegment* segment = nullptr;
    gst_event_parse_segment(event, &segment);
    gst_aggregator_update_segment(aggregator, segment);
    Restart(self);
  }
  return Parent()->sink_event(aggregator, pad, event);
}

// Upstream of the pad video, allows only what downstream accepts, since the format and the size do
// not change.
gboolean SinkQuery(GstAggregator* aggregator, GstAggregatorPad* pad, GstQuery* query) {
  if (GST_QUERY_TYPE(query) != GST_QUERY_CAPS || pad != Self(aggregator)->video) {
    return Parent()->sink_query(aggregator, pad, query);
  }
  GstCaps* filter = nullptr;
  gst_query_parse_caps(query, &filter);
  GstCaps* const all = gst_pad_get_pad_template_caps(aggregator->srcpad);
  GstCaps* const accepted = gst_pad_peer_query_caps(aggregator->srcpad, filter);
  GstCaps* const caps = gst_caps_intersect_full(accepted, all, GST_CAPS_INTERSECT_FIRST);
  gst_caps_unref(accepted);
  gst_caps_unref(all);
  gst_query_set_caps_result(query, caps);
  gst_caps_unref(caps);
  return TRUE;
}

gboolean SourceEvent(GstAggregator* aggregator, GstEvent* event) {
  GstStarfocus* const self = Self(aggregator);
  if (GST_EVENT_TYPE(event) == GST_EVENT_QOS) {
    gdouble proportion = 1;
    GstClockTimeDiff jitter = 0;
    GstClockTime time = GST_CLOCK_TIME_NONE;
    gst_event_parse_qos(event, nullptr, &proportion, &jitter, &time);
    GST_OBJECT_LOCK(self);
    self->proportion = proportion;
    self->earliest = GST_CLOCK_TIME_NONE;
    if (GST_CLOCK_TIME_IS_VALID(time)) {
      // Drops more than the delay, to catch up, as GstVideoDecoder does.
      const GstClockTimeDiff ahead = jitter > 0 ? 2 * jitter : jitter;
      const GstClockTimeDiff earliest = static_cast<GstClockTimeDiff>(time) + ahead;
      self->earliest = earliest > 0 ? static_cast<GstClockTime>(earliest) : 0;
    }
    GST_OBJECT_UNLOCK(self);
  }
  return Parent()->src_event(aggregator, event);
}

GstFlowReturn UpdateSourceCaps(GstAggregator* aggregator, GstCaps* caps, GstCaps** result) {
  GstStarfocus* const self = Self(aggregator);
  if (self->video_caps == nullptr) return GST_AGGREGATOR_FLOW_NEED_DATA;
  *result = gst_caps_intersect(self->video_caps, caps);
  return GST_FLOW_OK;
}

// Configures a pool, which may ask for more or larger buffers. Returns false if it refuses.
bool SetUpPool(GstBufferPool* pool, GstQuery* query, GstCaps* caps, guint bytes, guint least,
               guint most) {
  GstStructure* config = gst_buffer_pool_get_config(pool);
  gst_buffer_pool_config_set_params(config, caps, bytes, least, most);
  if (gst_query_find_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr)) {
    gst_buffer_pool_config_add_option(config, GST_BUFFER_POOL_OPTION_VIDEO_META);
  }
  if (gst_buffer_pool_set_config(pool, config)) return true;
  config = gst_buffer_pool_get_config(pool);
  if (gst_buffer_pool_config_validate_params(config, caps, bytes, least, most)) {
    return gst_buffer_pool_set_config(pool, config);
  }
  gst_structure_free(config);
  return false;
}

// Pictures come from a pool of downstream, which saves a copy, or else from a pool of the element.
gboolean DecideAllocation(GstAggregator*, GstQuery* query) {
  GstCaps* caps = nullptr;
  GstVideoInfo info;
  gst_query_parse_allocation(query, &caps, nullptr);
  if (caps == nullptr || !gst_video_info_from_caps(&info, caps)) return FALSE;
  GstBufferPool* pool = nullptr;
  guint bytes = static_cast<guint>(info.size), least = 0, most = 0;
  if (gst_query_get_n_allocation_pools(query) > 0) {
    gst_query_parse_nth_allocation_pool(query, 0, &pool, &bytes, &least, &most);
  } else {
    gst_query_add_allocation_pool(query, nullptr, bytes, 0, 0);
  }
  if (pool == nullptr) pool = gst_video_buffer_pool_new();
  bytes = std::max(bytes, static_cast<guint>(info.size));  // downstream may give 0
  bool is_set = SetUpPool(pool, query, caps, bytes, least, most);
  if (!is_set) {
    gst_object_unref(pool);
    pool = gst_video_buffer_pool_new();
    is_set = SetUpPool(pool, query, caps, bytes, least, most);
  }
  gst_query_set_nth_allocation_pool(query, 0, pool, bytes, least, most);
  gst_object_unref(pool);
  return is_set;
}

// Accepts frames with padding, such as those of cameras.
gboolean ProposeAllocation(GstAggregator*, GstAggregatorPad*, GstQuery*, GstQuery* query) {
  gst_query_add_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr);
  return TRUE;
}

gboolean Start(GstAggregator* aggregator) {
  GstStarfocus* const self = Self(aggregator);
  GST_OBJECT_LOCK(self);
  self->dropped = 0;
  GST_OBJECT_UNLOCK(self);
  self->processed = 0;
  return TRUE;
}

gboolean Stop(GstAggregator* aggregator) {
  GstStarfocus* const self = Self(aggregator);
  Restart(self);
  gst_clear_buffer(&self->map);
  gst_caps_replace(&self->video_caps, nullptr);
  self->refocuser.Close();
  return TRUE;
}

void SetProperty(GObject* object, guint id, const GValue* value, GParamSpec*) {
  GST_OBJECT_LOCK(object);
  SetSetting(id, value, &Self(object)->settings);
  GST_OBJECT_UNLOCK(object);
}

void GetProperty(GObject* object, guint id, GValue* value, GParamSpec*) {
  GST_OBJECT_LOCK(object);
  GetSetting(id, Self(object)->settings, value);
  if (id == kDropped) g_value_set_uint64(value, Self(object)->dropped);
  GST_OBJECT_UNLOCK(object);
}

void Finalize(GObject* object) {
  Self(object)->refocuser.~Refocuser();
  G_OBJECT_CLASS(element_parent_class)->finalize(object);
}

GstAggregatorPad* AddPad(GstStarfocus* self, const char* name) {
  GstPadTemplate* const made =
      gst_element_class_get_pad_template(GST_ELEMENT_GET_CLASS(self), name);
  gpointer pad = g_object_new(GST_TYPE_AGGREGATOR_PAD, "name", name, "direction", GST_PAD_SINK,
                              "template", made, nullptr);
  gst_element_add_pad(GST_ELEMENT(self), GST_PAD(pad));
  return GST_AGGREGATOR_PAD(pad);
}

void element_init(GstStarfocus* self) {
  self->video = AddPad(self, "video");
  self->depth = AddPad(self, "depth");
  new (&self->settings) RefocusSettings();
  new (&self->refocuser) Refocuser();
  self->earliest = GST_CLOCK_TIME_NONE;
  self->proportion = 1;
}

void element_class_init(GstStarfocusClass* made) {
  GObjectClass* const object = G_OBJECT_CLASS(made);
  object->set_property = SetProperty;
  object->get_property = GetProperty;
  object->finalize = Finalize;
  AddSettings(object);
  g_object_class_install_property(
      object, kDropped,
      g_param_spec_uint64("dropped", "Dropped", "Frames dropped because they would be late", 0,
                          G_MAXUINT64, 0,
                          static_cast<GParamFlags>(G_PARAM_READABLE | G_PARAM_STATIC_STRINGS)));

  GstElementClass* const element = GST_ELEMENT_CLASS(made);
  for (GstStaticPadTemplate* pad : {&video_template, &depth_template, &picture_template}) {
    gst_element_class_add_static_pad_template_with_gtype(element, pad, GST_TYPE_AGGREGATOR_PAD);
  }
  gst_element_class_set_static_metadata(element, "Refocus", "Filter/Effect/Video",
                                        "Changes the focus and the aperture of video with depth",
                                        "The starfocus authors <starfocus@example.org>");
  gst_type_mark_as_plugin_api(ShapeType(), static_cast<GstPluginAPIFlags>(0));

  GstAggregatorClass* const aggregator = GST_AGGREGATOR_CLASS(made);
  aggregator->aggregate = Aggregate;
  aggregator->get_next_time = NextTime;
  aggregator->sink_event = SinkEvent;
  aggregator->sink_query = SinkQuery;
  aggregator->src_event = SourceEvent;
  aggregator->update_src_caps = UpdateSourceCaps;
  aggregator->decide_allocation = DecideAllocation;
  aggregator->propose_allocation = ProposeAllocation;
  aggregator->start = Start;
  aggregator->stop = Stop;
}

gboolean Register(GstPlugin* plugin) {
  GST_DEBUG_CATEGORY_INIT(starfocus_debug, "starfocus", 0, "Refocusing");
  return gst_element_register(plugin, "starfocus", GST_RANK_NONE, element_get_type());
}

}  // namespace
}  // namespace starfocus

#define PACKAGE "starfocus"
GST_PLUGIN_DEFINE(GST_VERSION_MAJOR, GST_VERSION_MINOR, starfocus, "Refocuses video with depth",
                  starfocus::Register, STARFOCUS_VERSION_STRING, "Apache 2.0", PACKAGE, PACKAGE)
