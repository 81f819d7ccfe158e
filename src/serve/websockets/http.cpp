// HTTP requests: decides which requests are accepted, and sends the responses.
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/core.h>

#include "serve/limits.hpp"
#include "serve/websockets/service.hpp"

namespace dotpose::serve {
namespace {

constexpr const char* kText = "text/plain; charset=utf-8";
constexpr const char* kSocketPath = "/live";

/// Returns a header, or an empty string if it is missing or too long.
std::string header(lws* socket, lws_token_indexes name) {
    std::string value(kMaxHeadBytes, '\0');
    const int length = lws_hdr_copy(socket, value.data(), static_cast<int>(value.size()), name);
    value.resize(static_cast<std::size_t>(std::max(length, 0)));
    return value;
}

/// Returns a URL parameter, or an empty string if it is missing.
std::string parameter(lws* socket, std::string_view name) {
    std::array<char, kMaxTokenLength + 32> fragment{};
    for (int i = 0;
         lws_hdr_copy_fragment(socket, fragment.data(), static_cast<int>(fragment.size()),
                               WSI_TOKEN_HTTP_URI_ARGS, i) > 0;
         ++i) {
        const std::string_view text = fragment.data();
        if (text.starts_with(name) && text.substr(name.size()).starts_with('='))
            return std::string(text.substr(name.size() + 1));
    }
    return {};
}

RequestHead head_of(lws* socket) {
    RequestHead head;
    head.host = header(socket, WSI_TOKEN_HOST);
    head.origin = header(socket, WSI_TOKEN_ORIGIN);
    head.cookie = header(socket, WSI_TOKEN_HTTP_COOKIE);
    head.authorization = header(socket, WSI_TOKEN_HTTP_AUTHORIZATION);
    head.token = parameter(socket, "token");
    head.is_get = lws_hdr_total_length(socket, WSI_TOKEN_GET_URI) > 0;
    return head;
}

struct Refusal {
    unsigned status;
    const char* log;     ///< reason that is reported to the user of the program
    const char* answer;  ///< text for the client
};

Refusal refusal_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::wrong_host:
            return {HTTP_STATUS_FORBIDDEN, "the request is for another host",
                    "This address is not a name of this server.\n"};
        case Verdict::wrong_origin:
            return {HTTP_STATUS_FORBIDDEN, "the request is from a page of another site",
                    "Pages of other sites may not use this server.\n"};
        case Verdict::wrong_method:
            return {HTTP_STATUS_METHOD_NOT_ALLOWED, "the method is not GET",
                    "This server answers GET requests only.\n"};
        default:
            return {HTTP_STATUS_UNAUTHORIZED, "the token is missing or wrong",
                    "Open the address with the token that dotpose printed when it started.\n"};
    }
}

}  // namespace

int Server::Service::refuse(lws* socket, Verdict verdict) {
    const Refusal refusal = refusal_of(verdict);
    report(socket, refusal.log);
    return send(socket, refusal.status, {.type = kText, .body = refusal.answer}, "", true);
}

int Server::Service::answer_request(lws* socket, const std::string& path) {
    const Verdict verdict = access_->judge(head_of(socket));
    if (verdict == Verdict::allowed_by_url) {
        // The redirection removes the token from the browser's address bar and history.
        return send(socket, HTTP_STATUS_SEE_OTHER, {.type = kText, .body = "\n"},
                    access_->set_cookie(), false);
    }
    if (verdict != Verdict::allowed) return refuse(socket, verdict);
    std::optional<Answer> answer = answer_to(path);
    if (!answer) {
        return send(socket, HTTP_STATUS_NOT_FOUND,
                    {.type = kText, .body = "There is no such page.\n"}, "", true);
    }
    if (!answer->file.empty()) return send_file(socket, *answer);
    return send(socket, HTTP_STATUS_OK, std::move(*answer), "", false);
}

