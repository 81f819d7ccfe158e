// Tests that `dotpose listen` produces the same log and the same states from the packets of a
// device as `dotpose watch` produces from the frames.
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../drive.hpp"
#include "dotpose/pose_packet.hpp"
#include "dotpose/tools/image_file.hpp"
#include "mqtt_fixture.hpp"
#include "watched_fleet.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

class ListenFleet : public Mqtt {
  protected:
    /// Writes packets.bin and watch.csv for a drive over two sheets, and the sheet file table.json.
    void watch_drive(int frames) {
        const DriveCamera camera(188, 120);
        const Drive drive;
        for (int i = 0; i < frames; ++i) {
            write_pgm(directory_ / fmt::format("f{}.pgm", 100 + i),
                      camera.frame(drive, 240 + i).view());
        }
        save_drive_sheets(directory_ / "table.json");
        ASSERT_EQ(run("watch 'f*.pgm' --fps 100 --sheets table.json --packets packets.bin --log "
                      "watch.csv -o /dev/null"),
                  0)
            << errors_;
    }
    /// Returns the rows of a CSV file. Each row maps column names to cells.
    std::vector<std::map<std::string, std::string>> rows(const std::string& name) const {
        std::istringstream lines(file(name));
        std::vector<std::string> columns;
        std::vector<std::map<std::string, std::string>> rows;
        for (std::string line; std::getline(lines, line);) {
            std::istringstream cells(line);
            std::vector<std::string> row;
            for (std::string cell; std::getline(cells, cell, ',');)
                row.push_back(cell);
            if (columns.empty()) {
                columns = row;
                continue;
            }
            auto& cells_of = rows.emplace_back();
            for (std::size_t i = 0; i < row.size(); ++i)
                cells_of[columns[i]] = row[i];
        }
        return rows;
    }
};

