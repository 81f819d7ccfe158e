// GStreamer callbacks of the element. They are called from C, so they must not throw. The Stream
// class locates the frames.
#include "element.hpp"

#include <memory>
#include <optional>

#include <gst/video/gstvideofilter.h>
#include <gst/video/video.h>

#include "overlay.hpp"
#include "pose_structure.hpp"
#include "settings.hpp"
#include "stream.hpp"

namespace dotpose::gstreamer {
namespace {

struct State {
    Settings settings;             ///< guarded by the object lock
    std::optional<Stream> stream;  ///< present while the element is running
};

struct DotposeLocate {
    GstVideoFilter parent;
    State* state;
};
struct DotposeLocateClass {
    GstVideoFilterClass parent;
};

gpointer parent_class = nullptr;

DotposeLocate* locate_of(gpointer object) {
    return static_cast<DotposeLocate*>(object);
}

class Lock {
  public:
    explicit Lock(gpointer object) : object_(GST_OBJECT(object)) { GST_OBJECT_LOCK(object_); }
    ~Lock() { GST_OBJECT_UNLOCK(object_); }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

  private:
    GstObject* object_;
};

/// A frame whose planes remain mapped into memory until its destructor runs.
class MappedFrame {
  public:
    MappedFrame(const GstVideoInfo& info, GstBuffer* buffer, bool is_written) {
        const int flags = GST_MAP_READ | (is_written ? GST_MAP_WRITE : 0);
        is_mapped_ =
            gst_video_frame_map(&frame_, &info, buffer,
                                static_cast<GstMapFlags>(flags | GST_VIDEO_FRAME_MAP_FLAG_NO_REF));
    }
    ~MappedFrame() {
        if (is_mapped_) gst_video_frame_unmap(&frame_);
    }
    MappedFrame(const MappedFrame&) = delete;
    MappedFrame& operator=(const MappedFrame&) = delete;

    bool is_mapped() const { return is_mapped_; }
    /// Returns the first plane, which is the luma in all formats that the element supports.
    Luma luma() const {
        return {static_cast<std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame_, 0)),
                GST_VIDEO_FRAME_WIDTH(&frame_), GST_VIDEO_FRAME_HEIGHT(&frame_),
                GST_VIDEO_FRAME_PLANE_STRIDE(&frame_, 0)};
    }

  private:
    GstVideoFrame frame_;
    bool is_mapped_;
};

/// Returns the running time of a buffer, in µs. If the buffer has no time stamp, the time is
/// computed from the frame number and the frame rate. If the frame rate is also unknown, returns
/// the time of arrival.
std::int64_t time_us(DotposeLocate* self, GstBuffer* buffer) {
    const GstClockTime pts = GST_BUFFER_PTS(buffer);
    const GstSegment& segment = GST_BASE_TRANSFORM(self)->segment;
    const GstVideoInfo& info = self->parent.in_info;
    guint64 running_time = 0;
    if (GST_CLOCK_TIME_IS_VALID(pts)) {
        const int sign =
            gst_segment_to_running_time_full(&segment, GST_FORMAT_TIME, pts, &running_time);
        if (sign != 0) return sign * static_cast<std::int64_t>(running_time / 1000);
        return static_cast<std::int64_t>(pts / 1000);
    }
    if (info.fps_n <= 0) return g_get_monotonic_time();
    return static_cast<std::int64_t>(gst_util_uint64_scale(
        self->state->stream->frames(), guint64{1'000'000} * static_cast<guint64>(info.fps_d),
        static_cast<guint64>(info.fps_n)));
}

void put_times(GstStructure* structure, const GstSegment& segment, GstBuffer* buffer) {
    const GstClockTime pts = GST_BUFFER_PTS(buffer);
    gst_structure_set(structure, "timestamp", G_TYPE_UINT64, pts, "stream-time", G_TYPE_UINT64,
                      gst_segment_to_stream_time(&segment, GST_FORMAT_TIME, pts), "running-time",
                      G_TYPE_UINT64, gst_segment_to_running_time(&segment, GST_FORMAT_TIME, pts),
                      "duration", G_TYPE_UINT64, GST_BUFFER_DURATION(buffer), nullptr);
}

gboolean copy_field(GQuark field, const GValue* value, gpointer to) {
    gst_structure_id_set_value(static_cast<GstStructure*>(to), field, value);
    return TRUE;
}

void notify(DotposeLocate* self, GstBuffer* buffer, const Reading& reading,
            const Switches& switches) {
    if (!switches.posts_messages && !switches.attaches_meta) return;
    GstStructure* structure = gst_structure_new_empty(kPoseName);
    put_times(structure, GST_BASE_TRANSFORM(self)->segment, buffer);
    put_reading(structure, reading);
    if (switches.attaches_meta) {
        GstCustomMeta* meta = gst_buffer_add_custom_meta(buffer, kPoseName);
        gst_structure_foreach(structure, copy_field, gst_custom_meta_get_structure(meta));
    }
    if (switches.posts_messages) {
        gst_element_post_message(GST_ELEMENT(self),
                                 gst_message_new_element(GST_OBJECT(self), structure));
    } else {
        gst_structure_free(structure);
    }
}

