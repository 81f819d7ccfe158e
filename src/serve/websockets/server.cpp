#include "serve/server.hpp"

#include <array>
#include <utility>

#include <fmt/core.h>
#include <unistd.h>

#include "serve/background_thread.hpp"
#include "serve/limits.hpp"
#include "serve/websockets/service.hpp"

namespace dotpose::serve {
namespace {

std::string hostname() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "localhost";
}

/// Headers sent with all responses. They ensure that the page loads only its own files, that pages
/// of other sites cannot show it in a frame, and that other sites cannot read the responses.
constexpr std::array<std::pair<const char*, const char*>, kSecurityHeaders> kHeaders = {{
    {"content-security-policy:",
     "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self'; "
     "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"x-content-type-options:", "nosniff"},
    {"x-frame-options:", "DENY"},
    {"referrer-policy:", "no-referrer"},
    {"cross-origin-opener-policy:", "same-origin"},
    {"cross-origin-resource-policy:", "same-origin"},
    {"cache-control:", "no-store"},
}};

constexpr lws_usec_t kMaxHead_us = lws_usec_t{kHeadTimeout_s} * LWS_USEC_PER_SEC;
constexpr int kUnhandled = -2;  ///< result of `handle` for events that it does not handle

}  // namespace

Server::Service::Service(ServerOptions options)
    : options_(std::move(options)), reports_(options_.notify) {
    if (options_.token.empty() && !options_.address.is_loopback()) {
        throw BadArgument(fmt::format("a server at {} needs a token", text_of(options_.address)));
    }
}

Server::Service::~Service() {
    if (context_ == nullptr) return;
    stops_ = true;
    lws_cancel_service(context_);
    if (thread_.joinable()) thread_.join();
    lws_context_destroy(context_);
}

Topic& Server::Service::add_topic(const std::string& name, Format format) {
    topics_.push_back(std::make_unique<Topic>(name, format == Format::binary));
    return *topics_.back();
}

void Server::Service::start() {
    require_free(options_.address);
    lws_set_log_level(0, nullptr);
    protocols_[0] = {"dotpose", callback, 0, kMaxCommandBytes, 0, nullptr, kChunkBytes};
    static constexpr lws_retry_bo_t kLife = {nullptr, 0, 0, kSilence_s, kMaxSilence_s, 0};
    lws_context_creation_info info{};
    info.port = options_.address.port;
    info.iface = options_.address.is_any() ? nullptr : options_.address.ip.c_str();
    info.protocols = protocols_.data();
    for (std::size_t i = 0; i < kHeaders.size(); ++i) {
        headers_[i].name = kHeaders[i].first;
        headers_[i].value = kHeaders[i].second;
        headers_[i].next = i + 1 < headers_.size() ? &headers_[i + 1] : nullptr;
    }
    info.headers = headers_.data();
    info.user = this;
    info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND | LWS_SERVER_OPTION_VALIDATE_UTF8;
    if (options_.address.ip.find(':') == std::string::npos)
        info.options |= LWS_SERVER_OPTION_DISABLE_IPV6;
    info.max_http_header_data = kMaxHeadBytes;
    info.max_http_header_pool = kMaxConnections;
    info.timeout_secs = kHeadTimeout_s;
    info.timeout_secs_ah_idle = kHeadTimeout_s;
    info.keepalive_timeout = kHeadTimeout_s;
    info.retry_and_idle_policy = &kLife;
    info.pt_serv_buf_size = kChunkBytes;
    context_ = lws_create_context(&info);
    if (context_ == nullptr)
        throw Error(fmt::format("cannot listen at {}", text_of(options_.address)));
    lws_vhost* vhost = lws_get_vhost_by_name(context_, "default");
    options_.address.port = static_cast<std::uint16_t>(lws_get_vhost_listen_port(vhost));
    access_.emplace(options_.address, options_.token, hostname());
    thread_ = std::thread([this] {
        run_in_background();
        while (!stops_ && lws_service(context_, 0) >= 0) {
        }
    });
}

std::string Server::Service::url() const {
    Address shown = options_.address;
    if (shown.is_any()) shown.ip = hostname();
    const std::string query = options_.token.empty() ? "" : "?token=" + options_.token;
    return fmt::format("http://{}/{}", text_of(shown), query);
}

void Server::Service::set_route(const std::string& path, Route route) {
    const std::lock_guard lock(routes_mutex_);
    routes_[path] = std::move(route);
}

void Server::Service::remove_route(const std::string& path) {
    const std::lock_guard lock(routes_mutex_);
    routes_.erase(path);
}

void Server::Service::publish(Topic& topic, Topic::Encode encode) {
    topic.publish(std::move(encode));
    lws_cancel_service(context_);
}

void Server::Service::publish_for_each(Topic& topic, Topic::EncodeFor encode) {
    topic.publish_for_each(std::move(encode));
    lws_cancel_service(context_);
}

std::optional<Command> Server::Service::take_command() {
    const std::lock_guard lock(commands_mutex_);
    if (commands_.empty()) return std::nullopt;
    Command command = std::move(commands_.front());
    commands_.pop_front();
    return command;
}

void Server::Service::report(lws* socket, const std::string& reason) {
    std::array<char, 64> peer{};
    lws_get_peer_simple(socket, peer.data(), peer.size());
    reports_.refuse(peer.data(), reason, Reports::Clock::now());
}

int Server::Service::callback(lws* socket, lws_callback_reasons reason, void* user, void* in,
                              std::size_t size) {
    auto* service = static_cast<Service*>(lws_context_user(lws_get_context(socket)));
    if (service == nullptr) return 0;
    const int result = service->handle(socket, reason, in, size);
    return result == kUnhandled ? lws_callback_http_dummy(socket, reason, user, in, size) : result;
}

int Server::Service::handle(lws* socket, lws_callback_reasons reason, void* in, std::size_t size) {
    const auto text = [in, size] { return std::string_view(static_cast<const char*>(in), size); };
    switch (reason) {
        case LWS_CALLBACK_FILTER_NETWORK_CONNECTION:
            if (sockets_.size() < kMaxConnections) return 0;
            reports_.refuse("a client", "too many connections", Reports::Clock::now());
            return 1;
        case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
            sockets_[socket] = false;
            // Sets a timer, because libwebsockets does not limit the duration of some requests,
            // such as CONNECT.
            lws_set_timer_usecs(socket, kMaxHead_us);
            return 0;
        case LWS_CALLBACK_TIMER:
            return sockets_[socket] ? 0 : -1;
        case LWS_CALLBACK_WSI_DESTROY:
            sockets_.erase(socket);
            transfers_.erase(socket);
            return 0;
        case LWS_CALLBACK_HTTP:
            sockets_[socket] = true;
            return answer_request(socket, std::string(text()));
        case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
            return confirm_upgrade(socket, static_cast<const char*>(in));
        case LWS_CALLBACK_HTTP_WRITEABLE:
            return transfers_.contains(socket) ? continue_answer(socket) : kUnhandled;
        case LWS_CALLBACK_ESTABLISHED:
            sockets_[socket] = true;
            add_client(socket);
            return 0;
        case LWS_CALLBACK_RECEIVE:
            return receive(socket, text());
        case LWS_CALLBACK_SERVER_WRITEABLE:
            return write(socket);
        case LWS_CALLBACK_CLOSED:
            clients_.erase(socket);
            number_of_clients_ = static_cast<int>(clients_.size());
            count_ready_clients();
            return 0;
        case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
            request_writes();
            return 0;
        default:
            return kUnhandled;
    }
}

Server::Server(ServerOptions options) : service_(std::make_unique<Service>(std::move(options))) {}

Server::~Server() = default;

Topic& Server::add_topic(const std::string& name, Format format) {
    return service_->add_topic(name, format);
}

void Server::start() {
    service_->start();
}

std::string Server::url() const {
    return service_->url();
}

void Server::set_route(const std::string& path, Route route) {
    service_->set_route(path, std::move(route));
}

void Server::remove_route(const std::string& path) {
    service_->remove_route(path);
}

void Server::publish(Topic& topic, Topic::Encode encode) {
    service_->publish(topic, std::move(encode));
}

void Server::publish_for_each(Topic& topic, Topic::EncodeFor encode) {
    service_->publish_for_each(topic, std::move(encode));
}

std::optional<Command> Server::take_command() {
    return service_->take_command();
}

int Server::clients() const {
    return service_->clients();
}

}  // namespace dotpose::serve
