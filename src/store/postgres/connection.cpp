#include "store/postgres/connection.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include <fmt/core.h>

namespace dotpose::store {
namespace {

/// Joins the lines of a libpq message into one line, without their indentation.
std::string in_one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const bool is_space = c == '\n' || c == '\t' || c == ' ';
        if (!is_space) line += c;
        if (is_space && !line.empty() && line.back() != ' ') line += ' ';
    }
    if (line.ends_with(' ')) line.pop_back();
    return line;
}

std::vector<const char*> pointers_to(std::initializer_list<std::string> texts) {
    std::vector<const char*> pointers;
    for (const std::string& text : texts)
        pointers.push_back(text.c_str());
    return pointers;
}

}  // namespace

std::string_view Rows::text(int row, int column) const {
    return {PQgetvalue(result_.get(), row, column),
            static_cast<std::size_t>(PQgetlength(result_.get(), row, column))};
}

std::int64_t Rows::integer(int row, int column) const {
    std::int64_t value = 0;
    const std::string_view digits = text(row, column);
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return value;
}

PostgresConnection::PostgresConnection(const std::string& url) : connection_(nullptr, &PQfinish) {
    // Default parameters, which the URL can override. The three timeouts ensure that a lost
    // connection is detected.
    constexpr std::array keys = {"connect_timeout",  "tcp_user_timeout", "keepalives_idle",
                                 "application_name", "client_encoding",  "dbname"};
    std::array<const char*, keys.size() + 1> names{};
    std::ranges::copy(keys, names.begin());
    const std::array<const char*, keys.size() + 1> values = {
        "5", "10000", "10", "dotpose fleet", "UTF8", url.c_str(), nullptr};
    connection_.reset(PQconnectdbParams(names.data(), values.data(), 1));
    // Notices are discarded, because libpq would print them to standard error.
    PQsetNoticeProcessor(
        connection_.get(), [](void*, const char*) {}, nullptr);
    if (PQstatus(connection_.get()) == CONNECTION_OK) return;
    throw Error(in_one_line(PQerrorMessage(connection_.get())));
}

void PostgresConnection::fail(const PGresult* result) {
    const char* state = result == nullptr ? nullptr : PQresultErrorField(result, PG_DIAG_SQLSTATE);
    const char* message =
        result == nullptr ? nullptr : PQresultErrorField(result, PG_DIAG_MESSAGE_PRIMARY);
    throw Refused(in_one_line(message != nullptr ? message : PQerrorMessage(connection_.get())),
                  state != nullptr ? state : "");
}

Rows PostgresConnection::checked(PGresult* result) {
    Rows rows(result);
    const ExecStatusType status = PQresultStatus(result);
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK && status != PGRES_SINGLE_TUPLE) {
        fail(result);
    }
    return rows;
}

Rows PostgresConnection::run(const std::string& statements) {
    return checked(PQexec(connection_.get(), statements.c_str()));
}

Rows PostgresConnection::run(const std::string& statement,
                             std::initializer_list<std::string> parameters) {
    const auto values = pointers_to(parameters);
    return checked(PQexecParams(connection_.get(), statement.c_str(),
                                static_cast<int>(values.size()), nullptr, values.data(), nullptr,
                                nullptr, 0));
}

void PostgresConnection::start(const std::string& statement,
                               std::initializer_list<std::string> parameters) {
    const auto values = pointers_to(parameters);
    const bool is_sent =
        PQsendQueryParams(connection_.get(), statement.c_str(), static_cast<int>(values.size()),
                          nullptr, values.data(), nullptr, nullptr, 0) == 1;
    if (!is_sent || PQsetSingleRowMode(connection_.get()) != 1) fail(nullptr);
}

Rows PostgresConnection::next() {
    Rows rows = checked(PQgetResult(connection_.get()));
    if (rows.size() == 0) {
        while (PGresult* const rest = PQgetResult(connection_.get()))
            PQclear(rest);
    }
    return rows;
}

void PostgresConnection::copy(const std::string& statement, std::string_view data) {
    constexpr std::size_t kBlock = 1 << 20;
    Rows begun(PQexec(connection_.get(), statement.c_str()));
    if (PQresultStatus(begun.get()) != PGRES_COPY_IN) fail(begun.get());
    for (std::size_t at = 0; at < data.size(); at += kBlock) {
        const std::string_view block = data.substr(at, kBlock);
        if (PQputCopyData(connection_.get(), block.data(), static_cast<int>(block.size())) != 1) {
            fail(nullptr);
        }
    }
    if (PQputCopyEnd(connection_.get(), nullptr) != 1) fail(nullptr);
    checked(PQgetResult(connection_.get()));
    while (PGresult* const rest = PQgetResult(connection_.get()))
        PQclear(rest);
}

std::string label_of(const std::string& url) {
    char* error = nullptr;
    const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> options(
        PQconninfoParse(url.c_str(), &error), &PQconninfoFree);
    const std::unique_ptr<char, decltype(&PQfreemem)> message(error, &PQfreemem);
    if (!options) {
        throw BadArgument("the URL of the database is not valid: " +
                          in_one_line(message ? message.get() : "no memory"));
    }
    std::string host = "localhost";
    std::string database;
    for (const PQconninfoOption* option = options.get(); option->keyword != nullptr; ++option) {
        if (option->val == nullptr) continue;
        const std::string_view keyword = option->keyword;
        if (keyword == "host") host = option->val;
        if (keyword == "dbname") database = option->val;
    }
    return fmt::format("postgresql://{}/{}", host, database);
}

}  // namespace dotpose::store
