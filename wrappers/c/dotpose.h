/* dotpose for C99 and C++: computes the camera pose from one small image of a sheet printed with
 * dots.
 *
 *     dotpose_locator* locator = NULL;
 *     if (dotpose_locator_create(DOTPOSE_KIND_LARGE, NULL, &locator) != DOTPOSE_OK) return 1;
 *     dotpose_fix fix;
 *     dotpose_fix_init(&fix, sizeof fix);
 *     if (dotpose_locate(locator, pixels, width, height, width, NULL, &fix) == DOTPOSE_OK)
 *         printf("x %.3f mm, y %.3f mm, angle %.4f rad\n", fix.x_mm, fix.y_mm, fix.theta_rad);
 *     else
 *         puts(dotpose_status_message(fix.status));
 *     dotpose_locator_destroy(locator);
 *
 * Link with -ldotpose_c -lm. No C++ library is needed. On a microcontroller, provide static memory
 * (`dotpose_device_init`) and push the rows as the camera delivers them (`dotpose_begin`,
 * `dotpose_push_row`, `dotpose_finish`).
 *
 * Every function that can fail returns a dotpose_status: DOTPOSE_OK (0), the reason why a frame has
 * no pose, or the kind of misuse. No function throws or prints. Only
 * dotpose_locator_create allocates memory. There are no globals, so different objects may be used
 * concurrently.
 *
 * Coordinates: in the pattern frame, x points right and y points DOWN, as the printed page is read.
 * In images, u points right and v points down. The centre of the first pixel is (0, 0). Fixed
 * point: the suffix _qN marks a value in units of 2^-N. The suffix _bam marks a binary angle, where
 * 2^31 is half a turn.
 *
 * Layout: all fields have a fixed size and offset on every platform, without padding. A struct
 * whose first member is `size` may gain members at its end. Other structs change only together with
 * the shared library's version number. */
#ifndef DOTPOSE_H
#define DOTPOSE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* ---- Statuses ------------------------------------------------------------------------------- */

/* Result of a call, or the reason why it failed. The numbers never change. */
typedef int32_t dotpose_status;
enum {
    /* Located. */
    DOTPOSE_OK = 0,
    /* An option is out of its range, or the image view has no pixels. */
    DOTPOSE_BAD_ARGUMENT = 1,
    /* The image is too small to show 8 x 8 dots. */
    DOTPOSE_IMAGE_TOO_SMALL = 2,
    /* The image is larger than the memory supports. */
    DOTPOSE_IMAGE_TOO_LARGE = 3,
    /* The image has no dark marks on a lighter background. */
    DOTPOSE_NO_CONTRAST = 4,
    /* Too few dots. */
    DOTPOSE_TOO_FEW_DOTS = 5,
    /* The dots do not form a regular grid. */
    DOTPOSE_NO_GRID = 6,
    /* The dots are on the grid intersections and carry no symbols. */
    DOTPOSE_NO_DISPLACEMENT = 7,
    /* Fewer than 8 x 8 dots of one grid are in view. */
    DOTPOSE_GRID_TOO_SMALL = 8,
    /* No frame has been located yet. */
    DOTPOSE_NOT_RUN = 9,
    /* The pattern is mirrored. */
    DOTPOSE_MIRRORED = 10,
    /* A window must have 6 to 32 columns and rows. */
    DOTPOSE_BAD_WINDOW = 11,
    /* The position code does not contain the symbols. */
    DOTPOSE_NOT_IN_CODE = 12,
    /* The position code contains the symbols at several places. */
    DOTPOSE_AMBIGUOUS = 13,
    /* A position was found, but it may be wrong with more than the allowed probability. */
    DOTPOSE_NOT_CERTAIN = 14,
    /* The pattern is not where it was predicted. */
    DOTPOSE_NOT_TRACKED = 15,
    /* Places of two codes explain the dots about equally well; name the code, or show more dots. */
    DOTPOSE_AMBIGUOUS_CODE = 16,
    /* An unknown status, which a newer version of dotpose has added. */
    DOTPOSE_OTHER = 255,
    /* Misuse of this header's functions. */
    DOTPOSE_NULL_POINTER = 1000,
    DOTPOSE_NOT_ALIGNED = 1001, /* the address of the memory is not a multiple of 8 */
    DOTPOSE_TOO_LITTLE_MEMORY = 1002,
    DOTPOSE_OUT_OF_MEMORY = 1003,   /* the system is out of memory */
    DOTPOSE_NOT_INITIALIZED = 1004, /* the object was not set up, or was destroyed */
    DOTPOSE_BAD_SIZE = 1005,        /* the member `size` matches no version of the struct */
    DOTPOSE_BAD_VALUE = 1006,       /* an argument is out of its range */
    DOTPOSE_BAD_STRIDE = 1007,      /* rows overlap */
    DOTPOSE_WRONG_KIND = 1008,      /* this kind of locator does not support the call */
    DOTPOSE_NO_FRAME = 1009,        /* no frame was begun, or all its rows were pushed */
    DOTPOSE_NO_FIX = 1010,          /* a fix with status ok is required */
    DOTPOSE_NO_PACKET = 1011        /* the byte did not complete a packet; not a misuse */
};

