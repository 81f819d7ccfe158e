#include "settings.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <gst/gst.h>

#include "dotpose/files/code_names.hpp"

namespace dotpose::gstreamer {
namespace {

enum Property : guint {
    kSheets = 1,
    kCamera,
    kCode,
    kSpacing,
    kInverted,
    kTrack,
    kMaxSpeed,
    kAcceleration,
    kLostAfter,
    kMaxPWrong,
    kPostMessages,
    kAttachMeta,
    kOverlay,
};

constexpr GParamFlags kAlways = static_cast<GParamFlags>(
    G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS | GST_PARAM_MUTABLE_PLAYING);
/// Flags for properties that take effect only when the element starts.
constexpr GParamFlags kAtStart =
    static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS | GST_PARAM_MUTABLE_READY);

constexpr gint kAnyCode = 0;

gint number(std::optional<CodeVariant> code) {
    return code ? static_cast<gint>(*code) + 1 : kAnyCode;
}

std::optional<CodeVariant> code_of(gint number) {
    if (number == kAnyCode) return std::nullopt;
    return static_cast<CodeVariant>(number - 1);
}

/// Returns the GObject type of the `code` property, an enumeration. The first call registers the
/// type.
GType code_type() {
    static const std::array<GEnumValue, kCodeVariantCount + 2> values = [] {
        std::array<GEnumValue, kCodeVariantCount + 2> all{};
        all[0] = {kAnyCode, "Found out from the frames", "auto"};
        for (int i = 0; i < kCodeVariantCount; ++i) {
            const auto code = static_cast<CodeVariant>(i);
            all[static_cast<std::size_t>(i) + 1] = {number(code), name(code), name(code)};
        }
        return all;
    }();
    static const GType type = g_enum_register_static("DotposeCode", values.data());
    return type;
}

std::string text_of(const GValue* value) {
    const char* text = g_value_get_string(value);
    return text == nullptr ? std::string() : text;
}

void add_switch(GObjectClass* element_class, Property id, const char* name, const char* help,
                bool standard, GParamFlags flags) {
    g_object_class_install_property(
        element_class, id, g_param_spec_boolean(name, name, help, standard ? TRUE : FALSE, flags));
}

void add_number(GObjectClass* element_class, Property id, const char* name, const char* help,
                double least, double most, double standard) {
    g_object_class_install_property(
        element_class, id, g_param_spec_double(name, name, help, least, most, standard, kAtStart));
}

void add_file(GObjectClass* element_class, Property id, const char* name, const char* help) {
    g_object_class_install_property(element_class, id,
                                    g_param_spec_string(name, name, help, nullptr, kAtStart));
}

void add_track_numbers(GObjectClass* element_class) {
    const TrackOptions track;
    constexpr double kMin = 1e-3;
    constexpr double kMax = 1e7;
    add_number(element_class, kMaxSpeed, "max-speed-mm-s",
               "Maximum speed of the robot while it is not located", kMin, kMax,
               static_cast<double>(track.max_speed_mm_s));
    add_number(element_class, kAcceleration, "acceleration-mm-s2",
               "Usual acceleration of the robot: a larger value follows faster and smooths less",
               kMin, kMax, static_cast<double>(track.acceleration_mm_s2));
    add_number(element_class, kLostAfter, "lost-after-ms",
               "Time without an accepted fix after which the robot is lost", 0, 1e9,
               static_cast<double>(track.lost_after_us) / 1000);
    add_number(element_class, kMaxPWrong, "max-p-wrong",
               "Maximum probability that an accepted position is wrong, including the prior; "
               "counts as the next lower power of 2",
               1e-60, 1e-3, std::ldexp(1.0, track.max_p_wrong_log2));
}

}  // namespace

