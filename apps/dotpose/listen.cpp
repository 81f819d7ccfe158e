#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/core.h>

#include "byte_input.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/pose_packet.hpp"
#include "fields.hpp"
#include "lines.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "system/files.hpp"
#include "system/process.hpp"
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

constexpr std::array kBauds = {9600,   19200,  38400,  57600,   115200,
                               230400, 460800, 921600, 1000000, 2000000};

struct ListenArguments {
    std::string source;
    LineArguments lines;
    double spacing_mm = kDefaultSpacing_mm;
    int baud = 115200;
};

/// Reads bytes from a file, a pipe or a serial device.
class ByteSource {
  public:
    explicit ByteSource(const ListenArguments& arguments) : name_(arguments.source) {
        if (name_ == "-") {
            name_ = "standard input";
        } else {
            input_ = open_input(name_, arguments.baud);
        }
    }
    ~ByteSource() {
        if (input_.descriptor != kStandardInput) system::close_descriptor(input_.descriptor);
    }
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;

    /// Returns at least one byte, or none at the end of the input or after Ctrl-C. Throws Error if
    /// reading fails.
    std::span<const std::uint8_t> next() {
        while (!interrupted()) {
            const auto size = read();
            if (!size) continue;
            if (*size == 0 && input_.is_line) throw Error("cannot read " + name_ + ": it is gone");
            return std::span(buffer_).first(*size);
        }
        return {};
    }

  private:
    static constexpr int kStandardInput = 0;

    std::optional<std::size_t> read() {
        try {
            return system::read_available(input_.descriptor, buffer_.data(), buffer_.size());
        } catch (const std::system_error& error) {
            throw Error("cannot read " + name_ + ": " + error.code().message());
        }
    }

    std::string name_;
    ByteInput input_{kStandardInput, false};
    std::array<std::uint8_t, 4096> buffer_{};
};

/// Returns the pose of a packet in the units and axes of `units`, or none if the packet has no fix.
std::optional<PlanePose> pose_of(const PosePacket& packet, double spacing_mm, Units units) {
    if (packet.status != Status::ok) return std::nullopt;
    const PlanePose pose{
        packet.x_grid() * spacing_mm, packet.y_grid() * spacing_mm, packet.theta_rad(), {}};
    return units == Units::ros ? with_other_y(pose) : pose;
}

/// Returns the field with the standard deviation of the position: the larger of the standard
/// deviations along x and y.
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

void add_baud_option(Command& command, int& baud) {
    command
        .add_option_function<int>(
            "--baud",
            [&baud](int rate) {
                if (std::ranges::find(kBauds, rate) == kBauds.end()) {
                    throw ValidationError(
                        "--baud",
                        fmt::format("{} is not a usual rate, such as 115200 or 921600", rate));
                }
                baud = rate;
            },
            "Baud rate of a serial device")
        ->type_name("RATE")
        ->default_str(fmt::format("{}", baud));
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