/* Returns a status identifier, for example "too_few_dots". Never returns null. */
const char* dotpose_status_name(dotpose_status status);
/* Returns a status description: one sentence without a full stop. Never returns null. */
const char* dotpose_status_message(dotpose_status status);

/* Version of this header. DOTPOSE_VERSION_NUMBER increases with every version, and can be compared
 * by the preprocessor. */
#define DOTPOSE_VERSION "0.2.0"
#define DOTPOSE_VERSION_NUMBER 200

/* Returns the library version, such as "0.2.0". */
const char* dotpose_version(void);

/* ---- The position code ---------------------------------------------------------------------- */

/* Variants of the position code. A sheet is printed in one of them. */
enum {
    DOTPOSE_CODE_DETECT = -1,  /* in options: detect the code from the frames */
    DOTPOSE_CODE_ANOTO = 0,    /* default for new sheets */
    DOTPOSE_CODE_LIBDOTS = 1,  /* printed by libdots and other open tools */
    DOTPOSE_CODE_MICRODOTS = 2 /* printed by py-microdots */
};

/* Value of `bits_per_error` in options: measure the error rate over all frames so far. Device
 * locators treat it as unknown. */
#define DOTPOSE_MEASURED_ERROR_RATE (-1)

#define DOTPOSE_POSITIONS_PER_AXIS 410815348u
#define DOTPOSE_SECTIONS 63u

/* Place in the code (16 bytes). */
typedef struct dotpose_place {
    uint32_t x; /*  0: column, less than DOTPOSE_POSITIONS_PER_AXIS */
    uint32_t y; /*  4: row, less than DOTPOSE_POSITIONS_PER_AXIS */
    uint32_t u; /*  8: section along x, less than DOTPOSE_SECTIONS */
    uint32_t v; /* 12: section along y, less than DOTPOSE_SECTIONS */
} dotpose_place;

/* Direction in which a dot is displaced from its intersection. */
enum {
    DOTPOSE_SYMBOL_UP = 0,
    DOTPOSE_SYMBOL_LEFT = 1,
    DOTPOSE_SYMBOL_RIGHT = 2,
    DOTPOSE_SYMBOL_DOWN = 3
};

/* Returns the direction in which the dot at `place` is displaced: `dx` to the right and `dy` down.
 * Either `dx` or `dy` is -1 or 1, and the other is 0. The unit is the displacement length, usually
 * a sixth of the spacing. Returns BAD_VALUE if the code or the place does not exist. */
dotpose_status dotpose_displacement(int32_t code, const dotpose_place* place, int32_t* dx,
                                    int32_t* dy);

/* Writes the symbols (DOTPOSE_SYMBOL_) of columns x rows dots, row by row from `top_left`, for
 * example to print a sheet. `bytes` is the size of `symbols`. Returns TOO_LITTLE_MEMORY if `bytes`
 * is less than columns x rows. `columns` and `rows` must be from 1 to 65535. Treats both axes as
 * cyclic, as locators do. */
dotpose_status dotpose_symbols(int32_t code, const dotpose_place* top_left, int32_t columns,
                               int32_t rows, uint8_t* symbols, size_t bytes);

/* ---- Results -------------------------------------------------------------------------------- */

/* Mapping from image points to the paper plane, in spacings (44 bytes). For a point (u, v), in px
 * relative to `centre`:
 *     plane = at_centre + (du u + dv v) / (1 + perspective . (u, v) + lens (u^2 + v^2)). */
typedef struct dotpose_plane {
    int32_t centre_u_q8;       /*  0: px */
    int32_t centre_v_q8;       /*  4 */
    int32_t at_centre_x_q16;   /*  8: spacings */
    int32_t at_centre_y_q16;   /* 12 */
    int32_t du_x_q24;          /* 16: spacings per px to the right */
    int32_t du_y_q24;          /* 20 */
    int32_t dv_x_q24;          /* 24: spacings per px down */
    int32_t dv_y_q24;          /* 28 */
    int32_t perspective_u_q30; /* 32: per px */
    int32_t perspective_v_q30; /* 36 */
    int32_t lens_q40;          /* 40: per px^2 */
} dotpose_plane;

/* Attempts that can produce a fix, for the member `attempt`. */
enum {
    /* The dots were measured at their predicted positions. */
    DOTPOSE_ATTEMPT_TRACKED = 0,
    /* The grid was found in patches of the image, without a prediction. */
    DOTPOSE_ATTEMPT_FIRST = 1,
    /* The grid was found in the filtered image. */
    DOTPOSE_ATTEMPT_SECOND = 2,
    /* The frame was located in integer arithmetic, as on a microcontroller. */
    DOTPOSE_ATTEMPT_DEVICE = 3
};

/* Flatness of the paper in view, for the member `surface`. */
enum {
    /* One plane explains all dots. */
    DOTPOSE_SURFACE_EVEN = 0,
    /* One part of the paper is displaced, for example at a step between two sheets; the pose
     * refers to the part under the reference point. */
    DOTPOSE_SURFACE_DIVIDED = 1,
    /* Neighbouring dots have correlated residuals, as on wrinkled paper; the covariance includes
     * the effect of this correlation. */
    DOTPOSE_SURFACE_UNEVEN = 2
};

