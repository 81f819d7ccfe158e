/// Fields of the tip of a pen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_place.hpp"
#include "dotpose/tools/pen.hpp"
#include "fields.hpp"
#include "pose_fields.hpp"

namespace dotpose::cli {

struct TipRecord {
    std::optional<TipPose> tip;  ///< position in the pattern frame, or none if there is no tip
    bool is_down = false;
};

/// Returns the fields of the tip: its place, its height, their standard deviations, and `pen_down`.
/// If `has_sheets` is true, also returns the place on the sheet and in the world. The fields have
/// no values if there is no tip.
std::vector<Field> tip_fields(const TipRecord& record, const std::optional<SheetPlace>& place,
                              bool has_sheets, Units units);

/// Returns true if the brief CSV format contains the field.
bool is_brief_tip_field(const std::string& name);

/// Returns the place of the tip as text, such as "tip x 65.61 ± 0.002 mm, ...". The record must
/// have a tip.
std::string tip_text(const TipRecord& record, const std::optional<SheetPlace>& place, Units units);

}  // namespace dotpose::cli
