// A connection to PostgreSQL with libpq. Errors are exceptions.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

#include <libpq-fe.h>

#include "dotpose/files/error.hpp"

namespace dotpose::store {

/// Thrown if the database rejects a statement.
struct Refused : Error {
    Refused(const std::string& message, std::string state)
        : Error(message), sql_state(std::move(state)) {}
    std::string sql_state;  ///< code of five characters, or empty if the connection broke
};

class Rows {
  public:
    explicit Rows(PGresult* result) : result_(result, &PQclear) {}
    int size() const { return PQntuples(result_.get()); }
    bool is_null(int row, int column) const { return PQgetisnull(result_.get(), row, column) != 0; }
    std::string_view text(int row, int column) const;
    /// Returns the value as an integer, or 0 if the value is null.
    std::int64_t integer(int row, int column) const;
    PGresult* get() const { return result_.get(); }

  private:
    std::unique_ptr<PGresult, decltype(&PQclear)> result_;
};

class PostgresConnection {
  public:
    /// Connects to the server. Throws Error if this takes more than 5 s or fails.
    explicit PostgresConnection(const std::string& url);

    /// Runs statements without parameters, separated by semicolons. Throws Refused.
    Rows run(const std::string& statements);

    /// Runs a statement with the parameters $1, $2, .... Throws Refused.
    Rows run(const std::string& statement, std::initializer_list<std::string> parameters);

    /// Starts a statement whose rows are returned one at a time by `next`. Throws Refused.
    void start(const std::string& statement, std::initializer_list<std::string> parameters);
    /// Returns the next row as the only element of the result. Returns an empty result after the
    /// last row. Throws Refused.
    Rows next();

    /// Runs a statement COPY ... FROM STDIN and sends `data`, in the binary format, to it. Throws
    /// Refused.
    void copy(const std::string& statement, std::string_view data);

  private:
    Rows checked(PGresult* result);
    [[noreturn]] void fail(const PGresult* result);

    std::unique_ptr<PGconn, decltype(&PQfinish)> connection_;
};

/// Returns the host and the database of a URL, without user and password. Throws BadArgument if the
/// URL is not valid.
std::string label_of(const std::string& url);

}  // namespace dotpose::store