/* Places considered possible, for the member `prior`. */
enum {
    /* All places of the code. */
    DOTPOSE_PRIOR_PLANE = 0,
    /* Places on the known sheets, after the bits of the frame ruled out other sheets. */
    DOTPOSE_PRIOR_SHEETS = 1,
    /* Places on the known sheets, because the caller declared other sheets impossible. */
    DOTPOSE_PRIOR_ONLY_SHEETS = 2
};

/* The pose computed from one frame, and the evidence for it. The struct has 256 bytes. Its members
 * are listed in include/dotpose/fix_fields.def.
 *
 * The pose is the pattern position at the reference point of the image, by default the image
 * centre. If `status` is not DOTPOSE_OK, x_mm, y_mm and theta_rad are NaN. Only `status`,
 * `dots_seen` and the counts from completed stages are then valid. */
typedef struct dotpose_fix {
    /* Size of this struct; dotpose_fix_init sets it. */
    uint32_t size; /* 0 */
    /* ok, or the reason why there is no pose. */
    dotpose_status status; /* 4 */
    /* x of the pattern point under the reference point, to the right, in mm; NaN if the spacing of
     * the sheet is not known. */
    double x_mm; /* 8 */
    /* y of the pattern point under the reference point, DOWN the page, in mm; NaN if the spacing
     * of the sheet is not known. */
    double y_mm; /* 16 */
    /* Angle of the image x axis in the pattern, from +x towards +y: clockwise as seen on the
     * paper, in [-pi, pi). */
    double theta_rad; /* 24 */
    /* Upper bound on the probability that the position is wrong. */
    double p_wrong; /* 32 */
    /* Binary logarithm of the upper bound p_wrong. */
    int32_t p_wrong_log2; /* 40 */
    /* Number of dots found in the image, as dot-sized blobs or at the places that the code
     * predicts. */
    int32_t dots_seen; /* 44 */
    /* Number of dots to which the pose was fitted. */
    int32_t dots_used; /* 48 */
    /* Attempt that produced the fix: DOTPOSE_ATTEMPT_. */
    int32_t attempt; /* 52 */
    /* Flatness of the paper in view, as determined from the dots: DOTPOSE_SURFACE_. */
    int32_t surface; /* 56 */
    /* Number of bits that contradict the position; each cell read has two bits. */
    int32_t bit_errors; /* 60 */
    /* Root mean square distance of the dots from their fitted places, per axis, in px. */
    float residual_px; /* 64 */
    /* Covariance of x, y and theta, row by row, in mm and rad; zeros if it is not known, as on
     * devices. */
    float covariance[9]; /* 68 */
    /* Section in which the position was read, along x, 0 to 62. */
    uint32_t section_u; /* 104 */
    /* Section in which the position was read, along y, 0 to 62. */
    uint32_t section_v; /* 108 */
    /* Column of the intersection to the upper left of the reference point. */
    uint32_t cell_x; /* 112 */
    /* Row of the intersection to the upper left of the reference point. */
    uint32_t cell_y; /* 116 */
    /* Distance of the reference point from this intersection, to the right, in 2^-16 spacing. */
    uint32_t fraction_x_q16; /* 120 */
    /* Distance of the reference point from this intersection, down, in 2^-16 spacing. */
    uint32_t fraction_y_q16; /* 124 */
    /* theta_rad as a binary angle: 2^31 is half a turn. */
    int32_t theta_bam; /* 128 */
    /* Grid spacing in the image, in 2^-16 px. */
    int32_t spacing_px_q16; /* 132 */
    /* Spacing of the printed grid in nm, from the options; 0 if unknown. */
    int32_t spacing_nm; /* 136 */
    /* Place of the origin of pattern_from_image in the code. */
    dotpose_place place; /* 140 */
    /* Map from the image to the pattern, in spacings relative to place. */
    dotpose_plane pattern_from_image; /* 156 */
    /* Typical distance of a dot from its intersection, in 2^-16 spacing. */
    int32_t displacement_q16; /* 200 */
    /* Covariance of x, y and theta, row by row, in spacings and rad. */
    float covariance_grid[9]; /* 204 */
    /* Places that were considered possible when p_wrong was computed: DOTPOSE_PRIOR_. */
    int32_t prior; /* 240 */
    /* Number of frames whose bits determined the position; more than 1 only if the motion between
     * the frames was given. */
    int32_t frames; /* 244 */
    /* Change of theta during the readout of a rolling shutter, from the first to the last row, if
     * the frame shows a significant rotation. */
    float readout_turn_rad; /* 248 */
    /* Zero. */
    int32_t reserved; /* 252 */
} dotpose_fix;

/* Sets up a fix before the first call that writes to it. `bytes` is the caller's
 * sizeof(dotpose_fix). If the size of a fix matches no version of the struct, functions return
 * BAD_SIZE and leave the fix unchanged. */
dotpose_status dotpose_fix_init(dotpose_fix* fix, size_t bytes);

/* Expected position of the pattern in the next frame (76 bytes). */
typedef struct dotpose_prediction {
    dotpose_plane pattern_from_image; /*  0 */
    dotpose_place place;              /* 44 */
    int32_t displacement_q16;         /* 60 */
    int32_t sigma_q16;                /* 64: standard deviation of x and y, in spacings */
    int32_t sigma_theta_bam;          /* 68: standard deviation of theta */
    float readout_turn_rad;           /* 72: change of theta during the readout of a frame */
} dotpose_prediction;

