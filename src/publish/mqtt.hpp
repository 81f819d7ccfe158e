// MQTT through libmosquitto: messages out with a bounded queue, messages in by subscription. Both
// connect in the background and again whenever the connection breaks.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "dotpose/tools/error.hpp"

struct mosquitto;

namespace dotpose::publish {

struct MqttOptions {
    std::string host = "localhost";
    int port = 1883;
    std::string user;  ///< empty: none
    std::string password;
    bool has_tls = false;
    std::string ca_file;    ///< certificates to trust; empty: those of the system
    int qos = 0;            ///< 0: at most once, 1: at least once
    std::string client_id;  ///< empty: the broker chooses
    // Sent by the broker when the connection breaks; empty topic: nothing.
    std::string will_topic;
    std::string will;
    /// Messages kept while there is no connection. Of more, the oldest are dropped.
    std::size_t queue = 50;
    /// Told what the user should know: the broker is gone, is back.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
};

/// "mqtt://[USER[:PASSWORD]@]HOST[:PORT]", or mqtts:// for TLS, into the options. The default ports
/// are 1883 and 8883. Throws BadArgument.
void parse_url(const std::string& url, MqttOptions& options);

/// What both directions share: the connection and its thread.
class MqttClient {
  public:
    MqttClient(const MqttClient&) = delete;
    MqttClient& operator=(const MqttClient&) = delete;

    bool is_connected() const;

  protected:
    explicit MqttClient(MqttOptions options);
    virtual ~MqttClient();

    /// Connects, and waits a little for the answer. Throws Error: the broker refuses the user, the
    /// certificates cannot be read. A broker that does not answer is told, and tried on.
    void start();
    /// Ends the connection and the thread; after it no virtual function is called.
    void stop();

    // Called by the thread, without the lock.
    virtual void on_connected() {}
    virtual void on_disconnected() {}
    virtual void on_published(int) {}
    virtual void on_message(const std::string&, const std::string&) {}

    mosquitto* handle() const { return mosquitto_; }
    std::string place() const;

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
    std::string failure_;  ///< why the newest attempt to connect failed
    bool ends_ = false;
    std::chrono::steady_clock::time_point ends_by_;
    std::string refusal_;  ///< why the broker does not let us in
    std::thread thread_;
};

class MqttPublisher : public MqttClient {
  public:
    /// Throws Error; see MqttClient::start.
    explicit MqttPublisher(MqttOptions options);
    ~MqttPublisher() override;

    /// Sends, or keeps for later; never waits. After an interruption the newest leave first.
    void publish(std::string topic, std::string payload);

    /// Waits until all is sent or the time is over; false in that case.
    bool flush(std::chrono::milliseconds patience);

    std::int64_t sent() const;
    /// Messages that wait or are under way.
    std::int64_t unsent() const;
    /// Messages that were never sent: newer ones took their place in the queue, or (QoS 0) the
    /// connection broke while they were on their way.
    std::int64_t dropped() const;

  private:
    struct Message {
        std::string topic;
        std::string payload;
    };
    void on_connected() override { send_waiting(); }
    void on_disconnected() override;
    void on_published(int id) override;
    void send_waiting();

    std::deque<Message> waiting_;
    std::set<int> under_way_;  ///< handed over, not yet sent (QoS 0) or acknowledged (QoS 1)
    std::condition_variable done_;
    std::int64_t sent_ = 0;
    std::int64_t dropped_ = 0;
};

class MqttSubscriber : public MqttClient {
  public:
    using Handler = std::function<void(const std::string& topic, const std::string& payload)>;

    /// `handle` is called by another thread. Throws Error; see MqttClient::start.
    MqttSubscriber(MqttOptions options, std::string topic, Handler handle);
    ~MqttSubscriber() override;

  private:
    void on_connected() override;
    void on_message(const std::string& topic, const std::string& payload) override;

    std::string topic_;
    Handler handle_;
};

}  // namespace dotpose::publish
