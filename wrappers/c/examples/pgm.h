/* Reads 8-bit binary PGM files, for the examples. */
#ifndef PGM_H
#define PGM_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct pgm_image {
    int width_px;
    int height_px;
    uint8_t* pixels; /* to be released with free(); NULL if reading failed (the error is printed) */
} pgm_image;

static pgm_image read_pgm(const char* path) {
    pgm_image image = {0, 0, NULL};
    FILE* file = fopen(path, "rb");
    size_t bytes = 0;
    if (file != NULL && fscanf(file, "P5 %4d %4d 255", &image.width_px, &image.height_px) == 2 &&
        fgetc(file) != EOF && image.width_px > 0 && image.height_px > 0) {
        bytes = (size_t)image.width_px * (size_t)image.height_px;
        image.pixels = malloc(bytes);
        if (image.pixels != NULL && fread(image.pixels, 1, bytes, file) != bytes) {
            free(image.pixels);
            image.pixels = NULL;
        }
    }
    if (file != NULL) fclose(file);
    if (image.pixels == NULL) fprintf(stderr, "%s: not a binary PGM file of 8 bits\n", path);
    return image;
}

#endif
