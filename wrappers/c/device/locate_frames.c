/* Locates frames as a microcontroller does: with a fixed amount of memory, and row by row. The
 * input is a file of golden frames (wrappers/golden/README.md). Locates the first frame of each
 * pair and prints its golden line for `device`. This line must equal the line that the C++ library
 * writes. */
#include <dotpose.h>
#include <stdint.h>
#include <string.h>

#include "../../golden/columns.h"
#include "host.h"

enum { MAX_WIDTH_PX = 188 };

static uint64_t memory[DOTPOSE_DEVICE_BYTES / 8];
static uint8_t row[MAX_WIDTH_PX];
static dotpose_fix fix;

static void print_unsigned(uint32_t value) {
    char text[11];
    char* digit = text + sizeof text - 1;
    *digit = 0;
    do {
        *--digit = (char)('0' + value % 10);
        value /= 10;
    } while (value != 0);
    host_print(digit);
}

static void print_signed(int32_t value) {
    if (value < 0) host_print("-");
    print_unsigned(value < 0 ? 0u - (uint32_t)value : (uint32_t)value);
}

/* Prints the bits of a 4-byte or 8-byte number in hexadecimal, most significant digit first. */
static void print_bits(const void* number, size_t size) {
    uint8_t bytes[8];
    char text[17];
    char* digit = text;
    memcpy(bytes, number, size);
    while (size-- > 0) {
        *digit++ = "0123456789abcdef"[bytes[size] >> 4];
        *digit++ = "0123456789abcdef"[bytes[size] & 15];
    }
    *digit = 0;
    host_print(",");
    host_print(text);
}

/* Prints the number at an address. `kind` is the type of its golden column: i, u, f or d. */
static void print_number(char kind, const uint8_t* at) {
    uint32_t value = 0;
    memcpy(&value, at, sizeof value);
    if (kind == 'f' || kind == 'd') {
        print_bits(at, kind == 'd' ? 8 : 4);
        return;
    }
    host_print(",");
    if (kind == 'i')
        print_signed((int32_t)value);
    else
        print_unsigned(value);
}

static void print_fix(uint32_t index) {
    const size_t count = sizeof golden_columns / sizeof golden_columns[0];
    size_t i = 0;
    size_t n = 0;
    print_unsigned(index);
    host_print(",device");
    print_number('i', (const uint8_t*)&fix.status);
    print_number('i', (const uint8_t*)&fix.dots_seen);
    for (i = 0; i < count && fix.status == DOTPOSE_OK; ++i) {
        const golden_column column = golden_columns[i];
        const size_t size = column.kind == 'd' ? 8 : 4;
        for (n = 0; n < column.count; ++n)
            print_number(column.kind, (const uint8_t*)&fix + column.offset + n * size);
    }
    host_print("\n");
}

/* Reads a number and the byte after it. Returns -1 at the end of the file. */
static int32_t read_number(void) {
    int32_t number = 0;
    char byte = 0;
    if (!host_read(&byte, 1)) return -1;
    while (byte >= '0' && byte <= '9' && number < 10000) {
        number = 10 * number + (byte - '0');
        if (!host_read(&byte, 1)) return -1;
    }
    return number;
}

/* Reads a frame row by row, and locates it if `locator` is not null. Returns 0 at the end of the
 * file. */
static int read_frame(dotpose_locator* locator) {
    char magic[3];
    int32_t width_px = 0;
    int32_t height_px = 0;
    int32_t v = 0;
    if (!host_read(magic, sizeof magic)) return 0;
    width_px = read_number();
    height_px = read_number();
    if (read_number() != 255 || width_px < 1 || width_px > MAX_WIDTH_PX) return 0;
    if (locator != NULL) dotpose_begin(locator, width_px, height_px, NULL);
    for (v = 0; v < height_px; ++v) {
        if (!host_read(row, (size_t)width_px)) return 0;
        if (locator != NULL) dotpose_push_row(locator, row);
    }
    if (locator != NULL) dotpose_finish(locator, &fix);
    return 1;
}

int locate_frames(const char* path) {
    dotpose_locator* locator = NULL;
    const dotpose_status status = dotpose_device_init(memory, sizeof memory, NULL, &locator);
    uint32_t index = 0;
    dotpose_fix_init(&fix, sizeof fix);
    if (status != DOTPOSE_OK || !host_open(path)) {
        host_print(status != DOTPOSE_OK ? dotpose_status_message(status) : "no file of frames");
        host_print("\n");
        return 1;
    }
    for (index = 0; read_frame(locator); ++index) {
        print_fix(index);
        if (!read_frame(NULL)) return 1;
    }
    return 0;
}
