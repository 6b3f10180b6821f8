# SPDX-License-Identifier: Apache-2.0
"""A browser for the tests of the live page, and another site for it to visit."""
import http.server
import shutil
import threading
import unittest

from support import PATIENCE_S, AppTest

try:
    from playwright.sync_api import sync_playwright
except ImportError:
    sync_playwright = None

CHROMIUM = shutil.which("chromium")
HOSTILE_NAME = "<img src=x onerror=document.title='run'>\"&"

SCREENS = {
    "desktop_light": {"viewport": {"width": 1360, "height": 820}, "color_scheme": "light"},
    "desktop_dark": {"viewport": {"width": 1360, "height": 820}, "color_scheme": "dark"},
    "phone_light": {"viewport": {"width": 390, "height": 844}, "color_scheme": "light", "device_scale_factor": 2,
                    "has_touch": True},
    "phone_dark": {"viewport": {"width": 390, "height": 844}, "color_scheme": "dark", "device_scale_factor": 2,
                   "has_touch": True},
}


def url_of(program):
    return program.wait_for(r"^page: (http://127\.0\.0\.1:\d+/)")[1]


class OtherSite:
    """A server that answers every request with the same content; `asked` holds the paths of the requests."""

    def __init__(self, content_type, content):
        self.asked = asked = []

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                asked.append(self.path)
                self.send_response(200)
                self.send_header("Content-Type", content_type)
                self.end_headers()
                self.wfile.write(content)

            def log_message(self, *_):
                pass

        self._server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self._thread = threading.Thread(target=self._server.serve_forever)
        self.port = self._server.server_port

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()


@unittest.skipUnless(sync_playwright, "no Playwright: scripts/test.sh installs it")
@unittest.skipUnless(CHROMIUM, "no Chromium: apt-get install chromium")
class BrowserTest(AppTest):
    """A test with a browser. `faults` holds what its pages complain of, `hosts` whom they asked."""

    def setUp(self):
        super().setUp()
        self.objects_file = self.folder / "objects.geojson"
        self.faults = []
        self.hosts = set()
        self.playwright = sync_playwright().start()
        self.addCleanup(self.playwright.stop)
        self.browser = self.playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        self.addCleanup(self.browser.close)

    def open_screen(self, name, url):
        context = self.browser.new_context(permissions=["clipboard-read", "clipboard-write"], **SCREENS[name])
        page = context.new_page()
        page.set_default_timeout(1000 * PATIENCE_S)
        page.on("pageerror", lambda error: self.faults.append(f"{name}: {error}"))
        page.on("console", lambda message: self.faults.append(f"{name}: {message.text}")
                if message.type == "error" else None)
        page.on("request", lambda request: self.hosts.add(request.url.split("/")[2]))
        page.goto(url)
        return page
