#include "publish/mqtt.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>

#include <fmt/core.h>
#include <mosquitto.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

namespace dotpose::publish {
namespace {

using namespace std::chrono_literals;

/// Maximum time that `start` waits for the broker's answer.
constexpr auto kPatience = 3s;
/// Time between attempts to reach a broker that does not answer.
constexpr auto kBetweenAttempts = 500ms;
/// Maximum time to wait for the socket in one iteration of the network loop.
constexpr int kWait_ms = 100;

/// Initializes libmosquitto once per program.
struct Library {
    Library() { mosquitto_lib_init(); }
    ~Library() { mosquitto_lib_cleanup(); }
};

std::string reason_of(int code) {
    return code == MOSQ_ERR_ERRNO ? std::strerror(errno) : mosquitto_strerror(code);
}

/// Returns true if the peer closed the connection. With TLS, libmosquitto notices a closed
/// connection only after its keep-alive interval, but the operating system reports it immediately.
bool is_hung_up(int socket) {
    pollfd state{socket, 0, 0};
    return socket >= 0 && poll(&state, 1, 0) > 0 && (state.revents & (POLLHUP | POLLERR)) != 0;
}

void require(int code, const std::string& what) {
    if (code != MOSQ_ERR_SUCCESS) throw Error(what + ": " + mosquitto_strerror(code));
}

int parse_port(const std::string& text, const std::string& url) {
    int port = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, port);
    if (error != std::errc() || stop != end || port < 1 || port > 65535) {
        throw BadArgument("'" + url + "' has no port from 1 to 65535");
    }
    return port;
}

}  // namespace

void parse_url(const std::string& url, MqttOptions& options) {
    constexpr int kPort = 1883;
    constexpr int kTlsPort = 8883;
    const std::size_t scheme = url.find("://");
    const std::string name = url.substr(0, scheme);
    if (scheme == std::string::npos || (name != "mqtt" && name != "mqtts")) {
        const std::string meant =
            scheme == std::string::npos ? "; did you mean mqtt://" + url + "?" : std::string();
        throw BadArgument("'" + url + "' is not mqtt://HOST or mqtts://HOST" + meant);
    }
    options.has_tls = name == "mqtts";
    options.port = options.has_tls ? kTlsPort : kPort;
    std::string rest = url.substr(scheme + 3);
    if (rest.ends_with('/')) rest.pop_back();
    if (const std::size_t at = rest.rfind('@'); at != std::string::npos) {
        const std::string login = rest.substr(0, at);
        const std::size_t colon = login.find(':');
        options.user = login.substr(0, colon);
        if (colon != std::string::npos) options.password = login.substr(colon + 1);
        rest = rest.substr(at + 1);
    }
    if (const std::size_t colon = rest.rfind(':'); colon != std::string::npos) {
        options.port = parse_port(rest.substr(colon + 1), url);
        rest.resize(colon);
    }
    if (rest.empty()) throw BadArgument("'" + url + "' names no host");
    options.host = rest;
}

/// Callbacks for libmosquitto. They forward to the methods of MqttClient.
struct MqttClient::Callbacks {
    static MqttClient& client(void* object) { return *static_cast<MqttClient*>(object); }
    static void on_connect(mosquitto*, void* object, int code) { client(object).answered(code); }
    static void on_disconnect(mosquitto*, void* object, int reason) {
        client(object).disconnected(reason);
    }
    static void on_publish(mosquitto*, void* object, int id) { client(object).on_published(id); }
    static void on_message(mosquitto*, void* object, const mosquitto_message* message) {
        client(object).on_message(message->topic, {static_cast<const char*>(message->payload),
                                                   static_cast<std::size_t>(message->payloadlen)});
    }
};

MqttClient::MqttClient(MqttOptions options) : options_(std::move(options)) {
    static const Library library;
    const char* id = options_.client_id.empty() ? nullptr : options_.client_id.c_str();
    mosquitto_ = mosquitto_new(id, true, this);
    if (mosquitto_ == nullptr) throw Error("cannot set up MQTT: out of memory");
}

MqttClient::~MqttClient() {
    stop();
    mosquitto_destroy(mosquitto_);
}

std::string MqttClient::place() const {
    return fmt::format("the broker {}:{}", options_.host, options_.port);
}

