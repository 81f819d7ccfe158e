#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

#include <mosquitto.h>

#include "publish/mqtt.hpp"

namespace dotpose::publish {

MqttPublisher::MqttPublisher(MqttOptions options) : MqttClient(std::move(options)) {
    start();
}

MqttPublisher::~MqttPublisher() {
    if (!options_.presence_topic.empty()) send_offline();
    stop();
}

// Publishes `Presence::offline`, then waits until the broker has acknowledged all presence
// messages. If the connection were closed earlier, the broker would publish the last will.
void MqttPublisher::send_offline() {
    constexpr std::chrono::seconds kPatience(1);
    {
        std::unique_lock lock(mutex_);
        done_.wait_for(lock, kPatience, [this] { return is_online_published_ || has_failed(); });
        if (!is_online_published_) return;
    }
    send_presence(Presence::offline);
    std::unique_lock lock(mutex_);
    done_.wait_for(lock, kPatience, [this] { return presence_under_way_.empty(); });
}

void MqttPublisher::on_connected() {
    send_presence(Presence::online);
    {
        const std::lock_guard lock(mutex_);
        is_online_published_ = true;
    }
    done_.notify_all();
    send_waiting();
}

void MqttPublisher::send_presence(Presence presence) {
    if (options_.presence_topic.empty()) return;
    const std::lock_guard lock(mutex_);
    const std::string message = options_.presence(presence);
    int id = 0;
    const int code =
        mosquitto_publish(handle(), &id, options_.presence_topic.c_str(),
                          static_cast<int>(message.size()), message.data(), kPresenceQos, true);
    if (code == MOSQ_ERR_SUCCESS) presence_under_way_.insert(id);
}

void MqttPublisher::publish(std::string topic, std::string payload, bool is_retained) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back({std::move(topic), std::move(payload), is_retained});
        if (waiting_.size() > options_.queue) {
            waiting_.pop_front();
            ++dropped_;
        }
    }
    if (is_connected()) send_waiting();
}

void MqttPublisher::send_waiting() {
    const std::lock_guard lock(mutex_);
    while (!waiting_.empty() && under_way_.size() < kMaxUnderWay) {
        const Message& newest = waiting_.back();
        int id = 0;
        const int code = mosquitto_publish(handle(), &id, newest.topic.c_str(),
                                           static_cast<int>(newest.payload.size()),
                                           newest.payload.data(), options_.qos, newest.is_retained);
        const bool can_never_be_sent = code == MOSQ_ERR_INVAL || code == MOSQ_ERR_MALFORMED_UTF8 ||
                                       code == MOSQ_ERR_PAYLOAD_SIZE ||
                                       code == MOSQ_ERR_OVERSIZE_PACKET;
        if (can_never_be_sent) {
            ++dropped_;
        } else if (code == MOSQ_ERR_SUCCESS) {
            under_way_.insert(id);
        } else {
            return;  // the connection is lost, so the message stays in the queue
        }
        waiting_.pop_back();
    }
}

void MqttPublisher::on_published(int id) {
    {
        const std::lock_guard lock(mutex_);
        sent_ += static_cast<std::int64_t>(under_way_.erase(id));
        presence_under_way_.erase(id);
    }
    done_.notify_all();
    send_waiting();
}

void MqttPublisher::on_disconnected() {
    {
        const std::lock_guard lock(mutex_);
        is_online_published_ = false;
    }
    // After reconnecting, libmosquitto resends messages with QoS 1 and drops messages with QoS 0.
    if (options_.qos > 0) return;
    const std::lock_guard lock(mutex_);
    dropped_ += static_cast<std::int64_t>(under_way_.size());
    under_way_.clear();
}

bool MqttPublisher::flush(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    return done_.wait_for(lock, patience,
                          [this] { return waiting_.empty() && under_way_.empty(); });
}

std::int64_t MqttPublisher::sent() const {
    const std::lock_guard lock(mutex_);
    return sent_;
}

std::int64_t MqttPublisher::unsent() const {
    const std::lock_guard lock(mutex_);
    return static_cast<std::int64_t>(waiting_.size() + under_way_.size());
}

std::int64_t MqttPublisher::dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
}

}  // namespace dotpose::publish
