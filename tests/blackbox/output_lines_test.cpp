// Tests the output lines of `locate`, `watch` and `listen`: schema, units and covariances.
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../drive.hpp"
#include "../json_schema.hpp"
#include "../paths.hpp"
#include "dotpose/pose_packet.hpp"
#include "dotpose/tools/image_file.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Matrix = std::array<std::array<double, 3>, 3>;

constexpr double kRadians = std::numbers::pi / 180;

Matrix matrix_of(const json& covariance) {
    Matrix matrix{};
    for (std::size_t i = 0; i < 9; ++i)
        matrix[i / 3][i % 3] = covariance.at(i);
    return matrix;
}

/// Returns J C J', the covariance of the vector J p, where C is the covariance of p.
Matrix propagated(const Matrix& j, const Matrix& c) {
    Matrix result{};
    for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t k = 0; k < 9; ++k)
            result[i / 3][i % 3] += j[i / 3][k / 3] * c[k / 3][k % 3] * j[i % 3][k % 3];
    }
    return result;
}

/// Compares two covariance matrices that were printed with seven digits.
void expect_equal(const Matrix& actual, const Matrix& expected) {
    for (std::size_t i = 0; i < 9; ++i) {
        const double scale = std::sqrt(expected[i / 3][i / 3] * expected[i % 3][i % 3]);
        EXPECT_NEAR(actual[i / 3][i % 3], expected[i / 3][i % 3], 2e-6 * scale) << i;
    }
}

