#include "locate_frames.hpp"

#include <array>
#include <cstdint>

#include <dotpose/locate.hpp>

#include "host.hpp"
#include "markers.hpp"
#include "number.hpp"

namespace {

using namespace dotpose;

constexpr int kMaxWidth_px = 188;

DeviceWorkspace workspace;
std::array<std::uint8_t, kMaxWidth_px> row;

constexpr Options kOptions = [] {
    Options options;
    options.effort = Effort::device;
    return options;
}();

struct FrameSize {
    int width_px = 0;
    int height_px = 0;
};

/// The next number of a header, and the one byte after it; -1 where there is none.
int read_number() {
    char byte = 0;
    do {
        if (!host::read(&byte, 1)) return -1;
    } while (byte == ' ' || byte == '\n');
    int number = 0;
    while (byte >= '0' && byte <= '9' && number < 10000) {
        number = 10 * number + (byte - '0');
        if (!host::read(&byte, 1)) return -1;
    }
    return byte == ' ' || byte == '\n' ? number : -1;
}

enum class Header { frame, end, bad };

Header read_header(FrameSize& size) {
    std::array<char, 2> magic;
    if (!host::read(magic.data(), 1)) return Header::end;
    if (!host::read(&magic[1], 1) || magic[0] != 'P' || magic[1] != '5') return Header::bad;
    size.width_px = read_number();
    size.height_px = read_number();
    const bool is_8_bit = read_number() == 255;
    const bool has_room = size.width_px > 0 && size.width_px <= kMaxWidth_px;
    return is_8_bit && has_room ? Header::frame : Header::bad;
}

/// False if the file ends within the frame.
bool locate_frame(FrameSize size) {
    markers::resume();
    const Status status = begin(size.width_px, size.height_px, kOptions, workspace);
    markers::pause();
    for (int v = 0; v < size.height_px; ++v) {
        if (!host::read(row.data(), static_cast<std::size_t>(size.width_px))) return false;
        if (status != Status::ok) continue;
        markers::resume();
        push_row(row.data(), kOptions, workspace);
        markers::pause();
    }
    if (status == Status::ok) {
        markers::resume();
        finish_device(kOptions, workspace);
        markers::pause();
    }
    markers::end_frame();
    return true;
}

void print_fix(const Fix& fix) {
    host::print(name(fix.status));
    for (const std::int64_t number :
         {std::int64_t{fix.cell.x}, std::int64_t{fix.cell.y}, std::int64_t{fix.fraction_x_q16},
          std::int64_t{fix.fraction_y_q16}, std::int64_t{fix.theta_bam},
          std::int64_t{fix.section.u}, std::int64_t{fix.section.v},
          std::int64_t{fix.spacing_px_q16}, std::int64_t{fix.dots_seen},
          std::int64_t{fix.dots_used}, std::int64_t{fix.bit_errors},
          std::int64_t{fix.p_wrong_log2}}) {
        print_number(number);
    }
    host::print("\n");
}

}  // namespace

int locate_frames(const char* path) {
    if (!host::open(path)) {
        host::print("cannot open the file of frames\n");
        return 1;
    }
    FrameSize size;
    Header header = Header::end;
    while ((header = read_header(size)) == Header::frame) {
        if (!locate_frame(size)) {
            host::print("the file ends within a frame\n");
            return 1;
        }
        print_fix(workspace.fix);
    }
    if (header == Header::bad) host::print("not a binary PGM of 8 bits, at most 188 px wide\n");
    return header == Header::end ? 0 : 1;
}
