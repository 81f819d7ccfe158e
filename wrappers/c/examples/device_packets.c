/* Processes a frame as a microcontroller does: uses a fixed amount of memory, processes each row as
 * the camera delivers it, and sends a 32-byte packet. In this example, the rows are read from a
 * file, and the packet is written to standard output for `dotpose listen`:
 *
 *     ./device_packets frame.pgm | dotpose listen - */
#include <dotpose.h>
#include <stdio.h>
#include <stdlib.h>

#include "pgm.h"

static uint64_t memory[DOTPOSE_DEVICE_BYTES / 8];

int main(int argc, char** argv) {
    dotpose_locator* locator = NULL;
    dotpose_fix fix;
    dotpose_packet packet;
    uint8_t bytes[DOTPOSE_PACKET_BYTES];
    pgm_image frame;
    int v = 0;

    if (argc != 2) return fputs("usage: device_packets FRAME.pgm\n", stderr), 2;
    frame = read_pgm(argv[1]);
    if (frame.pixels == NULL) return 2;
    if (dotpose_device_init(memory, sizeof memory, NULL, &locator) != DOTPOSE_OK) return 1;
    dotpose_fix_init(&fix, sizeof fix);
    dotpose_begin(locator, frame.width_px, frame.height_px, NULL);
    for (v = 0; v < frame.height_px; ++v)
        dotpose_push_row(locator, frame.pixels + v * frame.width_px);
    dotpose_finish(locator, &fix); /* also returns the reason if dotpose_begin failed */
    free(frame.pixels);

    if (dotpose_packet_of(&fix, DOTPOSE_CODE_ANOTO, 1, 0, &packet) != DOTPOSE_OK ||
        dotpose_packet_encode(&packet, bytes, sizeof bytes) != DOTPOSE_OK) {
        fprintf(stderr, "%s\n", dotpose_status_message(fix.status));
        return 1;
    }
    return fwrite(bytes, sizeof bytes, 1, stdout) == 1 ? 0 : 1;
}
