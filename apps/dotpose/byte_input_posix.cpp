#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include "byte_input.hpp"
#include "dotpose/files/error.hpp"

namespace dotpose::cli {
namespace {

struct Baud {
    int rate = 0;
    speed_t constant = 0;
};
constexpr std::array kBaudConstants = {
    Baud{9600, B9600},       Baud{19200, B19200},     Baud{38400, B38400},   Baud{57600, B57600},
    Baud{115200, B115200},   Baud{230400, B230400},   Baud{460800, B460800}, Baud{921600, B921600},
    Baud{1000000, B1000000}, Baud{2000000, B2000000},
};

/// Sets a serial line to raw mode at the given baud rate. Returns false on failure.
bool set_up_line(int descriptor, int baud) {
    termios line{};
    if (tcgetattr(descriptor, &line) != 0) return false;
    cfmakeraw(&line);
    line.c_cflag |= CLOCAL | CREAD;
    for (const Baud& known : kBaudConstants) {
        if (known.rate != baud) continue;
        cfsetispeed(&line, known.constant);
        cfsetospeed(&line, known.constant);
    }
    return tcsetattr(descriptor, TCSANOW, &line) == 0;
}

}  // namespace

ByteInput open_input(const std::string& name, int baud) {
    const auto fail = [&] { throw Error("cannot read " + name + ": " + std::strerror(errno)); };
    const int descriptor = open(name.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC);
    if (descriptor < 0) fail();
    const bool is_line = isatty(descriptor) == 1;
    if (is_line && !set_up_line(descriptor, baud)) {
        const int error_number = errno;
        close(descriptor);
        errno = error_number;
        fail();
    }
    return {descriptor, is_line};
}

}  // namespace dotpose::cli
