# SPDX-License-Identifier: Apache-2.0
"""The live page, in a browser during a live run and with visitors of all kinds."""
import json
import math
import re
import socket
import threading
import time
import unittest
import urllib.request

from browser import HOSTILE_NAME, SCREENS, BrowserTest, OtherSite, url_of
from support import BIN, PATIENCE_S, AppTest, Live, World, run

SCREENSHOTS = BIN.parent / "screenshots"  # for manual inspection

# Where the map shows the first pixel of a colour, in the page's coordinates; null where there is none.
FIND_COLOUR = """([selector, colour]) => {
  const canvas = document.querySelector(selector), probe = document.createElement("canvas").getContext("2d");
  probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(colour).trim() || colour;
  probe.fillRect(0, 0, 1, 1);
  const [r, g, b] = probe.getImageData(0, 0, 1, 1).data, { width, height } = canvas;
  const pixels = canvas.getContext("2d").getImageData(0, 0, width, height).data, box = canvas.getBoundingClientRect();
  for (let y = Math.ceil(height * 0.3); y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const i = 4 * (y * width + x);
      if (Math.abs(pixels[i] - r) + Math.abs(pixels[i + 1] - g) + Math.abs(pixels[i + 2] - b) < 6)
        return [box.x + x * box.width / width, box.y + y * box.height / height];
    }
  }
  return null;
}"""


# A canvas cannot be read after an image from another server was drawn on it.
IS_TAINTED = """() => {
  try {
    document.querySelector("#map-canvas").getContext("2d").getImageData(0, 0, 1, 1);
    return false;
  } catch {
    return true;
  }
}"""


FOUR_NOTATIONS = (r"^-?\d+\.\d{8}, -?\d+\.\d{8} \| \d+°\d\d′\d\d\.\d{3}″[NS] \d+°\d\d′\d\d\.\d{3}″[EW] "
                  r"\| 23K \d+\.\d\d E \d+\.\d\d N \| 23KPQ\d{10}$")


def tile_of(feature, zoom):
    """The Web Mercator tile that holds a GeoJSON point."""
    longitude, latitude = map(math.radians, feature["geometry"]["coordinates"][:2])
    turns = (longitude / math.tau + 0.5, 0.5 - math.asinh(math.tan(latitude)) / math.tau)
    return (zoom, *(int(2**zoom * turn) for turn in turns))


TILE = b'<svg xmlns="http://www.w3.org/2000/svg" width="256" height="256"><path d="M0 0h256v256H0z" fill="#d0e8c0"/></svg>'


