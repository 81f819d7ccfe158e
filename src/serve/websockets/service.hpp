// Implementation of Server with libwebsockets. All functions that take an `lws*` run on the
// server's thread.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <libwebsockets.h>

#include "serve/server.hpp"
#include "serve/websockets/reports.hpp"

namespace dotpose::serve {

inline constexpr std::size_t kSecurityHeaders = 7;

/// A client connected through a WebSocket.
struct Client {
    std::vector<Subscription> subscriptions;     ///< one for each topic, in the order of the topics
    std::shared_ptr<const std::string> message;  ///< message that is being sent, or null
    std::size_t sent_bytes = 0;
    bool is_binary = false;
    std::size_t newest_topic = 0;  ///< index of the topic whose value was sent last
    std::string incoming;          ///< the part of an incomplete command that has been received
    double messages_left = 0;      ///< number of messages that the client may send now
    Reports::Clock::time_point counted_at;
};

/// The body of a response that is being sent.
struct Transfer {
    std::string body;
    std::size_t sent_bytes = 0;
    bool is_last = false;  ///< true to close the connection after sending the body
};

class Server::Service {
  public:
    explicit Service(ServerOptions options);
    ~Service();

    Topic& add_topic(const std::string& name, Format format);
    void start();
    std::string url() const;
    void set_route(const std::string& path, Route route);
    void remove_route(const std::string& path);
    void publish(Topic& topic, Topic::Encode encode);
    void publish_for_each(Topic& topic, Topic::EncodeFor encode);
    std::optional<Command> take_command();
    int clients() const { return number_of_clients_; }

  private:
    static int callback(lws* socket, lws_callback_reasons reason, void* user, void* in,
                        std::size_t size);
    /// Handles an event from libwebsockets. Returns a nonzero number to close the connection.
    int handle(lws* socket, lws_callback_reasons reason, void* in, std::size_t size);

    // http.cpp
    int answer_request(lws* socket, const std::string& path);
    int confirm_upgrade(lws* socket, const std::string& protocol);
    int send(lws* socket, unsigned status, Answer answer, const std::string& cookie, bool is_last);
    int send_file(lws* socket, const Answer& answer);
    int refuse(lws* socket, Verdict verdict);
    int continue_answer(lws* socket);
    std::optional<Answer> answer_to(const std::string& path);

    // clients.cpp
    void add_client(lws* socket);
    int receive(lws* socket, std::string_view part);
    bool obey(Client& client, const Command& command);
    int write(lws* socket);
    std::optional<std::size_t> due_topic(const Client& client) const;
    void request_writes();
    void count_ready_clients();
    int close(lws* socket, lws_close_status status, const std::string& reason);

    void report(lws* socket, const std::string& reason);

    ServerOptions options_;
    std::vector<std::unique_ptr<Topic>> topics_;
    std::optional<Access> access_;
    std::array<lws_protocols, 2> protocols_{};
    std::array<lws_protocol_vhost_options, kSecurityHeaders> headers_{};
    lws_context* context_ = nullptr;
    std::atomic<bool> stops_ = false;
    std::atomic<int> number_of_clients_ = 0;
    std::thread thread_;

    std::mutex routes_mutex_;
    std::map<std::string, Route> routes_;
    std::mutex commands_mutex_;
    std::deque<Command> commands_;

    // Used only by `thread_`.
    Reports reports_;
    std::map<lws*, bool> sockets_;  ///< true once a request has been received
    std::map<lws*, Client> clients_;
    std::map<lws*, Transfer> transfers_;
};

}  // namespace dotpose::serve