/* Predicts that the next frame has the same pose as `fix`. A frame that confirms its prediction is
 * located much faster. Any other frame is located as if it had no prediction. For frames that are
 * pushed row by row, see dotpose_begin. Returns NO_FIX if the fix is not ok. */
dotpose_status dotpose_prediction_like(const dotpose_fix* fix, dotpose_prediction* prediction);

/* Moves a prediction by `by_x_q16` and `by_y_q16` spacings in the pattern frame, and turns it by
 * `turn_bam` about the image point (`pivot_u_q8`, `pivot_v_q8`). `code` is the code of the sheet.
 * Returns BAD_VALUE, and does not change the prediction, if the movement along an axis exceeds 4096
 * spacings or a coordinate of the image point exceeds 8192 px, in either direction. */
dotpose_status dotpose_prediction_move(dotpose_prediction* prediction, int32_t code,
                                       int32_t by_x_q16, int32_t by_y_q16, int32_t turn_bam,
                                       int32_t pivot_u_q8, int32_t pivot_v_q8);

/* ---- Locators ------------------------------------------------------------------------------- */

/* Kinds of locators, and the memory they need. */
enum {
    DOTPOSE_KIND_DEVICE = 0, /* microcontrollers: integers only, images up to 188 px wide, 13 KB */
    DOTPOSE_KIND_SMALL = 1,  /* images up to 188 px wide, 330 KB */
    DOTPOSE_KIND_LARGE = 2,  /* images up to 4096 x 4096 px, 4.4 MB */
    DOTPOSE_KIND_DEVICE_160X120 = 3, /* like DEVICE, for images up to 160 px wide, 11 KB */
    DOTPOSE_KIND_DEVICE_320X240 = 4, /* like DEVICE, for images up to 320 x 240 px, 23 KB */
    /* Like DEVICE, but for images from optical mice: up to 36 px wide, known sheets only, 5 KB. */
    DOTPOSE_KIND_DEVICE_36X36 = 5
};

/* Attempts that a locator makes. Device locators always make the device attempt. */
enum {
    DOTPOSE_EFFORT_DEVICE = 0, /* one attempt in integer arithmetic, as on a device */
    DOTPOSE_EFFORT_ONCE = 1,   /* only the first attempt */
    DOTPOSE_EFFORT_TWICE = 2   /* if the first attempt fails, also tries the filtered frame */
};

/* Dots used to read the position. */
enum {
    DOTPOSE_DECODER_WINDOW = 0, /* the best window of 8 x 8 dots, as in the paper */
    DOTPOSE_DECODER_ALL = 1     /* all dots in view */
};

/* Options for a locator (96 bytes). include/dotpose/locator_options.hpp explains what each option
 * does and when to change it. */
typedef struct dotpose_options {
    uint32_t size; /* 0: set by dotpose_options_init */
    /* Code of the sheet: DOTPOSE_CODE_. The default, DETECT, detects the code from all images so
     * far. Device locators cannot detect the code and use anoto instead. */
    int32_t code;             /*  4 */
    int32_t effort;           /*  8: DOTPOSE_EFFORT_; default twice */
    int32_t decoder;          /* 12: DOTPOSE_DECODER_; default all */
    double spacing_mm;        /* 16: spacing of the printed grid; default 0.508, 0 if unknown */
    double lens_k_per_px2;    /* 24: radial distortion, negative for barrel distortion */
    double lens_centre_dx_px; /* 32: distortion centre, relative to the image centre */
    double lens_centre_dy_px; /* 40 */
    double reference_dx_px;   /* 48: reference point of the pose, relative to the image centre */
    double reference_dy_px;   /* 56 */
    double max_p_wrong;       /* 64: maximum accepted p_wrong; default 1e-9 */
    double max_bit_errors;    /* 72: maximum fraction of wrong bits; default 0.18 */
    int32_t min_contrast;     /* 80: minimum contrast, in grey levels; default 0 */
    int32_t min_dots;         /* 84: minimum number of dots; default 40 */
    int32_t show_stages;      /* 88: if 1, keeps all dots for dotpose_dots (slower); default 0 */
    int32_t bits_per_error;   /* 92: minimum number of bits per misread bit; default 0, unknown;
                               *     DOTPOSE_MEASURED_ERROR_RATE measures it over all frames */
} dotpose_options;

/* Sets the default options. `bytes` is the caller's sizeof(dotpose_options). */
dotpose_status dotpose_options_init(dotpose_options* options, size_t bytes);
/* Returns the name of the first member that is out of range and would cause BAD_ARGUMENT. Returns
 * null if all members are valid. */
const char* dotpose_bad_option(const dotpose_options* options);

/* Opaque locator. It must not be used by several threads at the same time. */
typedef struct dotpose_locator dotpose_locator;

/* Sizes for static memory. Each size is at least dotpose_locator_bytes() for its kind.
 *     static uint64_t memory[DOTPOSE_DEVICE_BYTES / 8]; */
#define DOTPOSE_DEVICE_BYTES (sizeof(void*) == 4 ? 12736u : 13504u)
#define DOTPOSE_DEVICE_36X36_BYTES (sizeof(void*) == 4 ? 4768u : 5040u)
#define DOTPOSE_DEVICE_160X120_BYTES (sizeof(void*) == 4 ? 10768u : 12000u)
#define DOTPOSE_DEVICE_320X240_BYTES (sizeof(void*) == 4 ? 23232u : 25232u)