class LivePage(BrowserTest):
    """What an operator is promised, on a telephone and on a desk, by day and by night."""

    def test_shows_a_live_run_on_every_screen(self):
        names = self.write("names.txt", HOSTILE_NAME + "\n")
        world = World()
        recording = self.folder / "flight"
        with world.watch("--http", "0", "--class-names", names, "--out", self.objects_file, "--record", recording) as app:
            url = url_of(app)
            pages = {name: self.open_screen(name, url) for name in SCREENS}
            with world.fly("--start-s", 80, "--end-s", 98, "--speed", 3):
                pages["desktop_light"].wait_for_selector("#video:not([hidden])")
                self.assertTrue(self.finds_colour(pages["desktop_light"], "#video-canvas", "#ffd23f"))
                for page in pages.values():
                    page.wait_for_selector("#objects li[data-id]:not(.tentative)")
                self.check_state(pages["desktop_light"])
                for name, page in pages.items():
                    self.check_screen(name, page, url)
                self.check_copy(pages["desktop_light"])
            self.assertEqual(self.faults, [])
            self.assertEqual(self.hosts, {url.split("/")[2]})
            self.assertEqual(app.interrupt(), 0)  # with all pages open
            pages["phone_dark"].wait_for_selector("#notice:has-text('does not answer')")
        self.check_recorded_pictures(recording)

    def test_draws_the_tiles_of_a_server_where_one_is_configured(self):
        with OtherSite("image/svg+xml", TILE) as tiles:
            tile_url = f"http://127.0.0.1:{tiles.port}/{{z}}/{{x}}/{{y}}.svg"
            config = self.write("config.json", {"live_page": {"tile_url": tile_url, "tile_attribution": "<b>Maps</b>"}})
            with Live("geoloc_replay", self.make_recording(), "--config", config, "--http", "0", "--speed", "0",
                      "--out", self.objects_file) as replay:
                url = url_of(replay)
                replay.wait_for("the page stays at")
                page = self.open_screen("desktop_light", url)
                page.wait_for_function(IS_TAINTED)
                self.assertEqual(page.locator("#attribution").inner_text(), "<b>Maps</b>")
                self.assertEqual(replay.interrupt(), 0)
        self.assertEqual([fault for fault in self.faults if "CONNECTION" not in fault], [])
        asked = {tuple(map(int, re.findall(r"\d+", path))) for path in tiles.asked}  # (zoom, x, y)
        for feature in json.loads(self.objects_file.read_text())["features"]:
            self.assertTrue(any(tile_of(feature, zoom) == (zoom, x, y) for zoom, x, y in asked), feature)

    def finds_colour(self, page, selector, colour):
        """Waits until it is drawn: the page follows the run. One look, since the next frame may be half drawn."""
        return page.wait_for_function(FIND_COLOUR, arg=[selector, colour]).json_value()

    def check_state(self, page):
        page.wait_for_selector("#light-link:not(.bad)")
        page.wait_for_selector("#light-video:not(.bad)")
        page.wait_for_selector("#calibration tr:has-text('Image delay'):has-text('±')")
        page.wait_for_selector("#counters:has-text('Frames located')")
        self.assertIn(HOSTILE_NAME, page.locator("#objects").inner_text())
        self.assertEqual(page.locator("#objects img[src=x]").count(), 0)
        self.check_pictures(page)

    def check_recorded_pictures(self, recording):
        """The recording shows the same objects again."""
        found = {feature["properties"]["id"] for feature in json.loads(self.objects_file.read_text())["features"]}
        pictured = {int(file.stem) for file in (recording / "pictures").iterdir()}
        self.assertLessEqual(found, pictured)
        with Live("geoloc_replay", recording, "--http", "0", "--speed", "0") as replay:
            url = url_of(replay)
            replay.wait_for("the page stays at")
            for chosen in found:
                with urllib.request.urlopen(f"{url}objects/{chosen}/picture", timeout=PATIENCE_S) as answer:
                    self.assertEqual(answer.headers["Content-Type"], "image/jpeg")
                    self.assertEqual(answer.read(), (recording / "pictures" / f"{chosen}.jpg").read_bytes())

    def check_pictures(self, page):
        """Objects have a picture, cut from the video."""
        page.wait_for_function("""() => [...document.querySelectorAll("#objects img:not([hidden])")]
          .some((image) => image.complete && image.naturalWidth >= 40)""")

    def selects_an_object(self, page):
        """Clicks where the map shows one; again where it was drawn anew between the look and the click."""
        for _ in range(10):
            page.mouse.click(*self.finds_colour(page, "#map-canvas", "--object"))
            deadline = time.monotonic() + 10
            while time.monotonic() < deadline:
                if page.locator("#selected:not([hidden]) .place").is_visible():
                    return
                page.wait_for_timeout(100)
        self.fail("clicks on objects select none")

    def check_screen(self, name, page, url):
        """A click on an object shows its position; nothing overflows; a screenshot is kept."""
        page.bring_to_front()
        page.locator("#fit").click()  # the map stands still from here on
        page.wait_for_selector("#fit[aria-pressed=false]")
        self.selects_an_object(page)
        coordinates = self.wait_for_coordinates(page, url)
        pointed = re.findall(r"-?\d+\.\d+", page.locator("#readout").inner_text())[:2]  # where the click was
        for read, told in zip(pointed, coordinates["degrees"].split(", ")):
            self.assertAlmostEqual(float(read), float(told), delta=2e-5)  # 2 m; a pixel is a few decimetres
        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth - innerWidth"), 0)
        page.locator("#fit").click()
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)
        page.screenshot(path=SCREENSHOTS / f"{name}.png", full_page=name.startswith("phone"))

    def wait_for_coordinates(self, page, url):
        """The server's data of the selected object, once the page shows the same: both follow the run."""
        chosen = int(re.match(r"\d+", page.locator("#selected h2").inner_text())[0])
        deadline = time.monotonic() + PATIENCE_S
        while True:
            with urllib.request.urlopen(f"{url}objects/{chosen}", timeout=PATIENCE_S) as answer:
                coordinates = json.load(answer)["coordinates"]
            shown = page.locator("#selected .place dd").all_inner_texts()
            self.assertRegex(" | ".join(shown), FOUR_NOTATIONS)
            places = [list(map(float, text.split(", "))) for text in (shown[0], coordinates["degrees"])]
            if math.dist(*places) < 1e-7:  # a centimetre: the page is not sent changes of less than a millimetre
                return coordinates
            self.assertLess(time.monotonic(), deadline, f"{shown} is not {coordinates}")
            page.wait_for_timeout(100)

    def check_copy(self, page):
        page.bring_to_front()
        page.locator("#selected .place button").first.click()
        page.wait_for_selector("#selected button:has-text('Copied')")
        copied = page.evaluate("navigator.clipboard.readText()")
        self.assertRegex(copied, r"^-22\.\d{8}, -43\.\d{8}$")