TEST_F(ListenFleet, TheLogIsThatOfWatch) {
    watch_drive(40);
    ASSERT_EQ(run("listen packets.bin --sheets table.json --log listen.csv"), 0) << errors_;
    EXPECT_EQ(errors_, "");
    std::istringstream lines(output_);
    std::string first;
    std::getline(lines, first);
    const auto line = nlohmann::json::parse(first);
    EXPECT_EQ(line["sheet"], "left");
    EXPECT_TRUE(line.contains("x_sheet_mm"));
    EXPECT_TRUE(line.contains("x_m"));
    EXPECT_FALSE(line.contains("covariance_sheet_mm_deg"));

    auto watched = rows("watch.csv");
    auto listened = rows("listen.csv");
    ASSERT_EQ(watched.size(), 40U);
    ASSERT_EQ(listened.size(), 40U);
    const auto difference = [&](std::size_t i, const char* column) {
        return std::abs(std::stod(watched[i][column]) - std::stod(listened[i][column]));
    };
    for (std::size_t i = 0; i < watched.size(); ++i) {
        for (const char* column : {"sheet", "state", "plane", "status"})
            EXPECT_EQ(watched[i][column], listened[i][column]) << i << column;
        // Poses in packets have a resolution of 1/65536 spacing (8 nm) and 0.0055 degrees.
        EXPECT_LT(difference(i, "x_sheet_mm"), 1e-4);
        EXPECT_LT(difference(i, "theta_sheet_deg"), 0.006);
        EXPECT_LT(difference(i, "track_x_mm"), 0.005);
        EXPECT_LT(difference(i, "t_s"), 1e-9);
    }
    EXPECT_LT(difference(39, "vx_mm_s"), 5);
    EXPECT_EQ(run("replay listen.csv"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("40"));
}

TEST_F(ListenFleet, ADeviceJoinsTheFleet) {
    const Broker broker(directory_);
    watch_drive(30);
    WatchedFleet fleet(directory_,
                       "--qos 1 --sheets table.json --log log.csv --mqtt " + broker.url());
    ASSERT_EQ(
        run("listen packets.bin --sheets table.json --robot m0 --qos 1 --mqtt " + broker.url()), 0)
        << errors_;
    EXPECT_THAT(errors_, HasSubstr("30 states published, 0 dropped"));
    EXPECT_EQ(std::ranges::count(output_, '\n'), 30);
    wait_until([&] { return std::ranges::count(file("log.csv"), '\n') == 31; });
    const std::string table = fleet.table();
    EXPECT_THAT(table, HasSubstr("\nm0               gone  "));
    EXPECT_THAT(table, HasSubstr("disconnected, table/left\n"));
    EXPECT_THAT(table, HasSubstr("1 robots, 30 states, 0 bad, 0 missed"));
}

TEST_F(ListenFleet, ClocksThatWrapAndDevicesThatRestart) {
    PosePacket packet;
    packet.status = Status::ok;
    packet.cell = {1000, 2000};
    packet.section = {3, 4};
    packet.certainty = 40;
    packet.deviation_q12 = 8;
    std::string bytes;
    const auto send = [&](std::uint16_t sequence, std::uint32_t time_us) {
        packet.sequence = sequence;
        packet.time_us = time_us;
        const PacketBytes encoded = encode(packet);
        bytes.append(encoded.begin(), encoded.end());
    };
    send(65535, 4294957296);  // 10 ms before the clock wraps around
    send(0, 10'000);
    send(0, 10'000);          // repeated
    send(65535, 4294957296);  // late
    send(1, 30'000);
    send(60'000, 5'000);  // restarted
    send(60'001, 25'000);
    std::ofstream(directory_ / "packets.bin", std::ios::binary) << bytes;
    ASSERT_EQ(run("listen packets.bin --log log.csv"), 0) << errors_;
    EXPECT_EQ(std::ranges::count(output_, '\n'), 7);
    std::vector<std::string> times;
    for (auto& row : rows("log.csv"))
        times.push_back(row["t_s"]);
    EXPECT_THAT(times,
                testing::ElementsAre("0.000000", "0.020000", "0.040000", "1.040000", "1.060000"));
}

TEST_F(ListenFleet, AStatusOfANewerVersionIsReportedAsOther) {
    const Broker broker(directory_);
    std::string bytes;
    for (std::uint16_t i = 0; i < 3; ++i) {
        PosePacket packet;
        packet.status = Status::other;
        packet.sequence = i;
        packet.time_us = i * 1'100'000U;
        const PacketBytes encoded = encode(packet);
        bytes.append(encoded.begin(), encoded.end());
    }
    std::ofstream(directory_ / "packets.bin", std::ios::binary) << bytes;
    WatchedFleet fleet(directory_, "--qos 1 --metrics fleet.prom --mqtt " + broker.url());
    ASSERT_EQ(run("listen packets.bin --robot m0 --qos 1 --mqtt " + broker.url()), 0) << errors_;
    // The fleet starts counting at the first report from the camera. The second report contains one
    // refused frame more than the first report, so the count is 1.
    wait_until([&] {
        return file("fleet.prom").find("refused_frames_total{reason=\"other\"} 1\n") !=
               std::string::npos;
    });
    EXPECT_THAT(fleet.table(), HasSubstr("\nm0               gone  "));
}

TEST_F(ListenFleet, RefusesWhatDoesNotFit) {
    std::ofstream(directory_ / "packets.bin") << "";
    EXPECT_EQ(run("listen packets.bin --sheets none.json"), 1);
    EXPECT_EQ(run("listen packets.bin --sheets none.json --spacing 0.5"), 2);
    EXPECT_EQ(run("listen packets.bin --log packets.bin"), 2);
    EXPECT_EQ(run("listen packets.bin --web nonsense"), 2);
    EXPECT_EQ(run("listen packets.bin --mqtt nonsense"), 2);
    EXPECT_THAT(errors_, HasSubstr("'nonsense' is not mqtt://HOST or mqtts://HOST"));
}

}  // namespace
}  // namespace dotpose::test
