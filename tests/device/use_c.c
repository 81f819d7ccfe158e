/* The same program as use_cpp.cpp, in C. */
#include <dotpose.h>
#include <stdio.h>
#include <string.h>

static uint64_t memory[DOTPOSE_DEVICE_BYTES / 8];
static uint64_t little[DOTPOSE_DEVICE_160X120_BYTES / 8];
static uint64_t much[DOTPOSE_DEVICE_320X240_BYTES / 8];
static const uint8_t row[188];

int main(void) {
    dotpose_locator* locator = NULL;
    dotpose_fix fix;
    int v;
    dotpose_fix_init(&fix, sizeof fix);
    if (dotpose_device_160x120_init(little, sizeof little, NULL, &locator) != DOTPOSE_OK) return 6;
    if (dotpose_begin(locator, 161, 120, NULL) != DOTPOSE_IMAGE_TOO_LARGE) return 7;
    if (dotpose_device_320x240_init(much, sizeof much, NULL, &locator) != DOTPOSE_OK) return 8;
    if (dotpose_begin(locator, 320, 240, NULL) != DOTPOSE_OK) return 9;
    if (dotpose_device_init(memory, sizeof memory, NULL, &locator) != DOTPOSE_OK) return 1;
    if (dotpose_begin(locator, 188, 120, NULL) != DOTPOSE_OK) return 2;
    for (v = 0; v < 120; ++v)
        if (dotpose_push_row(locator, row) != DOTPOSE_OK) return 3;
    if (dotpose_finish(locator, &fix) != DOTPOSE_NO_CONTRAST) return 4;
    if (strlen(dotpose_version()) < 5) return 5;
    printf("%s: %s\n", dotpose_version(), dotpose_status_message(fix.status));
    return 0;
}
