/* Prints the position and angles of a camera in space, computed from one frame. The arguments are
 * the focal length in px and an 8-bit binary PGM file. Link with dotpose::c_space. */
#include <dotpose_space.h>
#include <stdio.h>
#include <stdlib.h>

static uint8_t* read_pgm(const char* path, int32_t* width_px, int32_t* height_px) {
    FILE* file = fopen(path, "rb");
    uint8_t* pixels = NULL;
    int width = 0;
    int height = 0;
    if (file == NULL) return NULL;
    if (fscanf(file, "P5 %d %d 255", &width, &height) == 2 && fgetc(file) != EOF && width > 0 &&
        height > 0 && width <= 4096 && height <= 4096) {
        const size_t bytes = (size_t)width * (size_t)height;
        pixels = (uint8_t*)malloc(bytes);
        if (pixels != NULL && fread(pixels, 1, bytes, file) != bytes) {
            free(pixels);
            pixels = NULL;
        }
    }
    fclose(file);
    *width_px = width;
    *height_px = height;
    return pixels;
}

static void print_pose(const dotpose_space_pose* pose) {
    int i;
    printf("position_mm %.9f %.9f %.9f\n", pose->x_mm, pose->y_mm, pose->z_mm);
    printf("quaternion_xyzw %.12f %.12f %.12f %.12f\n", pose->quaternion_xyzw[0],
           pose->quaternion_xyzw[1], pose->quaternion_xyzw[2], pose->quaternion_xyzw[3]);
    printf("lean_rad %.12f %.12f %.12f\n", pose->tilt_rad, pose->azimuth_rad, pose->turn_rad);
    printf("covariance_mm_rad");
    for (i = 0; i < 36; ++i)
        printf(" %.12g", pose->covariance_mm_rad[i]);
    printf("\nambiguous %d second %d odds %.6g dots %d\n", (int)pose->is_ambiguous,
           (int)pose->has_second, pose->second_odds, (int)pose->dots);
}

int main(int argc, char** argv) {
    dotpose_space_camera camera;
    dotpose_options options;
    dotpose_locator* locator = NULL;
    dotpose_fix fix;
    dotpose_space_pose pose;
    dotpose_status status;
    int32_t width_px = 0;
    int32_t height_px = 0;
    uint8_t* pixels = argc == 3 ? read_pgm(argv[2], &width_px, &height_px) : NULL;
    if (pixels == NULL) {
        fputs("usage: space_one FOCAL_PX FRAME.pgm\n", stderr);
        return 2;
    }
    dotpose_space_camera_init(&camera, sizeof camera, width_px, height_px, atof(argv[1]));
    dotpose_options_init(&options, sizeof options);
    dotpose_space_use_camera(&camera, &options);
    dotpose_fix_init(&fix, sizeof fix);
    dotpose_space_pose_init(&pose, sizeof pose);
    status = dotpose_locator_create(DOTPOSE_KIND_LARGE, &options, &locator);
    if (status == DOTPOSE_OK)
        status = dotpose_locate(locator, pixels, width_px, height_px, width_px, NULL, &fix);
    if (status == DOTPOSE_OK)
        status = dotpose_space_fit(locator, &camera, pixels, width_px, height_px, width_px, &pose);
    if (status == DOTPOSE_OK)
        print_pose(&pose);
    else
        fprintf(stderr, "%s\n", dotpose_status_message(status));
    dotpose_locator_destroy(locator);
    free(pixels);
    return status == DOTPOSE_OK ? 0 : 1;
}
