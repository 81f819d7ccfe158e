// An Arduino core without a board. It is compiled and linked, but never run.
#include <Arduino.h>

SerialLine Serial;

void SerialLine::begin(unsigned long) {}
int SerialLine::available() {
    return 1;
}
int SerialLine::read() {
    return 0;
}
size_t SerialLine::write(const uint8_t*, size_t count) {
    return count;
}
void SerialLine::print(const char*) {}
void SerialLine::print(unsigned long) {}
void SerialLine::println(float) {}

extern "C" unsigned long micros() {
    static unsigned long now = 0;
    return ++now;
}

int main() {
    setup();
    for (;;)
        loop();
}
