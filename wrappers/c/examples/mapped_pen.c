/* Prints the position of a pen tip, computed from one frame and corrected with a print map. The
 * arguments are the focal length in px, the distance of the tip along the optical axis in mm, a
 * print map file, and an 8-bit binary PGM file. Link with dotpose::c_space. */
#include <dotpose_print_map.h>
#include <stdio.h>
#include <stdlib.h>

#include "pgm.h"

static dotpose_print_map* read_map(const char* path) {
    static uint8_t bytes[1 << 22];
    dotpose_print_map* map = NULL;
    FILE* file = fopen(path, "rb");
    if (file == NULL) return NULL;
    dotpose_print_map_create(bytes, fread(bytes, 1, sizeof bytes, file), &map);
    fclose(file);
    return map;
}

static int print_tip(const dotpose_space_pose* pose, double distance_mm, int use) {
    dotpose_space_pen pen;
    dotpose_space_tip tip;
    int32_t is_down = 1;
    dotpose_status status;
    dotpose_space_pen_init(&pen, sizeof pen);
    pen.z_mm = distance_mm;
    dotpose_space_tip_init(&tip, sizeof tip);
    status = dotpose_space_tip_of(pose, &pen, &tip);
    if (status == DOTPOSE_OK) status = dotpose_space_update_contact(&tip, &is_down);
    if (status != DOTPOSE_OK) return 1;
    printf("tip_mm %.6f %.6f height_mm %.6f down %d map %d\n", tip.x_mm, tip.y_mm, tip.height_mm,
           (int)is_down, use);
    return 0;
}

int main(int argc, char** argv) {
    dotpose_space_camera camera;
    dotpose_options options;
    dotpose_locator* locator = NULL;
    dotpose_fix fix;
    dotpose_space_pose pose;
    dotpose_map_use use = DOTPOSE_MAP_NONE;
    dotpose_status status;
    dotpose_print_map* map = argc == 5 ? read_map(argv[3]) : NULL;
    pgm_image image;
    int code = 1;
    if (map == NULL) {
        fputs("usage: mapped_pen FOCAL_PX TIP_MM MAP FRAME.pgm\n", stderr);
        return 2;
    }
    image = read_pgm(argv[4]);
    dotpose_space_camera_init(&camera, sizeof camera, image.width_px, image.height_px,
                              atof(argv[1]));
    dotpose_options_init(&options, sizeof options);
    dotpose_space_use_camera(&camera, &options);
    dotpose_fix_init(&fix, sizeof fix);
    dotpose_space_pose_init(&pose, sizeof pose);
    status = dotpose_locator_create(DOTPOSE_KIND_LARGE, &options, &locator);
    if (status == DOTPOSE_OK)
        status = dotpose_locate(locator, image.pixels, image.width_px, image.height_px,
                                image.width_px, NULL, &fix);
    if (status == DOTPOSE_OK)
        status = dotpose_print_map_fit_space(map, locator, &camera, image.pixels, image.width_px,
                                             image.height_px, image.width_px, &pose, &use);
    if (status == DOTPOSE_OK)
        code = print_tip(&pose, atof(argv[2]), (int)use);
    else
        fprintf(stderr, "%s\n", dotpose_status_message(status));
    dotpose_locator_destroy(locator);
    dotpose_print_map_destroy(map);
    free(image.pixels);
    return code;
}
