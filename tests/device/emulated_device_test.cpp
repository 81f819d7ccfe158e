// Runs the device program from embedded/ in an emulator, with the frames of a simulated drive.
// `dotpose listen` receives the packets. They must be bit-identical to the packets of the desktop
// program, and their poses must be close to those of a `DeviceLocator` without predictions. All
// frames must be on time, and no frame may be lost.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pty.h>
#include <unistd.h>

#include "board.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/pose_packet.hpp"
#include "dotpose/tools/simulate.hpp"
#include "paths.hpp"
#include "pose_sender.hpp"
#include "shell.hpp"
#include "temporary_directory.hpp"

namespace {

using namespace dotpose;
using nlohmann::json;

constexpr std::int64_t kFrameTime_us = 20'000;
constexpr double kFps = 50;
constexpr double kSpacing_mm = 0.508;

/// The robot rests until kStart_s, drives about half a circle at up to 170 mm/s until kStop_s, and
/// rests again until kEnd_s. The second rest is long enough for the pacer to reduce the rate to one
/// frame per second.
constexpr double kStart_s = 0.2;
constexpr double kStop_s = 2.2;
constexpr double kEnd_s = 10;
constexpr double kRadius_mm = 60;

/// Returns the position on the circle as an angle in rad. The motion starts and ends smoothly.
double angle_at(double t_s) {
    const double u = std::clamp((t_s - kStart_s) / (kStop_s - kStart_s), 0.0, 1.0);
    return 3.0 * u * u * u * (10 - 15 * u + 6 * u * u);
}

CameraPose pose_at(double t_s) {
    const double angle = angle_at(t_s);
    const double x = 1'000'000 + kRadius_mm / kSpacing_mm * std::cos(angle);
    const double y = 2'000'000 + kRadius_mm / kSpacing_mm * std::sin(angle);
    CameraPose pose;
    pose.cell = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
    pose.fraction_x = x - std::floor(x);
    pose.fraction_y = y - std::floor(y);
    pose.theta_rad = angle - 2;
    return pose;
}

/// Returns the frames of the drive. All frames of the second rest are identical.
std::vector<GreyImage> drive() {
    Setup setup;
    setup.seed = 27;
    Shot shot = draw_shot(setup, 0);
    std::vector<GreyImage> frames;
    for (int i = 0; i < kEnd_s * kFps; ++i) {
        const double t_s = i / kFps;
        if (t_s > kStop_s + 0.1) {
            frames.push_back(frames.back());
            continue;
        }
        shot.pose = pose_at(t_s);
        shot.seed = static_cast<std::uint64_t>(i);
        frames.push_back(render(shot));
    }
    return frames;
}

// The simulated board on which the desktop program runs. Its camera delivers the frames, and its
// serial line stores all bytes.
struct EndOfFrames {};
std::vector<GreyImage> camera;
std::string line;
std::size_t frame = 0;
int row = 0;

}  // namespace

namespace board {

Frame start_frame(std::int64_t not_before_us) {
    while (static_cast<std::int64_t>(frame) * kFrameTime_us < not_before_us)
        ++frame;
    if (frame >= camera.size()) throw EndOfFrames{};
    row = 0;
    const GreyImage& image = camera[frame++];
    return {image.width_px, image.height_px, static_cast<std::int64_t>(frame - 1) * kFrameTime_us};
}

const std::uint8_t* next_row() {
    return camera[frame - 1].view().row(row++);
}

void send(const std::uint8_t* bytes, std::size_t count) {
    line.append(bytes, bytes + count);
}

}  // namespace board