std::optional<Answer> Server::Service::answer_to(const std::string& path) {
    const auto page = std::ranges::find(options_.pages, path, &Page::path);
    if (page != options_.pages.end())
        return Answer{.type = std::string(page->type), .body = std::string(page->content)};
    Route route;
    {
        const std::lock_guard lock(routes_mutex_);
        const auto found = routes_.find(path);
        if (found == routes_.end()) return std::nullopt;
        route = found->second;
    }
    return route();
}

int Server::Service::confirm_upgrade(lws* socket, const std::string& protocol) {
    if (protocol != "websocket") return -1;
    const auto reject = [socket](unsigned status) {
        lws_return_http_status(socket, status, nullptr);
        return 1;
    };
    const Verdict verdict = access_->judge(head_of(socket));
    if (verdict != Verdict::allowed && verdict != Verdict::allowed_by_url) {
        const Refusal refusal = refusal_of(verdict);
        report(socket, refusal.log);
        return reject(refusal.status);
    }
    if (header(socket, WSI_TOKEN_GET_URI) != kSocketPath) return reject(HTTP_STATUS_NOT_FOUND);
    if (clients_.size() < kMaxClients) return 0;
    report(socket, fmt::format("{} clients are connected already", kMaxClients));
    return reject(HTTP_STATUS_SERVICE_UNAVAILABLE);
}

int Server::Service::send(lws* socket, unsigned status, Answer answer, const std::string& cookie,
                          bool is_last) {
    std::array<unsigned char, LWS_PRE + 2048> buffer{};
    unsigned char* const begin = buffer.data() + LWS_PRE;
    unsigned char* const end = buffer.data() + buffer.size();
    unsigned char* at = begin;
    const auto add = [&](const char* name, const std::string& value) {
        return lws_add_http_header_by_name(socket, reinterpret_cast<const unsigned char*>(name),
                                           reinterpret_cast<const unsigned char*>(value.data()),
                                           static_cast<int>(value.size()), &at, end) == 0;
    };
    bool fits = lws_add_http_common_headers(socket, status, answer.type.c_str(), answer.body.size(),
                                            &at, end) == 0;
    if (!cookie.empty()) fits = fits && add("set-cookie:", cookie) && add("location:", "/");
    if (!answer.download.empty())
        fits = fits && add("content-disposition:", "attachment; filename=" + answer.download);
    if (!fits || lws_finalize_write_http_header(socket, begin, &at, end) != 0) return -1;
    transfers_[socket] = {std::move(answer.body), 0, is_last};
    lws_callback_on_writable(socket);
    return 0;
}

int Server::Service::send_file(lws* socket, const Answer& answer) {
    const std::string disposition =
        fmt::format("content-disposition: attachment; filename={}\r\n", answer.download);
    const int state =
        lws_serve_http_file(socket, answer.file.c_str(), answer.type.c_str(), disposition.c_str(),
                            static_cast<int>(disposition.size()));
    if (state < 0) return -1;
    return state > 0 && lws_http_transaction_completed(socket) != 0 ? -1 : 0;
}

int Server::Service::continue_answer(lws* socket) {
    Transfer& transfer = transfers_.at(socket);
    std::array<unsigned char, LWS_PRE + kChunkBytes> buffer{};
    const std::size_t size = std::min(kChunkBytes, transfer.body.size() - transfer.sent_bytes);
    std::memcpy(buffer.data() + LWS_PRE, transfer.body.data() + transfer.sent_bytes, size);
    transfer.sent_bytes += size;
    const bool is_end = transfer.sent_bytes == transfer.body.size();
    const int written = lws_write(socket, buffer.data() + LWS_PRE, size,
                                  is_end ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP);
    if (written < 0) return -1;
    if (!is_end) {
        lws_callback_on_writable(socket);
        return 0;
    }
    const bool is_last = transfer.is_last;
    transfers_.erase(socket);
    return lws_http_transaction_completed(socket) != 0 || is_last ? -1 : 0;
}

}  // namespace dotpose::serve
