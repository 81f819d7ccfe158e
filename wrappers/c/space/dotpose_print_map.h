/* Print maps for C99 and C++. A print map corrects fixes and poses in space for the measured errors
 * of a print (docs/print-map.md). `dotpose calibrate --print-map` creates a map.
 *
 *     dotpose_print_map* map;
 *     if (dotpose_print_map_create(bytes, byte_count, &map) != DOTPOSE_OK) ...
 *     options.show_stages = 1;
 *     ...
 *     dotpose_map_use use;
 *     if (dotpose_locate(locator, pixels, 640, 480, 640, NULL, &fix) == DOTPOSE_OK &&
 *         dotpose_print_map_correct(map, locator, &fix, &use) == DOTPOSE_OK &&
 *         use == DOTPOSE_MAP_USED)
 *         printf("%.4f %.4f\n", fix.x_mm, fix.y_mm);
 *     dotpose_print_map_destroy(map);
 *
 * Link with the CMake target dotpose::c_space. No function throws or prints. Threads may share a
 * map. */
#ifndef DOTPOSE_PRINT_MAP_H
#define DOTPOSE_PRINT_MAP_H

#include <dotpose_space.h>

#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

typedef struct dotpose_print_map dotpose_print_map;

/* Reads a map from the contents of a map file, and allocates memory for the map. Returns BAD_VALUE
 * if the bytes are not a map, or if the map is damaged or has a newer format version. Can also
 * return OUT_OF_MEMORY or NULL_POINTER. On failure, sets `map` to null. */
dotpose_status dotpose_print_map_create(const void* bytes, size_t byte_count,
                                        dotpose_print_map** map);

/* Frees a map. Does nothing if `map` is null. */
void dotpose_print_map_destroy(dotpose_print_map* map);

/* Result of applying a map. */
typedef int32_t dotpose_map_use;
enum {
    DOTPOSE_MAP_NONE = 0,        /* the map does not contain the page in view */
    DOTPOSE_MAP_USED = 1,        /* the fix or the pose is corrected by the map */
    DOTPOSE_MAP_NOT_COVERED = 2, /* the map contains too few of the dots in view */
    DOTPOSE_MAP_CONTRADICTED = 3 /* the dots contradict the map, as on another print */
};

/* Corrects the fix of the image that the locator located most recently, and writes the result to
 * `fix`, which must have been set up by dotpose_fix_init. If `use` is DOTPOSE_MAP_USED, the
 * covariance refers to the absolute position on the page and includes the error of the map.
 * Otherwise, the result is the uncorrected fix. Returns
 * - OK,
 * - NO_FIX if the image was not located,
 * - WRONG_KIND for device locators, and for locators without `show_stages`,
 * - OUT_OF_MEMORY, or another misuse status. */
dotpose_status dotpose_print_map_correct(const dotpose_print_map* map,
                                         const dotpose_locator* locator, dotpose_fix* fix,
                                         dotpose_map_use* use);

/* Fits the pose of the camera as dotpose_space_fit does, but with the dot positions from the map.
 * If `use` is not DOTPOSE_MAP_USED, the result is the pose that dotpose_space_fit would return.
 * Returns the same statuses as dotpose_space_fit. */
dotpose_status dotpose_print_map_fit_space(const dotpose_print_map* map,
                                           const dotpose_locator* locator,
                                           const dotpose_space_camera* camera,
                                           const uint8_t* pixels, int32_t width_px,
                                           int32_t height_px, ptrdiff_t stride_bytes,
                                           dotpose_space_pose* pose, dotpose_map_use* use);

#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#pragma GCC visibility pop
#endif

#endif
