// Tests `check_print` on simulated scans. Each scanned print has one known fault. The scanner
// simulation (tests/scanned_page.hpp) is independent of src/simulate.
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../../scanned_page.hpp"
#include "print_checks.hpp"

namespace dotpose::check_print_test {
namespace {

using test::scan_page;
using test::ScanSettings;

struct Fault {
    const char* name;
    ScanSettings settings;
    std::vector<std::string> verdict;  ///< identifiers of all expected faults
};
void PrintTo(const Fault& fault, std::ostream* out) {
    *out << fault.name << " at " << fault.settings.dpi << " dpi";
}

std::vector<Fault> faults_at(double dpi) {
    std::vector<Fault> list;
    const auto add = [&](const char* name, std::vector<std::string> verdict, auto change) {
        ScanSettings settings;
        settings.dpi = dpi;
        change(settings);
        list.push_back({name, settings, std::move(verdict)});
    };
    add("flawless", {}, [](ScanSettings&) {});
    add("97_percent", {"scaled"}, [](ScanSettings& s) { s.scale_x = s.scale_y = 0.97; });
    add("103_percent", {"scaled"}, [](ScanSettings& s) { s.scale_x = s.scale_y = 1.03; });
    add("uneven", {"uneven_scale"}, [](ScanSettings& s) {
        s.scale_x = 1.0025;
        s.scale_y = 0.9975;
    });
    add("rotated", {}, [](ScanSettings& s) { s.rotation_rad = 1.5 * kDegree_rad; });
    add("rotated_by_a_quarter", {}, [](ScanSettings& s) {
        s.rotation_rad = 91.5 * kDegree_rad;
        s.scale_x = 1.001;
    });
    add("skewed", {"skewed"}, [](ScanSettings& s) {
        s.skew_rad = -0.3 * kDegree_rad;
        s.scale_y = 1.001;
    });
    add("swollen", {"swollen"}, [](ScanSettings& s) { s.dot_growth = 1.8; });
    add("thin", {"thin"}, [](ScanSettings& s) { s.dot_growth = 0.62; });
    add("gaps", {"missing"}, [](ScanSettings& s) { s.missing = 0.05; });
    return list;
}

class FaultyPrint : public testing::TestWithParam<Fault> {};

void expect_measured(const Fault& fault) {
    const ScanSettings& truth = fault.settings;
    const Sheet sheet = small_sheet();
    const PrintCheck result = check(scan_page(sheet, truth), truth.dpi);
    ASSERT_EQ(result.fields.size(), 1U);
    const PrintField& field = result.fields[0];
    ASSERT_TRUE(field.scale);
    EXPECT_NEAR(field.scale->scale_x, truth.scale_x, kScaleTolerance);
    EXPECT_NEAR(field.scale->scale_y, truth.scale_y, kScaleTolerance);
    EXPECT_NEAR(field.scale->rotation_rad, truth.rotation_rad, kRotationTolerance_rad);
    EXPECT_NEAR(field.scale->skew_rad, truth.skew_rad, kRotationTolerance_rad);
    EXPECT_NEAR(field.residual_mm, truth.jitter_mm, 0.005);
    EXPECT_EQ(field.pattern.section.u, 5);
    EXPECT_EQ(field.pattern.section.v, 41);
    EXPECT_NEAR(field.missing_fraction(), truth.missing, 0.006);
    EXPECT_LE(field.wrong_fraction(), 0.001);
    EXPECT_NEAR(field.dot_mm, sheet.pattern.dot_mm * truth.dot_growth, 0.1 * field.dot_mm);
    EXPECT_NEAR(field.paper_level, truth.paper_level, 1);
    EXPECT_EQ(faults(result), fault.verdict);
}

TEST_P(FaultyPrint, is_measured_and_named) {
    expect_measured(GetParam());
}

class FaultyPrintAtLength : public FaultyPrint {};

TEST_P(FaultyPrintAtLength, is_measured_and_named) {
    expect_measured(GetParam());
}

std::string fault_name(const testing::TestParamInfo<Fault>& tested) {
    return tested.param.name;
}

INSTANTIATE_TEST_SUITE_P(at_300_dpi, FaultyPrint, testing::ValuesIn(faults_at(300)), fault_name);
INSTANTIATE_TEST_SUITE_P(at_600_dpi, FaultyPrintAtLength, testing::ValuesIn(faults_at(600)),
                         fault_name);

}  // namespace
}  // namespace dotpose::check_print_test
