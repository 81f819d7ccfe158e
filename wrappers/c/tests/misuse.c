/* Checks that a misused function returns the status that describes the misuse, and has no other
 * effect. */
#include <dotpose.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH_PX = 188, HEIGHT_PX = 120 };

static int failures = 0;
static uint8_t pixels[HEIGHT_PX * WIDTH_PX];
static uint64_t memory[DOTPOSE_DEVICE_BYTES / 8];

static void expect(int line, dotpose_status found, dotpose_status expected) {
    if (found == expected) return;
    ++failures;
    printf("misuse.c:%d: %s instead of %s\n", line, dotpose_status_name(found),
           dotpose_status_name(expected));
}
#define EXPECT(expected, call) expect(__LINE__, (call), DOTPOSE_##expected)

static void check(int line, int holds) {
    if (holds) return;
    ++failures;
    printf("misuse.c:%d: does not hold\n", line);
}
#define CHECK(condition) check(__LINE__, (condition) ? 1 : 0)

static void statuses(void) {
    dotpose_status status = 0;
    CHECK(strcmp(dotpose_status_name(DOTPOSE_OK), "ok") == 0);
    CHECK(strcmp(dotpose_status_name(DOTPOSE_AMBIGUOUS_CODE), "ambiguous_code") == 0);
    CHECK(strcmp(dotpose_status_name(DOTPOSE_NULL_POINTER), "null_pointer") == 0);
    CHECK(strcmp(dotpose_status_name(DOTPOSE_NO_PACKET), "no_packet") == 0);
    CHECK(strcmp(dotpose_status_name(17), "other") == 0);
    CHECK(strcmp(dotpose_status_name(DOTPOSE_OTHER), "other") == 0);
    CHECK(strcmp(dotpose_status_name(DOTPOSE_NO_PACKET + 1), "other") == 0);
    for (status = -3; status < DOTPOSE_NO_PACKET + 3; ++status)
        CHECK(dotpose_status_name(status)[0] != 0 && dotpose_status_message(status)[0] != 0);
    CHECK(dotpose_status_name(INT32_MIN)[0] != 0 && dotpose_status_message(INT32_MAX)[0] != 0);
    CHECK(strlen(dotpose_version()) >= 5);
}

static void code(void) {
    dotpose_place place = {0, 0, 0, 0};
    dotpose_place beyond = {DOTPOSE_POSITIONS_PER_AXIS, 0, 0, 0};
    dotpose_place section = {0, 0, 0, DOTPOSE_SECTIONS};
    uint8_t symbols[12];
    int32_t dx = 0;
    int32_t dy = 0;
    EXPECT(NULL_POINTER, dotpose_displacement(0, NULL, &dx, &dy));
    EXPECT(NULL_POINTER, dotpose_displacement(0, &place, NULL, &dy));
    EXPECT(NULL_POINTER, dotpose_displacement(0, &place, &dx, NULL));
    EXPECT(BAD_VALUE, dotpose_displacement(3, &place, &dx, &dy));
    EXPECT(BAD_VALUE, dotpose_displacement(-1, &place, &dx, &dy));
    EXPECT(BAD_VALUE, dotpose_displacement(0, &beyond, &dx, &dy));
    EXPECT(BAD_VALUE, dotpose_displacement(0, &section, &dx, &dy));
    EXPECT(OK, dotpose_displacement(0, &place, &dx, &dy));
    EXPECT(NULL_POINTER, dotpose_symbols(0, NULL, 4, 3, symbols, sizeof symbols));
    EXPECT(NULL_POINTER, dotpose_symbols(0, &place, 4, 3, NULL, sizeof symbols));
    EXPECT(BAD_VALUE, dotpose_symbols(256, &place, 4, 3, symbols, sizeof symbols));
    EXPECT(BAD_VALUE, dotpose_symbols(0, &beyond, 4, 3, symbols, sizeof symbols));
    EXPECT(BAD_VALUE, dotpose_symbols(0, &place, 0, 3, symbols, sizeof symbols));
    EXPECT(BAD_VALUE, dotpose_symbols(0, &place, 4, -3, symbols, sizeof symbols));
    EXPECT(BAD_VALUE, dotpose_symbols(0, &place, 65536, 1, symbols, sizeof symbols));
    EXPECT(TOO_LITTLE_MEMORY, dotpose_symbols(0, &place, 65535, 65535, symbols, sizeof symbols));
    EXPECT(TOO_LITTLE_MEMORY, dotpose_symbols(0, &place, 4, 3, symbols, sizeof symbols - 1));
    EXPECT(OK, dotpose_symbols(0, &place, 4, 3, symbols, sizeof symbols));
}

