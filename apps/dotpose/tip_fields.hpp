/// Output fields for a pen tip.
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
    std::optional<TipPose> tip;  ///< pose in the pattern frame, or none if there is no tip
    bool is_down = false;
};

/// Returns the fields for the tip: its position, its height, their standard deviations, and
/// `pen_down`. If `has_sheets` is true, also returns the position on the sheet and in the world. If
/// there is no tip, the values are empty.
std::vector<Field> tip_fields(const TipRecord& record, const std::optional<SheetPlace>& place,
                              bool has_sheets, Units units);

/// Returns true if `Columns::brief` selects the field.
bool is_brief_tip_field(const std::string& name);

/// Returns the position of the tip as text, such as "tip x 65.61 ± 0.002 mm, ...". The record must
/// have a tip.
std::string tip_text(const TipRecord& record, const std::optional<SheetPlace>& place, Units units);

}  // namespace dotpose::cli
