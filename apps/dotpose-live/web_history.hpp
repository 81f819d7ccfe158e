/// The `history` topic, which provides the stored states of a robot to the web page of `dotpose
/// fleet --web --store`.
///
/// A low-priority thread reads the database through its own connection, so the live values on the
/// page are not delayed.
#pragma once

#include <memory>
#include <string>
#include <thread>

#include "serve/server.hpp"

namespace dotpose::cli {

class WebHistory {
  public:
    /// `where` is the database given to --store. The server must already be running.
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
    std::shared_ptr<Queries> queries_;  ///< shared with the server's thread
    std::thread thread_;                // declared last, because the thread uses the other members
};

}  // namespace dotpose::cli
