#include "lines.hpp"

#include <cerrno>
#include <cstring>

#include "system/files.hpp"
#include "system/path.hpp"

namespace dotpose::cli {

void throw_unwritable(const std::string& output, int error_number) {
    const std::string what = "cannot write " + output + ": " + std::strerror(error_number);
    if (error_number == EPIPE) throw ReaderLeft(what);
    throw Error(what);
}

File create_file(const std::string& path) {
    File file(system::open_file(system::path_of(path), "wb"));
    if (!file) throw Error("cannot create " + path + ": " + std::strerror(errno));
    return file;
}

Lines::Lines(const std::string& path) : path_(path) {
    if (!is_standard_output(path)) file_ = create_file(path);
}

void Lines::write(const std::string& line) {
    std::FILE* stream = file_ ? file_.get() : stdout;
    errno = 0;
    const bool written = std::fwrite(line.data(), 1, line.size(), stream) == line.size();
    if (written && std::fflush(stream) == 0) return;
    throw_unwritable(file_ ? path_ : "to standard output", errno != 0 ? errno : EIO);
}

}  // namespace dotpose::cli
