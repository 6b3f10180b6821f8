// SPDX-License-Identifier: Apache-2.0
#include "http_message.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/write.hpp>
#include <cstdint>
#include <limits>
#include <sstream>

namespace geoloc::io {
namespace {

namespace http = boost::beast::http;

constexpr std::size_t kLongestTarget = 8192;
constexpr std::size_t kLongestHeader = 8192;
constexpr int kServiceUnavailable = 503;

using Request = http::request<http::empty_body>;

template <typename Name>
std::string header(const Request& request, Name name) {
  const auto found = request.find(name);
  return found == request.end() ? "" : std::string(found->value());
}

std::variant<PageRequest, Refusal> judged(const Request& request) {
  const std::string target(request.target());
  if (target.size() > kLongestTarget) return Refusal{414};
  if (request.method() == http::verb::unknown) return Refusal{400};
  for (const auto& field : request) {
    if (field.value().size() > kLongestHeader) return Refusal{400};
  }
  const std::string address = target.substr(0, target.find('#'));
  const std::size_t question = address.find('?');
  PageRequest parts{std::string(request.method_string()), address.substr(0, question),
                    header(request, http::field::host), header(request, "Sec-Fetch-Site"),
                    header(request, "Sec-Fetch-Mode")};
  if (question != std::string::npos) parts.query = address.substr(question + 1);
  parts.origin = header(request, http::field::origin);
  return parts;
}

}  // namespace

struct RequestHead::Parser {
  http::request_parser<http::empty_body> parser;
  std::string waiting;  // bytes of an incomplete line
  std::size_t bytes_left;
};

RequestHead::RequestHead(std::size_t most_bytes) : parser_(std::make_unique<Parser>()) {
  parser_->bytes_left = most_bytes;
  parser_->parser.header_limit(std::numeric_limits<std::uint32_t>::max());  // bytes_left is the limit
  parser_->parser.skip(true);  // bodies are not expected and not read
}

RequestHead::~RequestHead() = default;

std::optional<std::variant<PageRequest, Refusal>> RequestHead::add(std::string_view bytes) {
  auto& [parser, waiting, bytes_left] = *parser_;
  const bool is_too_long = bytes.size() > bytes_left;
  bytes = bytes.substr(0, bytes_left);
  bytes_left -= bytes.size();
  waiting += bytes;
  while (!parser.is_header_done()) {
    boost::system::error_code error;
    const std::size_t used = parser.put(boost::asio::buffer(waiting), error);
    waiting.erase(0, used);
    if (error == http::error::need_more && !is_too_long) return std::nullopt;
    if (error) return Refusal{400};
  }
  return judged(parser.get());
}

std::string answer_head(const PageAnswer& answer, const Headers& headers,
                        std::optional<std::size_t> body_size) {
  http::response<http::empty_body> head;
  head.version(11);
  head.result(static_cast<unsigned>(answer.status));
  for (const auto& [name, value] : headers) head.set(name, value);
  head.set(http::field::connection, "close");
  if (!answer.type.empty()) head.set(http::field::content_type, answer.type);
  if (body_size) head.set(http::field::content_length, std::to_string(*body_size));
  if (answer.status == kServiceUnavailable) head.set(http::field::retry_after, "5");
  std::ostringstream text;
  text << head.base();
  return text.str();
}

}  // namespace geoloc::io
