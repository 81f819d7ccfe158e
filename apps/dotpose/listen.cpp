#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/pose_packet.hpp"
#include "fields.hpp"
#include "lines.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kListenExamples =
    "Examples:\n"
    "  dotpose listen /dev/ttyUSB0 --baud 115200\n"
    "  dotpose listen packets.bin --format csv -o poses.csv\n"
    "  nc robot 4000 | dotpose listen -\n\n"
    "One line per packet. Damaged packets are skipped; their number is printed on standard\n"
    "error at the end. docs/pose-packet.md describes the format.\n";

struct Baud {
    int rate = 0;
    speed_t constant = 0;
};
constexpr std::array kBauds = {
    Baud{9600, B9600},       Baud{19200, B19200},     Baud{38400, B38400},   Baud{57600, B57600},
    Baud{115200, B115200},   Baud{230400, B230400},   Baud{460800, B460800}, Baud{921600, B921600},
    Baud{1000000, B1000000}, Baud{2000000, B2000000},
};

struct ListenArguments {
    std::string source;
    LineArguments lines;
    double spacing_mm = kDefaultSpacing_mm;
    Baud baud{115200, B115200};
};

/// Reads bytes from a file, a pipe or a serial device.
class ByteSource {
  public:
    explicit ByteSource(const ListenArguments& arguments) : name_(arguments.source) {
        if (name_ == "-") {
            name_ = "standard input";
            return;
        }
        descriptor_ = open(name_.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC);
        if (descriptor_ < 0) fail();
        is_line_ = isatty(descriptor_) == 1;
        if (is_line_) set_up_line(arguments.baud);
    }
    ~ByteSource() {
        if (descriptor_ != STDIN_FILENO) close(descriptor_);
    }
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;

    /// Returns at least one byte, or none at the end of the input or after Ctrl-C. Throws Error if
    /// reading fails.
    std::span<const std::uint8_t> next() {
        constexpr int kPatience_ms = 100;
        while (!interrupted()) {
            pollfd ready{descriptor_, POLLIN, 0};
            const int count = poll(&ready, 1, kPatience_ms);
            if (count < 0 && errno != EINTR) fail();
            if (count <= 0) continue;
            const ssize_t size = read(descriptor_, buffer_.data(), buffer_.size());
            if (size < 0 && errno != EINTR) fail();
            if (size == 0 && is_line_) throw Error("cannot read " + name_ + ": it is gone");
            if (size >= 0) return std::span(buffer_).first(static_cast<std::size_t>(size));
        }
        return {};
    }

  private:
    [[noreturn]] void fail() const {
        throw Error("cannot read " + name_ + ": " + std::strerror(errno));
    }
    void set_up_line(const Baud& baud) {
        termios line{};
        if (tcgetattr(descriptor_, &line) != 0) fail();
        cfmakeraw(&line);
        line.c_cflag |= CLOCAL | CREAD;
        cfsetispeed(&line, baud.constant);
        cfsetospeed(&line, baud.constant);
        if (tcsetattr(descriptor_, TCSANOW, &line) != 0) fail();
    }

    std::string name_;
    int descriptor_ = STDIN_FILENO;
    bool is_line_ = false;  ///< true for a serial device, which has no end
    std::array<std::uint8_t, 4096> buffer_{};
};

/// Returns the pose of a packet in the units and axes of `units`, or none if the packet has no fix.
std::optional<PlanePose> pose_of(const PosePacket& packet, double spacing_mm, Units units) {
    if (packet.status != Status::ok) return std::nullopt;
    const PlanePose pose{
        packet.x_grid() * spacing_mm, packet.y_grid() * spacing_mm, packet.theta_rad(), {}};
    return units == Units::ros ? with_other_y(pose) : pose;
}

/// Returns the field with the standard deviation of the position, the larger of the values along x
/// and y.
Field deviation_field(const PosePacket& packet, double spacing_mm, Units units) {
    const double sigma_mm = packet.deviation_q12 * spacing_mm / 4096;
    // 255 represents all larger deviations as well, so it is not reported.
    const bool is_known = packet.status == Status::ok && packet.deviation_q12 < 255;
    if (units == Units::ros) return {"sigma_m", is_known ? metres(sigma_mm) : ""};
    return {"sigma_mm", is_known ? decimal(sigma_mm, 6) : ""};
}