/* Returns the number of bytes that a locator needs. Returns 0 for an unknown kind. */
size_t dotpose_locator_bytes(int32_t kind);

/* Sets up a locator in memory provided by the caller. The address must be a multiple of 8. The
 * memory must not be modified or copied while the locator is in use. The memory may be released
 * without destroying the locator. If `options` is null, uses the defaults. */
dotpose_status dotpose_locator_init(void* memory, size_t bytes, int32_t kind,
                                    const dotpose_options* options, dotpose_locator** locator);

/* Sets up a locator of DOTPOSE_KIND_DEVICE. If a program sets up locators only with this function,
 * the linker can remove the code of the other kinds as unused sections. */
dotpose_status dotpose_device_init(void* memory, size_t bytes, const dotpose_options* options,
                                   dotpose_locator** locator);
/* Like dotpose_device_init, but for DOTPOSE_KIND_DEVICE_36X36, DOTPOSE_KIND_DEVICE_160X120 and
 * DOTPOSE_KIND_DEVICE_320X240. */
dotpose_status dotpose_device_36x36_init(void* memory, size_t bytes, const dotpose_options* options,
                                         dotpose_locator** locator);
dotpose_status dotpose_device_160x120_init(void* memory, size_t bytes,
                                           const dotpose_options* options,
                                           dotpose_locator** locator);
dotpose_status dotpose_device_320x240_init(void* memory, size_t bytes,
                                           const dotpose_options* options,
                                           dotpose_locator** locator);

/* Creates a locator in allocated memory. */
dotpose_status dotpose_locator_create(int32_t kind, const dotpose_options* options,
                                      dotpose_locator** locator);
/* Destroys a locator. Frees its memory if dotpose_locator_create allocated it. Does nothing if
 * `locator` is null. */
void dotpose_locator_destroy(dotpose_locator* locator);

/* Changes the options. Discards an unfinished frame and restarts the measurement of the error
 * rate. */
dotpose_status dotpose_set_options(dotpose_locator* locator, const dotpose_options* options);

/* Printed rectangle of the code plane (20 bytes). */
typedef struct dotpose_region {
    uint8_t code;      /*  0: DOTPOSE_CODE_ of the sheet */
    uint8_t section_u; /*  1: section of the code, 0 to 62 */
    uint8_t section_v; /*  2 */
    uint8_t reserved;  /*  3: zero */
    uint32_t first_x;  /*  4: upper left intersection */
    uint32_t first_y;  /*  8 */
    uint32_t columns;  /* 12: at least 1 */
    uint32_t rows;     /* 16: at least 1 */
} dotpose_region;

/* Whether sheets other than the known sheets may be in view. */
enum {
    /* Other sheets are also located if enough of their dots are in view. */
    DOTPOSE_OTHERS_POSSIBLE = 0,
    /* Only places on known sheets are possible. */
    DOTPOSE_OTHERS_IMPOSSIBLE = 1
};

/* Sets the regions of the sheets that may be in view. About 30 dots in view, in images of at least
 * 24 x 24 px, are then enough for a fix. `others` is one of the DOTPOSE_OTHERS_ values. The locator
 * reads `regions` in each frame, so the array must remain valid and unchanged. If `count` is 0, all
 * places are possible again. Device locators search only the regions in their code. Discards an
 * unfinished frame. Returns BAD_VALUE, and keeps the previous regions, if a region is empty, is not
 * inside the plane, or has a code or section that does not exist. */
dotpose_status dotpose_set_known(dotpose_locator* locator, const dotpose_region* regions,
                                 size_t count, int32_t others);

/* Locates the pattern in an 8-bit grey image with dark dots on light paper. `prediction` may be
 * null. Row v begins at pixels + v * stride_bytes. Returns the fix's status. */
dotpose_status dotpose_locate(dotpose_locator* locator, const uint8_t* pixels, int32_t width_px,
                              int32_t height_px, ptrdiff_t stride_bytes,
                              const dotpose_prediction* prediction, dotpose_fix* fix);

/* Camera motion since the previous image, from odometry (20 bytes). */
typedef struct dotpose_measured_motion {
    float right_mm;  /*  0: displacement of the reference point along x of the previous image */
    float down_mm;   /*  4: displacement along y of the previous image */
    float turn_rad;  /*  8: change of theta */
    float sigma_mm;  /* 12: standard deviation per axis; if too small, fixes may be wrong */
    float sigma_rad; /* 16: standard deviation of the rotation */
} dotpose_measured_motion;

/* Locates an image. `since_last` is the camera motion since the previous image. Consecutive images
 * that are located with this function form a series. If the position from this image alone is not
 * certain, also uses the previous images in the series. The fix's `frames` is the number of images
 * used. The options must contain the spacing. Returns WRONG_KIND for device locators. */
dotpose_status dotpose_locate_moved(dotpose_locator* locator, const uint8_t* pixels,
                                    int32_t width_px, int32_t height_px, ptrdiff_t stride_bytes,
                                    const dotpose_measured_motion* since_last, dotpose_fix* fix);

/* Returns the code set in the options or, if the code is detected, the code of the last image. Pass
 * this code to dotpose_packet_of, and to dotpose_prediction_move if the prediction was made from
 * the fix of the last image. */