class OutputLines : public ToolCommand {
  protected:
    /// Writes frames from a drive over two sheets, frames without a pattern, and packets.
    void SetUp() override {
        save_drive_sheets(directory_ / "sheets.json");
        json file = json::parse(read_file(directory_ / "sheets.json"));
        for (json& sheet : file["sheets"])
            sheet["world"] = {{"x_m", 1.5}, {"y_m", -0.25}, {"yaw_rad", kYaw_rad}};
        std::ofstream(directory_ / "sheets.json") << file;
        const DriveCamera camera(188, 120);
        fs::create_directory(directory_ / "frames");
        for (int i = 0; i < 8; ++i) {
            write_pgm(directory_ / "frames" / ("f" + std::to_string(i) + ".pgm"),
                      camera.frame(drive_, kFirst + i).view());
        }
        std::ofstream(directory_ / "camera.yaml")
            << "format: dotpose-camera\nversion: 1\nwidth_px: 188\nheight_px: 120\n"
               "k_per_px2: 0\ncentre_px: [93.5, 59.5]\nfocal_px: 350\n";
        GreyImage flat{{}, 188, 120};
        flat.pixels.assign(188 * 120, 200);
        for (int i = 0; i < 16; ++i)
            write_pgm(directory_ / "frames" / ("g" + std::to_string(10 + i) + ".pgm"), flat.view());
        PosePacket packet;
        packet.status = Status::ok;
        packet.cell = {1000, 2000};
        packet.theta_bam16 = 0x2000;
        packet.certainty = 40;
        packet.deviation_q12 = 8;
        PosePacket none;
        none.status = Status::too_few_dots;
        std::ofstream packets(directory_ / "packets.bin", std::ios::binary);
        for (const PosePacket& sent : {packet, none}) {
            const PacketBytes bytes = encode(sent);
            packets.write(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        }
    }

    std::vector<json> lines(const std::string& arguments) {
        EXPECT_EQ(run(arguments), 0) << errors_;
        std::vector<json> lines;
        for (const std::string& line : lines_of(output_))
            lines.push_back(json::parse(line));
        return lines;
    }

    static constexpr double kYaw_rad = 0.4;
    /// Index of the first frame that the test uses. In this frame, the robot drives through a curve
    /// at 300 mm/s.
    static constexpr int kFirst = 320;
    const Drive drive_;
    const JsonSchema schema_{
        json::parse(read_file(test::source_dir() + "/docs/schema/lines-1.json"))};
};

/// Commands that write output lines, with each option that adds or removes fields.
constexpr std::array kRuns = {
    "locate frames/f0.pgm frames/g10.pgm",
    "locate frames/f0.pgm --sheets sheets.json",
    "locate frames/f0.pgm --code libdots",
    "locate frames/f0.pgm frames/g10.pgm --camera camera.yaml --pose space",
    "locate frames/f0.pgm --sheets sheets.json --camera camera.yaml --pose space",
    "watch frames --fps 200 --no-window",
    "watch frames --fps 200 --no-window --sheets sheets.json",
    "watch frames --fps 200 --no-window --camera camera.yaml --pose space",
    "watch frames --fps 200 --no-window --sheets sheets.json --camera camera.yaml --pose space",
    "listen packets.bin",
    "listen packets.bin --sheets sheets.json",
};

TEST_F(OutputLines, FitTheirSchema) {
    for (const std::string command : kRuns) {
        for (const std::string units : {"mm", "ros"}) {
            const std::string arguments = command + " --units " + units;
            const std::vector<json> found = lines(arguments);
            ASSERT_THAT(found, Not(IsEmpty())) << arguments;
            for (const json& line : found) {
                const JsonSchema::Verdict verdict = schema_.check(line);
                EXPECT_THAT(verdict.errors, IsEmpty()) << arguments << "\n" << line;
                for (const auto& [key, value] : line.items())
                    EXPECT_THAT(verdict.described_keys, Contains(key)) << arguments;
            }
        }
    }
}

TEST_F(OutputLines, HaveTheSameNamesInCsv) {
    for (const std::string command : kRuns) {
        for (const std::string units : {"mm", "ros"}) {
            const std::string arguments = command + " --units " + units;
            std::set<std::string> keys;
            for (const json& line : lines(arguments)) {
                for (const auto& [key, value] : line.items())
                    keys.insert(key);
            }
            const bool has_columns = arguments.starts_with("locate");
            ASSERT_EQ(run(arguments + " --format csv" + (has_columns ? " --columns all" : "")), 0);
            const std::vector<std::string> columns = cells_of(lines_of(output_).front());
            const std::set<std::string> names(columns.begin(), columns.end());
            EXPECT_EQ(names.size(), columns.size()) << "a name twice: " << arguments;
            for (const std::string& key : keys) {
                if (key == "section") {
                    EXPECT_THAT(columns, Contains("section_v"));
                } else if (key == "camera_turn_deg_s" || key == "camera_turn_rad_s") {
                    EXPECT_THAT(columns, Contains(key + "_x")) << arguments;
                    EXPECT_THAT(columns, Contains(key + "_z")) << arguments;
                } else if (key.find("quaternion") != std::string::npos) {
                    EXPECT_THAT(columns, Contains(key + "_w")) << arguments;
                } else if (key.find("camera_covariance") != std::string::npos) {
                    EXPECT_THAT(columns, Contains(key + "_55")) << arguments;
                } else if (key.find("covariance") != std::string::npos) {
                    EXPECT_THAT(columns, Contains(key + "_00")) << arguments;
                    EXPECT_THAT(columns, Contains(key + "_22")) << arguments;
                } else {
                    EXPECT_THAT(columns, Contains(key)) << arguments;
                }
            }
        }
    }
}

TEST_F(OutputLines, OfOtherKindsDoNotFitTheSchema) {
    const json line = lines("locate frames/f0.pgm --sheets sheets.json").at(0);
    ASSERT_THAT(schema_.check(line).errors, IsEmpty());
    const auto errors_of = [this, &line](const auto& change) {
        json changed = line;
        change(changed);
        return schema_.check(changed).errors;
    };
    EXPECT_THAT(errors_of([](json& l) { l["schema"] = 2; }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l.erase("status"); }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l["status"] = "fine"; }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l.erase("y_mm"); }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l.erase("p_wrong"); }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l["theta_deg"] = 181; }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l["yaw_rad"] = "0"; }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l["dots_seen"] = 1.5; }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l["section"].push_back(0); }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l["covariance_m_rad"].erase(0); }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l["frame"] = 0; }), Not(IsEmpty()));
    EXPECT_THAT(errors_of([](json& l) { l["sequence"] = 0; }), Not(IsEmpty()));
}

TEST_F(OutputLines, HaveTheCovarianceOfEachPose) {
    const json line = lines("locate frames/f0.pgm --sheets sheets.json").at(0);
    const Matrix pattern = matrix_of(line["covariance_mm_deg"]);
    EXPECT_NEAR(std::sqrt(pattern[0][0]), line["sigma_x_mm"].get<double>(), 1e-6);
    EXPECT_NEAR(std::sqrt(pattern[1][1]), line["sigma_y_mm"].get<double>(), 1e-6);
    EXPECT_NEAR(std::sqrt(pattern[2][2]), line["sigma_theta_deg"].get<double>(), 1e-6);
    // The sheet is printed at its nominal scale, so the covariance on the sheet equals the
    // covariance in the pattern.
    expect_equal(matrix_of(line["covariance_sheet_mm_deg"]), pattern);
    EXPECT_EQ(line["theta_sheet_deg"], line["theta_deg"]);
    // docs/sheet-files.md defines the pose in the world, for example x_m = world.x_m + (x cos(yaw)
    // + y sin(yaw)) / 1000.
    const double c = std::cos(kYaw_rad) / 1000;
    const double s = std::sin(kYaw_rad) / 1000;
    expect_equal(matrix_of(line["covariance_m_rad"]),
                 propagated({{{c, s, 0}, {s, -c, 0}, {0, 0, -kRadians}}}, pattern));
}