void install_properties(GObjectClass* element_class) {
    add_file(element_class, kSheets, "sheets",
             "Sheet file; adds the place on the sheet, and tracks the robot in the world");
    add_file(element_class, kCamera, "camera",
             "Camera file of 'dotpose calibrate' or ROS, with lens, reference point and heading");
    g_object_class_install_property(
        element_class, kCode,
        g_param_spec_enum("code", "code", "Code of the sheet, if there is no sheet file",
                          code_type(), kAnyCode, kAtStart));
    add_number(element_class, kSpacing, "spacing-mm",
               "Distance between adjacent grid intersections, if there is no sheet file", 0.01, 100,
               kDefaultSpacing_mm);
    add_switch(element_class, kInverted, "inverted",
               "The dots are white on black (copies the luma)", false, kAlways);
    add_switch(element_class, kTrack, "track",
               "Track the robot from frame to frame; otherwise each frame is located independently",
               true, kAtStart);
    add_track_numbers(element_class);
    add_switch(element_class, kPostMessages, "post-messages",
               "Post an element message 'dotpose' for each frame", true, kAlways);
    add_switch(element_class, kAttachMeta, "attach-meta",
               "Attach a custom meta 'dotpose' to each buffer", true, kAlways);
    add_switch(element_class, kOverlay, "overlay", "Draw dots and pose on the luma", false,
               kAtStart);
}

bool set_property(Settings& settings, guint id, const GValue* value) {
    const auto is_on = [value] { return g_value_get_boolean(value) != FALSE; };
    TrackOptions& track = settings.options.track;
    switch (id) {
        case kSheets:
            settings.sheets = text_of(value);
            break;
        case kCamera:
            settings.camera = text_of(value);
            break;
        case kCode:
            settings.options.code = code_of(g_value_get_enum(value));
            break;
        case kSpacing:
            settings.options.spacing_mm = g_value_get_double(value);
            break;
        case kInverted:
            settings.switches.is_inverted = is_on();
            break;
        case kTrack:
            settings.is_tracked = is_on();
            break;
        case kMaxSpeed:
            track.max_speed_mm_s = static_cast<float>(g_value_get_double(value));
            break;
        case kAcceleration:
            track.acceleration_mm_s2 = static_cast<float>(g_value_get_double(value));
            break;
        case kLostAfter:
            track.lost_after_us = static_cast<std::int64_t>(g_value_get_double(value) * 1000);
            break;
        case kMaxPWrong:
            track.max_p_wrong_log2 =
                static_cast<int>(std::floor(std::log2(g_value_get_double(value))));
            break;
        case kPostMessages:
            settings.switches.posts_messages = is_on();
            break;
        case kAttachMeta:
            settings.switches.attaches_meta = is_on();
            break;
        case kOverlay:
            settings.has_overlay = is_on();
            break;
        default:
            return false;
    }
    return true;
}

bool get_property(const Settings& settings, guint id, GValue* value) {
    const auto put_text = [value](const std::string& text) {
        g_value_set_string(value, text.empty() ? nullptr : text.c_str());
    };
    const auto put_switch = [value](bool is_on) {
        g_value_set_boolean(value, is_on ? TRUE : FALSE);
    };
    const TrackOptions& track = settings.options.track;
    switch (id) {
        case kSheets:
            put_text(settings.sheets);
            break;
        case kCamera:
            put_text(settings.camera);
            break;
        case kCode:
            g_value_set_enum(value, number(settings.options.code));
            break;
        case kSpacing:
            g_value_set_double(value, settings.options.spacing_mm);
            break;
        case kInverted:
            put_switch(settings.switches.is_inverted);
            break;
        case kTrack:
            put_switch(settings.is_tracked);
            break;
        case kMaxSpeed:
            g_value_set_double(value, static_cast<double>(track.max_speed_mm_s));
            break;
        case kAcceleration:
            g_value_set_double(value, static_cast<double>(track.acceleration_mm_s2));
            break;
        case kLostAfter:
            g_value_set_double(value, static_cast<double>(track.lost_after_us) / 1000);
            break;
        case kMaxPWrong:
            g_value_set_double(value, std::ldexp(1.0, track.max_p_wrong_log2));
            break;
        case kPostMessages:
            put_switch(settings.switches.posts_messages);
            break;
        case kAttachMeta:
            put_switch(settings.switches.attaches_meta);
            break;
        case kOverlay:
            put_switch(settings.has_overlay);
            break;
        default:
            return false;
    }
    return true;
}

}  // namespace dotpose::gstreamer
