/* Start-up code for Cortex-M, and host functions that use semihosting calls (Arm's "Semihosting for
 * AArch32 and AArch64"). */
#include <stdint.h>
#include <string.h>

#include "host.h"

enum {
    CALL_OPEN = 0x01,
    CALL_WRITE = 0x05,
    CALL_READ = 0x06,
    CALL_COMMAND_LINE = 0x15,
    CALL_EXIT = 0x20
};
enum { MODE_READ = 1, MODE_WRITE = 4 };

/* Symbols defined in firmware/cortex-m0plus/memory.ld. */
extern uint32_t data_begin[], data_end[], data_load[], bss_begin[], bss_end[];
extern uint32_t stack_bottom[], stack_top[];

static const uint32_t PAINT = 0x5AFEC0DE;

void reset(void);

static int32_t call(int32_t number, const void* arguments) {
    register int32_t r0 __asm__("r0") = number;
    register const void* r1 __asm__("r1") = arguments;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

static int32_t open_file(const char* path, uint32_t mode) {
    uint32_t arguments[3];
    arguments[0] = (uint32_t)path;
    arguments[1] = mode;
    arguments[2] = strlen(path);
    return call(CALL_OPEN, arguments);
}

/* Returns the number of bytes that were not transferred. */
static int32_t transfer(int32_t number, int32_t file, const void* bytes, size_t size) {
    uint32_t arguments[3];
    arguments[0] = (uint32_t)file;
    arguments[1] = (uint32_t)bytes;
    arguments[2] = size;
    return call(number, arguments);
}

static int32_t input = -1;

int host_open(const char* path) {
    input = open_file(path, MODE_READ);
    return input >= 0;
}

int host_read(void* bytes, size_t size) {
    return transfer(CALL_READ, input, bytes, size) == 0;
}

void host_print(const char* text) {
    static int32_t console = -1;
    if (console < 0) console = open_file(":tt", MODE_WRITE);
    transfer(CALL_WRITE, console, text, strlen(text));
}

static void leave(uint32_t status) {
    uint32_t arguments[2];
    arguments[0] = 0x20026; /* ADP_Stopped_ApplicationExit */
    arguments[1] = status;
    for (;;)
        call(CALL_EXIT, arguments);
}

static void fault(void) {
    leave(99);
}

/* Returns the last word of the command line, which is the path of the frame file. */
static const char* path_of_frames(void) {
    static char line[160];
    uint32_t arguments[2];
    const char* space = NULL;
    arguments[0] = (uint32_t)line;
    arguments[1] = sizeof line;
    if (call(CALL_COMMAND_LINE, arguments) != 0) return "";
    space = strrchr(line, ' ');
    return space == NULL ? line : space + 1;
}

/* Prints the maximum stack usage in bytes. */
static void print_stack(void) {
    const volatile uint32_t* word = stack_bottom;
    uint32_t bytes = 0;
    char text[] = "stack 00000\n";
    char* digit = text + 11;
    while (word < stack_top && *word == PAINT)
        ++word;
    for (bytes = (uint32_t)(stack_top - word) * 4; bytes != 0; bytes /= 10)
        *--digit = (char)('0' + bytes % 10);
    host_print(text);
    if (*(volatile uint32_t*)stack_bottom != PAINT) leave(98);
}

void reset(void) {
    const uint32_t* from = data_load;
    volatile uint32_t* to = data_begin;
    uint32_t status = 0;
    while (to < data_end)
        *to++ = *from++;
    for (to = bss_begin; to < bss_end; ++to)
        *to = 0;
    for (to = stack_bottom; to < (uint32_t*)__builtin_frame_address(0) - 16; ++to)
        *to = PAINT;
    status = (uint32_t)locate_frames(path_of_frames());
    print_stack();
    leave(status);
}

/* Vector table (ARMv6-M Architecture Reference Manual, B1.5.3). */
typedef struct vector_table {
    const void* initial_stack;
    void (*handlers[15])(void);
} vector_table;
extern const vector_table vectors;
__attribute__((section(".vectors"), used)) const vector_table vectors = {
    stack_top,
    {reset, fault, fault, fault, fault, fault, fault, 0, 0, 0, fault, fault, 0, fault, fault}};
