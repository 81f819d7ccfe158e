/* What the program needs of the machine. */
#ifndef HOST_H
#define HOST_H

#include <stddef.h>

/* Opens the file to read. Returns 0 if there is none. */
int host_open(const char* path);
/* Reads `size` bytes. Returns 0 if fewer are left. */
int host_read(void* bytes, size_t size);
/* Prints to standard output. */
void host_print(const char* text);

/* The program: locates the frames in the file at `path`. Returns the exit status. */
int locate_frames(const char* path);

#endif
