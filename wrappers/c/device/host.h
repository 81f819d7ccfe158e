/* Interface between locate_frames.c and the start-up code: functions that the host provides, and
 * the main function of the program. */
#ifndef HOST_H
#define HOST_H

#include <stddef.h>

/* Opens the file for reading. Returns 0 if the file does not exist. */
int host_open(const char* path);
/* Reads `size` bytes. Returns 0 if fewer bytes are left in the file. */
int host_read(void* bytes, size_t size);
/* Prints to standard output. */
void host_print(const char* text);

/* Main function of the program. Locates the frames in the file at `path` and returns the exit
 * status. */
int locate_frames(const char* path);

#endif
