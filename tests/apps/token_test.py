# SPDX-License-Identifier: Apache-2.0
"""The live page that asks for a token: who has none sees nothing, and the token goes nowhere else."""
import http.client
import os
import re
import stat
import subprocess
import unittest

from browser import BrowserTest, OtherSite
from support import BIN, PATIENCE_S, AppTest, Live, open_terminal, run

PATHS = "/", "/page.js", "/palette.css", "/events", "/frame", "/settings", "/objects/1", "/nowhere"


def ask(url, path, **headers):
    """Status, headers and the beginning of the body of an answer."""
    connection = http.client.HTTPConnection(url.split("/")[2], timeout=PATIENCE_S)
    try:
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        is_stream = answer.headers.get_content_type() == "text/event-stream"
        return answer.status, answer.headers, (answer.read(5) if is_stream else answer.read()).decode("utf-8", "replace")
    finally:
        connection.close()


class Guarded(AppTest):
    """A replay whose page asks for a token."""

    def setUp(self):
        super().setUp()
        self.recording = self.make_recording()
        self.file = self.folder / "page.token"

    def replay(self, *arguments):
        return Live("geoloc_replay", self.recording, "--speed", "0", "--out", self.folder / "objects.geojson", *arguments)

    def page_of(self, replay):
        replay.wait_for("the page stays at")
        return replay.wait_for(r"^page: (http://127\.0\.0\.1:\d+/)")[1]


class PageToken(Guarded):
    """What programs get."""

    def test_a_page_with_a_token_is_for_those_who_have_it(self):
        with self.replay("--http", "0", "--http-token", self.file) as replay:
            url = self.page_of(replay)
            token = self.file.read_text().strip()
            self.assertRegex(token, r"^[0-9a-f]{32}$")
            self.assertEqual(stat.S_IMODE(self.file.stat().st_mode), 0o600)

            for path in PATHS:
                with self.subTest(path):
                    status, headers, body = ask(url, path)
                    self.assertEqual(status, 401)
                    self.assertIn("Bearer", headers["WWW-Authenticate"])
                    self.assertNotIn("Set-Cookie", headers)
                    self.assertNotIn(token, body)
                    self.assertEqual(ask(url, path, Authorization="Bearer " + token[::-1])[0], 401)
            self.assertIn("--http-token", ask(url, "/")[2])
            self.assertEqual(ask(url, "/?token=" + token[::-1])[0], 401)

            status, headers, body = ask(url, "/?token=" + token)
            self.assertEqual(status, 200)
            self.assertIn('content="0; url=/"', body)
            cookie, *rules = headers["Set-Cookie"].split("; ")
            self.assertLessEqual({"HttpOnly", "SameSite=Strict", "Path=/"}, set(rules))
            for credential in {"Cookie": cookie}, {"Authorization": "Bearer " + token}:
                for path in PATHS:
                    with self.subTest(path, **credential):
                        expected = {"/frame": (204,), "/objects/1": (200, 404), "/nowhere": (404,)}.get(path, (200,))
                        status, headers, body = ask(url, path, **credential)
                        self.assertIn(status, expected)
                        self.assertNotIn(token, body + str(headers))
            self.assertEqual(ask(url, "/events", Cookie=cookie)[2], "data:")
            self.assertEqual(replay.interrupt(), 0)
        self.assertNotIn(token, "\n".join(replay.lines))
        self.assertIn(str(self.file), "\n".join(replay.lines))

    def test_guessing_is_slow_and_does_not_shut_out_the_curious(self):
        with self.replay("--http", "0", "--http-token", self.file) as replay:
            url = self.page_of(replay)
            answers = [ask(url, "/events", Authorization=f"Bearer guess {i}")[0] for i in range(30)]
            self.assertEqual(answers, [401] * 10 + [429] * 20)
            self.assertEqual(ask(url, "/")[0], 401)

    def test_the_token_stays_over_restarts_and_is_shown_to_a_terminal_alone(self):
        self.file.write_text("a-token-of-my-own\n")
        self.file.chmod(0o600)
        terminal, theirs = open_terminal()
        with os.fdopen(terminal, "rb", buffering=0) as screen:
            replay = subprocess.Popen([BIN / "geoloc_replay", self.recording, "--http", "0", "--http-token", self.file,
                                       "--out", self.folder / "objects.geojson"], stderr=theirs)
            os.close(theirs)
            try:
                shown = b""
                while b"\n" not in shown.partition(b"page: ")[2]:
                    shown += screen.read(1024)
                link = re.search(r"page: (http://\S+)", shown.decode())[1]
                self.assertRegex(link, r"/\?token=a-token-of-my-own$")
                self.assertIn("geoloc_", ask(link, "/?token=a-token-of-my-own")[1]["Set-Cookie"])
            finally:
                replay.kill()
                replay.wait()
        self.assertEqual(self.file.read_text(), "a-token-of-my-own\n")

    def test_the_network_is_warned_of_with_the_remedy(self):
        with self.replay("--http", "0.0.0.0:0") as replay:
            self.page_of(replay)
            replay.wait_for("WARNING.*EVERYONE.*--http-token FILE")
        with self.replay("--http", "0.0.0.0:0", "--http-token", self.file) as replay:
            self.page_of(replay)
            replay.wait_for("not encrypted.*docs/live_page.md")
            self.assertNotIn("WARNING", "\n".join(replay.lines))

    def test_what_is_no_token_is_refused_before_anything_starts(self):
        def refused(*reasons, options=("--http", "0")):
            result = run("geoloc_replay", self.recording, *options, "--http-token", self.file)
            self.assert_refused(result, "--http-token", *reasons)

        self.file.write_text("0123456789abcdef\n")
        self.file.chmod(0o644)
        refused("chmod 600", self.file)
        self.file.chmod(0o600)
        self.file.write_text("short\n")
        refused("holds no token", self.file)
        self.assertEqual(self.file.read_text(), "short\n")
        refused("input of this run", options=("--http", "0", "--out", self.file))
        result = run("geoloc_replay", self.recording, "--http-token", self.file)
        self.assertNotEqual(result.status, 0)
        self.assertIn("--http", result.err)
        self.file = self.folder / "nowhere" / "page.token"
        refused("cannot be written", self.file)


