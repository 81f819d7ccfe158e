/* Tracks a robot whose camera takes a frame every 5 ms. Prints the position and velocity of the
 * robot:
 *
 *     ./follow_robot frame_*.pgm */
#include <dotpose.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "pgm.h"

enum { PERIOD_US = 5000 };

static dotpose_tracker tracker;
static dotpose_prediction prediction;
static int has_prediction = 0;

/* Locates the frame taken at `time_us`, and predicts the next frame. */
static dotpose_track follow(dotpose_locator* locator, const pgm_image* frame, int64_t time_us) {
    dotpose_fix fix;
    dotpose_sighting sighting;
    dotpose_track track;
    int is_ok = 0;
    dotpose_fix_init(&fix, sizeof fix);
    is_ok =
        dotpose_locate(locator, frame->pixels, frame->width_px, frame->height_px, frame->width_px,
                       has_prediction ? &prediction : NULL, &fix) == DOTPOSE_OK &&
        dotpose_sighting_of(&fix, time_us, &sighting) == DOTPOSE_OK;
    dotpose_tracker_update(&tracker, time_us, is_ok ? &sighting : NULL, &track);
    has_prediction =
        is_ok && dotpose_tracker_predict(&tracker, time_us + PERIOD_US, &fix, &sighting, locator,
                                         &prediction) == DOTPOSE_OK;
    return track;
}

int main(int argc, char** argv) {
    dotpose_locator* locator = NULL;
    int i = 0;
    if (dotpose_locator_create(DOTPOSE_KIND_LARGE, NULL, &locator) != DOTPOSE_OK) return 1;
    if (dotpose_tracker_init(&tracker, NULL) != DOTPOSE_OK) return 1;
    for (i = 1; i < argc; ++i) {
        const int64_t time_us = (int64_t)PERIOD_US * i;
        pgm_image frame = read_pgm(argv[i]);
        dotpose_track track;
        if (frame.pixels == NULL) return 2;
        track = follow(locator, &frame, time_us);
        free(frame.pixels);
        if (track.is_lost)
            printf("%" PRId64 " us: lost\n", time_us);
        else
            printf("%" PRId64 " us: x %.3f mm, y %.3f mm, %ld mm/s, %ld mm/s\n", time_us,
                   track.x_mm, track.y_mm, lroundf(track.vx_mm_s), lroundf(track.vy_mm_s));
    }
    dotpose_locator_destroy(locator);
    return 0;
}