class Visitor:
    """A client of the event stream that reads all of it, or nothing."""

    def __init__(self, url, reads):
        host, port = url.split("/")[2].split(":")
        self._socket = socket.socket()
        if not reads:
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
        self._socket.connect((host, int(port)))
        self._socket.sendall(f"GET /events HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
        self.received = 0
        self._thread = threading.Thread(target=self._read if reads else lambda: None)
        self._thread.start()

    def _read(self):
        while piece := self._socket.recv(65536):
            self.received += len(piece)

    def leave(self):
        self._thread.join()
        self._socket.close()


class Visitors(AppTest):
    """Whoever visits, and however: the results are the same, and the program ends when it is told to."""

    def test_fifty_pages_change_no_byte_and_delay_no_end(self):
        recording = self.make_recording()
        alone, watched = self.folder / "alone.geojson", self.folder / "watched.geojson"
        self.assertEqual(run("geoloc_replay", recording, "--out", alone).status, 0)
        with Live("geoloc_replay", recording, "--out", watched, "--http", "0", "--speed", "10") as replay:
            url = url_of(replay)
            visitors = [Visitor(url, reads=i % 10 != 0) for i in range(50)]
            replay.wait_for("the page stays at")
            self.assertEqual(alone.read_bytes(), watched.read_bytes())
            self.assertEqual(replay.interrupt(), 0)
        for visitor in visitors:
            visitor.leave()
        self.assertTrue(all(visitor.received > 1000 for i, visitor in enumerate(visitors) if i % 10 != 0))

    def test_ctrl_c_ends_a_replay_that_is_played(self):
        recording = self.make_recording()
        objects = self.folder / "objects.geojson"
        with Live("geoloc_replay", recording, "--out", objects, "--http", "0") as replay:
            url_of(replay)
            self.assertEqual(replay.interrupt(), 0)
        self.assertEqual(json.loads(objects.read_text())["type"], "FeatureCollection")

    def test_what_is_no_place_for_a_page_is_refused(self):
        recording = self.make_recording()
        for endpoint in "port", "1.2.3.4:80", ":80", "127.0.0.1:99999":
            self.assert_refused(run("geoloc_replay", recording, "--http", endpoint), "--http", endpoint)


if __name__ == "__main__":
    unittest.main()
