// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mqtt/mqtt_connection.hpp"

#include <mosquitto.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace geoloc::io {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kKeepalive_s = 30;
constexpr int kAtLeastOnce = 1;
constexpr auto kFirstBackoff = std::chrono::milliseconds{500};
constexpr auto kLongestBackoff = std::chrono::milliseconds{10'000};
constexpr auto kStep = std::chrono::milliseconds{100};
/// A broker that takes a connection and then says nothing.
constexpr auto kMostSilence = std::chrono::seconds{15};

/// For encrypted keys: OpenSSL would ask the terminal.
int no_password(char* /*buffer*/, int /*size*/, int /*is_for_writing*/, void* /*user*/) {
  return 0;
}

const char* file_or_null(const std::string& file) {
  return file.empty() ? nullptr : file.c_str();
}

}  // namespace

struct MqttConnection::State {
  struct Library {
    Library() { mosquitto_lib_init(); }
    ~Library() { mosquitto_lib_cleanup(); }
  };
  struct Destroy {
    void operator()(mosquitto* its_client) const { mosquitto_destroy(its_client); }
  };
  struct Message {
    std::string topic, payload;
  };

  State(MqttAccess given, Tell its_tell) : access(std::move(given)), tell(std::move(its_tell)) {
    client.reset(mosquitto_new(nullptr, true, this));
    if (!client) throw std::runtime_error(name() + ": no memory for a connection");
    if (!access.address.user.empty() &&
        mosquitto_username_pw_set(client.get(), access.address.user.c_str(), file_or_null(access.password)) !=
            MOSQ_ERR_SUCCESS)
      throw std::runtime_error(name() + ": the user's name or password cannot be used");
    if (access.address.is_tls) set_tls();
    mosquitto_connect_callback_set(client.get(), [](mosquitto*, void* self, int refusal) {
      static_cast<State*>(self)->on_connect(refusal);
    });
    mosquitto_publish_callback_set(client.get(), [](mosquitto*, void* self, int number) {
      static_cast<State*>(self)->on_published(number);
    });
    mosquitto_message_callback_set(client.get(),
                                   [](mosquitto*, void* self, const mosquitto_message* message) {
                                     static_cast<State*>(self)->on_received(*message);
                                   });
    mosquitto_log_callback_set(client.get(), [](mosquitto*, void* self, int level, const char* text) {
      if (level == MOSQ_LOG_ERR) static_cast<State*>(self)->note(text);
    });
  }

  std::string name() const { return "--mqtt " + access.address.url(); }

  void set_tls() {
    const char* const folder = access.ca_file.empty() ? "/etc/ssl/certs" : nullptr;
    const int status =
        mosquitto_tls_set(client.get(), file_or_null(access.ca_file), folder,
                          file_or_null(access.certificate_file), file_or_null(access.key_file), &no_password);
    if (status != MOSQ_ERR_SUCCESS)
      throw std::runtime_error(name() + ": " +
                               (status == MOSQ_ERR_INVAL
                                    ? "a file of --mqtt-ca, --mqtt-cert or --mqtt-key cannot be read, or a "
                                      "certificate is without its key"
                                    : mosquitto_strerror(status)));
  }

  // What libmosquitto calls: nothing may be thrown through it.

  void on_connect(int refusal) noexcept {
    if (refusal != 0) {
      note(mosquitto_connack_string(refusal));
      is_refused = true;
      return;
    }
    is_open = true;
    ++counts.connections;
    backoff = kFirstBackoff;
    if (!topics.empty()) mosquitto_subscribe(client.get(), nullptr, topics.c_str(), kAtLeastOnce);
  }

  void on_published(int number) noexcept {
    if (in_flight != number) return;
    in_flight.reset();
    ++counts.delivered;
  }

  void on_received(const mosquitto_message& message) noexcept {
    heard_at = Clock::now();
    try {
      const auto size = static_cast<std::size_t>(std::max(0, message.payloadlen));
      on_message(message.topic, {static_cast<const char*>(message.payload), size});
    } catch (const std::exception& error) {
      note(error.what());
    }
  }

  void note(const char* text) noexcept {
    try {
      words = text;
    } catch (const std::exception&) {
      words.clear();
    }
  }

  // What poll() does.

