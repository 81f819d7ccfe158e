/// Runs PostgreSQL for a test, on a free port of the loopback interface.
#pragma once

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <fmt/core.h>
#include <unistd.h>

#include "../shell.hpp"
#include "broker.hpp"

namespace dotpose::test {

/// A PostgreSQL cluster. PostgreSQL refuses to run as root. If the test runs as root, the cluster
/// therefore belongs to the `postgres` user, which the Debian package creates.
class Postgres {
  public:
    Postgres() : port_(free_port()) {
        directory_ = checked("mktemp -d /tmp/dotpose-postgres-XXXXXX");
        directory_.pop_back();  // removes the line break
        if (geteuid() == 0) checked("chown postgres " + directory_);
        checked(as_user("initdb -D data -A trust -U robots --no-sync -E UTF8"));
        start();
        checked(as_user(fmt::format("createdb -h 127.0.0.1 -p {} -U robots fleet", port_)));
    }
    ~Postgres() {
        run_shell(as_user("pg_ctl -D data stop -m immediate"));
        std::filesystem::remove_all(directory_);
    }
    Postgres(const Postgres&) = delete;
    Postgres& operator=(const Postgres&) = delete;

    void start() {
        checked(as_user(fmt::format("pg_ctl -D data -w -l log -o '-p {} -k {} -h 127.0.0.1' start",
                                    port_, directory_)));
    }
    /// Kills all processes as in a crash, without giving PostgreSQL time to write a checkpoint.
    void crash() { checked(as_user("pg_ctl -D data -w stop -m immediate")); }

    std::string url() const { return fmt::format("postgresql://robots@127.0.0.1:{}/fleet", port_); }

    /// Returns the result rows of a query, with | between columns.
    std::string query(const std::string& sql) const {
        return checked("psql -X -A -t '" + url() + "' -c \"" + sql + "\"");
    }

  private:
    std::string as_user(const std::string& command) const {
        const std::string inside =
            "cd " + directory_ + " && PATH=$(ls -d /usr/lib/postgresql/*/bin | tail -1):$PATH && " +
            command;
        return geteuid() == 0 ? "runuser -u postgres -- sh -c \"" + escaped(inside) + "\"" : inside;
    }
    static std::string escaped(std::string text) {
        std::string result;
        for (const char c : text)
            result += c == '$' || c == '"' ? std::string("\\") + c : std::string(1, c);
        return result;
    }
    static std::string checked(const std::string& command) {
        const ShellOutcome outcome = run_shell("{ " + command + "; } 2>&1");
        if (outcome.exit_code != 0) throw std::runtime_error(command + ": " + outcome.output);
        return outcome.output;
    }

    int port_;
    std::string directory_;
};

}  // namespace dotpose::test
