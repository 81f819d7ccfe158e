#include <cerrno>

#include "live_program.hpp"

namespace dotpose::cli {

int become_live() {
    return ENOSYS;
}

std::string live_program_text(int) {
    return "the program dotpose-live, which does not exist for Windows: read images or raw frames "
           "here, or use Linux";
}

}  // namespace dotpose::cli
