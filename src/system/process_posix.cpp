#include <cerrno>
#include <csignal>
#include <system_error>

#include <poll.h>
#include <unistd.h>

#include "system/process.hpp"

namespace dotpose::system {

std::vector<std::string> start_program(int argc, char** argv) {
    return {argv, argv + argc};
}

std::filesystem::path program_folder() {
    std::error_code failed;
    return std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
}

bool is_terminal(std::FILE* stream) {
    return isatty(fileno(stream)) == 1;
}

std::optional<std::size_t> read_available(int descriptor, void* data, std::size_t max_bytes) {
    constexpr int kPatience_ms = 100;
    pollfd ready{descriptor, POLLIN, 0};
    ssize_t count = poll(&ready, 1, kPatience_ms);
    if (count == 0) return std::nullopt;
    if (count > 0) count = read(descriptor, data, max_bytes);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno == EINTR) return std::nullopt;
    throw std::system_error(errno, std::generic_category());
}

void on_end_signals(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
        sigaction(signal_number, &action, nullptr);
    }
}

void ignore_broken_pipes() {
    struct sigaction action {};
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, nullptr);
}

}  // namespace dotpose::system
