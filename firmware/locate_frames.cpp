#include "locate_frames.hpp"

#include <array>
#include <cstdint>

#include "host.hpp"
#include "markers.hpp"
#include "number.hpp"

// Maximum frame size, which determines the size of the memory.
#ifndef DOTPOSE_FRAME_WIDTH_PX
#define DOTPOSE_FRAME_WIDTH_PX 188
#define DOTPOSE_FRAME_HEIGHT_PX 120
#endif
#define DOTPOSE_TEXT_OF(number) #number
#define DOTPOSE_TEXT(number) DOTPOSE_TEXT_OF(number)

namespace {

using namespace dotpose;

constexpr int kMaxWidth_px = DOTPOSE_FRAME_WIDTH_PX;
constexpr int kMaxHeight_px = 9999;
constexpr bool kNeedsSheet = kMaxWidth_px < kMinFrameSide_px;
/// The known sheet: an A4 page with a spacing of 0.508 mm. Stored in flash memory.
constexpr KnownRegion kSheets[] = {
    {.section = {}, .first = {1024, 1024}, .columns = 393, .rows = 564}};

DeviceMemoryFor<DOTPOSE_FRAME_WIDTH_PX, DOTPOSE_FRAME_HEIGHT_PX> memory;
DeviceLocator locator(memory, program_options());
// One row of a frame. It is aligned to a word because aligned rows are copied faster. Rows that a
// camera writes by DMA are aligned in the same way.
alignas(4) std::array<std::uint8_t, kMaxWidth_px> row;

struct FrameHeader {
    int width_px = 0;
    int height_px = 0;
    bool is_predicted = false;
    Prediction prediction;
};

/// Reads the next number in a header, and the character that follows the number. Returns false if
/// there is no number, if its absolute value exceeds INT32_MAX, or if the character is neither a
/// space nor a newline.
bool read_number(std::int32_t& number) {
    char byte = 0;
    do {
        if (!host::read(&byte, 1)) return false;
    } while (byte == ' ' || byte == '\n');
    const bool is_negative = byte == '-';
    if (is_negative && !host::read(&byte, 1)) return false;
    std::uint32_t magnitude = 0;
    while (byte >= '0' && byte <= '9' && magnitude <= INT32_MAX / 10) {
        magnitude = 10 * magnitude + static_cast<std::uint32_t>(byte - '0');
        if (!host::read(&byte, 1)) return false;
    }
    number = static_cast<std::int32_t>(is_negative ? 0 - magnitude : magnitude);
    return magnitude <= INT32_MAX && (byte == ' ' || byte == '\n');
}

template <typename Int>
bool read_into(Int& value) {
    std::int32_t number = 0;
    if (!read_number(number)) return false;
    value = static_cast<Int>(number);
    return true;
}

/// Reads the numbers of a prediction that follow the letter T. Returns false if a number is
/// invalid.
bool read_prediction(Prediction& prediction) {
    Place& place = prediction.place;
    PlaneFromImage& plane = prediction.pattern_from_image;
    return read_into(place.cell.x) && read_into(place.cell.y) && read_into(place.section.u) &&
           read_into(place.section.v) && read_into(plane.centre_q8.x) &&
           read_into(plane.centre_q8.y) && read_into(plane.at_centre_q16.x) &&
           read_into(plane.at_centre_q16.y) && read_into(plane.du_q24.x) &&
           read_into(plane.du_q24.y) && read_into(plane.dv_q24.x) && read_into(plane.dv_q24.y) &&
           read_into(prediction.displacement_q16);
}

enum class Header { frame, end, bad };

Header read_header(FrameHeader& header) {
    header = {};
    std::array<char, 2> magic;
    if (!host::read(magic.data(), 1)) return Header::end;
    header.is_predicted = magic[0] == 'T';
    if (header.is_predicted &&
        (!read_prediction(header.prediction) || !host::read(magic.data(), 1)))
        return Header::bad;
    if (!host::read(&magic[1], 1) || magic[0] != 'P' || magic[1] != '5') return Header::bad;
    int most = 0;
    const bool is_8_bit =
        read_into(header.width_px) && read_into(header.height_px) && read_into(most) && most == 255;
    const bool has_room = header.width_px > 0 && header.width_px <= kMaxWidth_px &&
                          header.height_px >= 0 && header.height_px <= kMaxHeight_px;
    return is_8_bit && has_room ? Header::frame : Header::bad;
}

Status begin_frame(const FrameHeader& frame) {
    return frame.is_predicted ? locator.begin(frame.width_px, frame.height_px, frame.prediction)
                              : locator.begin(frame.width_px, frame.height_px);
}

/// Reads the rows of a frame and locates the frame. Returns false if the file ends before the end
/// of the frame.
bool locate_frame(const FrameHeader& frame, Fix& fix) {
    markers::resume();
    const Status status = begin_frame(frame);
    markers::pause();
    for (int v = 0; v < frame.height_px; ++v) {
        if (!host::read(row.data(), static_cast<std::size_t>(frame.width_px))) return false;
        if (status != Status::ok) continue;
        markers::resume();
        locator.push_row(row.data());
        markers::pause();
    }
    markers::resume();
    fix = locator.finish();
    markers::pause();
    markers::end_frame();
    return true;
}

void print_fix(const Fix& fix) {
    host::print(name(fix.status));
    print_number(fix.cell.x);
    print_number(fix.cell.y);
    for (const std::int32_t number :
         {std::int32_t{fix.fraction_x_q16}, std::int32_t{fix.fraction_y_q16}, fix.theta_bam,
          std::int32_t{fix.section.u}, std::int32_t{fix.section.v}, fix.spacing_px_q16,
          std::int32_t{fix.dots_seen}, std::int32_t{fix.dots_used}, std::int32_t{fix.bit_errors},
          std::int32_t{fix.p_wrong_log2}}) {
        print_number(number);
    }
    host::print("\n");
}

}  // namespace

DeviceOptions program_options() {
    DeviceOptions options;
    if (kNeedsSheet) options.blobs.min_area_px = 1;
    return options;
}

void set_known_sheet(DeviceLocator& to) {
    if constexpr (kNeedsSheet) static_cast<void>(to.set_known(kSheets, OtherSheets::impossible));
}

int locate_frames(const char* path) {
    set_known_sheet(locator);
    if (!host::open(path)) {
        host::print("cannot open the frames\n");
        return 1;
    }
    FrameHeader frame;
    Header header = Header::end;
    while ((header = read_header(frame)) == Header::frame) {
        Fix fix;
        if (!locate_frame(frame, fix)) {
            host::print("the file ends within a frame\n");
            return 1;
        }
        print_fix(fix);
    }
    if (header == Header::bad) {
        host::print("not a binary PGM of 8 bits, at most " DOTPOSE_TEXT(
            DOTPOSE_FRAME_WIDTH_PX) " px wide\n");
    }
    return header == Header::end ? 0 : 1;
}
