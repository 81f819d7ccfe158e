#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <io.h>

#include "byte_input.hpp"
#include "dotpose/files/error.hpp"
#include "system/path.hpp"

namespace dotpose::cli {

ByteInput open_input(const std::string& name, int) {
    const int descriptor =
        _wopen(system::path_of(name).c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT);
    if (descriptor < 0) throw Error("cannot read " + name + ": " + std::strerror(errno));
    if (_isatty(descriptor) == 0) return {descriptor, false};
    _close(descriptor);
    throw Error("cannot read " + name +
                ": serial devices are not supported on Windows; write their bytes to a pipe and "
                "read it with 'dotpose listen -'");
}

}  // namespace dotpose::cli
