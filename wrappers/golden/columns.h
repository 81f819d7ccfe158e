/* The columns of golden lines (README.md), written by scripts/generate-fields. */
#include <dotpose.h>
#include <stddef.h>

/* Numbers that follow each other in a dotpose_fix. */
typedef struct golden_column {
    char kind; /* i: int32_t, u: uint32_t, f: float, d: double */
    uint8_t count;
    uint16_t offset;
} golden_column;

static const golden_column golden_columns[] = {
    {'d', 1, offsetof(dotpose_fix, x_mm)},
    {'d', 1, offsetof(dotpose_fix, y_mm)},
    {'d', 1, offsetof(dotpose_fix, theta_rad)},
    {'d', 1, offsetof(dotpose_fix, p_wrong)},
    {'i', 1, offsetof(dotpose_fix, p_wrong_log2)},
    {'i', 1, offsetof(dotpose_fix, dots_seen)},
    {'i', 1, offsetof(dotpose_fix, dots_used)},
    {'i', 1, offsetof(dotpose_fix, attempt)},
    {'i', 1, offsetof(dotpose_fix, surface)},
    {'i', 1, offsetof(dotpose_fix, bit_errors)},
    {'f', 1, offsetof(dotpose_fix, residual_px)},
    {'f', 9, offsetof(dotpose_fix, covariance)},
    {'u', 1, offsetof(dotpose_fix, section_u)},
    {'u', 1, offsetof(dotpose_fix, section_v)},
    {'u', 1, offsetof(dotpose_fix, cell_x)},
    {'u', 1, offsetof(dotpose_fix, cell_y)},
    {'u', 1, offsetof(dotpose_fix, fraction_x_q16)},
    {'u', 1, offsetof(dotpose_fix, fraction_y_q16)},
    {'i', 1, offsetof(dotpose_fix, theta_bam)},
    {'i', 1, offsetof(dotpose_fix, spacing_px_q16)},
    {'i', 1, offsetof(dotpose_fix, spacing_nm)},
    {'u', 4, offsetof(dotpose_fix, place)},
    {'i', 11, offsetof(dotpose_fix, pattern_from_image)},
    {'i', 1, offsetof(dotpose_fix, displacement_q16)},
    {'f', 9, offsetof(dotpose_fix, covariance_grid)},
};
