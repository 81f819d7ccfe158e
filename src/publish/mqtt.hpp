// An MQTT publisher with a bounded queue, and an MQTT subscriber. Both use libmosquitto, connect in
// the background, and reconnect after the connection breaks.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "dotpose/files/error.hpp"

struct mosquitto;

namespace dotpose::publish {

/// Connection state of a publisher, for presence messages.
enum class Presence {
    online,   ///< the publisher is connected
    offline,  ///< the publisher disconnected
    broken,   ///< the publisher's connection broke
};

struct MqttOptions {
    std::string host = "localhost";
    int port = 1883;
    std::string user;  ///< user name, or empty to connect without a user name
    std::string password;
    bool has_tls = false;
    /// File with trusted certificates, or empty to use the system's certificates.
    std::string ca_file;
    int qos = 0;            ///< 0 for at most once, 1 for at least once
    std::string client_id;  ///< client ID, or empty to let the broker choose an ID
    /// Topic of the publisher's presence messages, or empty to send no presence messages. The
    /// broker retains the newest message for later subscribers. The message for `Presence::broken`
    /// is registered as the last will of the connection.
    std::string presence_topic;
    /// Returns a presence message. Two threads call this function, but never at the same time.
    std::function<std::string(Presence)> presence;
    /// Maximum number of queued messages. If the queue is full, the oldest message is dropped.
    std::size_t queue = 50;
    /// Called with messages for the user, for example when the connection is lost.
    std::function<void(const std::string&)> notify = [](const std::string&) {};
};

/// Parses "mqtt://[USER[:PASSWORD]@]HOST[:PORT]", or mqtts:// for TLS, into `options`. The default
/// ports are 1883 and 8883. Throws BadArgument if the URL is invalid.
void parse_url(const std::string& url, MqttOptions& options);

/// An MQTT connection and its thread. Base class of the publisher and the subscriber.
class MqttClient {
  public:
    MqttClient(const MqttClient&) = delete;
    MqttClient& operator=(const MqttClient&) = delete;

    bool is_connected() const;

    /// Throws Error with the reason if the broker was never reached.
    void require_reached() const;

  protected:
    explicit MqttClient(MqttOptions options);
    virtual ~MqttClient();

    /// Connects and waits up to 3 s for the broker's answer. Throws Error if the broker rejects the
    /// connection, or if the certificates cannot be read. If the broker does not answer, reports
    /// this through `MqttOptions::notify`. The thread then keeps trying to connect.
    void start();
    /// Disconnects and stops the thread. No virtual function is called afterwards.
    void stop();

    // The thread calls these functions without holding the lock.
    virtual void on_connected() {}
    virtual void on_disconnected() {}
    virtual void on_published(int) {}
    virtual void on_message(std::string_view, std::string_view) {}
    /// Runs one iteration of the network loop while connected: waits a short time for the socket,
    /// then receives and sends. Returns a libmosquitto error code.
    virtual int work();

    /// Returns true if the latest attempt to connect failed or the connection is lost. The caller
    /// must hold `mutex_`.
    bool has_failed() const {
        return (was_reached_ && !is_connected_) || !failure_.empty() || !refusal_.empty();
    }
    mosquitto* handle() const { return mosquitto_; }
    std::string place() const;

    /// Maximum number of messages in flight: not yet sent by libmosquitto (QoS 0), or not yet
    /// acknowledged by the broker (QoS 1). The limit is small, because the publisher sends the
    /// newest messages first, but cannot reorder messages in flight.
    static constexpr std::size_t kMaxUnderWay = 20;
    /// Quality of service for presence messages: at least once.
    static constexpr int kPresenceQos = 1;

    MqttOptions options_;
    mutable std::mutex mutex_;

  private:
    struct Callbacks;
    void set_up_security();
    void run();
    void answered(int code);
    void disconnected(int reason);

    mosquitto* mosquitto_ = nullptr;
    std::condition_variable changed_;
    bool is_connected_ = false;
    bool was_reached_ = false;
    std::string failure_;  ///< reason why the latest attempt to connect failed
    bool ends_ = false;
    std::chrono::steady_clock::time_point ends_by_;
    std::string refusal_;  ///< reason why the broker refused the connection
    std::thread thread_;
};

class MqttPublisher : public MqttClient {
  public:
    /// Connects. Throws the same errors as MqttClient::start.
    explicit MqttPublisher(MqttOptions options);
    ~MqttPublisher() override;

    /// Sends a message, or queues it until there is a connection. Does not block. After an
    /// interruption, the newest messages are sent first. If `is_retained` is true, the broker keeps
    /// the message for later subscribers. An empty retained message removes the previous one.
    void publish(std::string topic, std::string payload, bool is_retained = false);

    /// Waits up to `patience` for all messages to be sent. Returns false on timeout.
    bool flush(std::chrono::milliseconds patience);

    std::int64_t sent() const;
    /// Returns the number of messages that are queued or being sent.
    std::int64_t unsent() const;
    /// Returns the number of messages that were never sent. They were dropped from a full queue,
    /// were invalid, or were being sent with QoS 0 when the connection broke.
    std::int64_t dropped() const;

  private:
    struct Message {
        std::string topic;
        std::string payload;
        bool is_retained = false;
    };
    void on_connected() override;
    void on_disconnected() override;
    void on_published(int id) override;
    void send_waiting();
    void send_presence(Presence presence);
    void send_offline();

    std::deque<Message> waiting_;
    /// IDs of the messages in flight: not yet sent (QoS 0) or not yet acknowledged (QoS 1).
    std::set<int> under_way_;
    std::set<int> presence_under_way_;  ///< IDs of unacknowledged presence messages
    bool is_online_published_ = false;  ///< true if `online` was published on this connection
    std::condition_variable done_;
    std::int64_t sent_ = 0;
    std::int64_t dropped_ = 0;
};

class MqttSubscriber : public MqttClient {
  public:
    using Handler = std::function<void(std::string_view topic, std::string_view payload)>;

    /// Subscribes to topics. `handle` is called on another thread. Throws the same errors as
    /// MqttClient::start.
    MqttSubscriber(MqttOptions options, std::vector<std::string> topics, Handler handle);
    ~MqttSubscriber() override;

    /// Ends the connection. The handler is not called afterwards.
    void disconnect() { stop(); }

  private:
    void on_connected() override;
    void on_message(std::string_view topic, std::string_view payload) override;
    int work() override;
    int receive_all();
    int send_all(int socket);

    std::vector<std::string> topics_;
    Handler handle_;
    std::int64_t received_ = 0;  ///< number of received messages
};

}  // namespace dotpose::publish
