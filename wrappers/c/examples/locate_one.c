/* Locates the pattern in one image:
 *
 *     gcc locate_one.c -ldotpose_c -lm -o locate_one
 *     ./locate_one frame.pgm */
#include <dotpose.h>
#include <stdio.h>
#include <stdlib.h>

#include "pgm.h"

int main(int argc, char** argv) {
    dotpose_locator* locator = NULL;
    dotpose_status status = DOTPOSE_OK;
    dotpose_fix fix;
    pgm_image frame;

    if (argc != 2) return fputs("usage: locate_one FRAME.pgm\n", stderr), 2;
    frame = read_pgm(argv[1]);
    if (frame.pixels == NULL) return 2;
    dotpose_fix_init(&fix, sizeof fix);
    status = dotpose_locator_create(DOTPOSE_KIND_LARGE, NULL, &locator);
    if (status == DOTPOSE_OK) {
        status = dotpose_locate(locator, frame.pixels, frame.width_px, frame.height_px,
                                frame.width_px, NULL, &fix);
    }
    if (status == DOTPOSE_OK)
        printf("x %.3f mm, y %.3f mm, angle %.4f rad\n", fix.x_mm, fix.y_mm, fix.theta_rad);
    else
        puts(dotpose_status_message(status));
    dotpose_locator_destroy(locator);
    free(frame.pixels);
    return status == DOTPOSE_OK ? 0 : 1;
}
