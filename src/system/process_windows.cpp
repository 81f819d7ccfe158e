#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <io.h>
#include <windows.h>
// shellapi.h uses types from windows.h, so windows.h must be included first.
#include <shellapi.h>

#include "system/process.hpp"

namespace dotpose::system {
namespace {

std::string utf8_of(const wchar_t* text) {
    const std::u8string utf8 = std::filesystem::path(text).u8string();
    return {utf8.begin(), utf8.end()};
}

void make_streams_binary() {
    _fmode = _O_BINARY;
    for (std::FILE* const stream : {stdin, stdout, stderr}) {
        _setmode(_fileno(stream), _O_BINARY);
    }
    // Disables buffering, because Windows has no line buffering. With full buffering, lines written
    // to a pipe would not arrive until the buffer is full or the program exits.
    std::setvbuf(stderr, nullptr, _IONBF, 0);
}

void prepare_console() {
    SetConsoleOutputCP(CP_UTF8);
    for (const DWORD stream : {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE}) {
        const HANDLE console = GetStdHandle(stream);
        DWORD mode = 0;
        if (GetConsoleMode(console, &mode) != 0) {
            SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
        }
    }
}

void (*end_handler)(int) = nullptr;

/// Reinstalls itself as the handler, because Windows resets the handler of a signal before calling
/// it.
void on_end_signal(int signal_number) {
    std::signal(signal_number, on_end_signal);
    end_handler(signal_number);
}

/// Returns true if reading from a pipe would not block. Also returns true for all other files,
/// which cannot be checked and may block.
bool has_bytes_or_end(int descriptor) {
    const auto handle = reinterpret_cast<HANDLE>(_get_osfhandle(descriptor));
    if (GetFileType(handle) != FILE_TYPE_PIPE) return true;
    DWORD available = 0;
    return PeekNamedPipe(handle, nullptr, 0, nullptr, &available, nullptr) == 0 || available > 0;
}

}  // namespace

std::vector<std::string> start_program(int, char**) {
    make_streams_binary();
    prepare_console();
    int count = 0;
    wchar_t** const words = CommandLineToArgvW(GetCommandLineW(), &count);
    std::vector<std::string> arguments;
    std::transform(words, words + count, std::back_inserter(arguments), utf8_of);
    LocalFree(words);
    return arguments;
}

std::filesystem::path program_folder() {
    std::wstring name(32768, L'\0');  // maximum length of a path
    name.resize(GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size())));
    return std::filesystem::path(name).parent_path();
}

bool is_terminal(std::FILE* stream) {
    // Uses GetConsoleMode because _isatty also returns true for NUL and serial devices.
    DWORD mode = 0;
    return GetConsoleMode(reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(stream))), &mode) != 0;
}

std::optional<std::size_t> read_available(int descriptor, void* data, std::size_t max_bytes) {
    constexpr int kPatience_ms = 100;
    constexpr int kPause_ms = 5;
    for (int waited_ms = 0; !has_bytes_or_end(descriptor); waited_ms += kPause_ms) {
        if (waited_ms >= kPatience_ms) return std::nullopt;
        Sleep(kPause_ms);
    }
    constexpr std::size_t kMaxBytes = std::size_t{1} << 30;  // _read takes an unsigned int
    const int count =
        _read(descriptor, data, static_cast<unsigned>(std::min(max_bytes, kMaxBytes)));
    if (count < 0) throw std::system_error(errno, std::generic_category());
    return static_cast<std::size_t>(count);
}

void on_end_signals(void (*handler)(int)) {
    end_handler = handler;
    for (const int signal_number : {SIGINT, SIGTERM, SIGBREAK}) {
        std::signal(signal_number, on_end_signal);
    }
}

// Windows has no signal for broken pipes.
void ignore_broken_pipes() {}

}  // namespace dotpose::system
