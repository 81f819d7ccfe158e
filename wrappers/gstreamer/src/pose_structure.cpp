#include "pose_structure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "dotpose/files/code_names.hpp"
#include "dotpose/tools/track_names.hpp"

namespace dotpose::gstreamer {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// Sets the fields of a structure, with one function for each type of value.
class Fields {
  public:
    explicit Fields(GstStructure* structure) : structure_(structure) {}

    void text(const char* name, const std::string& value) const {
        if (!value.empty()) {
            gst_structure_set(structure_, name, G_TYPE_STRING, value.c_str(), nullptr);
        }
    }
    void count(const char* name, int value) const {
        gst_structure_set(structure_, name, G_TYPE_INT, value, nullptr);
    }
    void number(const char* name, double value) const {
        if (std::isfinite(value)) {
            gst_structure_set(structure_, name, G_TYPE_DOUBLE, value, nullptr);
        }
    }
    void evidence(const char* name, int value) const { count(name, value); }
    void evidence(const char* name, float value) const { number(name, static_cast<double>(value)); }
    template <typename Enum>
    void evidence(const char* key, Enum value) const {
        text(key, name(value));
    }
    /// Sets an angle. Converts it from rad to degrees in (-180, 180].
    void angle(const char* name, double value_rad) const {
        const double value_deg = value_rad * kDegrees;
        number(name, value_deg <= -180 ? value_deg + 360 : value_deg);
    }
    /// Sets the nine elements of a covariance, row by row. Each element is multiplied by two
    /// factors: one for its row and one for its column. Sets nothing if the covariance is unknown.
    template <typename Matrix>
    void covariance(const char* name, const Matrix& matrix,
                    const std::array<double, 3>& factors) const {
        if (!(matrix[0][0] > 0)) return;
        GValue array = G_VALUE_INIT;
        gst_value_array_init(&array, 9);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                GValue element = G_VALUE_INIT;
                g_value_init(&element, G_TYPE_DOUBLE);
                g_value_set_double(&element,
                                   factors[i] * factors[j] * static_cast<double>(matrix[i][j]));
                gst_value_array_append_and_take_value(&array, &element);
            }
        }
        gst_structure_take_value(structure_, name, &array);
    }

  private:
    GstStructure* structure_;
};

void put_section(GstStructure* structure, Section section) {
    GValue array = G_VALUE_INIT;
    gst_value_array_init(&array, 2);
    for (const int part : {int{section.u}, int{section.v}}) {
        GValue element = G_VALUE_INIT;
        g_value_init(&element, G_TYPE_INT);
        g_value_set_int(&element, part);
        gst_value_array_append_and_take_value(&array, &element);
    }
    gst_structure_take_value(structure, "section", &array);
}

template <typename Matrix>
double sigma(const Matrix& covariance, std::size_t i) {
    return std::sqrt(static_cast<double>(covariance[i][i]));
}

void put_pattern_pose(const Fields& fields, const Located& located) {
    const Fix& fix = located.fix;
    const double spacing_mm = located.spacing_mm;
    fields.number("x_mm", fix.x_grid() * spacing_mm);
    fields.number("y_mm", fix.y_grid() * spacing_mm);
    fields.angle("theta_deg", fix.theta_rad());
    if (!fix.has_covariance()) return;
    fields.number("sigma_x_mm", sigma(fix.covariance, 0) * spacing_mm);
    fields.number("sigma_y_mm", sigma(fix.covariance, 1) * spacing_mm);
    fields.number("sigma_theta_deg", sigma(fix.covariance, 2) * kDegrees);
    if (std::isfinite(spacing_mm)) {
        fields.covariance("covariance_mm_deg", fix.covariance, {spacing_mm, spacing_mm, kDegrees});
    }
}

