#include "lines.hpp"

#include <cerrno>
#include <cstring>

namespace dotpose::cli {

void throw_unwritable(const std::string& output, int error_number) {
    const std::string what = "cannot write " + output + ": " + std::strerror(error_number);
    if (error_number == EPIPE) throw ReaderLeft(what);
    throw Error(what);
}

Lines::Lines(const std::string& path) : path_(path) {
    if (is_standard_output(path)) return;
    file_.reset(std::fopen(path.c_str(), "w"));
    if (!file_) throw Error("cannot create " + path + ": " + std::strerror(errno));
}

void Lines::write(const std::string& line) {
    std::FILE* stream = file_ ? file_.get() : stdout;
    errno = 0;
    const bool written = std::fwrite(line.data(), 1, line.size(), stream) == line.size();
    if (written && std::fflush(stream) == 0) return;
    throw_unwritable(file_ ? path_ : "to standard output", errno != 0 ? errno : EIO);
}

}  // namespace dotpose::cli
