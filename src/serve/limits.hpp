// Limits on the memory and the time that the clients of a server can use.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dotpose::serve {

inline constexpr int kMaxConnections = 64;  ///< maximum number of HTTP and WebSocket connections
inline constexpr int kMaxClients = 16;      ///< maximum number of WebSockets
inline constexpr int kHeadTimeout_s = 5;    ///< time limit for receiving the head of a request
inline constexpr int kSilence_s = 20;       ///< time without a message after which a ping is sent
/// Time without a message after which the client is disconnected.
inline constexpr int kMaxSilence_s = 40;
inline constexpr std::size_t kMaxHeadBytes = 4096;     ///< maximum size of the head of a request
inline constexpr std::size_t kChunkBytes = 32 * 1024;  ///< maximum size of one write
inline constexpr std::size_t kMaxWaitingCommands = 32;
/// Maximum number of messages that a client may send: per second on average, and in a single burst.
inline constexpr double kMaxMessages_per_s = 200;
inline constexpr double kMaxBurst = 200;

}  // namespace dotpose::serve
