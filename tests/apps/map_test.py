# SPDX-License-Identifier: Apache-2.0
"""Background maps of the live page from files: a tile shows what the file has at that place, by GDAL's own reading."""
import math
import shutil
import subprocess
import unittest
import urllib.error
import urllib.request

from support import PATIENCE_S, AppTest, Live, run

# Where the simulated flights are: west, north, east, south in degrees.
AREA = -43.134, -22.905, -43.131, -22.908
SIDE = 300
COLOURS = {"north-west": (255, 0, 0), "north-east": (0, 255, 0), "south-west": (0, 0, 255), "south-east": (255, 255, 0)}


def place_of(corner):
    """Longitude, latitude in the middle of a quarter."""
    west, north, east, south = AREA
    return (west + (east - west) * (0.25 if corner.endswith("west") else 0.75),
            south + (north - south) * (0.75 if corner.startswith("north") else 0.25))


def tile_at(longitude, latitude, zoom):
    """Column, row of the tile, and the place's pixel in it."""
    x = (longitude + 180) / 360 * 2**zoom
    y = (1 - math.asinh(math.tan(math.radians(latitude))) / math.pi) / 2 * 2**zoom
    return int(x), int(y), int(256 * (x % 1)), int(256 * (y % 1))


def gdal(tool, *arguments):
    return subprocess.run([tool, *map(str, arguments)], capture_output=True, text=True, check=True).stdout


def get(url):
    """Status and body."""
    try:
        with urllib.request.urlopen(url, timeout=PATIENCE_S) as answer:
            return answer.status, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, error.read()