TEST_F(OutputLines, OfRosAreRightHandedInMetresAndRadians) {
    const std::string command = "locate frames/f0.pgm --sheets sheets.json --units ";
    const json mm = lines(command + "mm").at(0);
    const json ros = lines(command + "ros").at(0);
    const auto number = [](const json& line, const char* key) {
        return line.at(key).get<double>();
    };
    EXPECT_NEAR(number(ros, "x_pattern_m"), number(mm, "x_mm") / 1000, 2e-9);
    EXPECT_NEAR(number(ros, "y_pattern_m"), -number(mm, "y_mm") / 1000, 2e-9);
    EXPECT_NEAR(number(ros, "yaw_pattern_rad"), -number(mm, "theta_deg") * kRadians, 2e-8);
    EXPECT_NEAR(number(ros, "x_sheet_m"), number(mm, "x_sheet_mm") / 1000, 2e-9);
    EXPECT_NEAR(number(ros, "y_sheet_m"), -number(mm, "y_sheet_mm") / 1000, 2e-9);
    EXPECT_NEAR(number(ros, "yaw_sheet_rad"), -number(mm, "theta_sheet_deg") * kRadians, 2e-8);
    for (const char* same : {"x_m", "y_m", "yaw_rad", "covariance_m_rad", "x_grid", "section"})
        EXPECT_EQ(ros.at(same), mm.at(same)) << same;
    for (const char* left_out : {"x_mm", "theta_deg", "sigma_x_mm", "x_sheet_mm"})
        EXPECT_FALSE(ros.contains(left_out)) << left_out;
    const Matrix flip = {{{1e-3, 0, 0}, {0, -1e-3, 0}, {0, 0, -kRadians}}};
    const Matrix expected = propagated(flip, matrix_of(mm["covariance_mm_deg"]));
    expect_equal(matrix_of(ros["covariance_pattern_m_rad"]), expected);
    expect_equal(matrix_of(ros["covariance_sheet_m_rad"]), expected);
}

TEST_F(OutputLines, OfATrackTurnOverOnlyWhereYPointsDown) {
    // Without sheets, the track is in pattern coordinates, with y down. With sheets, it is in world
    // coordinates, with y up.
    for (const std::string sheets : {"", " --sheets sheets.json"}) {
        const double sign = sheets.empty() ? -1 : 1;
        const std::string command = "watch frames --fps 200 --no-window" + sheets + " --units ";
        const json mm = lines(command + "mm").at(7);
        const json ros = lines(command + "ros").at(7);
        const auto expect = [&](const char* key, const char* key_mm, double factor) {
            EXPECT_NEAR(ros.at(key).get<double>(), factor * mm.at(key_mm).get<double>(), 1e-5)
                << key << sheets;
        };
        EXPECT_EQ(mm["plane"], sheets.empty() ? "pattern" : "world");
        expect("track_x_m", "track_x_mm", 1e-3);
        expect("track_y_m", "track_y_mm", sign * 1e-3);
        expect("track_yaw_rad", "track_theta_deg", sign * kRadians);
        expect("vx_m_s", "vx_mm_s", 1e-3);
        expect("vy_m_s", "vy_mm_s", sign * 1e-3);
        expect("turn_rad_s", "turn_deg_s", sign * kRadians);
        expect("sigma_v_m_s", "sigma_v_mm_s", 1e-3);
        EXPECT_GT(std::abs(ros["vy_m_s"].get<double>()), 0.02);
        const Matrix scale = {{{1e-3, 0, 0}, {0, sign * 1e-3, 0}, {0, 0, sign * kRadians}}};
        expect_equal(matrix_of(ros["track_covariance_m_rad"]),
                     propagated(scale, matrix_of(mm["track_covariance_mm_deg"])));
    }
}

TEST_F(OutputLines, OfADeviceHaveUnitsToo) {
    const json ros = lines("listen packets.bin --spacing 0.5 --units ros").at(0);
    EXPECT_DOUBLE_EQ(ros["x_pattern_m"], 0.5);
    EXPECT_DOUBLE_EQ(ros["y_pattern_m"], -1.0);
    EXPECT_NEAR(ros["yaw_pattern_rad"].get<double>(), -std::numbers::pi / 4, 1e-8);
    EXPECT_NEAR(ros["sigma_m"].get<double>(), 0.5e-3 * 8 / 4096, 1e-9);
}

TEST_F(OutputLines, OfALogAreInMmWhateverTheUnits) {
    ASSERT_EQ(run("watch frames --fps 200 --no-window --units ros --log run.csv"), 0);
    EXPECT_THAT(lines_of(file("run.csv")).front(), HasSubstr(",track_x_mm,"));
    EXPECT_EQ(run("replay run.csv"), 0) << errors_;
}

}  // namespace
}  // namespace dotpose::test
