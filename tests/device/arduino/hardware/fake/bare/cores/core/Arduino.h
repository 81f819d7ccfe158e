/* The subset of the Arduino API that the examples use. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
unsigned long micros(void);
void setup(void);
void loop(void);
#ifdef __cplusplus
}

struct SerialLine {
    void begin(unsigned long baud);
    int available();
    int read();
    size_t write(const uint8_t* bytes, size_t count);
    void print(const char* text);
    void print(unsigned long number);
    void println(float number);
};
extern SerialLine Serial;
#endif
