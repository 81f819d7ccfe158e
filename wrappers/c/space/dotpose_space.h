/* Poses in space for C99 and C++: position and rotation of a camera over the paper, in six degrees
 * of freedom (docs/pose-in-space.md).
 *
 *     dotpose_space_camera camera;
 *     dotpose_space_camera_init(&camera, sizeof camera, 640, 480, focal_px);
 *     dotpose_options options;
 *     dotpose_options_init(&options, sizeof options);
 *     dotpose_space_use_camera(&camera, &options);
 *     dotpose_locator_create(DOTPOSE_KIND_LARGE, &options, &locator);
 *     ...
 *     dotpose_space_pose pose;
 *     dotpose_space_pose_init(&pose, sizeof pose);
 *     if (dotpose_locate(locator, pixels, 640, 480, 640, NULL, &fix) == DOTPOSE_OK &&
 *         dotpose_space_fit(locator, &camera, pixels, 640, 480, 640, &pose) == DOTPOSE_OK &&
 *         !pose.is_ambiguous)
 *         printf("height %.3f mm, tilt %.3f rad\n", -pose.z_mm, pose.tilt_rad);
 *
 * Link with the CMake target dotpose::c_space. Unlike libdotpose_c, this library depends on the C++
 * standard library and allocates memory. Its functions neither throw nor print.
 *
 * Coordinate frames, all right-handed:
 * - Camera: the origin is the projection centre, x is along the image x axis, y is down in the
 *   image, and z is forward along the optical axis.
 * - Pattern: x right, y DOWN, z INTO the paper, in mm. A camera above the paper has z < 0. */
#ifndef DOTPOSE_SPACE_H
#define DOTPOSE_SPACE_H

#include <dotpose.h>

#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* A camera (80 bytes). */
typedef struct dotpose_space_camera {
    uint32_t size;           /*  0: set by dotpose_space_camera_init */
    int32_t width_px;        /*  4 */
    int32_t height_px;       /*  8 */
    int32_t reserved;        /* 12: zero */
    double focal_u_px;       /* 16: focal length along the image x axis */
    double focal_v_px;       /* 24: focal length along the image y axis */
    double axis_u_px;        /* 32: image point on the optical axis, without distortion */
    double axis_v_px;        /* 40 */
    double lens_k_per_px2;   /* 48: radial distortion, negative for barrel distortion */
    double lens_centre_u_px; /* 56: distortion centre */
    double lens_centre_v_px; /* 64 */
    double print_scale;      /* 72: printed length divided by nominal length */
} dotpose_space_camera;

/* Sets up a camera with square pixels, an optical axis through the image centre, and no distortion.
 * `bytes` is the caller's sizeof(dotpose_space_camera). */
dotpose_status dotpose_space_camera_init(dotpose_space_camera* camera, size_t bytes,
                                         int32_t width_px, int32_t height_px, double focal_px);

/* Sets the options that a locator for this camera needs: the lens and `show_stages`. */
dotpose_status dotpose_space_use_camera(const dotpose_space_camera* camera,
                                        dotpose_options* options);

/* A pose in space (488 bytes). */
typedef struct dotpose_space_pose {
    uint32_t size; /*  0: set by dotpose_space_pose_init */
    int32_t dots;  /*  4: number of dots used */
    /* 1 if there is a second pose and `second_odds` exceeds 2^-30, so either pose may be correct.
     * Otherwise 0. */
    int32_t is_ambiguous; /* 8 */
    int32_t has_second;   /* 12: 1 if the members `second_` are valid, else 0 */
    /* Position of the projection centre in the pattern. */
    double x_mm; /* 16 */
    double y_mm; /* 24 */
    double z_mm; /* 32: negative above the paper */
    /* Rotation from the camera frame to the pattern: unit quaternion (x, y, z, w) with w >= 0. */
    double quaternion_xyzw[4]; /* 40 */
    double tilt_rad;           /* 72: angle between the optical axis and the normal of the paper */
    /* Direction on the paper in which the camera leans, clockwise from +x. */
    double azimuth_rad; /* 80 */
    /* Angle of the image x axis on the paper after removal of the tilt, clockwise from +x. */
    double turn_rad; /* 88 */
    /* Covariance of the position (mm) and of a small rotation (rad) about the axes of the CAMERA
     * frame, row by row. */
    double covariance_mm_rad[36]; /* 96 */
    double residual_px;           /* 384: rms residual of the dots, per axis */
    /* Likelihood of the second pose divided by the likelihood of the first pose. 0 if there is no
     * second pose. */
    double second_odds;               /* 392 */
    double second_position_mm[3];     /* 400 */
    double second_quaternion_xyzw[4]; /* 424 */
    double reserved[4];               /* 456: zero */
} dotpose_space_pose;

