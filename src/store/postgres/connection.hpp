// A connection to PostgreSQL with libpq. Errors are thrown as exceptions.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

#include <libpq-fe.h>

#include "dotpose/files/error.hpp"

namespace dotpose::store {

/// Thrown if the database rejects a statement or the connection is lost.
struct Refused : Error {
    Refused(const std::string& message, std::string state)
        : Error(message), sql_state(std::move(state)) {}
    std::string sql_state;  ///< SQLSTATE code, or empty if the connection was lost
};

class Rows {
  public:
    explicit Rows(PGresult* result) : result_(result, &PQclear) {}
    int size() const { return PQntuples(result_.get()); }
    bool is_null(int row, int column) const { return PQgetisnull(result_.get(), row, column) != 0; }
    std::string_view text(int row, int column) const;
    /// Returns the value as an integer, or 0 if it is null.
    std::int64_t integer(int row, int column) const;
    PGresult* get() const { return result_.get(); }

  private:
    std::unique_ptr<PGresult, decltype(&PQclear)> result_;
};

class PostgresConnection {
  public:
    /// Connects to the server. Throws Error if the connection cannot be established within 5 s, or
    /// within the time limit in the URL if it contains one.
    explicit PostgresConnection(const std::string& url);

    /// Runs statements without parameters, separated by semicolons. Throws Refused.
    Rows run(const std::string& statements);

    /// Runs a statement with the parameters $1, $2, .... Throws Refused.
    Rows run(const std::string& statement, std::initializer_list<std::string> parameters);

    /// Starts a statement. `next` then returns its rows one at a time. Throws Refused.
    void start(const std::string& statement, std::initializer_list<std::string> parameters);
    /// Returns a result with only the next row, or an empty result after the last row. Throws
    /// Refused.
    Rows next();

    /// Runs a COPY ... FROM STDIN statement with `data`, which must be in the binary format. Throws
    /// Refused.
    void copy(const std::string& statement, std::string_view data);

  private:
    Rows checked(PGresult* result);
    [[noreturn]] void fail(const PGresult* result);

    std::unique_ptr<PGconn, decltype(&PQfinish)> connection_;
};

/// Returns the host and the database name in a URL, without the user and the password. Throws
/// BadArgument if the URL is invalid.
std::string label_of(const std::string& url);

}  // namespace dotpose::store