/// Locates the pattern in the luma of the frame. Draws the overlay if it is enabled.
Reading read(DotposeLocate* self, const Luma& luma, std::int64_t time, const Switches& switches) {
    Stream& stream = *self->state->stream;
    const ImageView image = {luma.pixels, luma.width_px, luma.height_px, luma.stride_bytes};
    const Reading reading = stream.read(image, switches.is_inverted, time);
    if (stream.has_overlay()) draw_overlay(luma, stream.follower().trace());
    return reading;
}

GstFlowReturn transform_ip(GstBaseTransform* base, GstBuffer* buffer) {
    DotposeLocate* self = locate_of(base);
    const Switches switches = [self] {
        const Lock lock(self);
        return self->state->settings.switches;
    }();
    std::optional<Reading> reading;
    try {
        // Without the overlay, the frame is mapped only for reading, because mapping for writing
        // would copy memory that is shared with other elements.
        const MappedFrame frame(self->parent.in_info, buffer, self->state->stream->has_overlay());
        if (!frame.is_mapped()) {
            GST_ELEMENT_ERROR(self, STREAM, FORMAT, ("A frame cannot be mapped"), (nullptr));
            return GST_FLOW_ERROR;
        }
        reading = read(self, frame.luma(), time_us(self, buffer), switches);
    } catch (const std::exception& error) {
        GST_ELEMENT_ERROR(self, STREAM, FAILED, ("%s", error.what()), (nullptr));
        return GST_FLOW_ERROR;
    }
    notify(self, buffer, *reading, switches);
    return GST_FLOW_OK;
}

gboolean start(GstBaseTransform* base) {
    DotposeLocate* self = locate_of(base);
    const Settings settings = [self] {
        const Lock lock(self);
        return self->state->settings;
    }();
    try {
        self->state->stream.emplace(settings);
        return TRUE;
    } catch (const std::exception& error) {
        GST_ELEMENT_ERROR(self, RESOURCE, SETTINGS, ("%s", error.what()), (nullptr));
        return FALSE;
    }
}

gboolean stop(GstBaseTransform* base) {
    locate_of(base)->state->stream.reset();
    return TRUE;
}

gboolean set_info(GstVideoFilter* filter, GstCaps* /*in*/, GstVideoInfo* info, GstCaps* /*out*/,
                  GstVideoInfo* /*out_info*/) {
    DotposeLocate* self = locate_of(filter);
    try {
        self->state->stream->require_size(info->width, info->height);
        return TRUE;
    } catch (const std::exception& error) {
        GST_ELEMENT_ERROR(self, STREAM, FORMAT, ("%s", error.what()), (nullptr));
        return FALSE;
    }
}

void set_property_of(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
    const Lock lock(object);
    if (!set_property(locate_of(object)->state->settings, id, value)) {
        G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
    }
}

void get_property_of(GObject* object, guint id, GValue* value, GParamSpec* spec) {
    const Lock lock(object);
    if (!get_property(locate_of(object)->state->settings, id, value)) {
        G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
    }
}

void finalize(GObject* object) {
    delete locate_of(object)->state;
    G_OBJECT_CLASS(parent_class)->finalize(object);
}

void init(GTypeInstance* instance, gpointer /*locate_class*/) {
    DotposeLocate* self = locate_of(instance);
    self->state = new State;
    GstBaseTransform* base = GST_BASE_TRANSFORM(self);
    gst_base_transform_set_in_place(base, TRUE);
    // Frames are located even if they are too late for display.
    gst_base_transform_set_qos_enabled(base, FALSE);
}

void add_pads(GstElementClass* element_class) {
    GstCaps* caps = gst_caps_from_string(GST_VIDEO_CAPS_MAKE("{ GRAY8, I420, NV12 }"));
    for (const auto& [name, direction] : {std::pair{"sink", GST_PAD_SINK}, {"src", GST_PAD_SRC}})
        gst_element_class_add_pad_template(
            element_class, gst_pad_template_new(name, direction, GST_PAD_ALWAYS, caps));
    gst_caps_unref(caps);
}

void init_class(gpointer locate_class, gpointer /*data*/) {
    parent_class = g_type_class_peek_parent(locate_class);
    GObjectClass* object_class = G_OBJECT_CLASS(locate_class);
    object_class->set_property = set_property_of;
    object_class->get_property = get_property_of;
    object_class->finalize = finalize;
    install_properties(object_class);

    GstElementClass* element_class = GST_ELEMENT_CLASS(locate_class);
    add_pads(element_class);
    gst_element_class_set_static_metadata(
        element_class, "Dot sheet locator", "Filter/Analyzer/Video",
        "Locates the camera on a sheet printed with a dot position code", "dotpose");

    GstBaseTransformClass* transform_class = GST_BASE_TRANSFORM_CLASS(locate_class);
    transform_class->start = start;
    transform_class->stop = stop;
    // Replaces GstVideoFilter's transform_ip, which maps all frames for writing and therefore
    // copies shared memory.
    transform_class->transform_ip = transform_ip;
    GST_VIDEO_FILTER_CLASS(locate_class)->set_info = set_info;
}

GType locate_type() {
    static const GType type = g_type_register_static_simple(
        GST_TYPE_VIDEO_FILTER, "DotposeLocate", sizeof(DotposeLocateClass), init_class,
        sizeof(DotposeLocate), init, static_cast<GTypeFlags>(0));
    return type;
}

}  // namespace

gboolean register_element(GstPlugin* plugin) {
    return gst_element_register(plugin, "dotposelocate", GST_RANK_NONE, locate_type());
}

}  // namespace dotpose::gstreamer
