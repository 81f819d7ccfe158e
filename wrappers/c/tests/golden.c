/* Locates golden frames (wrappers/golden/README.md) through dotpose.h, and prints their golden
 * lines, which must equal those of the C++ library. Usage: golden FRAMES.frames [ROWS]. If ROWS is
 * given, frames are pushed row by row to the device locator. */
#include <dotpose.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../golden/columns.h"

typedef struct image {
    int width_px;
    int height_px;
    uint8_t* pixels;
} image;

static void fail(const char* what) {
    fprintf(stderr, "golden: %s\n", what);
    exit(2);
}

/* Reads the next image. Returns 0 at the end of the file. */
static int read_image(FILE* file, image* result) {
    size_t bytes = 0;
    if (fscanf(file, "P5 %4d %4d 255", &result->width_px, &result->height_px) != 2) return 0;
    bytes = (size_t)result->width_px * (size_t)result->height_px;
    result->pixels = realloc(result->pixels, bytes);
    if (fgetc(file) == EOF || fread(result->pixels, 1, bytes, file) != bytes)
        fail("the file ends within a frame");
    return 1;
}

/* Prints the number at an address. Floating-point numbers are printed as hexadecimal bit
 * patterns. */
static void print_number(char kind, const unsigned char* at) {
    int32_t integer = 0;
    uint32_t bits = 0;
    uint64_t bits_of_double = 0;
    memcpy(&integer, at, sizeof integer);
    memcpy(&bits, at, sizeof bits);
    if (kind == 'i') printf(",%" PRId32, integer);
    if (kind == 'u') printf(",%" PRIu32, bits);
    if (kind == 'f') printf(",%08" PRIx32, bits);
    if (kind != 'd') return;
    memcpy(&bits_of_double, at, sizeof bits_of_double);
    printf(",%016" PRIx64, bits_of_double);
}

static void print_fix(int index, const char* way, const dotpose_fix* fix) {
    const size_t count = sizeof golden_columns / sizeof golden_columns[0];
    size_t i = 0;
    size_t n = 0;
    printf("%d,%s,%" PRId32 ",%" PRId32, index, way, fix->status, fix->dots_seen);
    for (i = 0; i < count && fix->status == DOTPOSE_OK; ++i) {
        const golden_column column = golden_columns[i];
        const size_t size = column.kind == 'd' ? 8 : 4;
        for (n = 0; n < column.count; ++n)
            print_number(column.kind, (const unsigned char*)fix + column.offset + n * size);
    }
    printf("\n");
}

static void push_rows(dotpose_locator* locator, const image* frame, dotpose_fix* fix) {
    int v = 0;
    if (dotpose_begin(locator, frame->width_px, frame->height_px, NULL) != DOTPOSE_OK)
        fail("a frame cannot be begun");
    for (v = 0; v < frame->height_px; ++v) {
        if (dotpose_push_row(locator, frame->pixels + v * frame->width_px) != DOTPOSE_OK)
            fail("a row cannot be pushed");
    }
    dotpose_finish(locator, fix);
}

/* Prints the golden lines for a frame, one for each method. For the `tracked` method, locates the
 * next frame with a prediction from the fix of this frame. */
static void locate(int index, const image* frame, const image* next, dotpose_locator* large,
                   dotpose_locator* device, int by_rows) {
    const int width_px = frame->width_px;
    dotpose_options options;
    dotpose_prediction prediction;
    dotpose_fix fix;
    dotpose_fix_init(&fix, sizeof fix);
    dotpose_options_init(&options, sizeof options);
    options.code = DOTPOSE_CODE_ANOTO;
    dotpose_set_options(large, &options);
    dotpose_locate(large, frame->pixels, width_px, frame->height_px, width_px, NULL, &fix);
    print_fix(index, "locate", &fix);
    if (dotpose_prediction_like(&fix, &prediction) == DOTPOSE_OK) {
        dotpose_locate(large, next->pixels, width_px, next->height_px, width_px, &prediction, &fix);
        print_fix(index, "tracked", &fix);
    }
    dotpose_locate_any_code(large, frame->pixels, width_px, frame->height_px, width_px, NULL, NULL,
                            NULL, &fix);
    print_fix(index, "any_code", &fix);
    if (width_px > 188) return;
    if (by_rows)
        push_rows(device, frame, &fix);
    else
        dotpose_locate(device, frame->pixels, width_px, frame->height_px, width_px, NULL, &fix);
    print_fix(index, "device", &fix);
}

int main(int argc, char** argv) {
    static uint64_t device_memory[DOTPOSE_DEVICE_BYTES / 8];
    dotpose_locator* large = NULL;
    dotpose_locator* device = NULL;
    image frame = {0, 0, NULL};
    image next = {0, 0, NULL};
    FILE* file = argc < 2 ? NULL : fopen(argv[1], "rb");
    int index = 0;
    if (file == NULL) fail("usage: golden FRAMES [ROWS]");
    if (dotpose_locator_create(DOTPOSE_KIND_LARGE, NULL, &large) != DOTPOSE_OK ||
        dotpose_device_init(device_memory, sizeof device_memory, NULL, &device) != DOTPOSE_OK)
        fail("no locator");
    for (index = 0; read_image(file, &frame) && read_image(file, &next); ++index)
        locate(index, &frame, &next, large, device, argc > 2);
    dotpose_locator_destroy(large);
    free(frame.pixels);
    free(next.pixels);
    fclose(file);
    return 0;
}