dotpose_status dotpose_code_of(const dotpose_locator* locator, int32_t* code);

/* Locate an image row by row: call dotpose_begin, then dotpose_push_row for each row from the top,
 * then dotpose_finish. The pixels of a row need not remain valid after the call. `prediction` may
 * be null. If a frame does not confirm its prediction, a device locator returns not_tracked. Other
 * locators locate the frame without the prediction. */
dotpose_status dotpose_begin(dotpose_locator* locator, int32_t width_px, int32_t height_px,
                             const dotpose_prediction* prediction);
dotpose_status dotpose_push_row(dotpose_locator* locator, const uint8_t* pixels);
dotpose_status dotpose_finish(dotpose_locator* locator, dotpose_fix* fix);

/* Dot found in an image (16 bytes). */
typedef struct dotpose_dot {
    float u_px;      /*  0: undistorted position */
    float v_px;      /*  4 */
    int32_t mass;    /*  8: summed darkness of its pixels, in grey levels */
    int32_t area_px; /* 12 */
} dotpose_dot;

/* Writes up to `capacity` dots of the last frame to `dots`. Sets `count` to the total number of
 * dots, which may exceed `capacity`. `dots` may be null if `capacity` is 0. Some attempts store
 * their dots only if the show_stages option is set. Without this option, `count` can be 0. Returns
 * WRONG_KIND for device locators. */
dotpose_status dotpose_dots(const dotpose_locator* locator, dotpose_dot* dots, int32_t capacity,
                            int32_t* count);

/* ---- Sheets whose code is not known --------------------------------------------------------- */

/* Evidence for each code, accumulated over all frames of one sheet so far. Initialise the struct
 * with zeros:
 *     dotpose_code_evidence evidence = {{0}}; */
typedef struct dotpose_code_evidence {
    int32_t state[9];
} dotpose_code_evidence;

/* Code in which a frame was read, and a possible alternative (28 bytes). */
typedef struct dotpose_code_reading {
    int32_t code;        /*  0: DOTPOSE_CODE_ in which the frame was read */
    int32_t has_other;   /*  4: 1 if a place in another code also explains the frame, else 0 */
    int32_t other_code;  /*  8: DOTPOSE_CODE_ of the alternative */
    dotpose_place other; /* 12: place in the other code that corresponds to the fix's cell */
} dotpose_code_reading;

/* Locates an image whose code is not known, and updates the evidence. If two codes explain the
 * frame about equally well, the status is ambiguous_code. Sets the locator's code to the code that
 * was read. The prediction must refer to the code that the locator used before this call.
 * `prediction`, `evidence` and `reading` may be null. If `evidence` is null, uses only this frame.
 * Returns WRONG_KIND for device locators. */
dotpose_status dotpose_locate_any_code(dotpose_locator* locator, const uint8_t* pixels,
                                       int32_t width_px, int32_t height_px, ptrdiff_t stride_bytes,
                                       const dotpose_prediction* prediction,
                                       dotpose_code_evidence* evidence,
                                       dotpose_code_reading* reading, dotpose_fix* fix);

/* Locates an image using the code set in the locator's options. Reports in `reading` whether
 * another code also explains the image. `reading` may be null. Returns WRONG_KIND for device
 * locators. */
dotpose_status dotpose_locate_in_code(dotpose_locator* locator, const uint8_t* pixels,
                                      int32_t width_px, int32_t height_px, ptrdiff_t stride_bytes,
                                      dotpose_code_reading* reading, dotpose_fix* fix);

/* Sets `code` to the most likely code, and `p_wrong` to the probability that the sheet is printed
 * in a different code. Without evidence, all codes are equally probable: the result is anoto, and
 * `p_wrong` is 2/3. */
dotpose_status dotpose_code_likeliest(const dotpose_code_evidence* evidence, int32_t* code,
                                      float* p_wrong);

/* ---- Trackers ------------------------------------------------------------------------------- */

/* Follows a robot from frame to frame. The contents are private. The struct may be copied.
 *
 *     dotpose_tracker tracker;
 *     dotpose_tracker_init(&tracker, NULL);
 *     for (;;) {
 *         int ok = dotpose_locate(locator, ..., has_prediction ? &prediction : NULL, &fix) == 0;
 *         if (ok) dotpose_sighting_of(&fix, time_us, &sighting);
 *         dotpose_tracker_update(&tracker, time_us, ok ? &sighting : NULL, &track);
 *         has_prediction = ok && dotpose_tracker_predict(&tracker, next_us, &fix, &sighting,
 *                                                        locator, &prediction) == DOTPOSE_OK;
 *     }
 *
 * See include/dotpose/track.hpp and docs/tracking.md. */
typedef struct dotpose_tracker {
    uint64_t state[216];
} dotpose_tracker;

/* Limits on the robot's motion, and criteria for accepting sightings (88 bytes). Each comment ends
 * with the default. */