std::vector<Field> fields(const PosePacket& packet, double spacing_mm, Units units) {
    const bool ok = packet.status == Status::ok;
    const auto if_ok = [ok](std::string text) { return ok ? std::move(text) : std::string(); };
    const auto number = [](unsigned value) { return fmt::format("{}", value); };
    std::vector<Field> all = {
        {"schema", kSchemaVersion},
        {"sequence", number(packet.sequence)},
        {"time_us", number(packet.time_us)},
        {"status", name(packet.status), true},
        {"message", ok ? "" : message(packet.status), true},
        {"code", code_name(packet.code), true},
    };
    const std::vector<Field> evidence = {
        {"x_grid", if_ok(decimal(packet.x_grid(), 6))},
        {"y_grid", if_ok(decimal(packet.y_grid(), 6))},
        {"section_u", if_ok(number(packet.section.u)), false, "section"},
        {"section_v", if_ok(number(packet.section.v)), false, "section"},
        {"p_wrong", if_ok(p_wrong_text(std::ldexp(1.0, -packet.certainty)))},
        deviation_field(packet, spacing_mm, units),
    };
    append(all, pose_fields(pattern_names(units), units, pose_of(packet, spacing_mm, units)));
    append(all, evidence);
    return all;
}

/// Counts lost packets for the report at the end.
class LossCounter {
  public:
    void count(const PosePacket& packet) {
        // Maximum decrease of the sequence number for a repeated or late packet. A larger decrease
        // means that the device was restarted.
        constexpr int kMaxLate = 16;
        const int step = last_ ? static_cast<std::int16_t>(packet.sequence - *last_) : 1;
        if (step > 1) lost_ += static_cast<std::uint64_t>(step - 1);
        if (step > 0 || step < -kMaxLate) last_ = packet.sequence;
        ++arrived_;
    }
    void report(std::uint32_t damaged) const {
        if (arrived_ == 0 || damaged > 0 || lost_ > 0) {
            tell(fmt::format("{} packets, {} stretches damaged, {} packets lost{}", arrived_,
                             damaged, lost_,
                             arrived_ == 0 ? "; were the bytes sent by a device or 'dotpose watch "
                                             "--packets', and is --baud right?"
                                           : ""));
        }
    }

  private:
    std::optional<std::uint16_t> last_;
    std::uint64_t arrived_ = 0;
    std::uint64_t lost_ = 0;
};

void run(const ListenArguments& arguments) {
    RunFiles files;
    files.reads("", arguments.source);
    files.writes_lines(arguments.lines.out, content_of(arguments.lines.format));
    catch_interrupts();
    ByteSource source(arguments);
    Lines lines(arguments.lines.out);
    PacketReader reader;
    LossCounter losses;
    const auto [out, format, units] = arguments.lines;
    if (format == RecordFormat::csv) {
        lines.write(csv_header(fields({}, arguments.spacing_mm, units)));
    }
    for (auto bytes = source.next(); !bytes.empty(); bytes = source.next()) {
        for (const std::uint8_t byte : bytes) {
            if (!reader.push(byte)) continue;
            lines.write(line_of(fields(reader.packet(), arguments.spacing_mm, units), format));
            losses.count(reader.packet());
        }
    }
    losses.report(reader.damaged());
}

void add_baud_option(Command& command, Baud& baud) {
    command
        .add_option_function<int>(
            "--baud",
            [&baud](int rate) {
                for (const Baud& known : kBauds) {
                    if (rate == known.rate) {
                        baud = known;
                        return;
                    }
                }
                throw ValidationError(
                    "--baud",
                    fmt::format("{} is not a usual rate, such as 115200 or 921600", rate));
            },
            "Baud rate of a serial device")
        ->type_name("RATE")
        ->default_str(fmt::format("{}", baud.rate));
}

}  // namespace

void add_listen(Command& app, int&) {
    const auto arguments = std::make_shared<ListenArguments>();
    Command* command =
        app.add_subcommand("listen", "Print the poses that a device sends as packets");
    command->footer(kListenExamples);
    command->add_option("source", arguments->source, "Serial device, file, or - (standard input)")
        ->type_name("SOURCE")
        ->required();
    add_baud_option(*command, arguments->baud);
    add_spacing_option(*command, arguments->spacing_mm);
    add_line_options(*command, arguments->lines);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