@unittest.skipUnless(shutil.which("gdal_translate"), "needs gdal-bin")
class BackgroundMap(AppTest):
    def setUp(self):
        super().setUp()
        self.recording = self.make_recording()
        quarters = [["north-west", "north-east"], ["south-west", "south-east"]]
        pixels = b"".join(bytes(COLOURS[name]) * (SIDE // 2) for row in range(SIDE) for name in quarters[2 * row // SIDE])
        self.orthophoto = self.folder / "orthophoto.tif"
        west, north, east, south = AREA
        self.picture = self.folder / "picture.ppm"
        self.picture.write_bytes(f"P6 {SIDE} {SIDE} 255\n".encode() + pixels)
        gdal("gdal_translate", "-q", "-a_srs", "EPSG:4326", "-a_ullr", west, north, east, south, self.picture, self.orthophoto)

    def replay(self, *arguments):
        return Live("geoloc_replay", self.recording, "--http", "0", "--speed", "0", "--out", self.folder / "objects.geojson",
                    *arguments)

    def page_of(self, replay):
        replay.wait_for("the page stays at")
        return replay.wait_for(r"^page: (http://127\.0\.0\.1:\d+/)")[1]

    def colour_at(self, url, longitude, latitude, zoom):
        """Red, green, blue, alpha of a place; nothing where there is no tile."""
        x, y, column, row = tile_at(longitude, latitude, zoom)
        status, png = get(f"{url}map/{zoom}/{x}/{y}")
        if status == 404:
            return None
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        file = self.folder / "tile.png"
        file.write_bytes(png)
        return tuple(map(int, gdal("gdallocationinfo", "-valonly", file, column, row).split()))

    def as_utm(self):
        file = self.folder / "utm.tif"
        gdal("gdalwarp", "-q", "-t_srs", "EPSG:32723", "-dstalpha", self.orthophoto, file)
        return file

    def as_mbtiles(self):
        file = self.folder / "tiles.mbtiles"
        gdal("gdal_translate", "-q", "-of", "MBTILES", self.orthophoto, file)
        return file

    def as_palette(self):
        """Its red as numbers of colours."""
        view, file = self.folder / "palette.vrt", self.folder / "palette.tif"
        number = gdal("gdal_translate", "-q", "-of", "VRT", "-b", 1, self.orthophoto, "/vsistdout/")
        table = "".join(f'<Entry c1="{r}" c2="{g}" c3="{b}" c4="255"/>' for r, g, b in [(0, 0, 255)] + [(255, 0, 0)] * 255)
        view.write_text(number.replace("<ColorInterp>Red</ColorInterp>",
                                       f"<ColorInterp>Palette</ColorInterp><ColorTable>{table}</ColorTable>"))
        gdal("gdal_translate", "-q", view, file)
        return file

    def test_a_palette_is_looked_up(self):
        with self.replay("--map", self.as_palette()) as replay:
            url = self.page_of(replay)
            for corner, (red, *_) in COLOURS.items():
                self.assertEqual(self.colour_at(url, *place_of(corner), 18), (255, 0, 0, 255) if red else (0, 0, 255, 255))

    def test_a_tile_shows_what_the_file_has_there(self):
        files = {"GeoTIFF": self.orthophoto, "UTM": self.as_utm(), "MBTiles": self.as_mbtiles()}
        for name, file in files.items():
            with self.subTest(name), self.replay("--map", file) as replay:
                url = self.page_of(replay)
                self.assertIn(b'"tile_url":"map/{z}/{x}/{y}"', get(url + "settings")[1])
                for corner, colour in COLOURS.items():
                    for zoom in 15, 18, 21:
                        shown = self.colour_at(url, *place_of(corner), zoom)
                        self.assertEqual(shown[3], 255)
                        for is_value, want in zip(shown, colour):
                            self.assertAlmostEqual(is_value, want, delta=12, msg=f"{corner} at zoom {zoom}: {shown}")
                self.assertIsNone(self.colour_at(url, AREA[2] + 0.1, AREA[1], 18), "beside the map")
                west, north, *_ = AREA
                self.assertEqual(self.colour_at(url, west - 0.003, north + 0.003, 14)[3], 0, "the tile's part beside the map")

    def test_no_address_harms(self):
        with self.replay("--map", self.orthophoto) as replay:
            url = self.page_of(replay)
            for address in ("99/0/0", "-1/0/0", "1/2/0", "1/0/-1", "1/0", "1/0/0/0", "1/0/0x", "23/8388608/0", "a/b/c", "",
                            "99999999999/0/0", "../settings"):
                with self.subTest(address):
                    self.assertEqual(get(f"{url}map/{address}")[0], 404)
            self.assertEqual(get(f"{url}map/0/0/0")[0], 200)

    def test_an_elevation_model_is_shown_as_a_relief(self):
        hills = self.folder / "hills"
        self.assertEqual(run("geoloc_sim", "--record", hills, "--hills-m", 5, "--start-s", 80, "--end-s", 100).status, 0)
        self.recording = hills
        with self.replay("--ground", hills / "terrain.asc") as replay:
            url = self.page_of(replay)
            greys = {self.colour_at(url, -43.1325 + 0.0001 * step, -22.9065, 19) for step in range(10)}
            self.assertTrue(all(shown[1] == 255 for shown in greys), greys)
            self.assertGreater(len(greys), 3, "hills have slopes")

    def test_unusable_maps_are_named_before_anything_starts(self):
        nowhere, deep, cut = self.folder / "nowhere.tif", self.folder / "deep.tif", self.as_mbtiles()
        gdal("gdal_translate", "-q", self.picture, nowhere)
        gdal("gdal_translate", "-q", "-ot", "UInt16", self.orthophoto, deep)
        cut.write_bytes(cut.read_bytes()[:3000])
        for file, reason in {nowhere: "does not say where it lies", deep: "gdal_translate -ot Byte", cut: "not a map",
                             self.write("text.tif", "no picture"): "not a map", self.folder / "missing.tif": "not a map"}.items():
            with self.subTest(str(file)):
                result = run("geoloc_replay", self.recording, "--http", "0", "--map", file)
                self.assert_refused(result, f"--map {file}")
                self.assertIn(reason, result.err)
        self.assert_refused(run("geoloc_replay", self.recording, "--map", self.orthophoto), "--map requires --http")

    def test_damage_shows_nothing_and_ends_nothing(self):
        damaged = self.folder / "damaged.tif"
        damaged.write_bytes(self.orthophoto.read_bytes()[:20000])
        with self.replay("--map", damaged) as replay:
            url = self.page_of(replay)
            for corner in COLOURS:
                self.colour_at(url, *place_of(corner), 19)
            self.assertEqual(get(url + "settings")[0], 200)


if __name__ == "__main__":
    unittest.main()