  void open(Clock::time_point now) {
    words.clear();
    is_refused = false;
    is_trying = true;
    heard_at = now;
    const int status =
        mosquitto_connect_async(client.get(), access.address.host.c_str(), access.address.port, kKeepalive_s);
    if (status != MOSQ_ERR_SUCCESS) fail(now, status);
  }

  std::string reason_of(int status) const {
    if (!words.empty()) return words;
    if (status == MOSQ_ERR_ERRNO) return std::generic_category().message(errno);
    return mosquitto_strerror(status);
  }

  void fail(Clock::time_point now, int status) {
    fault = reason_of(status);
    const bool was_open = std::exchange(is_open, false);
    is_trying = false;
    mosquitto_disconnect(client.get());
    next_attempt = now + (was_open ? kFirstBackoff : backoff);
    backoff = std::min(2 * backoff, kLongestBackoff);
    if (!std::exchange(has_told, true)) tell(name() + ": " + fault + "; trying again");
  }

  void send_waiting() {
    if (!is_open || !waiting || in_flight) return;
    int number = 0;
    const int status = mosquitto_publish(client.get(), &number, waiting->topic.c_str(),
                                         static_cast<int>(waiting->payload.size()), waiting->payload.data(),
                                         kAtLeastOnce, true);
    if (status != MOSQ_ERR_SUCCESS) return fail(Clock::now(), status);
    in_flight = number;
    waiting.reset();
  }

  void poll(std::chrono::milliseconds patience) {
    const auto now = Clock::now();
    if (!is_trying) {
      if (now < next_attempt) {
        std::this_thread::sleep_for(std::min<Clock::duration>(patience, next_attempt - now));
        return;
      }
      open(now);
      if (!is_trying) return;
    }
    send_waiting();
    if (!is_trying) return;
    const int status = mosquitto_loop(client.get(), static_cast<int>(patience.count()), 1);
    if (status != MOSQ_ERR_SUCCESS || is_refused) return fail(Clock::now(), status);
    if (!is_open && Clock::now() - heard_at > kMostSilence) {
      note("no answer");
      return fail(Clock::now(), MOSQ_ERR_UNKNOWN);
    }
    if (is_open) {
      fault.clear();
      if (std::exchange(has_told, false)) tell(name() + ": connected");
    }
    send_waiting();
  }

  Library library;
  MqttAccess access;
  Tell tell;
  std::string topics;
  OnMessage on_message;
  std::unique_ptr<mosquitto, Destroy> client;
  bool is_trying = false;   // there is a connection, or one is being made
  bool is_open = false;     // the broker has taken us
  bool is_refused = false;  // it has not
  bool has_told = false;    // of a fault that lasts
  std::string words;        // of libmosquitto, or of the broker
  std::string fault;
  Clock::time_point next_attempt{};
  Clock::time_point heard_at{};
  std::chrono::milliseconds backoff = kFirstBackoff;
  std::optional<Message> waiting;
  std::optional<int> in_flight;  // libmosquitto sends it again after a break
  Counts counts;
};

MqttConnection::MqttConnection(MqttAccess access, Tell tell)
    : state_(std::make_unique<State>(std::move(access), std::move(tell))) {}

MqttConnection::~MqttConnection() = default;

void MqttConnection::subscribe(std::string topics, OnMessage on_message) {
  state_->topics = std::move(topics);
  state_->on_message = std::move(on_message);
}

void MqttConnection::publish(const std::string& topic, std::string payload) {
  if (state_->waiting) ++state_->counts.replaced;
  state_->waiting = {topic, std::move(payload)};
  state_->send_waiting();
}

void MqttConnection::poll(std::chrono::milliseconds patience) {
  state_->poll(patience);
}

bool MqttConnection::flush(std::chrono::milliseconds patience) {
  const auto deadline = Clock::now() + patience;
  while (state_->waiting || state_->in_flight) {
    if (Clock::now() >= deadline) return false;
    poll(kStep);
  }
  return true;
}

bool MqttConnection::is_connected() const {
  return state_->is_open;
}

const MqttConnection::Counts& MqttConnection::counts() const {
  return state_->counts;
}

const std::string& MqttConnection::fault() const {
  return state_->fault;
}

}  // namespace geoloc::io
