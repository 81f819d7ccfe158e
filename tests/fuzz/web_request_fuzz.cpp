// Fuzzes the requests and commands that clients of the web page send. A request without the token
// must never be allowed.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "serve/access.hpp"
#include "serve/command.hpp"

namespace {

using namespace dotpose::serve;

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

std::string take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

void judge(std::string_view text) {
    static const Access kNetwork({"0.0.0.0", 8080}, kToken, "robot");
    static const Access kLoopback({"127.0.0.1", 8080}, "", "robot");
    const bool has_token = text.find(kToken) != std::string_view::npos;
    RequestHead head;
    head.is_get = true;
    head.host = take_line(text);
    head.origin = take_line(text);
    head.cookie = take_line(text);
    head.authorization = take_line(text);
    head.token = take_line(text);
    const Verdict verdict = kNetwork.judge(head);
    const bool is_allowed = verdict == Verdict::allowed || verdict == Verdict::allowed_by_url;
    if (is_allowed && !has_token) std::abort();
    if (kLoopback.judge(head) == Verdict::allowed && !head.origin.empty() &&
        !head.origin.ends_with("://" + head.host)) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    judge(text);
    if (const auto command = parse_command(text)) {
        if (size > kMaxCommandBytes || command->name.empty()) std::abort();
    }
    return 0;
}
