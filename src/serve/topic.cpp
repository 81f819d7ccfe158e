#include "serve/topic.hpp"

#include <exception>
#include <utility>

namespace dotpose::serve {
namespace {

/// Returns the encoded value. Returns an empty string if the encoder throws, so that other topics
/// are still sent.
std::string encoded(const Topic::Encode& encode) {
    try {
        return encode();
    } catch (const std::exception&) {
        return {};
    }
}

}  // namespace

void Topic::publish(Encode encode) {
    const std::lock_guard lock(mutex_);
    // The previous value is destroyed after the lock is released.
    std::swap(encode_, encode);
    ++version_;
    // No client is ready for another value until the server has sent this one.
    set_ready_clients(0);
}

std::uint64_t Topic::version() const {
    const std::lock_guard lock(mutex_);
    return version_;
}

std::shared_ptr<const std::string> Topic::message(std::uint64_t& version) {
    Encode encode;
    {
        const std::lock_guard lock(mutex_);
        encode = std::exchange(encode_, nullptr);
        if (encode) message_version_ = version_;
    }
    // Only the server's thread uses the message, so the program may publish while it is encoded.
    if (encode) message_ = std::make_shared<const std::string>(name_ + '\n' + encoded(encode));
    version = message_version_;
    return message_;
}

}  // namespace dotpose::serve