static void options(void) {
    dotpose_options good;
    dotpose_options bad;
    dotpose_locator* locator = NULL;
    dotpose_fix fix;
    struct {
        dotpose_options known;
        uint64_t more;
    } newer;
    dotpose_fix_init(&fix, sizeof fix);
    EXPECT(NULL_POINTER, dotpose_options_init(NULL, sizeof good));
    EXPECT(BAD_SIZE, dotpose_options_init(&good, 0));
    EXPECT(BAD_SIZE, dotpose_options_init(&good, sizeof good + 8));
    EXPECT(OK, dotpose_options_init(&good, sizeof good));
    CHECK(good.size == sizeof good && good.spacing_mm == 0.508 && good.effort == 2);
    EXPECT(OK, dotpose_locator_create(DOTPOSE_KIND_SMALL, &good, &locator));
    memset(&newer, 0, sizeof newer);
    newer.known = good;
    newer.known.size = sizeof newer;
    EXPECT(BAD_SIZE, dotpose_set_options(locator, &newer.known));
    bad = good;
    bad.size = 0;
    EXPECT(BAD_SIZE, dotpose_set_options(locator, &bad));
    CHECK(strcmp(dotpose_bad_option(&bad), "size") == 0 && dotpose_bad_option(NULL) == NULL);
    CHECK(dotpose_bad_option(&good) == NULL);
    bad = good;
    bad.code = 256; /* would be anoto if truncated to 8 bits */
    EXPECT(BAD_ARGUMENT, dotpose_set_options(locator, &bad));
    bad = good;
    bad.effort = -1;
    EXPECT(BAD_ARGUMENT, dotpose_set_options(locator, &bad));
    bad = good;
    bad.min_contrast = 256;
    EXPECT(BAD_ARGUMENT, dotpose_set_options(locator, &bad));
    CHECK(strcmp(dotpose_bad_option(&bad), "min_contrast") == 0);
    bad = good;
    bad.spacing_mm = (double)NAN;
    EXPECT(BAD_ARGUMENT, dotpose_set_options(locator, &bad));
    CHECK(strcmp(dotpose_bad_option(&bad), "spacing_mm") == 0);
    bad = good;
    bad.show_stages = 2;
    EXPECT(BAD_ARGUMENT, dotpose_set_options(locator, &bad));
    /* Refused options leave the previous options unchanged. */
    EXPECT(NO_CONTRAST, dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
    EXPECT(OK, dotpose_set_options(locator, NULL));
    EXPECT(NULL_POINTER, dotpose_set_options(NULL, &good));
    dotpose_locator_destroy(locator);
    good.bits_per_error = DOTPOSE_MEASURED_ERROR_RATE;
    CHECK(dotpose_bad_option(&good) == NULL);
    bad = good;
    bad.bits_per_error = 65537;
    EXPECT(BAD_ARGUMENT, dotpose_locator_create(DOTPOSE_KIND_LARGE, &bad, &locator));
    CHECK(locator == NULL);
    bad = good;
    bad.max_p_wrong = 0;
    EXPECT(BAD_ARGUMENT, dotpose_locator_create(DOTPOSE_KIND_LARGE, &bad, &locator));
    CHECK(locator == NULL);
    EXPECT(BAD_ARGUMENT, dotpose_device_init(memory, sizeof memory, &bad, &locator));
    CHECK(locator == NULL);
}

static void making(void) {
    dotpose_locator* locator = NULL;
    dotpose_fix fix;
    uint64_t zeros[16] = {0};
    dotpose_fix_init(&fix, sizeof fix);
    CHECK(dotpose_locator_bytes(DOTPOSE_KIND_DEVICE) <= DOTPOSE_DEVICE_BYTES);
    CHECK(dotpose_locator_bytes(DOTPOSE_KIND_DEVICE_160X120) <= DOTPOSE_DEVICE_160X120_BYTES);
    CHECK(dotpose_locator_bytes(DOTPOSE_KIND_DEVICE_320X240) <= DOTPOSE_DEVICE_320X240_BYTES);
    CHECK(dotpose_locator_bytes(DOTPOSE_KIND_DEVICE_36X36) <= DOTPOSE_DEVICE_36X36_BYTES);
    CHECK(DOTPOSE_DEVICE_160X120_BYTES < DOTPOSE_DEVICE_BYTES);
    CHECK(dotpose_locator_bytes(DOTPOSE_KIND_SMALL) < dotpose_locator_bytes(DOTPOSE_KIND_LARGE));
    CHECK(dotpose_locator_bytes(-1) == 0 && dotpose_locator_bytes(6) == 0);
    EXPECT(NULL_POINTER, dotpose_device_init(NULL, sizeof memory, NULL, &locator));
    EXPECT(NULL_POINTER, dotpose_device_init(memory, sizeof memory, NULL, NULL));
    EXPECT(NOT_ALIGNED, dotpose_device_init((char*)memory + 4, sizeof memory - 8, NULL, &locator));
    EXPECT(TOO_LITTLE_MEMORY,
           dotpose_device_init(memory, dotpose_locator_bytes(DOTPOSE_KIND_DEVICE) - 1, NULL,
                               &locator));
    EXPECT(TOO_LITTLE_MEMORY,
           dotpose_locator_init(memory, sizeof memory, DOTPOSE_KIND_LARGE, NULL, &locator));
    EXPECT(TOO_LITTLE_MEMORY, dotpose_device_320x240_init(memory, sizeof memory, NULL, &locator));
    EXPECT(BAD_VALUE, dotpose_locator_init(memory, sizeof memory, 6, NULL, &locator));
    EXPECT(NULL_POINTER,
           dotpose_locator_init(NULL, sizeof memory, DOTPOSE_KIND_DEVICE, NULL, &locator));
    EXPECT(NULL_POINTER,
           dotpose_locator_init(memory, sizeof memory, DOTPOSE_KIND_DEVICE, NULL, NULL));
    EXPECT(BAD_VALUE, dotpose_locator_create(-1, NULL, &locator));
    EXPECT(NULL_POINTER, dotpose_locator_create(DOTPOSE_KIND_LARGE, NULL, NULL));
    CHECK(locator == NULL);

    EXPECT(OK, dotpose_locator_init(memory, sizeof memory, DOTPOSE_KIND_DEVICE, NULL, &locator));
    dotpose_locator_destroy(locator);
    EXPECT(NOT_INITIALIZED,
           dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
    dotpose_locator_destroy(locator); /* does nothing, because the pointer is null */
    dotpose_locator_destroy(NULL);
    locator = (dotpose_locator*)(void*)zeros;
    EXPECT(NOT_INITIALIZED,
           dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
    EXPECT(NOT_INITIALIZED, dotpose_begin(locator, WIDTH_PX, HEIGHT_PX, NULL));
    EXPECT(NOT_INITIALIZED, dotpose_push_row(locator, pixels));
    EXPECT(NOT_INITIALIZED, dotpose_finish(locator, &fix));
    EXPECT(NOT_INITIALIZED, dotpose_set_options(locator, NULL));
}

static void locating(dotpose_locator* locator) {
    dotpose_fix fix;
    dotpose_prediction prediction;
    memset(&prediction, 0, sizeof prediction);
    dotpose_fix_init(&fix, sizeof fix);
    EXPECT(NULL_POINTER, dotpose_locate(NULL, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
    CHECK(fix.status == DOTPOSE_NULL_POINTER && fix.x_mm != fix.x_mm && fix.p_wrong == 1);
    EXPECT(NULL_POINTER, dotpose_locate(locator, NULL, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
    EXPECT(NULL_POINTER,
           dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, NULL));
    EXPECT(BAD_STRIDE,
           dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX - 1, NULL, &fix));
    EXPECT(BAD_STRIDE,
           dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, 1 - WIDTH_PX, NULL, &fix));
    EXPECT(BAD_STRIDE, dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, 0, NULL, &fix));
    EXPECT(IMAGE_TOO_SMALL, dotpose_locate(locator, pixels, 63, HEIGHT_PX, WIDTH_PX, NULL, &fix));
    EXPECT(IMAGE_TOO_SMALL, dotpose_locate(locator, pixels, WIDTH_PX, -1, WIDTH_PX, NULL, &fix));
    EXPECT(IMAGE_TOO_SMALL,
           dotpose_locate(locator, pixels, INT32_MIN, INT32_MIN, WIDTH_PX, NULL, &fix));
    EXPECT(IMAGE_TOO_LARGE,
           dotpose_locate(locator, pixels, INT32_MAX, INT32_MAX, PTRDIFF_MAX, NULL, &fix));
    EXPECT(IMAGE_TOO_LARGE, dotpose_locate(locator, pixels, 189, 4097, 200, NULL, &fix));
    EXPECT(NO_CONTRAST, dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
    CHECK(fix.status == DOTPOSE_NO_CONTRAST && fix.theta_rad != fix.theta_rad);
    /* A negative stride reads the rows in reverse order, starting with the last row. */
    EXPECT(NO_CONTRAST, dotpose_locate(locator, pixels + (HEIGHT_PX - 1) * WIDTH_PX, WIDTH_PX,
                                       HEIGHT_PX, -WIDTH_PX, NULL, &fix));
    EXPECT(NO_CONTRAST,
           dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, &prediction, &fix));
    prediction.place.x = DOTPOSE_POSITIONS_PER_AXIS;
    EXPECT(BAD_VALUE,
           dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, &prediction, &fix));
    EXPECT(BAD_VALUE, dotpose_begin(locator, WIDTH_PX, HEIGHT_PX, &prediction));
}

static void pushing(dotpose_locator* locator) {
    dotpose_fix fix;
    int v = 0;
    dotpose_fix_init(&fix, sizeof fix);
    EXPECT(NO_FRAME, dotpose_push_row(locator, pixels));
    EXPECT(NO_FRAME, dotpose_finish(locator, &fix));
    CHECK(fix.status == DOTPOSE_NO_FRAME);
    EXPECT(IMAGE_TOO_SMALL, dotpose_begin(locator, 63, HEIGHT_PX, NULL));
    EXPECT(NO_FRAME, dotpose_push_row(locator, pixels));
    EXPECT(IMAGE_TOO_SMALL, dotpose_finish(locator, &fix));
    EXPECT(IMAGE_TOO_LARGE, dotpose_begin(locator, 4097, HEIGHT_PX, NULL));
    EXPECT(OK, dotpose_begin(locator, WIDTH_PX, HEIGHT_PX, NULL));
    EXPECT(NULL_POINTER, dotpose_push_row(locator, NULL));
    for (v = 0; v < HEIGHT_PX; ++v)
        EXPECT(OK, dotpose_push_row(locator, pixels));
    EXPECT(NO_FRAME, dotpose_push_row(locator, pixels));
    EXPECT(NULL_POINTER, dotpose_finish(locator, NULL));
    EXPECT(NO_CONTRAST, dotpose_finish(locator, &fix));
    EXPECT(NO_FRAME, dotpose_finish(locator, &fix));
    /* dotpose_set_options and dotpose_locate discard an unfinished frame. */
    EXPECT(OK, dotpose_begin(locator, WIDTH_PX, HEIGHT_PX, NULL));
    EXPECT(OK, dotpose_set_options(locator, NULL));
    EXPECT(NO_FRAME, dotpose_push_row(locator, pixels));
    EXPECT(OK, dotpose_begin(locator, WIDTH_PX, HEIGHT_PX, NULL));
    EXPECT(NO_CONTRAST, dotpose_locate(locator, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
    EXPECT(NO_FRAME, dotpose_finish(locator, &fix));
    /* A frame may be finished before all its rows have been pushed. */
    EXPECT(OK, dotpose_begin(locator, WIDTH_PX, HEIGHT_PX, NULL));
    EXPECT(NO_CONTRAST, dotpose_finish(locator, &fix));
    EXPECT(NULL_POINTER, dotpose_begin(NULL, WIDTH_PX, HEIGHT_PX, NULL));
    EXPECT(NULL_POINTER, dotpose_push_row(NULL, pixels));
    EXPECT(NULL_POINTER, dotpose_finish(NULL, &fix));
}

/* Returns a made-up fix with the given status. */
static dotpose_fix made_up(dotpose_status status) {
    dotpose_fix fix;
    dotpose_fix_init(&fix, sizeof fix);
    fix.status = status;
    fix.spacing_nm = 508000;
    return fix;
}

/* A fix whose size does not match any version is neither read nor written. */
static void sizes(dotpose_locator* large, dotpose_locator* device) {
    static dotpose_pacer pacer;
    dotpose_fix fix = made_up(DOTPOSE_OK);
    dotpose_prediction prediction;
    dotpose_sighting sighting;
    dotpose_packet packet;
    const uint32_t bad[] = {0, sizeof fix - 8, sizeof fix + 4, sizeof fix + 8, UINT32_MAX};
    int64_t next_us = 0;
    size_t i = 0;
    EXPECT(NULL_POINTER, dotpose_fix_init(NULL, sizeof fix));
    EXPECT(OK, dotpose_pacer_init(&pacer, NULL));
    for (i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        EXPECT(BAD_SIZE, dotpose_fix_init(&fix, bad[i]));
        fix = made_up(DOTPOSE_OK);
        fix.size = bad[i];
        EXPECT(BAD_SIZE, dotpose_locate(large, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
        EXPECT(BAD_SIZE, dotpose_finish(device, &fix));
        EXPECT(BAD_SIZE, dotpose_locate_any_code(large, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL,
                                                 NULL, NULL, &fix));
        EXPECT(BAD_SIZE,
               dotpose_locate_in_code(large, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
        EXPECT(BAD_SIZE, dotpose_prediction_like(&fix, &prediction));
        EXPECT(BAD_SIZE, dotpose_sighting_of(&fix, 0, &sighting));
        EXPECT(BAD_SIZE, dotpose_packet_of(&fix, 0, 1, 2, &packet));
        EXPECT(BAD_SIZE, dotpose_pacer_next_frame(&pacer, &fix, 0, &next_us, NULL));
        CHECK(fix.size == bad[i] && fix.status == DOTPOSE_OK);
    }
    EXPECT(OK, dotpose_fix_init(&fix, sizeof fix));
    CHECK(fix.size == sizeof fix && fix.status == DOTPOSE_NOT_RUN && fix.x_mm != fix.x_mm);
}

static void predictions(void) {
    dotpose_prediction prediction;
    dotpose_fix fix = made_up(DOTPOSE_NO_GRID);
    EXPECT(NULL_POINTER, dotpose_prediction_like(NULL, &prediction));
    EXPECT(NULL_POINTER, dotpose_prediction_like(&fix, NULL));
    EXPECT(NO_FIX, dotpose_prediction_like(&fix, &prediction));
    fix = made_up(DOTPOSE_OK);
    EXPECT(OK, dotpose_prediction_like(&fix, &prediction));
    fix.section_u = 256;
    EXPECT(BAD_VALUE, dotpose_prediction_like(&fix, &prediction));
    fix = made_up(DOTPOSE_OK);
    fix.fraction_x_q16 = 65536;
    EXPECT(BAD_VALUE, dotpose_prediction_like(&fix, &prediction));
    EXPECT(NULL_POINTER, dotpose_prediction_move(NULL, 0, 0, 0, 0, 0, 0));
    EXPECT(OK, dotpose_prediction_move(&prediction, 0, 1 << 28, -(1 << 28), INT32_MIN, 0, 0));
    EXPECT(BAD_VALUE, dotpose_prediction_move(&prediction, 3, 0, 0, 0, 0, 0));
    EXPECT(BAD_VALUE, dotpose_prediction_move(&prediction, 0, INT32_MAX, 0, 0, 0, 0));
    EXPECT(BAD_VALUE, dotpose_prediction_move(&prediction, 0, 0, 0, 0, INT32_MIN, 0));
    prediction.pattern_from_image.at_centre_x_q16 = INT32_MAX;
    EXPECT(BAD_VALUE, dotpose_prediction_move(&prediction, 0, 0, 0, 0, 0, 0));
}

static void known_sheets(dotpose_locator* large, dotpose_locator* device) {
    dotpose_region sheet = {DOTPOSE_CODE_ANOTO, 0, 0, 0, 1024, 2048, 393, 564};
    EXPECT(OK, dotpose_set_known(device, &sheet, 1, DOTPOSE_OTHERS_IMPOSSIBLE));
    EXPECT(OK, dotpose_set_known(device, NULL, 0, DOTPOSE_OTHERS_POSSIBLE));
    EXPECT(NULL_POINTER, dotpose_set_known(NULL, &sheet, 1, DOTPOSE_OTHERS_POSSIBLE));
    EXPECT(NULL_POINTER, dotpose_set_known(large, NULL, 1, DOTPOSE_OTHERS_POSSIBLE));
    EXPECT(BAD_VALUE, dotpose_set_known(large, &sheet, 1, 2));
    EXPECT(BAD_VALUE, dotpose_set_known(large, &sheet, 1, -1));
    EXPECT(OK, dotpose_set_known(large, &sheet, 1, DOTPOSE_OTHERS_POSSIBLE));
    sheet.section_v = 63;
    EXPECT(BAD_VALUE, dotpose_set_known(large, &sheet, 1, DOTPOSE_OTHERS_POSSIBLE));
    sheet.section_v = 62;
    sheet.code = 3;
    EXPECT(BAD_VALUE, dotpose_set_known(large, &sheet, 1, DOTPOSE_OTHERS_POSSIBLE));
    sheet.code = DOTPOSE_CODE_MICRODOTS;
    sheet.rows = 0;
    EXPECT(BAD_VALUE, dotpose_set_known(large, &sheet, 1, DOTPOSE_OTHERS_POSSIBLE));
    sheet.rows = UINT32_MAX;
    EXPECT(BAD_VALUE, dotpose_set_known(large, &sheet, 1, DOTPOSE_OTHERS_POSSIBLE));
    EXPECT(OK, dotpose_set_known(large, NULL, 0, DOTPOSE_OTHERS_POSSIBLE));
}

static void any_code(dotpose_locator* large, dotpose_locator* device) {
    dotpose_code_evidence evidence = {{0}};
    dotpose_code_reading reading;
    dotpose_fix fix;
    int32_t code = -1;
    int32_t count = -1;
    float p_wrong = -1;
    dotpose_fix_init(&fix, sizeof fix);
    EXPECT(WRONG_KIND, dotpose_locate_any_code(device, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL,
                                               &evidence, &reading, &fix));
    EXPECT(WRONG_KIND,
           dotpose_locate_in_code(device, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, &reading, &fix));
    EXPECT(WRONG_KIND, dotpose_dots(device, NULL, 0, &count));
    EXPECT(NULL_POINTER, dotpose_code_of(NULL, &code));
    EXPECT(NULL_POINTER, dotpose_code_of(large, NULL));
    EXPECT(OK, dotpose_code_of(device, &code));
    CHECK(code == DOTPOSE_CODE_ANOTO);
    EXPECT(NO_CONTRAST, dotpose_locate_any_code(large, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL,
                                                NULL, NULL, &fix));
    EXPECT(NULL_POINTER, dotpose_locate_any_code(large, NULL, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL,
                                                 &evidence, &reading, &fix));
    EXPECT(NULL_POINTER, dotpose_locate_any_code(large, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL,
                                                 &evidence, &reading, NULL));
    EXPECT(NULL_POINTER,
           dotpose_locate_in_code(NULL, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, &reading, &fix));
    EXPECT(NO_CONTRAST,
           dotpose_locate_in_code(large, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL, &fix));
    EXPECT(OK, dotpose_code_likeliest(&evidence, &code, &p_wrong));
    CHECK(code == DOTPOSE_CODE_ANOTO && p_wrong > 0.6F && p_wrong < 0.7F);
    memset(&evidence, 0x55, sizeof evidence);
    EXPECT(BAD_VALUE, dotpose_code_likeliest(&evidence, &code, &p_wrong));
    EXPECT(BAD_VALUE, dotpose_locate_any_code(large, pixels, WIDTH_PX, HEIGHT_PX, WIDTH_PX, NULL,
                                              &evidence, &reading, &fix));
    EXPECT(NULL_POINTER, dotpose_code_likeliest(NULL, &code, &p_wrong));
    EXPECT(NULL_POINTER, dotpose_code_likeliest(&evidence, NULL, &p_wrong));
    EXPECT(NULL_POINTER, dotpose_code_likeliest(&evidence, &code, NULL));
    EXPECT(OK, dotpose_dots(large, NULL, 0, &count));
    CHECK(count == 0);
    EXPECT(NULL_POINTER, dotpose_dots(large, NULL, 1, &count));
    EXPECT(NULL_POINTER, dotpose_dots(large, NULL, 0, NULL));
    EXPECT(NULL_POINTER, dotpose_dots(NULL, NULL, 0, &count));
}

static void trackers(dotpose_locator* locator) {
    static dotpose_tracker tracker; /* all zeros, so not set up */
    dotpose_track_options options;
    dotpose_sighting sighting;
    dotpose_prediction prediction;
    dotpose_track track;
    dotpose_fix fix = made_up(DOTPOSE_OK);
    EXPECT(NOT_INITIALIZED, dotpose_tracker_update(&tracker, 0, NULL, &track));
    EXPECT(NULL_POINTER, dotpose_track_options_init(NULL, sizeof options));
    EXPECT(BAD_SIZE, dotpose_track_options_init(&options, sizeof options - 8));
    EXPECT(NULL_POINTER, dotpose_tracker_update_moved(&tracker, 0, NULL, NULL, &track));
    EXPECT(OK, dotpose_track_options_init(&options, sizeof options));
    EXPECT(NULL_POINTER, dotpose_tracker_init(NULL, &options));
    EXPECT(OK, dotpose_tracker_init(&tracker, &options));
    options.still_mm = (float)NAN;
    EXPECT(BAD_ARGUMENT, dotpose_tracker_init(&tracker, &options));
    EXPECT(NOT_INITIALIZED, dotpose_tracker_update(&tracker, 0, NULL, &track));
    dotpose_track_options_init(&options, sizeof options);
    options.spacing_mm = 0;
    EXPECT(BAD_ARGUMENT, dotpose_tracker_init(&tracker, &options));
    options.size = 3;
    EXPECT(BAD_SIZE, dotpose_tracker_init(&tracker, &options));
    EXPECT(OK, dotpose_tracker_init(&tracker, NULL));

    EXPECT(NULL_POINTER, dotpose_sighting_of(NULL, 0, &sighting));
    EXPECT(NULL_POINTER, dotpose_sighting_of(&fix, 0, NULL));
    EXPECT(BAD_VALUE, dotpose_sighting_of(&fix, INT64_MAX, &sighting));
    fix.spacing_nm = 0;
    EXPECT(BAD_VALUE, dotpose_sighting_of(&fix, 0, &sighting));
    fix = made_up(DOTPOSE_MIRRORED);
    EXPECT(NO_FIX, dotpose_sighting_of(&fix, 0, &sighting));
    fix = made_up(DOTPOSE_OK);
    EXPECT(OK, dotpose_sighting_of(&fix, 1000, &sighting));

    EXPECT(NULL_POINTER, dotpose_tracker_update(NULL, 0, NULL, &track));
    EXPECT(NULL_POINTER, dotpose_tracker_update(&tracker, 0, NULL, NULL));
    EXPECT(BAD_VALUE, dotpose_tracker_update(&tracker, INT64_MIN, NULL, &track));
    EXPECT(OK, dotpose_tracker_update(&tracker, 0, NULL, &track));
    CHECK(track.is_lost == 1 && track.verdict == DOTPOSE_VERDICT_NONE && track.events == 0);
    sighting.covariance[0] = INFINITY;
    EXPECT(BAD_VALUE, dotpose_tracker_update(&tracker, 1000, &sighting, &track));
    sighting.covariance[0] = -1;
    EXPECT(BAD_VALUE, dotpose_tracker_update(&tracker, 1000, &sighting, &track));
    sighting.covariance[0] = 0;
    sighting.x_nm = INT64_MAX;
    EXPECT(BAD_VALUE, dotpose_tracker_update(&tracker, 1000, &sighting, &track));
    sighting.x_nm = 0;

    EXPECT(OK, dotpose_tracker_predict(&tracker, 2000, &fix, &sighting, locator, &prediction));
    EXPECT(NULL_POINTER,
           dotpose_tracker_predict(NULL, 2000, &fix, &sighting, locator, &prediction));
    EXPECT(NULL_POINTER,
           dotpose_tracker_predict(&tracker, 2000, NULL, &sighting, locator, &prediction));
    EXPECT(NULL_POINTER, dotpose_tracker_predict(&tracker, 2000, &fix, NULL, locator, &prediction));
    EXPECT(NULL_POINTER,
           dotpose_tracker_predict(&tracker, 2000, &fix, &sighting, NULL, &prediction));
    EXPECT(NULL_POINTER, dotpose_tracker_predict(&tracker, 2000, &fix, &sighting, locator, NULL));
    fix.pattern_from_image.du_x_q24 = INT32_MAX;
    EXPECT(BAD_VALUE,
           dotpose_tracker_predict(&tracker, 2000, &fix, &sighting, locator, &prediction));
}

static void packets(void) {
    static dotpose_packet_reader reader; /* all zeros, so not set up */
    dotpose_packet packet;
    dotpose_fix fix = made_up(DOTPOSE_NO_GRID);
    uint8_t bytes[DOTPOSE_PACKET_BYTES];
    uint32_t damaged = 7;
    int i = 0;
    EXPECT(NULL_POINTER, dotpose_packet_of(NULL, 0, 1, 2, &packet));
    EXPECT(NULL_POINTER, dotpose_packet_of(&fix, 0, 1, 2, NULL));
    EXPECT(BAD_VALUE, dotpose_packet_of(&fix, 3, 1, 2, &packet));
    fix.status = DOTPOSE_NULL_POINTER; /* status of a misused call */
    EXPECT(BAD_VALUE, dotpose_packet_of(&fix, 0, 1, 2, &packet));
    fix.status = DOTPOSE_NO_GRID;
    EXPECT(OK, dotpose_packet_of(&fix, 0, 65537, 2, &packet));
    CHECK(packet.sequence == 1 && packet.status == DOTPOSE_NO_GRID);
    EXPECT(NULL_POINTER, dotpose_packet_encode(NULL, bytes, sizeof bytes));
    EXPECT(NULL_POINTER, dotpose_packet_encode(&packet, NULL, sizeof bytes));
    EXPECT(TOO_LITTLE_MEMORY, dotpose_packet_encode(&packet, bytes, sizeof bytes - 1));
    EXPECT(OK, dotpose_packet_encode(&packet, bytes, sizeof bytes));
    EXPECT(NOT_INITIALIZED, dotpose_packet_reader_push(&reader, 0, &packet));
    EXPECT(NULL_POINTER, dotpose_packet_reader_init(NULL));
    EXPECT(OK, dotpose_packet_reader_init(&reader));
    EXPECT(NULL_POINTER, dotpose_packet_reader_push(NULL, 0, &packet));
    EXPECT(NULL_POINTER, dotpose_packet_reader_push(&reader, 0, NULL));
    bytes[3] ^= 1;
    for (i = 0; i < DOTPOSE_PACKET_BYTES; ++i)
        EXPECT(NO_PACKET, dotpose_packet_reader_push(&reader, bytes[i], &packet));
    EXPECT(NULL_POINTER, dotpose_packet_reader_damaged(&reader, NULL));
    EXPECT(NULL_POINTER, dotpose_packet_reader_damaged(NULL, &damaged));
    EXPECT(OK, dotpose_packet_reader_damaged(&reader, &damaged));
    CHECK(damaged == 1);
    packet.status = DOTPOSE_OTHER; /* status of a packet from a newer sender */
    EXPECT(OK, dotpose_packet_encode(&packet, bytes, sizeof bytes));
    packet.status = DOTPOSE_OTHER - 1;
    EXPECT(BAD_VALUE, dotpose_packet_encode(&packet, bytes, sizeof bytes));
    packet.status = DOTPOSE_OK;
    packet.sequence = 65536;
    EXPECT(BAD_VALUE, dotpose_packet_encode(&packet, bytes, sizeof bytes));
    packet.sequence = 0;
    packet.theta_bam16 = 32768;
    EXPECT(BAD_VALUE, dotpose_packet_encode(&packet, bytes, sizeof bytes));
}

static void pacers(void) {
    static dotpose_pacer pacer; /* all zeros, so not set up */
    dotpose_pacer_options options;
    dotpose_fix fix = made_up(DOTPOSE_NO_GRID);
    int64_t next_us = 0;
    int32_t is_moving = 0;
    EXPECT(NOT_INITIALIZED, dotpose_pacer_next_frame(&pacer, &fix, 0, &next_us, &is_moving));
    EXPECT(NULL_POINTER, dotpose_pacer_options_init(NULL, sizeof options));
    EXPECT(BAD_SIZE, dotpose_pacer_options_init(&options, 4));
    EXPECT(OK, dotpose_pacer_options_init(&options, sizeof options));
    EXPECT(NULL_POINTER, dotpose_pacer_init(NULL, NULL));
    options.moving_period_us = -1;
    EXPECT(BAD_ARGUMENT, dotpose_pacer_init(&pacer, &options));
    options.moving_period_us = INT64_MAX;
    EXPECT(BAD_ARGUMENT, dotpose_pacer_init(&pacer, &options));
    EXPECT(OK, dotpose_pacer_init(&pacer, NULL));
    EXPECT(NULL_POINTER, dotpose_pacer_next_frame(NULL, &fix, 0, &next_us, NULL));
    EXPECT(NULL_POINTER, dotpose_pacer_next_frame(&pacer, NULL, 0, &next_us, NULL));
    EXPECT(NULL_POINTER, dotpose_pacer_next_frame(&pacer, &fix, 0, NULL, NULL));
    EXPECT(BAD_VALUE, dotpose_pacer_next_frame(&pacer, &fix, INT64_MAX, &next_us, NULL));
    EXPECT(OK, dotpose_pacer_next_frame(&pacer, &fix, 5, &next_us, &is_moving));
    CHECK(next_us == 5 && is_moving == 1);
}

int main(void) {
    dotpose_locator* device = NULL;
    dotpose_locator* large = NULL;
    statuses();
    code();
    options();
    making();
    EXPECT(OK, dotpose_device_init(memory, sizeof memory, NULL, &device));
    EXPECT(OK, dotpose_locator_create(DOTPOSE_KIND_LARGE, NULL, &large));
    if (device == NULL || large == NULL) return 1;
    locating(device);
    locating(large);
    pushing(device);
    pushing(large);
    sizes(large, device);
    predictions();
    known_sheets(large, device);
    any_code(large, device);
    trackers(large);
    packets();
    pacers();
    dotpose_locator_destroy(large);
    if (failures == 0) puts("every misuse has its status");
    return failures == 0 ? 0 : 1;
}