class TokenInBrowser(Guarded, BrowserTest):
    """What an operator does with a link, or with the token itself."""

    def new_page(self):
        page = self.browser.new_context().new_page()
        page.set_default_timeout(1000 * PATIENCE_S)
        return page

    def assert_shows_the_run(self, page, url):
        page.wait_for_selector("#objects li")
        self.assertEqual(page.url, url)
        self.assertEqual(page.evaluate("document.cookie"), "")

    def test_a_link_or_the_token_opens_the_page(self):
        with self.replay("--http", "0", "--http-token", self.file) as replay:
            url = self.page_of(replay)
            link = url + "?token=" + self.file.read_text().strip()
            by_link = self.new_page()
            by_link.goto(link)
            self.assert_shows_the_run(by_link, url)
            by_link.reload()
            self.assert_shows_the_run(by_link, url)

            by_form = self.new_page()
            by_form.goto(url)
            for token, proof in ("wrong", "text=That is not the token"), (self.file.read_text().strip(), "#objects li"):
                by_form.fill("input[name=token]", token)
                by_form.click("button")
                by_form.wait_for_selector(proof)
            self.assert_shows_the_run(by_form, url)

            with OtherSite("text/html", f'<a href="{link}">the drone</a>'.encode()) as other:
                from_elsewhere = self.new_page()
                from_elsewhere.goto(f"http://localhost:{other.port}/")  # for browsers another site than 127.0.0.1
                from_elsewhere.click("a")
                self.assert_shows_the_run(from_elsewhere, url)
            self.assertEqual(replay.interrupt(), 0)


if __name__ == "__main__":
    unittest.main()
