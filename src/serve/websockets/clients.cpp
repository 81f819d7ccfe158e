// WebSockets: handles commands from clients and sends messages to clients.
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "serve/limits.hpp"
#include "serve/websockets/service.hpp"

namespace dotpose::serve {
namespace {

/// Counts a message from the client. Returns false if the client sends too many messages.
bool may_send(Client& client, Reports::Clock::time_point now) {
    const std::chrono::duration<double> elapsed = now - client.counted_at;
    client.counted_at = now;
    client.messages_left =
        std::min(kMaxBurst, client.messages_left + elapsed.count() * kMaxMessages_per_s);
    client.messages_left -= 1;
    return client.messages_left >= 0;
}

}  // namespace

void Server::Service::add_client(lws* socket) {
    Client client;
    client.subscriptions.resize(topics_.size());
    client.messages_left = kMaxBurst;
    client.counted_at = Reports::Clock::now();
    clients_.insert_or_assign(socket, std::move(client));
    number_of_clients_ = static_cast<int>(clients_.size());
}

int Server::Service::close(lws* socket, lws_close_status status, const std::string& reason) {
    report(socket, reason);
    std::string text = reason;
    lws_close_reason(socket, status, reinterpret_cast<unsigned char*>(text.data()), text.size());
    return -1;
}

int Server::Service::receive(lws* socket, std::string_view part) {
    Client& client = clients_.at(socket);
    if (client.incoming.size() + part.size() + lws_remaining_packet_payload(socket) >
        kMaxCommandBytes) {
        return close(socket, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, "a message is too large");
    }
    client.incoming += part;
    if (lws_is_final_fragment(socket) == 0) return 0;
    if (!may_send(client, Reports::Clock::now()))
        return close(socket, LWS_CLOSE_STATUS_POLICY_VIOLATION, "too many messages");
    const std::optional<Command> command = parse_command(std::exchange(client.incoming, {}));
    if (!command || !obey(client, *command))
        return close(socket, LWS_CLOSE_STATUS_POLICY_VIOLATION, "a message is not a command");
    request_writes();
    return 0;
}

/// Executes a subscription command (subscribe, unsubscribe or next) immediately, and queues all
/// other commands for the program. Returns false if the topic does not exist or the queue is full.
bool Server::Service::obey(Client& client, const Command& command) {
    const bool begins = command.name == "subscribe";
    const bool ends = command.name == "unsubscribe";
    if (begins || ends || command.name == "next") {
        const std::string* topic = command.argument<std::string>("topic");
        if (topic == nullptr) return false;
        const auto found = std::ranges::find(
            topics_, *topic, [](const auto& known) -> const std::string& { return known->name(); });
        if (found == topics_.end()) return false;
        Subscription& subscription =
            client.subscriptions[static_cast<std::size_t>(found - topics_.begin())];
        if (begins) subscription.begin(command);
        if (ends) subscription.end();
        if (!begins && !ends) subscription.acknowledge();
        return true;
    }
    const std::lock_guard lock(commands_mutex_);
    if (commands_.size() >= kMaxWaitingCommands) return false;
    commands_.push_back(command);
    return true;
}

/// Returns the next topic that has a value for the client. The search starts after the topic of the
/// last message to the client, so that all topics take turns.
std::optional<std::size_t> Server::Service::due_topic(const Client& client) const {
    for (std::size_t step = 1; step <= topics_.size(); ++step) {
        const std::size_t i = (client.newest_topic + step) % topics_.size();
        if (client.subscriptions[i].is_due(topics_[i]->version())) return i;
    }
    return std::nullopt;
}

int Server::Service::write(lws* socket) {
    Client& client = clients_.at(socket);
    if (!client.message) {
        const std::optional<std::size_t> topic = due_topic(client);
        if (!topic) return 0;
        std::uint64_t version = 0;
        client.message = topics_[*topic]->message(version, client.subscriptions[*topic].request);
        client.is_binary = topics_[*topic]->is_binary();
        client.newest_topic = *topic;
        client.sent_bytes = 0;
        client.subscriptions[*topic].sent(version);
    }
    std::array<unsigned char, LWS_PRE + kChunkBytes> buffer{};
    const std::size_t size = std::min(kChunkBytes, client.message->size() - client.sent_bytes);
    std::memcpy(buffer.data() + LWS_PRE, client.message->data() + client.sent_bytes, size);
    const bool is_start = client.sent_bytes == 0;
    client.sent_bytes += size;
    const bool is_end = client.sent_bytes == client.message->size();
    const int flags =
        lws_write_ws_flags(client.is_binary ? LWS_WRITE_BINARY : LWS_WRITE_TEXT, is_start, is_end);
    const int written =
        lws_write(socket, buffer.data() + LWS_PRE, size, static_cast<lws_write_protocol>(flags));
    if (written < static_cast<int>(size)) return -1;
    if (is_end) client.message.reset();
    if (!is_end || due_topic(client)) lws_callback_on_writable(socket);
    count_ready_clients();
    return 0;
}

/// Asks libwebsockets to call `write` for each client that is due a message, as soon as the
/// client's socket accepts data.
void Server::Service::request_writes() {
    for (const auto& [socket, client] : clients_) {
        if (client.message || due_topic(client)) lws_callback_on_writable(socket);
    }
    count_ready_clients();
}

void Server::Service::count_ready_clients() {
    for (std::size_t i = 0; i < topics_.size(); ++i) {
        const std::uint64_t version = topics_[i]->version();
        topics_[i]->set_ready_clients(
            static_cast<int>(std::ranges::count_if(clients_, [i, version](const auto& entry) {
                return entry.second.subscriptions[i].is_ready(version);
            })));
    }
}

}  // namespace dotpose::serve
