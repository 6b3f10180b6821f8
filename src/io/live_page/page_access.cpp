// SPDX-License-Identifier: Apache-2.0
#include "page_access.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <utility>

namespace geoloc::io {
namespace {

constexpr std::string_view kParameter = "token=";
constexpr std::string_view kBearer = "Bearer ";

bool is_same_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// The value of the part that begins with `name`, among parts that a mark separates.
std::optional<std::string> value_of(std::string_view text, char mark, std::string_view name) {
  while (!text.empty()) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const std::string_view part = text.substr(0, text.find(mark));
    if (part.substr(0, name.size()) == name) return std::string(part.substr(name.size()));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
  }
  return std::nullopt;
}

/// Browsers keep the cookies of all ports of a host together, so the name tells the ports apart.
std::string cookie_name(const std::string& host) {
  const std::size_t colon = host.rfind(':');
  const std::string port = colon == std::string::npos ? "" : host.substr(colon + 1);
  const bool is_port = !port.empty() && port.find_first_not_of("0123456789") == std::string::npos;
  return "geoloc_" + (is_port ? port : "80") + "=";
}

/// Sec-Fetch-Site comes from every browser to an address that it trusts, Origin to all others.
bool is_from_own_page(const PageRequest& request) {
  if (!request.fetch_site.empty()) return request.fetch_site == "same-origin";
  return request.origin.empty() || is_same_but_for_case(request.origin, "http://" + request.host) ||
         is_same_but_for_case(request.origin, "https://" + request.host);
}

std::string document(const std::string& head, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
         "<meta name=\"color-scheme\" content=\"light dark\">" +
         head + "<title>geoloc</title></head>\n<body>" + body + "</body>\n</html>\n";
}

PageAnswer ask_for_token(const PageRequest& request, bool was_wrong) {
  PageAnswer answer;
  answer.status = 401;
  answer.headers = {{"WWW-Authenticate", "Bearer realm=\"geoloc\""}};
  const std::string fault = was_wrong ? "That is not the token." : "The token is missing.";
  if (request.path != "/") {
    answer.body = fault + " Send it as Authorization: Bearer, or as the cookie that /?token=… sets.\n";
    return answer;
  }
  answer.type = "text/html; charset=utf-8";
  answer.body = document(
      "", "<h1>geoloc</h1>\n<p>" + (was_wrong ? "<strong>" + fault + "</strong> " : "") +
              "Whoever has the token sees this page. geoloc shows it as a link in the terminal where it "
              "runs; it is also in the file that <code>--http-token</code> names.</p>\n"
              "<form action=\"/\"><label>Token <input name=\"token\" type=\"password\" required autofocus "
              "autocomplete=\"current-password\"></label> <button>Open</button></form>");
  return answer;
}

PageAnswer ask_to_wait() {
  PageAnswer answer;
  answer.status = 429;
  answer.headers = {{"Retry-After", std::to_string(TokenGuesses::kPeriod.count())}};
  answer.body = "Too many wrong tokens came from your network. Wait a minute.\n";
  return answer;
}

/// Sets the cookie and leads to the address without the token. The document does so itself, because browsers
/// would not send a SameSite cookie along a redirection that began at another site's link.
PageAnswer welcome(const PageRequest& request, const std::string& token) {
  PageAnswer answer;
  answer.type = "text/html; charset=utf-8";
  answer.body = document("<meta http-equiv=\"refresh\" content=\"0; url=/\">",
                         "<p><a href=\"/\">Go on to the page</a></p>");
  answer.headers = {{"Set-Cookie", cookie_name(request.host) + token +
                                       "; Path=/; Max-Age=2592000; HttpOnly; SameSite=Strict" +
                                       (request.is_over_tls ? "; Secure" : "")}};
  return answer;
}

}  // namespace

bool is_same_secret(std::string_view given, std::string_view secret) {
  if (given.size() != secret.size()) return false;
  volatile unsigned difference = 0;  // volatile: no compiler may leave the loop early
  for (std::size_t i = 0; i < secret.size(); ++i)
    difference = difference | (static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(secret[i]));
  return difference == 0;
}

std::optional<OfferedToken> offered_token(const PageRequest& request) {
  if (request.path == "/") {
    if (auto token = value_of(request.query, '&', kParameter)) return OfferedToken{std::move(*token), true};
  }
  const std::string_view scheme = std::string_view(request.authorization).substr(0, kBearer.size());
  if (is_same_but_for_case(scheme, kBearer))
    return OfferedToken{request.authorization.substr(kBearer.size()), false};
  if (auto token = value_of(request.cookie, ';', cookie_name(request.host)))
    return OfferedToken{std::move(*token), false};
  return std::nullopt;
}

PageAccess::PageAccess(std::string token) : token_(std::move(token)) {}

std::optional<PageAnswer> PageAccess::answer_instead(const PageRequest& request,
                                                     TokenGuesses::Time now) const {
  if (token_.empty()) return std::nullopt;
  const auto offered = offered_token(request);
  if (!offered) return ask_for_token(request, false);
  if (!guesses_.may_try(request.client_network, now)) return ask_to_wait();
  if (!is_same_secret(offered->token, token_)) {
    guesses_.note_wrong(request.client_network, offered->token, now);
    return ask_for_token(request, true);
  }
  if (offered->is_by_link) return welcome(request, token_);
  return std::nullopt;
}

bool PageAccess::may_change(const PageRequest& request) const {
  if (!is_from_own_page(request)) return false;
  if (token_.empty()) return request.is_from_this_computer && !request.is_forwarded;
  const auto offered = offered_token(request);
  return offered && is_same_secret(offered->token, token_);
}

}  // namespace geoloc::io
