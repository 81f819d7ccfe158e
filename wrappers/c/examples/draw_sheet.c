/* Draws a part of a sheet as an image. The locate_one example can locate the image:
 *
 *     ./draw_sheet 1000 2000 >sheet.pgm
 *     ./locate_one sheet.pgm */
#include <dotpose.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    COLUMNS = 40,
    ROWS = 30,
    SPACING_PX = 18,
    SHIFT_PX = 3, /* one sixth of the spacing, equal to the dot diameter */
    WIDTH_PX = COLUMNS * SPACING_PX,
    HEIGHT_PX = ROWS * SPACING_PX
};

static uint8_t pixels[HEIGHT_PX][WIDTH_PX];

/* Draws the dot of a cell as a 3 x 3 px square, displaced from the centre of the cell. */
static void draw_dot(int column, int row, int32_t dx, int32_t dy) {
    const int u = column * SPACING_PX + SPACING_PX / 2 + SHIFT_PX * (int)dx;
    const int v = row * SPACING_PX + SPACING_PX / 2 + SHIFT_PX * (int)dy;
    int i = 0;
    for (i = 0; i < 9; ++i)
        pixels[v - 1 + i / 3][u - 1 + i % 3] = 0;
}

int main(int argc, char** argv) {
    dotpose_place place = {0, 0, 0, 0};
    uint32_t column = 0;
    uint32_t row = 0;
    if (argc != 3) return fputs("usage: draw_sheet COLUMN ROW >SHEET.pgm\n", stderr), 2;
    memset(pixels, 255, sizeof pixels);
    for (row = 0; row < ROWS; ++row) {
        for (column = 0; column < COLUMNS; ++column) {
            int32_t dx = 0;
            int32_t dy = 0;
            dotpose_status status = DOTPOSE_OK;
            place.x = (uint32_t)strtoul(argv[1], NULL, 10) + column;
            place.y = (uint32_t)strtoul(argv[2], NULL, 10) + row;
            status = dotpose_displacement(DOTPOSE_CODE_ANOTO, &place, &dx, &dy);
            if (status != DOTPOSE_OK) {
                fprintf(stderr, "%s\n", dotpose_status_message(status));
                return 1;
            }
            draw_dot((int)column, (int)row, dx, dy);
        }
    }
    printf("P5\n%d %d\n255\n", WIDTH_PX, HEIGHT_PX);
    return fwrite(pixels, sizeof pixels, 1, stdout) == 1 ? 0 : 1;
}