/* Sets up a pose. `bytes` is the caller's sizeof(dotpose_space_pose). */
dotpose_status dotpose_space_pose_init(dotpose_space_pose* pose, size_t bytes);

/* Fits the pose of the camera to all dots of the image that the locator located most recently. The
 * arguments must be that image and the camera that was passed to dotpose_space_use_camera. The pose
 * is written only if the status is OK. Returns
 * - OK,
 * - NO_FIX if the last image was not located or if the spacing of the sheet is not known,
 * - TOO_FEW_DOTS if the dots do not determine a pose,
 * - BAD_VALUE if a member of the camera is out of range, or if the size of the image differs from
 *   that of the camera,
 * - WRONG_KIND for device locators, and for locators without `show_stages`,
 * - OUT_OF_MEMORY, or another misuse status. */
dotpose_status dotpose_space_fit(const dotpose_locator* locator, const dotpose_space_camera* camera,
                                 const uint8_t* pixels, int32_t width_px, int32_t height_px,
                                 ptrdiff_t stride_bytes, dotpose_space_pose* pose);

/* A pen that contains the camera (64 bytes). */
typedef struct dotpose_space_pen {
    uint32_t size;    /*  0: set by dotpose_space_pen_init */
    int32_t reserved; /*  4: zero */
    /* Position of the tip in the camera frame (tip_mm in the camera file). */
    double x_mm; /*  8 */
    double y_mm; /* 16 */
    double z_mm; /* 24 */
    /* Measured height of the tip while the pen rests on the paper (tip_rest_mm in the camera
     * file). */
    double rest_mm;     /* 32 */
    double sigma_mm[3]; /* 40: standard deviations of x_mm, y_mm and z_mm */
} dotpose_space_pen;

/* Sets all members except `size` to 0. `bytes` is the caller's sizeof(dotpose_space_pen). */
dotpose_status dotpose_space_pen_init(dotpose_space_pen* pen, size_t bytes);

/* Position of a pen tip in the pattern (104 bytes). */
typedef struct dotpose_space_tip {
    uint32_t size;            /*  0: set by dotpose_space_tip_init */
    int32_t reserved;         /*  4: zero */
    double x_mm;              /*  8 */
    double y_mm;              /* 16 */
    double height_mm;         /* 24: height above the paper, 0 while the pen rests on the paper */
    double covariance_mm2[9]; /* 32: covariance of x, y and the height, row by row */
} dotpose_space_tip;

/* Sets up a tip. `bytes` is the caller's sizeof(dotpose_space_tip). */
dotpose_status dotpose_space_tip_init(dotpose_space_tip* tip, size_t bytes);

/* Computes the position of the tip from a pose that dotpose_space_fit returned. The pose should not
 * be ambiguous. Returns OK, NO_FIX if the pose was not fitted, BAD_VALUE if a member of the pen is
 * not finite, or another misuse status. The tip is written only if the status is OK. */
dotpose_status dotpose_space_tip_of(const dotpose_space_pose* pose, const dotpose_space_pen* pen,
                                    dotpose_space_tip* tip);

/* Detects with hysteresis whether the pen touches the paper. On entry, `is_down` must contain the
 * result for the previous pose, or 1 before the first pose. On return, `is_down` is 1 if the pen is
 * on the paper, and otherwise 0. A pen on the paper is reported as lifted when its height reaches
 * 0.05 mm plus three standard deviations. A lifted pen is reported as touching the paper when its
 * height falls below 0.05 mm. */
dotpose_status dotpose_space_update_contact(const dotpose_space_tip* tip, int32_t* is_down);

#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#pragma GCC visibility pop
#endif

#endif
