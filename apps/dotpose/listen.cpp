#include <algorithm>
#include <array>
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
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/pose_packet.hpp"
#include "fields.hpp"
#include "lines.hpp"
#include "mqtt_arguments.hpp"
#include "output_arguments.hpp"
#include "packet_fields.hpp"
#include "packet_follower.hpp"
#include "progress.hpp"
#include "reading_fields.hpp"
#include "reading_sink.hpp"
#include "run_files.hpp"
#include "system/files.hpp"
#include "system/path.hpp"
#include "system/process.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kListenExamples =
    "Examples:\n"
    "  dotpose listen /dev/ttyUSB0 --baud 115200\n"
    "  dotpose listen packets.bin --format csv -o poses.csv\n"
    "  nc robot 4000 | dotpose listen -\n"
    "  dotpose listen /dev/ttyUSB0 --sheets hall.json --mqtt mqtt://broker --robot anna\n"
    "  dotpose listen /dev/ttyUSB0 --sheets hall.json --web 8080\n\n"
    "One line per packet. Damaged packets are skipped; their number is printed on standard\n"
    "error at the end. docs/pose-packet.md describes the format.\n";

constexpr std::array kBauds = {9600,   19200,  38400,  57600,   115200,
                               230400, 460800, 921600, 1000000, 2000000};

struct ListenArguments {
    std::string source;
    LineArguments lines;
    double spacing_mm = kDefaultSpacing_mm;
    int baud = 115200;
    std::string sheets;
    std::string log;
    PublishArguments publish;
    PageArguments page;
};

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

    /// Reads at least one byte. Returns an empty span at the end of the input or after Ctrl-C.
    /// Throws Error if reading fails.
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

/// Counts received and lost packets for the final report.
class LossCounter {
  public:
    void count(const PosePacket& packet) {
        const int step = last_ ? packets_since(*last_, packet.sequence) : 1;
        if (step > 1) lost_ += static_cast<std::uint64_t>(step - 1);
        if (!is_late(step)) last_ = packet.sequence;
        ++arrived_;
    }
    void report(std::uint32_t damaged) const {
        if (arrived_ == 0 || damaged > 0 || lost_ > 0) {
            notify(fmt::format(
                "{} packets, {} stretches damaged, {} packets lost{}", arrived_, damaged, lost_,
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

using Sinks = std::vector<std::unique_ptr<ReadingSink>>;

/// Connects to the broker if --mqtt is given, and starts the web page if --web is given.
Sinks open_sinks(const ListenArguments& arguments) {
    Sinks sinks;
    sinks.push_back(open_publisher(arguments.publish, arguments.sheets));
    sinks.push_back(open_page(arguments.page, arguments.publish.robot, arguments.sheets));
    std::erase(sinks, nullptr);
    return sinks;
}

class ListenOutputs {
  public:
    ListenOutputs(const ListenArguments& arguments, Sinks sinks)
        : arguments_(arguments),
          follower_(sheets_of(arguments), arguments.spacing_mm),
          lines_(arguments.lines.out),
          sinks_(std::move(sinks)) {
        if (arguments.lines.format == RecordFormat::csv) {
            lines_.write(csv_header(fields_of({})));
        }
        if (arguments.log.empty()) return;
        log_.emplace(arguments.log);
        Record empty;
        empty.has_sheets = follower_.has_sheets();
        log_->write(csv_header_of_readings(empty, Units::mm));
    }

    void take(const PosePacket& packet) {
        lines_.write(line_of(fields_of(packet), arguments_.lines.format));
        losses_.count(packet);
        const auto reading = follower_.follow(packet);
        if (!reading) return;
        if (log_) log_->write(csv_line(fields(*reading, Units::mm)));
        for (const auto& sink : sinks_)
            sink->take(*reading);
    }

    void finish(std::uint32_t damaged) {
        losses_.report(damaged);
        for (const auto& sink : sinks_)
            sink->finish();
    }

  private:
    static std::vector<SheetEntry> sheets_of(const ListenArguments& arguments) {
        if (arguments.sheets.empty()) return {};
        std::vector<SheetEntry> sheets = read_sheets(system::path_of(arguments.sheets));
        if (sheets.empty()) throw Error(arguments.sheets + " has no sheets");
        return sheets;
    }
    std::vector<Field> fields_of(const PosePacket& packet) const {
        const Units units = arguments_.lines.units;
        const Record record = follower_.record_of(packet);
        std::vector<Field> all = fields(packet, record.spacing_mm, units);
        if (record.has_sheets) append(all, sheet_fields(record, units));
        return all;
    }

    const ListenArguments& arguments_;
    PacketFollower follower_;
    Lines lines_;
    std::optional<Lines> log_;
    Sinks sinks_;
    LossCounter losses_;
};

void run(const ListenArguments& arguments) {
    RunFiles files;
    files.reads("", arguments.source);
    files.reads("--sheets", arguments.sheets);
    files.reads("--mqtt-ca", arguments.publish.mqtt.ca_file);
    files.reads("--web-token-file", arguments.page.token_file);
    files.writes_lines(arguments.lines.out, content_of(arguments.lines.format));
    files.writes("--log", arguments.log, Content::csv);
    // Opens the sinks before all other outputs, because opening a sink may replace this process
    // with dotpose-live.
    Sinks sinks = open_sinks(arguments);
    catch_interrupts();
    ByteSource source(arguments);
    ListenOutputs outputs(arguments, std::move(sinks));
    PacketReader reader;
    for (auto bytes = source.next(); !bytes.empty(); bytes = source.next()) {
        for (const std::uint8_t byte : bytes) {
            if (reader.push(byte)) outputs.take(reader.packet());
        }
    }
    outputs.finish(reader.damaged());
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
    add_sheets_option(*command, arguments->sheets,
                      "Sheet file: also report the sheet, and track the robot in the world")
        ->excludes(command->get_option("--spacing"));
    command
        ->add_option("--log", arguments->log,
                     "Also write all packets as dotpose watch --log does, for dotpose replay")
        ->type_name("FILE");
    arguments->publish.add_to(*command, "Name of the robot on the broker");
    arguments->page.add_to(*command);
    add_line_options(*command, arguments->lines);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
