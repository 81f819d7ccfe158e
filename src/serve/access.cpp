#include "serve/access.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <utility>

#include <arpa/inet.h>
#include <fmt/core.h>
#include <sys/random.h>

namespace dotpose::serve {
namespace {

std::string in_lower_case(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::tolower(c); });
    return result;
}

bool is_token_character(unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("-_.~").find(static_cast<char>(c)) != std::string_view::npos;
}

/// Removes the port from "HOST[:PORT]". IPv6 addresses keep their brackets.
std::string_view without_port(std::string_view host) {
    const std::size_t bracket = host.rfind(']');
    const std::size_t colon = host.rfind(':');
    const bool has_port =
        colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket);
    return has_port ? host.substr(0, colon) : host;
}

bool is_ip(const std::string& host) {
    std::array<unsigned char, sizeof(in6_addr)> bytes{};
    if (host.starts_with('[') && host.ends_with(']'))
        return inet_pton(AF_INET6, host.substr(1, host.size() - 2).c_str(), bytes.data()) == 1;
    return inet_pton(AF_INET, host.c_str(), bytes.data()) == 1;
}

/// Returns the value of a cookie, or an empty string if there is no such cookie.
std::string_view cookie_of(std::string_view cookies, std::string_view name) {
    while (!cookies.empty()) {
        const std::size_t end = std::min(cookies.find(';'), cookies.size());
        std::string_view cookie = cookies.substr(0, end);
        cookies.remove_prefix(std::min(end + 1, cookies.size()));
        while (cookie.starts_with(' '))
            cookie.remove_prefix(1);
        if (cookie.starts_with(name) && cookie.substr(name.size()).starts_with('='))
            return cookie.substr(name.size() + 1);
    }
    return {};
}

}  // namespace

std::string make_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw Error("the system has no random numbers for a token");
    std::string token;
    for (const unsigned char byte : bytes)
        token += fmt::format("{:02x}", byte);
    return token;
}

std::string read_token(const std::string& path) {
    std::ifstream file(path);
    std::string token(kMaxTokenLength + 2, '\0');
    file.read(token.data(), static_cast<std::streamsize>(token.size()));
    token.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    token.resize(std::min(token.find_first_of("\r\n"), token.size()));
    if (token.empty()) throw Error(fmt::format("cannot read a token from {}", path));
    if (token.size() < kMinTokenLength || token.size() > kMaxTokenLength ||
        !std::ranges::all_of(token, is_token_character)) {
        throw Error(fmt::format(
            "the token in {} is not {} to {} letters and digits: make one with 'openssl rand -hex "
            "16'",
            path, kMinTokenLength, kMaxTokenLength));
    }
    return token;
}

bool equals_in_constant_time(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned char difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        // `volatile` prevents the compiler from adding an early exit to the loop.
        volatile unsigned char bits = static_cast<unsigned char>(a[i] ^ b[i]);
        difference = static_cast<unsigned char>(difference | bits);
    }
    return difference == 0;
}

Access::Access(const Address& address, std::string token, std::string hostname)
    : address_(address),
      token_(std::move(token)),
      hostname_(in_lower_case(hostname)),
      cookie_name_(fmt::format("dotpose-{}", address.port)) {}

/// Returns true if the Host header names this server. An IP address is safe, because only names can
/// be rebound to another address. A server at a loopback address accepts only the names of the
/// loopback interface. Any port is accepted, because an ssh tunnel may use a different port.
bool Access::is_own_host(std::string_view host) const {
    const std::string name = in_lower_case(without_port(host));
    if (name == "localhost" || name == "127.0.0.1" || name == "[::1]") return true;
    if (address_.is_loopback()) return name == address_.ip;
    return is_ip(name) || name == hostname_ || name == hostname_ + ".local";
}

bool Access::is_token(std::string_view token) const {
    return equals_in_constant_time(token, token_);
}

Verdict Access::judge(const RequestHead& head) const {
    if (!is_own_host(head.host)) return Verdict::wrong_host;
    if (!head.origin.empty() && head.origin != "http://" + head.host &&
        head.origin != "https://" + head.host) {
        return Verdict::wrong_origin;
    }
    if (!head.is_get) return Verdict::wrong_method;
    if (token_.empty()) return Verdict::allowed;
    if (!head.token.empty() && is_token(head.token)) return Verdict::allowed_by_url;
    constexpr std::string_view kBearer = "Bearer ";
    const std::string_view authorization = head.authorization;
    const bool is_allowed =
        is_token(cookie_of(head.cookie, cookie_name_)) ||
        (authorization.starts_with(kBearer) && is_token(authorization.substr(kBearer.size())));
    return is_allowed ? Verdict::allowed : Verdict::wrong_token;
}

std::string Access::set_cookie() const {
    return fmt::format("{}={}; HttpOnly; SameSite=Lax; Path=/", cookie_name_, token_);
}

}  // namespace dotpose::serve
