// SPDX-License-Identifier: Apache-2.0
#include "http_message.hpp"

#include <gtest/gtest.h>

#include "fuzz/hostile_requests.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kRoom = 16384;
const std::string kRequest =
    "GET /objects/17?x=1 HTTP/1.1\r\nHost: localhost:8080\r\nsec-fetch-site: same-origin\r\n"
    "Sec-Fetch-Mode: cors\r\nOrigin: http://localhost:8080\r\n\r\n";

using Read = std::optional<std::variant<PageRequest, Refusal>>;

Read read(std::string_view bytes, std::size_t room = kRoom) {
  return RequestHead(room).add(bytes);
}

int refusal_of(const Read& read) {
  return read && std::holds_alternative<Refusal>(*read) ? std::get<Refusal>(*read).status : 0;
}

void expect_the_request(const Read& read, const std::string& what) {
  ASSERT_TRUE(read && std::holds_alternative<PageRequest>(*read)) << what;
  const auto& request = std::get<PageRequest>(*read);
  EXPECT_EQ(request.method, "GET") << what;
  EXPECT_EQ(request.path, "/objects/17") << what;
  EXPECT_EQ(request.query, "x=1") << what;
  EXPECT_EQ(request.host, "localhost:8080") << what;
  EXPECT_EQ(request.fetch_site, "same-origin") << what;
  EXPECT_EQ(request.fetch_mode, "cors") << what;
  EXPECT_EQ(request.query, "x=1") << what;
  EXPECT_EQ(request.origin, "http://localhost:8080") << what;
}

TEST(RequestHead, IsTheSameInWhateverPiecesItComes) {
  for (std::size_t piece = 1; piece <= kRequest.size(); ++piece) {
    RequestHead head(kRoom);
    Read whole;
    for (std::size_t at = 0; at < kRequest.size(); at += piece) {
      ASSERT_FALSE(whole) << piece << " bytes at a time, whole before the byte " << at;
      whole = head.add(std::string_view(kRequest).substr(at, piece));
    }
    expect_the_request(whole, std::to_string(piece) + " bytes at a time");
  }
}

TEST(RequestHead, IsWholeAtTheEmptyLineAndNotBefore) {
  expect_the_request(read(kRequest + "and a body"), "with a body");
  for (std::size_t size = 0; size < kRequest.size(); ++size) {
    EXPECT_FALSE(read(kRequest.substr(0, size))) << size;
  }
}

TEST(RequestHead, IsRefusedBeyondItsBytes) {
  expect_the_request(read(kRequest, kRequest.size()), "just as long as allowed");
  EXPECT_EQ(refusal_of(read(kRequest, kRequest.size() - 1)), 400);
  EXPECT_EQ(refusal_of(read(std::string(kRoom + 1, 'a'))), 400);
}

TEST(RequestHead, IsRefusedByWhatIsWrongWithIt) {
  EXPECT_EQ(refusal_of(read("GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n\r\n")), 414);
  EXPECT_EQ(refusal_of(read("GET / HTTP/1.1\r\nX: " + std::string(9000, 'a') + "\r\n\r\n")), 400);
  for (const char* const text :
       {"BREW / HTTP/1.1\r\n\r\n", "GET / HTTP/2.0\r\n\r\n", "GET /\r\n\r\n", "\r\n\r\n",
        "GET / HTTP/1.1\r\nno colon\r\n\r\n", "GET / HTTP/1.1\r\n\x01: x\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length: x\r\n\r\n"}) {
    EXPECT_EQ(refusal_of(read(text)), 400) << text;
  }
}

TEST(RequestHead, HasWhatSaysWhoAsks) {
  const auto request_with = [](const std::string& headers) {
    return std::get<PageRequest>(*read("GET /?token=a&b?c#d HTTP/1.1\r\n" + headers + "\r\n"));
  };
  const PageRequest plain = request_with("");
  EXPECT_EQ(plain.path, "/");
  EXPECT_EQ(plain.query, "token=a&b?c");
  EXPECT_FALSE(plain.is_forwarded || plain.is_over_tls || plain.is_from_this_computer);
  const PageRequest full =
      request_with("Cookie: a=b; c=d\r\nauthorization: Bearer x\r\nOrigin: http://localhost\r\n");
  EXPECT_EQ(full.cookie, "a=b; c=d");
  EXPECT_EQ(full.authorization, "Bearer x");
  EXPECT_EQ(full.origin, "http://localhost");
  for (const char* const name : {"Forwarded", "Via", "X-Forwarded-For", "X-Real-IP", "x-forwarded-proto"})
    EXPECT_TRUE(request_with(std::string(name) + ": x\r\n").is_forwarded) << name;
  for (const char* const stated : {"10.0.0.1", "10.0.0.9, 10.0.0.1", "unknown,10.0.0.1"})
    EXPECT_EQ(request_with("X-Forwarded-For: " + std::string(stated) + "\r\n").forwarded_for, "10.0.0.1");
  EXPECT_TRUE(request_with("X-Forwarded-Proto: https\r\n").is_over_tls);
}

TEST(RequestHead, IsReadOrRefusedWhateverComes) {
  std::string bytes = kRequest;
  for (std::size_t i = 0; i < 4000; ++i) {
    bytes[(i * 7919) % bytes.size()] = static_cast<char>(i * 31);
    hostile::read_request(bytes);
    if (i % 40 == 0) bytes = kRequest;
  }
}

TEST(AnswerHead, StatesWhatFollows) {
  const Headers headers{{"Cache-Control", "no-store"}};
  EXPECT_EQ(answer_head({200, "text/plain", "", false}, headers, 12),
            "HTTP/1.1 200 OK\r\nCache-Control: no-store\r\nConnection: close\r\nContent-Type: text/plain\r\n"
            "Content-Length: 12\r\n\r\n");
  EXPECT_EQ(answer_head({200, "", "", false, {{"Set-Cookie", "a=b"}}}, {}, 0),
            "HTTP/1.1 200 OK\r\nSet-Cookie: a=b\r\nConnection: close\r\nContent-Length: 0\r\n\r\n");
  EXPECT_EQ(
      answer_head({503, "", "", false}, {}, 0),
      "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Length: 0\r\nRetry-After: 5\r\n\r\n");
  EXPECT_EQ(answer_head({200, "text/event-stream", "", true}, {}, std::nullopt),
            "HTTP/1.1 200 OK\r\nConnection: close\r\nContent-Type: text/event-stream\r\n\r\n");
}

}  // namespace
}  // namespace geoloc::io
