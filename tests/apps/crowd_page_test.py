# SPDX-License-Identifier: Apache-2.0
"""The page with far more objects than a map can show one by one."""
import json
import unittest

from browser import BrowserTest, url_of
from support import BIN, Live, run

SCREENSHOTS = BIN.parent / "screenshots"  # for manual inspection

MANY = 12000  # three times what the server sends at once
SPACING_M = 12.0  # so that none is taken for its neighbour
IN_A_ROW = 120


class CrowdPage(BrowserTest):
    def field(self):
        """A flight that has MANY objects in a field, each a copy of one that was found."""
        recording, file = self.folder / "flight", self.folder / "flight.json"
        run("geoloc_sim", "--record", recording, "--start-s", 70, "--end-s", 80)
        run("geoloc_replay", recording, "--flight-id", "flight", "--summary", file, "--out", self.objects_file)
        summary = json.loads(file.read_text())
        one = summary["objects"][0]
        one["shared_error_m"] = [row[:3] for row in one["shared_error_m"]]  # the others matter little, and fill the file
        summary["objects"] = [{**one, "id": i + 1, "position_in_enu_m": [SPACING_M * (i % IN_A_ROW), SPACING_M * (i // IN_A_ROW), 0.0]}
                              for i in range(MANY)]
        summary["apart"] = []
        del summary["part"]  # tells of the errors that were left out
        summary["version"] = 1  # has none
        file.write_text(json.dumps(summary))
        return file

    def test_all_objects_come_and_a_tap_on_a_crowd_leads_to_its_members(self):
        with Live("geoloc_fuse", self.field(), "--http", "0", "--out", self.objects_file) as fleet:
            page = self.open_screen("desktop_light", url_of(fleet))
            page.wait_for_selector(f"#object-count:has-text('{MANY} confirmed')")
            SCREENSHOTS.mkdir(exist_ok=True)
            page.screenshot(path=SCREENSHOTS / "crowds.png")
            self.assertEqual(page.locator("#news").is_visible(), False)  # they were there before the page
            self.assertLess(page.locator("#objects li[data-id]").count(), MANY)
            box = page.locator("#map-canvas").bounding_box()
            opened = page.locator("#selected:not([hidden]) .place")
            for i in range(25):  # crowds lead nearer, until an object is within reach of one of these taps
                page.mouse.click(box["x"] + box["width"] / 2 + 15 * (i % 5), box["y"] + box["height"] / 2 + 15 * (i // 5))
                page.wait_for_timeout(300)
                if opened.is_visible():
                    break
            page.screenshot(path=SCREENSHOTS / "crowd.png")
            self.assertTrue(opened.is_visible())
            self.assertEqual(self.faults, [])
            self.assertEqual(fleet.interrupt(), 0)


if __name__ == "__main__":
    unittest.main()