bool MqttClient::is_connected() const {
    const std::lock_guard lock(mutex_);
    return is_connected_;
}

void MqttClient::require_reached() const {
    const std::lock_guard lock(mutex_);
    if (was_reached_) return;
    const std::string& reason = refusal_.empty() ? failure_ : refusal_;
    throw Error(place() + " was never reached" + (reason.empty() ? "" : ": " + reason));
}

void MqttClient::set_up_security() {
    if (!options_.user.empty()) {
        require(
            mosquitto_username_pw_set(mosquitto_, options_.user.c_str(), options_.password.c_str()),
            "cannot set user and password");
    }
    if (options_.has_tls) {
        const char* file = options_.ca_file.empty() ? nullptr : options_.ca_file.c_str();
        const char* folder = file == nullptr ? "/etc/ssl/certs" : nullptr;
        require(mosquitto_tls_set(mosquitto_, file, folder, nullptr, nullptr, nullptr),
                "cannot use the certificates " + (file == nullptr ? folder : options_.ca_file));
    }
}

void MqttClient::start() {
    set_up_security();
    // Without this option, TCP may delay a small message by up to 40 ms to combine it with the next
    // message.
    require(mosquitto_int_option(mosquitto_, MOSQ_OPT_TCP_NODELAY, 1), "cannot set the connection");
    if (!options_.presence_topic.empty()) {
        const std::string will = options_.presence(Presence::broken);
        require(mosquitto_will_set(mosquitto_, options_.presence_topic.c_str(),
                                   static_cast<int>(will.size()), will.data(), kPresenceQos, true),
                "cannot set the last will");
    }
    mosquitto_connect_callback_set(mosquitto_, Callbacks::on_connect);
    mosquitto_disconnect_callback_set(mosquitto_, Callbacks::on_disconnect);
    mosquitto_publish_callback_set(mosquitto_, Callbacks::on_publish);
    mosquitto_message_callback_set(mosquitto_, Callbacks::on_message);
    // Allows one more message in flight than `publish` uses, so that presence messages are sent
    // without waiting.
    mosquitto_max_inflight_messages_set(mosquitto_, static_cast<unsigned>(kMaxUnderWay + 1));
    // Messages are published by threads other than the one that executes `run`.
    mosquitto_threaded_set(mosquitto_, true);
    constexpr int kKeepAlive_s = 10;
    const int code =
        mosquitto_connect_async(mosquitto_, options_.host.c_str(), options_.port, kKeepAlive_s);
    const std::string at_once = reason_of(code);
    thread_ = std::thread([this] { run(); });

    std::unique_lock lock(mutex_);
    if (code == MOSQ_ERR_SUCCESS) {
        changed_.wait_for(lock, kPatience, [this] {
            return is_connected_ || !refusal_.empty() || !failure_.empty();
        });
    }
    const std::string refusal = refusal_;
    std::string failure = code == MOSQ_ERR_SUCCESS ? failure_ : at_once;
    if (failure.empty()) failure = "no answer";
    const bool is_connected = is_connected_;
    lock.unlock();
    if (!refusal.empty()) {
        stop();
        throw Error(place() + " refuses the connection: " + refusal);
    }
    if (!is_connected)
        options_.notify("cannot reach " + place() + ": " + failure + "; trying again");
}

void MqttClient::stop() {
    if (!thread_.joinable()) return;
    mosquitto_disconnect(mosquitto_);
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        ends_by_ = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    }
    changed_.notify_all();
    thread_.join();
}

int MqttClient::work() {
    return mosquitto_loop(mosquitto_, kWait_ms, 1);
}