void put_evidence(const Fields& fields, const Fix& fix) {
#define FIX_EVIDENCE(type, name, is_known, doc) \
    if (is_known) fields.evidence(#name, fix.name);
#include "dotpose/fix_fields.def"
    if (!fix) return;
    // Minimum reported probability. The model of paper, ink and camera does not justify smaller
    // values.
    constexpr double kMin_p_wrong = 1e-30;
    fields.number("p_wrong", std::max(fix.p_wrong(), kMin_p_wrong));
    fields.number("spacing_px", fix.spacing_px());
}

/// Sets the code of the sheet and, if another code also explains the frame, the alternative code.
void put_code(const Fields& fields, const Located& located) {
    const CodeReading& reading = located.reading;
    const bool is_ok = located.fix.status == Status::ok;
    const bool is_read = is_ok || located.fix.status == Status::ambiguous_code;
    if (is_read) fields.text("code", name(reading.code));
    if (is_ok && !located.code_is_given) {
        fields.number("code_p_wrong", static_cast<double>(reading.evidence.p_wrong(reading.code)));
    }
    if (reading.has_other && (is_read || located.code_is_given)) {
        fields.text("other_code", name(reading.other_code));
    }
}

void put_place(const Fields& fields, const SheetPlace& place) {
    fields.text("sheet", place.entry->name);
    fields.number("x_sheet_mm", place.x_mm);
    fields.number("y_sheet_mm", place.y_mm);
    fields.angle("theta_sheet_deg", place.theta_rad);
    fields.covariance("covariance_sheet_mm_deg", place.covariance, {1, 1, kDegrees});
    const auto world = world_place(place);
    if (!world) return;
    fields.number("x_m", world->x_m);
    fields.number("y_m", world->y_m);
    fields.number("yaw_rad", world->yaw_rad);
    fields.covariance("covariance_m_rad", world->covariance, {1, 1, 1});
}

void put_motion(const Fields& fields, const TrackedPose& pose) {
    const Covariance6& covariance = pose.covariance;
    fields.number("track_x_mm", pose.x_mm());
    fields.number("track_y_mm", pose.y_mm());
    fields.angle("track_theta_deg", pose.theta_rad());
    fields.covariance("track_covariance_mm_deg", covariance, {1, 1, kDegrees});
    fields.number("vx_mm_s", static_cast<double>(pose.vx_mm_s));
    fields.number("vy_mm_s", static_cast<double>(pose.vy_mm_s));
    fields.number("turn_deg_s", static_cast<double>(pose.turn_rad_s) * kDegrees);
    fields.number("track_sigma_mm", std::max(sigma(covariance, 0), sigma(covariance, 1)));
    fields.number("track_sigma_deg", sigma(covariance, 2) * kDegrees);
    fields.number("sigma_v_mm_s", std::max(sigma(covariance, 3), sigma(covariance, 4)));
    fields.number("sigma_turn_deg_s", sigma(covariance, 5) * kDegrees);
}

void put_track(const Fields& fields, const Track& track, bool is_in_world) {
    fields.text("state", state_name(track));
    fields.text("events", event_names(track.events));
    fields.text("verdict", name(track.verdict));
    if (track.is_lost) return;
    fields.text("plane", is_in_world ? "world" : "pattern");
    put_motion(fields, track.pose);
}

}  // namespace

void put_reading(GstStructure* structure, const Reading& reading) {
    const Fields fields(structure);
    const Located& located = reading.located;
    gst_structure_set(structure, "frame", G_TYPE_UINT64, guint64{reading.frame}, nullptr);
    fields.text("status", name(located.fix.status));
    put_evidence(fields, located.fix);
    if (located.fix.status == Status::ok) {
        put_pattern_pose(fields, located);
        put_section(structure, located.fix.section);
    } else {
        fields.text("message", message(located.fix.status));
    }
    put_code(fields, located);
    if (located.place) put_place(fields, *located.place);
    if (reading.track) put_track(fields, *reading.track, reading.is_in_world);
}

}  // namespace dotpose::gstreamer
