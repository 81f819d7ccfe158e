/// Runs GStreamer pipelines and collects their output.
#pragma once

#include <string>
#include <vector>

#include <gst/gst.h>
#include <nlohmann/json.hpp>

namespace dotpose::test {

/// Initialises GStreamer with the plugin of this build and a private registry.
inline void start_gstreamer() {
    g_setenv("GST_PLUGIN_PATH", DOTPOSE_GSTREAMER_FOLDER, TRUE);
    g_setenv("GST_REGISTRY", DOTPOSE_REGISTRY, TRUE);
    gst_init(nullptr, nullptr);
}

inline bool has_element(const char* name) {
    GstElementFactory* factory = gst_element_factory_find(name);
    if (factory == nullptr) return false;
    gst_object_unref(factory);
    return true;
}

/// Returns a value from a structure as JSON, without rounding.
inline nlohmann::json json_of(const GValue* value) {
    if (G_VALUE_HOLDS_STRING(value)) return g_value_get_string(value);
    if (G_VALUE_HOLDS_DOUBLE(value)) return g_value_get_double(value);
    if (G_VALUE_HOLDS_INT(value)) return g_value_get_int(value);
    if (G_VALUE_HOLDS_UINT64(value)) return g_value_get_uint64(value);
    nlohmann::json array = nlohmann::json::array();
    if (!GST_VALUE_HOLDS_ARRAY(value)) return "of an unknown type";
    for (guint i = 0; i < gst_value_array_get_size(value); ++i)
        array.push_back(json_of(gst_value_array_get_value(value, i)));
    return array;
}

inline nlohmann::json json_of(const GstStructure* structure) {
    nlohmann::json fields = nlohmann::json::object();
    for (gint i = 0; i < gst_structure_n_fields(structure); ++i) {
        const char* name = gst_structure_nth_field_name(structure, static_cast<guint>(i));
        fields[name] = json_of(gst_structure_get_value(structure, name));
    }
    return fields;
}

/// Returns the fields of the buffer's custom meta, or null if the buffer has no such meta.
inline nlohmann::json meta_of(GstBuffer* buffer) {
    GstCustomMeta* meta = gst_buffer_get_custom_meta(buffer, "dotpose");
    if (meta == nullptr) return nullptr;
    return json_of(gst_custom_meta_get_structure(meta));
}

inline std::string bytes_of(GstBuffer* buffer) {
    std::string bytes(gst_buffer_get_size(buffer), '\0');
    gst_buffer_extract(buffer, 0, bytes.data(), bytes.size());
    return bytes;
}

/// A buffer that the sink of a pipeline received.
struct Arrived {
    GstClockTime pts = GST_CLOCK_TIME_NONE;
    GstClockTime duration = GST_CLOCK_TIME_NONE;
    nlohmann::json meta;
    std::string bytes;
};

struct Outcome {
    std::vector<nlohmann::json> messages;  ///< messages from the element, in order
    std::vector<Arrived> frames;
    std::string error;  ///< first error, or empty if there is none
};

namespace pipeline_detail {

inline void keep(GstElement* /*sink*/, GstBuffer* buffer, GstPad* /*pad*/, gpointer frames) {
    static_cast<std::vector<Arrived>*>(frames)->push_back(
        {GST_BUFFER_PTS(buffer), GST_BUFFER_DURATION(buffer), meta_of(buffer), bytes_of(buffer)});
}

/// Collects a message. Returns true if it is the last message.
inline bool take(GstMessage* message, Outcome& outcome) {
    if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ELEMENT) {
        const GstStructure* structure = gst_message_get_structure(message);
        if (gst_structure_has_name(structure, "dotpose")) {
            outcome.messages.push_back(json_of(structure));
        }
        return false;
    }
    if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR) {
        GError* error = nullptr;
        gst_message_parse_error(message, &error, nullptr);
        outcome.error = error->message;
        g_error_free(error);
    }
    return true;
}

}  // namespace pipeline_detail

/// Runs a pipeline until the end of the stream or the first error. `description` must not contain a
/// sink, because this function appends one.
inline Outcome run_pipeline(const std::string& description) {
    Outcome outcome;
    GError* error = nullptr;
    GstElement* pipeline = gst_parse_launch(
        (description + " ! fakesink name=sink signal-handoffs=true sync=false").c_str(), &error);
    if (error != nullptr) {
        outcome.error = error->message;
        g_clear_error(&error);
        if (pipeline != nullptr) gst_object_unref(pipeline);
        return outcome;
    }
    GstElement* sink = gst_bin_get_by_name(GST_BIN(pipeline), "sink");
    g_signal_connect(sink, "handoff", G_CALLBACK(pipeline_detail::keep), &outcome.frames);
    gst_object_unref(sink);
    gst_element_set_state(pipeline, GST_STATE_PLAYING);
    GstBus* bus = gst_element_get_bus(pipeline);
    constexpr auto kWanted =
        static_cast<GstMessageType>(GST_MESSAGE_ELEMENT | GST_MESSAGE_ERROR | GST_MESSAGE_EOS);
    for (bool is_over = false; !is_over;) {
        GstMessage* message = gst_bus_timed_pop_filtered(bus, 60 * GST_SECOND, kWanted);
        if (message == nullptr) {
            outcome.error = "the pipeline stands still";
            break;
        }
        is_over = pipeline_detail::take(message, outcome);
        gst_message_unref(message);
    }
    gst_element_set_state(pipeline, GST_STATE_NULL);
    gst_object_unref(bus);
    gst_object_unref(pipeline);
    return outcome;
}

}  // namespace dotpose::test
