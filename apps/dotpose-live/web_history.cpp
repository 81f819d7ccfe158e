#include "web_history.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "dotpose/files/error.hpp"
#include "json_text.hpp"
#include "serve/background_thread.hpp"
#include "store/database.hpp"
#include "thinned_history.hpp"

namespace dotpose::cli {

/// Request for the states of a robot. The time span is either the last `last_s` seconds, or the
/// range from `from_s` to `to_s` in seconds since 1970.
struct HistoryRequest {
    std::string robot;
    double last_s = 0;
    double from_s = 0;
    double to_s = 0;
    double ask = 0;  ///< changed by the page to repeat an otherwise identical request
    bool operator==(const HistoryRequest&) const = default;
};

namespace {

using nlohmann::json;

constexpr std::size_t kMaxQueries = 8;
constexpr std::size_t kMaxHistories = 16;
constexpr std::size_t kMaxRobotName = 400;
constexpr double kMaxSpan_s = 31 * 86'400.0;
/// Maximum time in a request, in seconds since 1970 (the end of 2099).
constexpr double kMaxTime_s = 4.1e9;
/// Maximum number of states that a query reads. A robot that sends 10 states per second reaches
/// this number in 23 days.
constexpr std::int64_t kMaxReadStates = 20'000'000;

double seconds_of(const serve::Command& request, std::string_view key, double max) {
    const auto* value = request.argument<double>(key);
    if (value == nullptr) return 0;
    if (*value >= 0 && *value <= max) return *value;
    throw BadArgument(fmt::format("{} must be a number from 0 to {:.0f}", key, max));
}

/// Returns the request, or nullopt if the command does not name a robot. Throws BadArgument if the
/// request is invalid.
std::optional<HistoryRequest> request_of(const serve::Command& command) {
    const auto* robot = command.argument<std::string>("robot");
    if (robot == nullptr) return std::nullopt;
    if (robot->empty() || robot->size() > kMaxRobotName)
        throw BadArgument("there is no such robot");
    const HistoryRequest request{*robot, seconds_of(command, "last_s", kMaxSpan_s),
                                 seconds_of(command, "from_s", kMaxTime_s),
                                 seconds_of(command, "to_s", kMaxTime_s),
                                 seconds_of(command, "ask", 1e9)};
    if (request.last_s > 0) return request;
    if (request.from_s >= request.to_s)
        throw BadArgument("the time \"from\" must be before \"to\"");
    if (request.to_s - request.from_s > kMaxSpan_s)
        throw BadArgument(
            "the span has more than 31 days; dotpose fleet history reads longer spans");
    return request;
}

store::Query query_of(const HistoryRequest& request) {
    constexpr double kPerSecond = 1e6;
    const auto us = [](double seconds) { return static_cast<std::int64_t>(seconds * kPerSecond); };
    if (request.last_s <= 0) return {request.robot, us(request.from_s), us(request.to_s)};
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const std::int64_t now_us = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
    return {request.robot, now_us - us(request.last_s), now_us + us(1)};
}

json json_of(const HistoryRequest& request) {
    return {{"robot", request.robot}, {"ask", request.ask}};
}

std::string problem_text(json value, const std::string& problem) {
    value["problem"] = problem;
    return text_of(value);
}

}  // namespace

struct WebHistory::Queries {
    std::string where;
    std::mutex mutex;  ///< protects the following members
    std::condition_variable changed;
    bool ends = false;
    std::deque<HistoryRequest> waiting;  ///< queued requests, starting with the one being processed
    std::deque<std::pair<HistoryRequest, std::string>> results;

    bool is_ending() {
        const std::lock_guard lock(mutex);
        return ends;
    }
    std::string value_for(const serve::Command& command);
    std::string read(const HistoryRequest& request);
    std::string read_states(const HistoryRequest& request);
};

/// Returns the value for a client. This function is called on the server's thread, so it must not
/// wait for the database.
std::string WebHistory::Queries::value_for(const serve::Command& command) {
    try {
        const std::optional<HistoryRequest> request = request_of(command);
        if (!request) return "null";
        const std::lock_guard lock(mutex);
        for (const auto& [known, value] : results) {
            if (known == *request) return value;
        }
        if (std::ranges::find(waiting, *request) == waiting.end()) {
            if (waiting.size() >= kMaxQueries)
                return problem_text(json_of(*request), "too many queries are waiting; try again");
            waiting.push_back(*request);
            changed.notify_one();
        }
        json value = json_of(*request);
        value["is_reading"] = true;
        return text_of(value);
    } catch (const BadArgument& error) {
        json value = json::object();
        if (const auto* ask = command.argument<double>("ask")) value["ask"] = *ask;
        return problem_text(std::move(value), error.what());
    }
}

std::string WebHistory::Queries::read_states(const HistoryRequest& request) {
    /// Thrown to end a query early.
    struct Enough {};
    ThinnedHistory history;
    bool is_cut = false;
    const auto database = store::make_database(where, store::Access::read);
    try {
        database->read(query_of(request), [&](const store::State& state) {
            constexpr std::int64_t kCheckPeriod = 1024;
            history.add(state);
            is_cut = history.states() >= kMaxReadStates;
            if (is_cut || (history.states() % kCheckPeriod == 0 && is_ending())) throw Enough();
        });
    } catch (const Enough&) {
    }
    json value = history.value();
    value.update(json_of(request));
    value["is_cut"] = is_cut;
    return text_of(value);
}

/// Returns the states, or the reason why they cannot be read.
std::string WebHistory::Queries::read(const HistoryRequest& request) {
    try {
        return read_states(request);
    } catch (const std::exception& error) {
        return problem_text(json_of(request), error.what());
    }
}

WebHistory::WebHistory(const std::string& where, serve::Server& server, serve::Topic& topic)
    : server_(server), topic_(topic), queries_(std::make_shared<Queries>()) {
    queries_->where = where;
    publish();
    thread_ = std::thread([this] { run(); });
}

WebHistory::~WebHistory() {
    {
        const std::lock_guard lock(queries_->mutex);
        queries_->ends = true;
    }
    queries_->changed.notify_one();
    thread_.join();
}

/// Sends each client the result of its request, or a notice that the request is still waiting.
void WebHistory::publish() {
    server_.publish_for_each(topic_, [queries = queries_](const serve::Command& request) {
        return queries->value_for(request);
    });
}

void WebHistory::run() {
    serve::run_in_background();
    Queries& queries = *queries_;
    std::unique_lock lock(queries.mutex);
    while (true) {
        queries.changed.wait(lock, [&] { return queries.ends || !queries.waiting.empty(); });
        if (queries.ends) return;
        const HistoryRequest request = queries.waiting.front();
        lock.unlock();
        std::string value = queries.read(request);
        lock.lock();
        queries.waiting.pop_front();
        queries.results.emplace_back(request, std::move(value));
        if (queries.results.size() > kMaxHistories) queries.results.pop_front();
        lock.unlock();
        publish();
        lock.lock();
    }
}

}  // namespace dotpose::cli
