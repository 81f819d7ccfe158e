/* Locates the camera in one image, a binary PGM file of 8 bits:
 *
 *     gcc locate_one.c -ldotpose_c -lm -o locate_one
 *     ./locate_one frame.pgm */
#include <dotpose.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct image {
    int width_px;
    int height_px;
    uint8_t* pixels;
} image;

/* Reads a file; the caller frees the pixels. Without them the file could not be read. */
static image read_pgm(const char* path) {
    image result = {0, 0, NULL};
    FILE* file = fopen(path, "rb");
    if (file == NULL) return result;
    if (fscanf(file, "P5 %4d %4d 255", &result.width_px, &result.height_px) == 2 &&
        fgetc(file) != EOF && result.width_px > 0 && result.height_px > 0) {
        const size_t bytes = (size_t)result.width_px * (size_t)result.height_px;
        result.pixels = malloc(bytes);
        if (result.pixels != NULL && fread(result.pixels, 1, bytes, file) != bytes) {
            free(result.pixels);
            result.pixels = NULL;
        }
    }
    fclose(file);
    return result;
}

int main(int argc, char** argv) {
    dotpose_locator* locator = NULL;
    dotpose_status status = DOTPOSE_OK;
    dotpose_fix fix;
    image frame;

    if (argc != 2) {
        fputs("usage: locate_one FRAME.pgm\n", stderr);
        return 2;
    }
    frame = read_pgm(argv[1]);
    if (frame.pixels == NULL) {
        fprintf(stderr, "%s: not a binary PGM file of 8 bits\n", argv[1]);
        return 2;
    }
    status = dotpose_locator_create(DOTPOSE_KIND_LARGE, NULL, &locator);
    if (status == DOTPOSE_OK) {
        status = dotpose_locate(locator, frame.pixels, frame.width_px, frame.height_px,
                                frame.width_px, NULL, &fix);
    }
    if (status == DOTPOSE_OK) {
        printf("x %.3f mm, y %.3f mm, angle %.4f rad\n", fix.x_mm, fix.y_mm, fix.theta_rad);
    } else {
        puts(dotpose_status_message(status));
    }
    dotpose_locator_destroy(locator);
    free(frame.pixels);
    return status == DOTPOSE_OK ? 0 : 1;
}
