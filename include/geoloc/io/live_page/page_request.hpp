// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace geoloc::io {

using Headers = std::vector<std::pair<std::string, std::string>>;

/// The relevant parts of a request, unchecked.
struct PageRequest {
  std::string method;
  std::string path;        ///< without the query
  std::string host;        ///< header Host
  std::string fetch_site;  ///< headers Sec-Fetch-Site and -Mode: the browser's statement on whose behalf it
                           ///< sends the request
  std::string fetch_mode;
  std::string query = {};   ///< of the target, without the question mark
  std::string cookie = {};  ///< headers Cookie, Authorization and Origin
  std::string authorization = {};
  std::string origin = {};
  bool is_forwarded = false;        ///< a proxy says that it passes the request on
  std::string forwarded_for = {};   ///< for whom: the last of header X-Forwarded-For
  bool is_over_tls = false;         ///< and that its client speaks TLS
  std::string client_network = {};  ///< who sends it, as ClientAddress has it
  bool is_from_this_computer = false;
};

struct PageAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  bool is_event_stream = false;  ///< in place of the body
  Headers headers = {};          ///< besides those of every answer
};

}  // namespace geoloc::io
