/// Runs a mosquitto broker on a free port of the loopback interface.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dotpose::test {

inline int free_port() {
    const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    if (bind(descriptor, generic, size) != 0 || getsockname(descriptor, generic, &size) != 0) {
        throw std::runtime_error("no free port");
    }
    close(descriptor);
    return ntohs(address.sin_port);
}

class Broker {
  public:
    /// `users` is the path of a file written by mosquitto_passwd. If no path is given, anonymous
    /// clients are allowed. With TLS, the broker uses a self-signed certificate, cert.pem in
    /// `directory`. `more` is appended to the configuration file.
    explicit Broker(const std::filesystem::path& directory, const std::string& users = {},
                    bool has_tls = false, const std::string& more = {})
        : port_(free_port()), directory_(directory), has_tls_(has_tls) {
        if (has_tls) make_certificate();
        std::ofstream configuration(directory / "mosquitto.conf");
        configuration << "listener " << port_ << " 127.0.0.1\n"
                      << "persistence true\npersistence_location " << directory.string() << "/\n"
                      << "max_queued_messages 100000\nuser root\n";
        if (users.empty()) {
            configuration << "allow_anonymous true\n";
        } else {
            configuration << "allow_anonymous false\npassword_file " << users << "\n";
        }
        if (has_tls) {
            configuration << "certfile " << certificate() << "\nkeyfile "
                          << (directory / "key.pem").string() << "\n";
        }
        configuration << more;
        configuration.close();
        start();
    }
    ~Broker() { stop(); }
    Broker(const Broker&) = delete;
    Broker& operator=(const Broker&) = delete;

    void start() {
        const std::string file = (directory_ / "mosquitto.conf").string();
        process_ = fork();
        if (process_ == 0) {
            const int nowhere = open("/dev/null", O_RDWR);
            dup2(nowhere, STDOUT_FILENO);
            dup2(nowhere, STDERR_FILENO);
            // Adds /usr/sbin to the PATH. Debian installs mosquitto there, but only the PATH of
            // root contains this folder.
            setenv("PATH", (std::string(std::getenv("PATH")) + ":/usr/sbin").c_str(), 1);
            execlp("mosquitto", "mosquitto", "-c", file.c_str(), nullptr);
            _exit(127);
        }
        for (int i = 0; i < 500 && !answers(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        if (!answers()) throw std::runtime_error("mosquitto does not start");
    }
    void stop() {
        if (process_ <= 0) return;
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
        process_ = 0;
    }

    int port() const { return port_; }
    std::string url() const {
        return (has_tls_ ? "mqtts://127.0.0.1:" : "mqtt://127.0.0.1:") + std::to_string(port_);
    }
    std::string certificate() const { return (directory_ / "cert.pem").string(); }

  private:
    void make_certificate() const {
        const std::string command =
            "cd '" + directory_.string() +
            "' && openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes "
            "-keyout key.pem -out cert.pem -days 2 -subj /CN=127.0.0.1 "
            "-addext subjectAltName=IP:127.0.0.1 2> /dev/null";
        if (std::system(command.c_str()) != 0) throw std::runtime_error("no certificate");
    }
    bool answers() const {
        const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port_));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const bool is_there =
            connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
        close(descriptor);
        return is_there;
    }

    int port_;
    std::filesystem::path directory_;
    bool has_tls_;
    pid_t process_ = 0;
};

}  // namespace dotpose::test
