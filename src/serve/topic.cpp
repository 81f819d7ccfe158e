#include "serve/topic.hpp"

#include <exception>
#include <utility>

namespace dotpose::serve {
namespace {

/// Returns the encoded value. Returns an empty string if the encoder throws, so that other topics
/// are still sent.
template <typename Encode, typename... Request>
std::string encoded(const Encode& encode, const Request&... request) {
    try {
        return encode(request...);
    } catch (const std::exception&) {
        return {};
    }
}

}  // namespace

void Topic::publish(Encode encode) {
    replace(std::move(encode), nullptr);
}

void Topic::publish_for_each(EncodeFor encode) {
    replace(nullptr, std::make_shared<const EncodeFor>(std::move(encode)));
}

void Topic::replace(Encode encode, std::shared_ptr<const EncodeFor> encode_for) {
    const std::lock_guard lock(mutex_);
    // The previous encoders are destroyed after the lock is released.
    std::swap(encode_, encode);
    std::swap(encode_for_, encode_for);
    ++version_;
    // No client is ready for another value until the server has sent this one.
    set_ready_clients(0);
}

std::uint64_t Topic::version() const {
    const std::lock_guard lock(mutex_);
    return version_;
}

std::shared_ptr<const std::string> Topic::message_of(const std::string& value) const {
    return std::make_shared<const std::string>(name_ + '\n' + value);
}

std::shared_ptr<const std::string> Topic::message(std::uint64_t& version, const Command& request) {
    Encode encode;
    std::shared_ptr<const EncodeFor> encode_for;
    {
        const std::lock_guard lock(mutex_);
        encode = std::exchange(encode_, nullptr);
        encode_for = encode_for_;
        if (encode) message_version_ = version_;
        version = encode_for ? version_ : message_version_;
    }
    // The value is encoded without holding the lock, so that the program can publish in the
    // meantime. Only the server's thread uses `message_`.
    if (encode_for) return message_of(encoded(*encode_for, request));
    if (encode) message_ = message_of(encoded(encode));
    return message_;
}

}  // namespace dotpose::serve
