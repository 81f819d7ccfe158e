// Tests `dotpose listen` with packets from a file, a pipe and a serial device.
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <stdlib.h>
#include <unistd.h>

#include "dotpose/pose_packet.hpp"
#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

PosePacket packet_at(std::uint16_t sequence, std::uint32_t x) {
    PosePacket packet;
    packet.sequence = sequence;
    packet.time_us = sequence * 20'000U;
    packet.status = Status::ok;
    packet.cell = {x, 2000};
    packet.fraction_x_q16 = 0x4000;
    packet.theta_bam16 = 0x2000;
    packet.section = {3, 4};
    packet.certainty = 40;
    packet.deviation_q12 = 8;
    return packet;
}

std::string on_the_line(const PosePacket& packet) {
    const PacketBytes bytes = encode(packet);
    return {bytes.begin(), bytes.end()};
}

class Listen : public ToolCommand {
  protected:
    void put(const std::string& bytes) {
        std::ofstream(directory_ / "packets.bin", std::ios::binary) << bytes;
    }
    std::vector<json> lines() const {
        std::vector<json> lines;
        std::istringstream stream(output_);
        for (std::string line; std::getline(stream, line);)
            lines.push_back(json::parse(line));
        return lines;
    }
};

TEST_F(Listen, CountsAPacketThatComesTwiceAsNoLoss) {
    put(on_the_line(packet_at(7, 1000)) + on_the_line(packet_at(7, 1000)) +
        on_the_line(packet_at(8, 1000)) + on_the_line(packet_at(7, 1000)) +
        on_the_line(packet_at(11, 1000)));
    ASSERT_EQ(run("listen packets.bin"), 0);
    EXPECT_THAT(errors_, HasSubstr("5 packets, 0 stretches damaged, 2 packets lost"));
}

TEST_F(Listen, PrintsAPacketAsALine) {
    put(on_the_line(packet_at(7, 1000)));
    ASSERT_EQ(run("listen packets.bin --spacing 0.5"), 0);
    EXPECT_EQ(errors_, "");
    ASSERT_EQ(lines().size(), 1U);
    const json line = lines()[0];
    EXPECT_EQ(line["sequence"], 7);
    EXPECT_EQ(line["time_us"], 140'000);
    EXPECT_EQ(line["status"], "ok");
    EXPECT_EQ(line["code"], "anoto");
    EXPECT_DOUBLE_EQ(line["x_mm"], 500.125);
    EXPECT_DOUBLE_EQ(line["y_mm"], 1000);
    EXPECT_DOUBLE_EQ(line["x_grid"], 1000.25);
    EXPECT_DOUBLE_EQ(line["theta_deg"], 45);
    EXPECT_EQ(line["section"], json::array({3, 4}));
    EXPECT_NEAR(line["p_wrong"], 9.1e-13, 0.1e-13);  // 2^-40
    EXPECT_NEAR(line["sigma_mm"], 0.000977, 1e-6);   // 8/4096 of a spacing of 0.5 mm
}

TEST_F(Listen, SaysWhyThereIsNoPose) {
    PosePacket packet;
    packet.status = Status::too_few_dots;
    put(on_the_line(packet));
    ASSERT_EQ(run("listen packets.bin"), 0);
    const json line = lines().at(0);
    EXPECT_EQ(line["status"], "too_few_dots");
    EXPECT_EQ(line["message"], message(Status::too_few_dots));
    EXPECT_FALSE(line.contains("x_mm"));
}

TEST_F(Listen, CountsDamagedAndLostPackets) {
    std::string damaged = on_the_line(packet_at(2, 2));
    damaged[5] ^= 4;
    put(std::string("half a packet") + '\0' + on_the_line(packet_at(1, 1)) + damaged +
        on_the_line(packet_at(3, 3)));
    ASSERT_EQ(run("listen - --format csv", (directory_ / "packets.bin").string()), 0);
    EXPECT_THAT(output_, HasSubstr("\n1,1,20000,ok,"));
    EXPECT_THAT(output_, HasSubstr("\n1,3,60000,ok,"));
    EXPECT_EQ(std::ranges::count(output_, '\n'), 3);
    EXPECT_EQ(errors_, "dotpose: 2 packets, 2 stretches damaged, 1 packets lost\n");
}

TEST_F(Listen, ReadsASerialDeviceUntilItGoes) {
    const int device = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(device, 0);
    ASSERT_EQ(grantpt(device), 0);
    ASSERT_EQ(unlockpt(device), 0);
    const std::string name = ptsname(device);
    std::string stream;
    // The packets contain bytes that a terminal would interpret as control characters.
    for (std::uint16_t i = 0; i < 50; ++i)
        stream += on_the_line(packet_at(i, 0x0D0A0304U));
    std::thread sender([&] {
        // Nothing reads the device before the tool has opened it, so the test waits until the
        // output file of the tool exists.
        while (!fs::exists(directory_ / "poses.jsonl"))
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        EXPECT_EQ(write(device, stream.data(), stream.size()), static_cast<ssize_t>(stream.size()));
        while (std::ranges::count(file("poses.jsonl"), '\n') < 50)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        close(device);
    });
    run("listen " + name + " --baud 921600 -o poses.jsonl");
    sender.join();
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(errors_, HasSubstr("cannot read " + name));
    const std::string poses = file("poses.jsonl");
    EXPECT_EQ(std::ranges::count(poses, '\n'), 50);
    EXPECT_THAT(poses, HasSubstr("\"x_grid\":218759940.25"));  // 0x0D0A0304
}

TEST_F(Listen, RefusesWhatItCannotRead) {
    EXPECT_EQ(run("listen nowhere"), 1);
    EXPECT_THAT(errors_, HasSubstr("cannot read nowhere: No such file"));
    EXPECT_EQ(run("listen x --baud 123"), 2);
    EXPECT_THAT(errors_, HasSubstr("--baud: 123 is not a usual rate"));
    EXPECT_EQ(run("listen"), 2);
}

}  // namespace
}  // namespace dotpose::test