typedef struct dotpose_track_options {
    uint32_t size;                         /*  0: set by dotpose_track_options_init */
    float acceleration_mm_s2;              /*  4: standard deviation while manoeuvring; 600 */
    float angular_acceleration_rad_s2;     /*  8: 6 */
    float max_acceleration_mm_s2;          /* 12: physical limit; 10000 */
    float max_angular_acceleration_rad_s2; /* 16: 200 */
    float max_speed_mm_s;                  /* 20: 1000 */
    float max_turn_rad_s;                  /* 24: 20 */
    float gate_sigmas;                     /* 28: 5 */
    int32_t confirmations;                 /* 32: number of sightings that confirm a jump; 3 */
    float still_mm;                        /* 36: maximum movement of a stationary robot; 0.1 */
    float still_rad;                       /* 40: 0.02 */
    float min_sigma_mm;                    /* 44: standard deviation of printing errors; 0.0002 */
    float min_sigma_rad;                   /* 48: 0.00002 */
    int32_t max_p_wrong_log2;              /* 52: limit above which a sighting is weak; -30 */
    int32_t max_weak_p_wrong_log2;         /* 56: limit for weak sightings; -10, at most -1 */
    float spacing_mm;                      /* 60: pattern spacing; 0.508 */
    int64_t lost_after_us;                 /* 64: 70000 */
    int64_t stationary_after_us;           /* 72: 500000 */
    float max_sigma_mm;                    /* 80: limit while only odometry updates the pose; 5 */
    float reserved;                        /* 84: 0 */
} dotpose_track_options;

/* Robot position and angle measured in one frame, in any plane (80 bytes). */
typedef struct dotpose_sighting {
    int64_t time_us;      /*  0: middle of the exposure; at most 2^62 in magnitude */
    int64_t x_nm;         /*  8: at most 2^60 in magnitude, like y_nm */
    int64_t y_nm;         /* 16 */
    int32_t theta_bam;    /* 24 */
    uint32_t plane;       /* 28: sightings in different planes are unrelated */
    float covariance[9];  /* 32: of x, y and theta, row by row, in mm and rad */
    int32_t p_wrong_log2; /* 68 */
    int32_t spacing_nm;   /* 72: pattern spacing */
    int32_t is_y_up;      /* 76: 1 if y points up the page in this plane, else 0 */
} dotpose_sighting;

/* The tracker's verdict on a sighting. */
enum {
    DOTPOSE_VERDICT_NONE = 0, /* there was no sighting */
    DOTPOSE_VERDICT_BELIEVED = 1,
    DOTPOSE_VERDICT_WITH_PRIOR = 2, /* weak, but certain enough given the previous position */
    DOTPOSE_VERDICT_GATED = 3,      /* at an impossible place, and not confirmed yet */
    DOTPOSE_VERDICT_TOO_WEAK = 4
};

/* Bits of `events`: changes caused by a frame. */
enum {
    DOTPOSE_EVENT_FIX = 1,        /* the robot was found, for the first time or again */
    DOTPOSE_EVENT_LOST = 2,       /* no accepted sighting for too long, or pose too uncertain */
    DOTPOSE_EVENT_KIDNAPPED = 4,  /* the robot cannot have driven to its new place */
    DOTPOSE_EVENT_STATIONARY = 8, /* the robot came to rest */
    DOTPOSE_EVENT_MOVING = 16     /* the robot moves again */
};

/* Robot state at the time of the newest frame (232 bytes). The pose is invalid while the robot is
 * lost. */
typedef struct dotpose_track {
    int64_t time_us;       /*  0 */
    double x_mm;           /*  8 */
    double y_mm;           /* 16 */
    double theta_rad;      /* 24 */
    int64_t x_nm;          /* 32: x as an exact integer */
    int64_t y_nm;          /* 40 */
    int32_t theta_bam;     /* 48 */
    uint32_t plane;        /* 52 */
    float vx_mm_s;         /* 56 */
    float vy_mm_s;         /* 60 */
    float turn_rad_s;      /* 64 */
    int32_t p_wrong_log2;  /* 68: log2 of the bound on p_wrong, including the prior */
    int32_t verdict;       /* 72: DOTPOSE_VERDICT_ */
    int32_t is_lost;       /* 76: 1 or 0 */
    int32_t is_stationary; /* 80: 1 or 0 */
    uint32_t events;       /* 84: sum of DOTPOSE_EVENT_ */
    float covariance[36];  /* 88: of x, y, theta and their velocities, row by row; mm, rad, s */
} dotpose_track;

/* Sets the default options. `bytes` is the caller's sizeof(dotpose_track_options). */
dotpose_status dotpose_track_options_init(dotpose_track_options* options, size_t bytes);

/* Sets up a tracker in the `lost` state. If `options` is null, uses the defaults. */
dotpose_status dotpose_tracker_init(dotpose_tracker* tracker, const dotpose_track_options* options);

/* Converts a fix to a sighting in the pattern frame. Returns NO_FIX if the fix is not ok, and
 * BAD_VALUE if the spacing of the fix is not known or exceeds 20 mm. */
dotpose_status dotpose_sighting_of(const dotpose_fix* fix, int64_t time_us,
                                   dotpose_sighting* sighting);

/* Updates the tracker with the next frame, and returns the new state in `track`. `sighting` is null
 * if the frame has no fix. A frame that is not newer than the last frame does not change the
 * tracker. */
dotpose_status dotpose_tracker_update(dotpose_tracker* tracker, int64_t time_us,
                                      const dotpose_sighting* sighting, dotpose_track* track);

/* Like dotpose_tracker_update, but also uses the measured motion of the robot since the previous
 * update. The motion's `right_mm` is the displacement along the image x axis. The theta of a
 * sighting is the angle of this axis. If `sighting` is null, only the motion changes the pose. */
