/// Creates a small print, and returns the faults found in its scan.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "dotpose/tools/check_print.hpp"
#include "dotpose/tools/print.hpp"

namespace dotpose::check_print_test {

inline constexpr double kDegree_rad = std::numbers::pi / 180;
inline constexpr double kScaleTolerance = 0.0002;
inline constexpr double kRotationTolerance_rad = 0.02 * kDegree_rad;

inline Sheet small_sheet() {
    SheetOptions options;
    options.paper = {70, 90};
    options.origin = {123'456, 7'890};
    options.pattern.section = {5, 41};
    return make_sheet(options);
}

inline PrintCheck check(const GreyImage& scan, double dpi) {
    CheckPrintOptions options;
    options.resolution = Resolution{dpi, dpi};
    return check_print(scan.view(), options);
}

inline std::vector<std::string> faults(const PrintCheck& check) {
    std::vector<std::string> names;
    for (const Finding& finding : check.findings) {
        if (finding.is_fault) names.emplace_back(name(finding.kind));
    }
    return names;
}

}  // namespace dotpose::check_print_test
