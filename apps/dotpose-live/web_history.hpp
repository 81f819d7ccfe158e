/// The topic `history` of the page of `dotpose fleet --web --store`: stored states of a robot.
///
/// A thread with a low priority reads the database, with a connection of its own. The live values
/// of the page do not wait for it.
#pragma once

#include <memory>
#include <string>
#include <thread>

#include "serve/server.hpp"

namespace dotpose::cli {

class WebHistory {
  public:
    /// `where` is the database of `--store`. The server must already be running.
    WebHistory(const std::string& where, serve::Server& server, serve::Topic& topic);
    /// Stops a running query.
    ~WebHistory();
    WebHistory(const WebHistory&) = delete;
    WebHistory& operator=(const WebHistory&) = delete;

  private:
    struct Queries;

    void run();
    void publish();

    serve::Server& server_;
    serve::Topic& topic_;
    std::shared_ptr<Queries> queries_;  ///< shared with the thread of the server
    std::thread thread_;                // last member, because the thread uses the other members
};

}  // namespace dotpose::cli