// Runs the network loop. The thread that libmosquitto provides is not used, because it exits if the
// first connection attempt fails.
void MqttClient::run() {
    for (;;) {
        int code = is_connected() ? work() : mosquitto_loop(mosquitto_, kWait_ms, 1);
        std::string reason = code == MOSQ_ERR_SUCCESS ? std::string() : reason_of(code);
        std::unique_lock lock(mutex_);
        if (code == MOSQ_ERR_SUCCESS && !is_connected_ &&
            is_hung_up(mosquitto_socket(mosquitto_))) {
            code = MOSQ_ERR_NO_CONN;
            reason = "no connection";
        }
        // The thread must not exit before the disconnect message is sent. Otherwise, the broker
        // publishes the last will.
        const bool has_left = !is_connected_ || code != MOSQ_ERR_SUCCESS;
        if (ends_ && (has_left || std::chrono::steady_clock::now() > ends_by_)) return;
        if (code == MOSQ_ERR_SUCCESS) continue;
        if (!is_connected_ && refusal_.empty()) failure_ = reason;
        changed_.notify_all();
        changed_.wait_for(lock, kBetweenAttempts, [this] { return ends_; });
        if (ends_) return;
        lock.unlock();
        mosquitto_reconnect_async(mosquitto_);
    }
}

void MqttClient::answered(int code) {
    bool was_refused = false;
    {
        const std::lock_guard lock(mutex_);
        is_connected_ = code == 0;
        was_reached_ = was_reached_ || is_connected_;
        was_refused = !refusal_.empty();
        refusal_ = code == 0 ? "" : mosquitto_connack_string(code);
    }
    changed_.notify_all();
    if (code == 0) {
        on_connected();
    } else if (!was_refused) {
        options_.notify(place() + " refuses the connection: " + mosquitto_connack_string(code));
    }
}

void MqttClient::disconnected(int reason) {
    bool is_news = false;
    {
        const std::lock_guard lock(mutex_);
        is_news = is_connected_ && reason != 0;  // the reason is 0 after mosquitto_disconnect
        is_connected_ = false;
    }
    on_disconnected();
    if (is_news) options_.notify(place() + " is gone; trying to reach it again");
}

MqttSubscriber::MqttSubscriber(MqttOptions options, std::vector<std::string> topics, Handler handle)
    : MqttClient(std::move(options)), topics_(std::move(topics)), handle_(std::move(handle)) {
    start();
}

MqttSubscriber::~MqttSubscriber() {
    stop();
}

void MqttSubscriber::on_connected() {
    for (const std::string& topic : topics_)
        mosquitto_subscribe(handle(), nullptr, topic.c_str(), options_.qos);
}

void MqttSubscriber::on_message(std::string_view topic, std::string_view payload) {
    ++received_;
    handle_(topic, payload);
}

// Processes all available messages together. mosquitto_loop needs eight system calls per message.
// Processing messages together needs fewer system calls and combines the acknowledgements.
int MqttSubscriber::work() {
    const int socket = mosquitto_socket(handle());
    const bool has_answers = mosquitto_want_write(handle());
    pollfd state{socket, static_cast<short>(has_answers ? POLLIN | POLLOUT : POLLIN), 0};
    if (socket >= 0) poll(&state, 1, kWait_ms);
    const std::int64_t before = received_;
    int code = receive_all();
    const std::int64_t taken = received_ - before;
    if (code == MOSQ_ERR_SUCCESS) code = send_all(taken > 1 ? socket : -1);
    if (code == MOSQ_ERR_SUCCESS) code = mosquitto_loop_misc(handle());
    // Waking up for each message takes longer than processing it, so this thread waits 1 ms for
    // messages to accumulate.
    if (code == MOSQ_ERR_SUCCESS && taken > 0) std::this_thread::sleep_for(1ms);
    return code;
}

int MqttSubscriber::receive_all() {
    constexpr int kMaxBatch = 256;  // maximum number of messages that are acknowledged together
    for (int i = 0; i < kMaxBatch; ++i) {
        const std::int64_t before = received_;
        const int code = mosquitto_loop_read(handle(), 1);
        if (code != MOSQ_ERR_SUCCESS || received_ == before) return code;
    }
    return MOSQ_ERR_SUCCESS;
}

// Sends the acknowledgements. If `socket` is not -1, combines several acknowledgements in one
// network packet.
int MqttSubscriber::send_all(int socket) {
    if (!mosquitto_want_write(handle())) return MOSQ_ERR_SUCCESS;
    const auto hold_back = [socket](int yes) {
        if (socket >= 0) setsockopt(socket, IPPROTO_TCP, TCP_CORK, &yes, sizeof yes);
    };
    hold_back(1);
    const int code = mosquitto_loop_write(handle(), 1);
    hold_back(0);
    return code;
}

}  // namespace dotpose::publish
