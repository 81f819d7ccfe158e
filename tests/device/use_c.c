/* The same as use_cpp.cpp, in C. */
#include <dotpose.h>
#include <stdio.h>
#include <string.h>

static uint64_t memory[DOTPOSE_DEVICE_BYTES / 8];
static const uint8_t row[188];

int main(void) {
    dotpose_locator* locator = NULL;
    dotpose_fix fix;
    int v;
    if (dotpose_device_init(memory, sizeof memory, NULL, &locator) != DOTPOSE_OK) return 1;
    if (dotpose_begin(locator, 188, 120, NULL) != DOTPOSE_OK) return 2;
    for (v = 0; v < 120; ++v)
        if (dotpose_push_row(locator, row) != DOTPOSE_OK) return 3;
    if (dotpose_finish(locator, &fix) != DOTPOSE_NO_CONTRAST) return 4;
    if (strlen(dotpose_version()) < 5) return 5;
    printf("%s: %s\n", dotpose_version(), dotpose_status_message(fix.status));
    return 0;
}