namespace {

class EmulatedDevice : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        camera = drive();
        run_on_desktop();
    }

    static void run_on_desktop() {
        frame = 0;
        line.clear();
        PoseSender sender;
        try {
            for (;;)
                sender.send_next();
        } catch (const EndOfFrames&) {
        }
    }

    std::string text_of(const char* name) const {
        std::ifstream in(directory_.path() / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    /// Runs the emulator with its serial line connected to a terminal. `dotpose listen` reads this
    /// terminal. Returns the exit code of the emulator.
    int emulate() const {
        std::ofstream out(directory_.path() / "drive.frames", std::ios::binary);
        for (const GreyImage& image : camera) {
            out << "P5\n" << image.width_px << ' ' << image.height_px << "\n255\n";
            out.write(reinterpret_cast<const char*>(image.pixels.data()),
                      static_cast<std::streamsize>(image.pixels.size()));
        }
        out.close();
        const SerialLine serial;
        // Waits until `listen` has configured the terminal, because an unconfigured terminal alters
        // bytes. At the end, waits until all packets have arrived, because interrupting `listen`
        // earlier would lose the bytes in transit.
        const std::string commands =
            "cd " + directory_.path().string() + "; " + test::tool_path() + " listen " +
            serial.name() +
            " -o lines 2>losses & listener=$!;"
            " wait_for() { n=0; until eval \"$1\" || [ $((n+=1)) -gt 300 ]; do sleep 0.1; done; };"
            " wait_for 'stty -F " +
            serial.name() +
            " -a | grep -q -- -icanon';"
            " { " DOTPOSE_EMULATE " drive.frames 2>said; echo $? >code; } | tee packets >&" +
            std::to_string(SerialLine::kDescriptor) +
            "; wait_for '[ $(cat code) != 0 ] || [ $(wc -l <lines) -ge " +
            std::to_string(packets_sent()) + " ]'; kill -INT $listener; wait $listener";
        EXPECT_EQ(test::run_shell(commands).exit_code, 0);
        return std::stoi(text_of("code"));
    }

  private:
    /// A pseudo-terminal. Bytes written to kDescriptor can be read from the terminal `name`.
    class SerialLine {
      public:
        /// Must be a single digit, because shells do not support larger descriptors.
        static constexpr int kDescriptor = 9;
        SerialLine() {
            int master = -1;
            std::array<char, 256> name{};
            if (openpty(&master, &terminal_, name.data(), nullptr, nullptr) != 0 ||
                dup2(master, kDescriptor) < 0) {
                throw std::system_error(errno, std::generic_category(), "no pseudo-terminal");
            }
            close(master);
            name_ = name.data();
        }
        ~SerialLine() {
            close(kDescriptor);
            close(terminal_);
        }
        SerialLine(const SerialLine&) = delete;
        SerialLine& operator=(const SerialLine&) = delete;
        const std::string& name() const { return name_; }

      private:
        int terminal_ = -1;
        std::string name_;
    };

    static int packets_sent() {
        PacketReader reader;
        return static_cast<int>(std::ranges::count_if(
            line, [&reader](char byte) { return reader.push(static_cast<std::uint8_t>(byte)); }));
    }

    test::TemporaryDirectory directory_;
};

/// Tests the packets of the desktop program. The next test requires the emulator to send the same
/// packets.
TEST_F(EmulatedDevice, FollowsTheDriveAndSlowsDownAtRest) {
    PacketReader reader;
    DeviceMemory memory;
    DeviceLocator alone(memory);
    std::vector<std::int64_t> times_us;
    bool is_missed = false;
    int missed = 0;
    for (const char byte : line) {
        if (!reader.push(static_cast<std::uint8_t>(byte))) continue;
        const PosePacket& packet = reader.packet();
        ASSERT_EQ(packet.sequence, times_us.size());
        times_us.push_back(packet.time_us);
        const bool was_missed = is_missed;
        is_missed = packet.status != Status::ok;
        if (is_missed) {
            // The rows of a frame that is not tracked have been discarded, so only the next frame
            // can be located without a prediction.
            EXPECT_EQ(packet.status, Status::not_tracked);
            EXPECT_FALSE(was_missed) << packet.time_us;
            ++missed;
            continue;
        }
        const CameraPose truth = pose_at(packet.time_us / 1e6);
        EXPECT_NEAR(packet.x_grid(), x_grid(truth), 0.012) << packet.time_us;
        EXPECT_NEAR(packet.y_grid(), y_grid(truth), 0.012) << packet.time_us;
        // A `DeviceLocator` without a prediction must give nearly the same pose.
        const Fix fix =
            alone.locate(camera[static_cast<std::size_t>(packet.time_us / kFrameTime_us)].view());
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_NEAR(packet.x_grid(), fix.x_grid(), 0.012) << packet.time_us;
        EXPECT_NEAR(packet.y_grid(), fix.y_grid(), 0.012) << packet.time_us;
    }
    EXPECT_EQ(reader.damaged(), 0U);
    // Tracking may fail in at most 1 % of about 300 frames.
    EXPECT_LE(missed, 3);
    ASSERT_GT(times_us.size(), 300U);
    // During the drive and for 5 s after it, every frame is processed. After that, one frame per
    // second is processed.
    for (std::size_t i = 0; i < 300; ++i)
        ASSERT_EQ(times_us[i], static_cast<std::int64_t>(i) * kFrameTime_us);
    EXPECT_EQ(times_us.back() - times_us[times_us.size() - 2], 1'000'000);
}

TEST_F(EmulatedDevice, SendsTheSameToTheBitAndNothingIsLost) {
    const int code = emulate();
    if (code == 77) GTEST_SKIP() << text_of("said");
    ASSERT_EQ(code, 0) << text_of("said");
    EXPECT_TRUE(text_of("packets") == line);
    EXPECT_EQ(text_of("losses"), "");
    EXPECT_THAT(text_of("said"), testing::MatchesRegex("stack [0-9]+ bytes\n"));

    std::istringstream lines(text_of("lines"));
    std::size_t count = 0;
    std::string text;
    PacketReader sent;
    for (const char byte : line) {
        if (!sent.push(static_cast<std::uint8_t>(byte))) continue;
        ASSERT_TRUE(std::getline(lines, text)) << count;
        const json got = json::parse(text);
        EXPECT_EQ(got.at("sequence"), count++);
        EXPECT_EQ(got.at("time_us"), sent.packet().time_us);
        EXPECT_EQ(got.at("status"), name(sent.packet().status));
        if (sent.packet().status != Status::ok) continue;
        const CameraPose truth = pose_at(sent.packet().time_us / 1e6);
        EXPECT_NEAR(got.at("x_mm"), x_grid(truth) * kSpacing_mm, 0.006);
        EXPECT_NEAR(got.at("y_mm"), y_grid(truth) * kSpacing_mm, 0.006);
        EXPECT_NEAR(
            std::remainder(
                got.at("theta_deg").get<double>() - truth.theta_rad * 180 / 3.14159265358979, 360),
            0, 0.2);
    }
    EXPECT_FALSE(std::getline(lines, text)) << "more lines than packets";
}

}  // namespace