dotpose_status dotpose_tracker_update_moved(dotpose_tracker* tracker, int64_t time_us,
                                            const dotpose_sighting* sighting,
                                            const dotpose_measured_motion* motion,
                                            dotpose_track* track);

/* Predicts the pose for the frame at `time_us`, from the newest fix and its sighting. `locator`
 * must be the locator that will locate the frame, because the prediction depends on the locator's
 * code and reference point. Returns NO_FIX if the fix is not ok. */
dotpose_status dotpose_tracker_predict(const dotpose_tracker* tracker, int64_t time_us,
                                       const dotpose_fix* newest, const dotpose_sighting* seen,
                                       const dotpose_locator* locator,
                                       dotpose_prediction* prediction);

/* ---- Pose packets: docs/pose-packet.md ------------------------------------------------------ */

#define DOTPOSE_PACKET_BYTES 32

/* Contents of a pose packet, which reports the result for one frame (52 bytes). If `status` is not
 * DOTPOSE_OK, only the members before `cell_x` are valid. */
typedef struct dotpose_packet {
    uint32_t sequence;       /*  0: frame counter, 16 bits; gaps indicate lost packets */
    uint32_t time_us;        /*  4: on the sender's clock */
    dotpose_status status;   /*  8 */
    int32_t code;            /* 12: DOTPOSE_CODE_ */
    uint32_t cell_x;         /* 16: x in spacings is cell_x + fraction_x_q16 / 65536.0 */
    uint32_t cell_y;         /* 20 */
    uint32_t fraction_x_q16; /* 24 */
    uint32_t fraction_y_q16; /* 28 */
    int32_t theta_bam16;     /* 32: 2^15 is half a turn */
    uint32_t section_u;      /* 36 */
    uint32_t section_v;      /* 40 */
    uint32_t certainty;      /* 44: 0 to 255; p_wrong is at most 2^-certainty */
    uint32_t deviation_q12;  /* 48: max sigma of x and y, spacings; 255 if too large or unknown */
} dotpose_packet;

/* Returns the packet for a fix with any status. The packet contains the lower 16 bits of
 * `sequence`. */
dotpose_status dotpose_packet_of(const dotpose_fix* fix, int32_t code, uint32_t sequence,
                                 uint32_t time_us, dotpose_packet* packet);

/* Writes the DOTPOSE_PACKET_BYTES bytes of a packet. `capacity` is the size of `bytes`. Returns
 * TOO_LITTLE_MEMORY if `capacity` is less than DOTPOSE_PACKET_BYTES, and BAD_VALUE if a member of
 * the packet is out of range. */
dotpose_status dotpose_packet_encode(const dotpose_packet* packet, uint8_t* bytes, size_t capacity);

/* Extracts packets from a byte stream that may contain other data. The contents are private. */
typedef struct dotpose_packet_reader {
    uint64_t state[14];
} dotpose_packet_reader;

dotpose_status dotpose_packet_reader_init(dotpose_packet_reader* reader);
/* Processes the next byte. Returns OK and writes `packet` if the byte completes a packet. Otherwise
 * returns NO_PACKET and leaves `packet` unchanged. */
dotpose_status dotpose_packet_reader_push(dotpose_packet_reader* reader, uint8_t byte,
                                          dotpose_packet* packet);
/* Returns the number of byte sequences rejected as damaged packets. */
dotpose_status dotpose_packet_reader_damaged(const dotpose_packet_reader* reader,
                                             uint32_t* damaged);

/* ---- Frame pacing, to save battery ---------------------------------------------------------- */

/* Determines when to take the next frame. The contents are private. */
typedef struct dotpose_pacer {
    uint64_t state[40];
} dotpose_pacer;

/* Movement criteria and frame periods (40 bytes). Each comment ends with the default. */
typedef struct dotpose_pacer_options {
    uint32_t size;                /*  0: set by dotpose_pacer_options_init */
    int32_t moved_q16;            /*  4: movement threshold per axis, in spacings; 6554 */
    int32_t turned_bam;           /*  8: turn threshold; 11930465, one degree */
    int32_t lost_is_moved;        /* 12: 1 if losing the pattern counts as movement; 1 */
    int64_t stationary_after_us;  /* 16: 5000000 */
    int64_t stationary_period_us; /* 24: frame period while stationary; 1000000 */
    int64_t moving_period_us;     /* 32: frame period while moving; 0 */
} dotpose_pacer_options;

/* Sets the default options. `bytes` is the caller's sizeof(dotpose_pacer_options). */
dotpose_status dotpose_pacer_options_init(dotpose_pacer_options* options, size_t bytes);
/* Sets up a pacer. If `options` is null, uses the defaults. */
dotpose_status dotpose_pacer_init(dotpose_pacer* pacer, const dotpose_pacer_options* options);
/* Updates the pacer with the fix and the time of a frame. The fix may have any status. Sets
 * `next_us` to the earliest time for the next frame, and `is_moving` to 1 if the device is moving,
 * else to 0. `is_moving` may be null. */
dotpose_status dotpose_pacer_next_frame(dotpose_pacer* pacer, const dotpose_fix* fix,
                                        int64_t time_us, int64_t* next_us, int32_t* is_moving);

#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#pragma GCC visibility pop
#endif

#endif
